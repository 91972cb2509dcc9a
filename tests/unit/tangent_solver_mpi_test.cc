// Solvers of rock that yields against the residual of what they were given, on any number of ranks.

#include <deal.II/base/mpi.h>
#include <deal.II/lac/block_sparsity_pattern.h>

#include <doctest/doctest.h>

#include "solvers/cholesky.h"
#include "solvers/patch_solver.h"
#include "solvers/tangent_solver.h"

#include <cmath>
#include <memory>

namespace stockwork::tangent_solver_mpi_test
{
using namespace dealii;

namespace
{
const MPI_Comm comm = MPI_COMM_WORLD;
constexpr unsigned int side = 24, n = side * side;

bool are_neighbours(const int i, const int j)
{
  const int s = side;
  return std::abs(i / s - j / s) <= 1 && std::abs(i % s - j % s) <= 1;
}

/// A nine-point stencil, positive definite.
double linear_rock(const unsigned int i, const unsigned int j)
{
  return i == j ? 8.2 : -1. + 0.1 * std::sin(3. * (i + j) + 5. * i * j);
}

/// Where the rock yields: two squares.
bool yields(const unsigned int i, const unsigned int size)
{
  const unsigned int x = i % side, y = i / side;
  return (x >= 2 && x < 2 + size && y >= 3 && y < 3 + size) || (x > side - 3 && y > side - 3);
}

/// It has lost nine tenths of its stiffness, and in what is left there is no symmetry.
double change(const unsigned int i, const unsigned int j)
{
  return -0.9 * linear_rock(i, j) + 0.05 * std::sin(7. * i + 2. * j);
}

/// What the extra unknowns are coupled to: two each.
unsigned int end_of_border(const unsigned int e, const unsigned int k)
{
  return (97 * e + (k == 0 ? 51 : 303)) % n;
}

struct Rock
{
  LinearSystem system;
  TrilinosWrappers::BlockSparseMatrix change_of_rock;

  Rock(const unsigned int yielding, const unsigned int n_extra)
  {
    IndexSet owned(n);
    const unsigned int me = Utilities::MPI::this_mpi_process(comm),
                       p = Utilities::MPI::n_mpi_processes(comm);
    owned.add_range(n * me / p, n * (me + 1) / p);
    const std::vector<IndexSet> sets = {owned};
    BlockDynamicSparsityPattern pattern(1, 1);
    pattern.block(0, 0).reinit(n, n);
    pattern.collect_sizes();
    for (const auto i : owned)
      for (unsigned int j = 0; j < n; ++j)
        if (are_neighbours(i, j))
          pattern.add(i, j);
    for (auto *matrix : {&system.bulk, &change_of_rock})
      matrix->reinit(sets, pattern, comm);
    system.residual_bulk.reinit(sets, comm);
    for (const auto i : owned)
    {
      system.residual_bulk(i) = std::cos(1. + i);
      for (unsigned int j = 0; j < n; ++j)
        if (are_neighbours(i, j))
        {
          system.bulk.set(i, j, linear_rock(i, j));
          if (yields(i, yielding) && yields(j, yielding))
            change_of_rock.set(i, j, change(i, j));
        }
    }
    system.bulk.compress(VectorOperation::insert);
    change_of_rock.compress(VectorOperation::insert);
    system.residual_bulk.compress(VectorOperation::insert);
    for (unsigned int e = 0; e < n_extra; ++e)
    {
      if (me == 0)
      {
        system.extra_extra.add(e, e, 3. + e);
        for (const unsigned int k : {0, 1})
        {
          system.bulk_extra.add(end_of_border(e, k), e, 1. - 1.5 * k);
          system.extra_bulk.add(e, end_of_border(e, k), 0.7 - 1.5 * k);
        }
      }
      system.residual_extra.push_back(2. - e);
    }
    system.elastic = system.definite = system.definite_displacement = true;
    system.symmetric = n_extra == 0;
  }

  void yield()
  {
    system.rock_change = &change_of_rock;
    system.rock_change_is_symmetric = false;
  }

