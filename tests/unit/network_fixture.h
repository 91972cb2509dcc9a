#pragma once

#include <deal.II/base/mpi.h>
#include <deal.II/lac/full_matrix.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "flow/network.h"
#include "stockwork/base/quantity.h"

/// A fracture in rock so simple that much is known exactly: n segments of length h in a row, on a
/// Winkler foundation, w_i = u_i with stiffness k [Pa/m], and one dof of pore pressure for each
/// segment if wanted. Runs on any number of ranks; segment i belongs to rank i % n_ranks.
class Chain
{
public:
  /// Adds everything up in one dense system: bulk dofs first, then extra unknowns.
  class DenseSink : public stockwork::Sink
  {
  public:
    DenseSink(const unsigned int n_bulk, const unsigned int n)
      : matrix(n, n)
      , residual(n)
      , n_bulk(n_bulk)
    {
    }

    void add(const stockwork::LocalSystem &local) override
    {
      std::vector<unsigned int> index(local.bulk.begin(), local.bulk.end());
      for (const unsigned int e : local.extra)
        index.push_back(n_bulk + e);
      for (unsigned int i = 0; i < index.size(); ++i)
      {
        residual(index[i]) += local.residual(i);
        for (unsigned int j = 0; j < index.size(); ++j)
          matrix(index[i], index[j]) += local.matrix(i, j);
      }
    }

    void sum_over_ranks()
    {
      dealii::Utilities::MPI::sum(matrix, MPI_COMM_WORLD, matrix);
      for (auto &r : residual)
        r = dealii::Utilities::MPI::sum(r, MPI_COMM_WORLD);
    }

    dealii::FullMatrix<double> matrix;
    dealii::Vector<double> residual;

  private:
    unsigned int n_bulk;
  };

  using Entries = std::vector<std::pair<std::string, std::string>>;

  unsigned int n;
  double h = 0.5;
  double stiffness = 1e9, viscosity = 1e-3, compressibility = 0., mobility = 0.;
  double pore_storage = 0.; ///< > 0: with pore pressures
  unsigned int n_model = 0; ///< extra unknowns of "the model" before those of the flow
  /// To change the segments before they are handed over.
  std::function<void(std::vector<stockwork::Segment<2>> &)> edit = [](auto &) {};

  stockwork::Network<2> network;
  stockwork::Collectives collectives{MPI_COMM_WORLD};
  std::vector<double> bulk, bulk_reference;   ///< replicated
  std::vector<double> extra, extra_reference; ///< the model's, the flow's
  stockwork::StepContext context;

  explicit Chain(const unsigned int n)
    : n(n)
  {
    context.time = 0.;
  }

  /// @param entries of the deck, "Wells/Well 1/Rate"
  void set_up(const Entries &entries)
  {
    dealii::ParameterHandler prm;
    network.declare_parameters(prm);
    for (const auto &entry : entries)
    {
      std::size_t begin = 0, sections = 0;
      for (std::size_t end; (end = entry.first.find('/', begin)) != std::string::npos;
           begin = end + 1, ++sections)
        prm.enter_subsection(entry.first.substr(begin, end - begin));
      prm.set(entry.first.substr(begin), entry.second);
      for (; sections > 0; --sections)
        prm.leave_subsection();
    }
    network.parse_parameters(prm);
    network.set_fluid(viscosity, compressibility, mobility);
    prm.enter_subsection("Fracture flow");
    network.set_scales(
      stockwork::get_optional_quantity(prm, "Minimum aperture", stockwork::dimension::length)
        .value_or(1e-5),
      1e6, 1e-4, 1.);
    prm.leave_subsection();
    update_segments();
    bulk.resize(n_bulk());
    bulk_reference = bulk;
  }

  unsigned int n_bulk() const
  {
    return pore_storage > 0. ? 2 * n : n;
  }

  std::vector<stockwork::Segment<2>> segments() const
  {
    std::vector<stockwork::Segment<2>> all(n);
    for (unsigned int i = 0; i < n; ++i)
    {
      auto &segment = all[i];
      segment.key = 1000 + 7 * i;
      segment.centre = dealii::Point<2>((i + 0.5) * h, 0.);
      segment.normal = dealii::Point<2>(0., 1.);
      segment.area = h;
      segment.opening.bulk = {i};
      segment.opening.bulk_coefficients = {1.};
      if (pore_storage > 0.)
      {
        segment.pore_pressure.bulk = {n + i};
        segment.pore_pressure.bulk_coefficients = {1.};
      }
      if (i > 0)
        segment.neighbours.push_back({1000 + 7 * (i - 1), h / 2, 1.});
      if (i + 1 < n)
        segment.neighbours.push_back({1000 + 7 * (i + 1), h / 2, 1.});
    }
    return all;
  }