  /// |R + J dx| over |R|
  double residual(const TrilinosWrappers::MPI::BlockVector &dx,
                  const std::vector<double> &dx_extra) const
  {
    auto r = system.residual_bulk;
    system.bulk.vmult_add(r, dx);
    if (system.rock_change != nullptr)
      system.rock_change->vmult_add(r, dx);
    std::vector<double> r_extra(dx_extra.size(), 0.);
    const auto &values = dx.block(0);
    for (unsigned int e = 0; e < dx_extra.size(); ++e)
    {
      for (const unsigned int k : {0, 1})
        if (const unsigned int i = end_of_border(e, k); values.in_local_range(i))
        {
          r.block(0)(i) += (1. - 1.5 * k) * dx_extra[e];
          r_extra[e] += (0.7 - 1.5 * k) * values(i);
        }
    }
    r.compress(VectorOperation::add);
    Utilities::MPI::sum(r_extra, comm, r_extra);
    double sum = r.norm_sqr(), size = system.residual_bulk.norm_sqr();
    for (unsigned int e = 0; e < dx_extra.size(); ++e)
    {
      sum += std::pow(r_extra[e] + (3. + e) * dx_extra[e] + system.residual_extra[e], 2);
      size += std::pow(system.residual_extra[e], 2);
    }
    return std::sqrt(sum / size);
  }
};

using Type = LinearSolverParameters::Type;

std::unique_ptr<LinearSolver> make(const Type type)
{
  LinearSolverParameters parameters;
  parameters.type = type;
  return make_linear_solver(parameters, {}, comm);
}
} // namespace


TEST_CASE("the inverse between a few unknowns is that of the factor")
{
  if (Utilities::MPI::this_mpi_process(comm) > 0)
    return;
  std::vector<int> rows, columns;
  std::vector<double> values;
  for (unsigned int i = 0; i < n; ++i)
    for (unsigned int j = 0; j <= i; ++j)
      if (are_neighbours(i, j))
      {
        rows.push_back(i + 1);
        columns.push_back(j + 1);
        values.push_back(linear_rock(i, j));
      }
  Cholesky factor;
  factor.analyse(n, rows, columns);
  factor.factorise(values);
  const std::vector<int> few = {3, 17, 208, 209, 575};
  const auto inverse = factor.local_inverse(few);

  dealii::Vector<double> y(few.size()), x(few.size());
  std::vector<double> load(n, 0.);
  for (unsigned int i = 0; i < n; ++i)
    load[i] = std::sin(2. * i);
  std::vector<double> solution = load, again(n), of_few(n, 0.);
  factor.solve(solution);
  std::vector<double> half = inverse->forward(load.data());
  inverse->backward(half, again.data());
  for (unsigned int i = 0; i < n; ++i)
    CHECK(std::abs(again[i] - solution[i]) < 1e-13);
  inverse->backward_to_few(half, x);
  for (unsigned int k = 0; k < few.size(); ++k)
    CHECK(std::abs(x(k) - solution[few[k]]) < 1e-13);

  for (unsigned int k = 0; k < few.size(); ++k)
  {
    y(k) = 1. + k;
    load[few[k]] += y(k);
    of_few[few[k]] = y(k);
  }
  factor.solve(of_few);
  for (unsigned int repeat = 0; repeat < 2; ++repeat)
  {
    inverse->vmult(x, y);
    for (unsigned int k = 0; k < few.size(); ++k)
      CHECK(std::abs(x(k) - of_few[few[k]]) < 1e-13);
  }
  inverse->add_forward(y, half);
  inverse->backward(half, again.data());
  factor.solve(load);
  for (unsigned int i = 0; i < n; ++i)
    CHECK(std::abs(again[i] - load[i]) < 1e-13);
}


TEST_CASE("rock that yields is solved to the tolerance, whatever the solver keeps")
{
  for (const Type type : {Type::automatic, Type::bordered, Type::direct, Type::iterative})
    for (const unsigned int n_extra : {0u, 3u})
    {
      CAPTURE(static_cast<int>(type));
      CAPTURE(n_extra);
      TangentSolver solver([type]() { return make(type); }, comm);
      SystemStamps stamps;
      Rock rock(5, n_extra), more(8, n_extra), all(side, n_extra);
      const auto solve = [&](Rock &now, const double tolerance)
      {
        // A preconditioner that is kept refers to the matrix it was made of.
        rock.system.rock_change = now.system.rock_change;
        rock.system.rock_change_is_symmetric = false;
        TrilinosWrappers::MPI::BlockVector dx(rock.system.residual_bulk);
        std::vector<double> dx_extra(n_extra);
        const auto report = solver.solve(rock.system, stamps, tolerance, dx, dx_extra);
        CHECK(report.converged);
        CHECK(rock.residual(dx, dx_extra) < 5. * tolerance);
        return report;
      };
      solve(rock, 1e-10);
      for (Rock *const now : {&rock, &more, &all, &rock})
      {
        now->yield();
        for (const double tolerance : {1e-3, 1e-9})
          solve(*now, tolerance);
      }
    }
}


TEST_CASE("nothing is left of the residual in a patch")
{
  PatchSolver patch(comm);
  for (const unsigned int size : {5u, 8u})
  {
    const Rock rock(size, 0);
    const auto &b = rock.system.residual_bulk.block(0);
    TrilinosWrappers::MPI::Vector x(b), r(b);
    for (const auto i : x.locally_owned_elements())
      x(i) = std::sin(0.3 * i);
    patch.build(rock.system.bulk.block(0, 0), rock.change_of_rock.block(0, 0), n / 4);
    const TrilinosWrappers::MPI::Vector before(x);
    patch.correct(x, b);
    rock.system.bulk.block(0, 0).residual(r, x, b);
    r *= -1.;
    rock.change_of_rock.block(0, 0).vmult_add(r, x);
    for (const auto i : x.locally_owned_elements())
      if (yields(i, size))
        CHECK(std::abs(r(i)) < 1e-12);
      else
        CHECK(x(i) == before(i));
  }
  // Where too much yields, or nothing any more, nothing happens.
  const Rock all(side, 0);
  TrilinosWrappers::MPI::Vector x(all.system.residual_bulk.block(0));
  const double before = x.l2_norm();
  patch.build(all.system.bulk.block(0, 0), all.change_of_rock.block(0, 0), n / 4);
  patch.correct(x, all.system.residual_bulk.block(0));
  CHECK(x.l2_norm() == before);
  patch.clear();
  patch.correct(x, all.system.residual_bulk.block(0));
  CHECK(x.l2_norm() == before);
}
} // namespace stockwork::tangent_solver_mpi_test