  /// As after growth: new unknowns start from their initial value, old ones keep theirs.
  void update_segments()
  {
    auto all = segments();
    edit(all);
    std::vector<stockwork::Segment<2>> mine;
    const unsigned int n_ranks = dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
    for (unsigned int i = 0; i < n; ++i)
      if (i % n_ranks == collectives.rank())
        mine.push_back(all[i]);
    const auto earlier = [&](const std::uint64_t key)
    {
      const auto place = std::find(keys.begin(), keys.end(), key);
      return place != keys.end() ? std::optional<double>(extra[n_model + (place - keys.begin())])
                                 : std::nullopt;
    };
    network.set_segments(dealii::ArrayView<const stockwork::Segment<2>>(mine.data(), mine.size()),
                         collectives, earlier);
    network.set_offset(n_model);

    std::vector<double> old = std::move(extra), old_reference = std::move(extra_reference);
    const auto old_keys = std::move(keys);
    keys.clear();
    extra.assign(n_model, 0.);
    extra_reference.assign(n_model, 0.);
    for (const auto &unknown : network.unknowns())
    {
      extra.push_back(unknown.initial);
      extra_reference.push_back(unknown.initial);
      for (unsigned int k = 0; k < old_keys.size(); ++k)
        if (old_keys[k] == unknown.key)
        {
          extra.back() = old[n_model + k];
          extra_reference.back() = old_reference[n_model + k];
        }
      keys.push_back(unknown.key);
    }
  }

  stockwork::Unknowns unknowns(const std::vector<double> &bulk_values,
                               const std::vector<double> &extra_values) const
  {
    const unsigned int rank = collectives.rank(),
                       n_ranks = dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
    dealii::IndexSet owned(bulk_values.size()), all(bulk_values.size());
    owned.add_range(bulk_values.size() * rank / n_ranks, bulk_values.size() * (rank + 1) / n_ranks);
    all.add_range(0, bulk_values.size());
    dealii::TrilinosWrappers::MPI::BlockVector distributed(std::vector<dealii::IndexSet>{owned},
                                                           MPI_COMM_WORLD);
    for (const auto i : owned)
      distributed.block(0)(i) = bulk_values[i];
    distributed.compress(dealii::VectorOperation::insert);

    stockwork::Unknowns result;
    result.bulk.reinit({owned}, {all}, MPI_COMM_WORLD);
    result.bulk = distributed;
    result.extra = extra_values;
    return result;
  }

  /// Call with the state as it stands.
  template <class Action>
  auto with_state(const Action &action) const
  {
    const auto current = unknowns(bulk, extra);
    const auto reference = unknowns(bulk_reference, extra_reference);
    const stockwork::State state{current, reference, reference, reference, {}};
    return action(state);
  }

  DenseSink assemble() const
  {
    DenseSink sink(n_bulk(), n_bulk() + extra.size());
    with_state([&](const auto &state) { network.assemble(context, state, collectives, sink); });
    sink.sum_over_ranks();
    return sink;
  }

  /// The flow and the foundation.
  DenseSink assemble_all() const
  {
    DenseSink sink = assemble();
    for (unsigned int i = 0; i < n; ++i)
    {
      sink.residual(i) += h * stiffness * bulk[i];
      sink.matrix(i, i) += h * stiffness;
    }
    for (unsigned int i = n; i < n_bulk(); ++i)
    {
      sink.residual(i) -= h * pore_storage * (bulk[i] - bulk_reference[i]);
      sink.matrix(i, i) -= h * pore_storage;
    }
    return sink;
  }

  void begin_step(const double dt)
  {
    context.dt = dt;
    context.time += dt;
    ++context.step;
    context.rate = context.pressure_rate = 1. / dt;
    network.begin_step(context);
  }

  /// Newton's method, with shorter increments where it goes round in circles. Returns the
  /// iterations.
  unsigned int solve(const double tolerance = 1e-11)
  {
    for (unsigned int iteration = 1; iteration < 100; ++iteration)
    {
      DenseSink sink = assemble_all();
      const unsigned int size = sink.residual.size();
      // Symmetric scaling by typical sizes of the unknowns.
      std::vector<double> scale(size, 1e6);
      for (unsigned int i = 0; i < n; ++i)
        scale[i] = 1e-3;
      dealii::Vector<double> rhs(size), increment(size);
      for (unsigned int i = 0; i < size; ++i)
      {
        rhs(i) = -sink.residual(i) * scale[i];
        for (unsigned int j = 0; j < size; ++j)
          sink.matrix(i, j) *= scale[i] * scale[j];
      }
      sink.matrix.gauss_jordan();
      sink.matrix.vmult(increment, rhs);
      increment *= iteration > 20 ? 0.5 : 1.;
      double change = 0.;
      for (unsigned int i = 0; i < size; ++i)
      {
        (i < n_bulk() ? bulk[i] : extra[i - n_bulk()]) += scale[i] * increment(i);
        change = std::max(change, std::abs(increment(i)));
      }
      if (change < tolerance)
        return iteration;
    }
    throw std::runtime_error("no convergence");
  }

  stockwork::FluidBalance balance() const
  {
    return with_state([&](const auto &state)
                      { return network.balance(context, state, collectives); });
  }

  std::vector<stockwork::WellReport> wells() const
  {
    return with_state([&](const auto &state)
                      { return network.wells(context, state, collectives); });
  }

  void commit()
  {
    with_state([&](const auto &state) { network.commit(context, state, collectives); });
    bulk_reference = bulk;
    extra_reference = extra;
  }

  void rollback()
  {
    network.rollback();
    context.time -= context.dt;
    --context.step;
    bulk = bulk_reference;
    extra = extra_reference;
  }

  /// A step that is accepted.
  stockwork::FluidBalance step(const double dt)
  {
    begin_step(dt);
    solve();
    const auto result = balance();
    commit();
    return result;
  }

private:
  std::vector<std::uint64_t> keys;
};
