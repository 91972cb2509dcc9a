// A phase-field model of brittle fracture (AT2; Bourdin, Francfort and Marigo 2000) in a shared
// library of its own: a crack is where a damage field d on the mesh is 1, and fades into the rock
// over a length l. README.md has the equations.
#include "minimum.h"

#include "stockwork/base/error.h"
#include "stockwork/base/quantity.h"
#include "stockwork/fracture/registry.h"
#include "stockwork/mesh/key.h"
#include "stockwork/rock/linear_stiffness.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/lac/sparsity_tools.h>

#include <boost/serialization/utility.hpp>
#include <boost/serialization/vector.hpp>

#include <cmath>
#include <map>

namespace phase_field
{
using namespace dealii;
using namespace stockwork;

constexpr int dim = 2;

/// Of the stiffness, what is left where d = 1, so that displacements stay unique there.
constexpr double residual_stiffness = 1e-6;

/// A locally owned cell with both kinds of shape functions, and what is at its points.
struct Cell
{
  const FEValues<dim> &bulk, &own;
  const FEValuesViews::Vector<dim> &displacement;
  std::vector<types::global_dof_index> bulk_dofs, own_dofs;
  std::vector<double> d;
  std::vector<Tensor<1, dim>> slope, u; ///< grad d; u and strain where there is a state
  std::vector<SymmetricTensor<2, dim>> strain;
  RockProperties rock;
  double excess; ///< of a crack's length where d = 1 in one row of cells: see README.md
  int station;   ///< see PhaseField::stations
};


class PhaseField : public FractureModel<dim>, private KeptTerms
{
public:
  PhaseField(ParameterHandler &prm, const Scene<dim> &scene)
    : scene(scene)
    , cells_per_length(get_quantity(prm, "Cells per length", dimension::number))
    , cell_size(get_quantity(prm, "Cell size", dimension::length))
    , tolerance(get_quantity(prm, "Tolerance", dimension::number))
    , fields({"phase_field"})
  {
    if (scene.cracks.empty() || scene.has_pore_pressure)
      throw InputError("The model 'phase_field' needs a crack to begin with (subsection Cracks), "
                       "and dry rock ('Rock/Bulk model' = elastic).");
    for (const auto &crack : scene.cracks)
      if (crack.kind != InitialCrack<dim>::Kind::open)
        throw EntryError(crack.entry, crack.text,
                         "nothing where the model is 'phase_field', whose cracks are open");
    if (!(scene.rock.main().energy_release_rate > 0.))
      throw InputError("The model 'phase_field' needs 'Rock/Critical energy release rate' or "
                       "'Rock/Fracture toughness'.");
  }

  Requirements requirements() const override
  {
    Requirements requirements;
    requirements.random_rock = true;
    return requirements;
  }

  NodalFields<dim> *nodal_fields() override
  {
    return &fields;
  }

  const KeptTerms *kept_terms() const override
  {
    return this;
  }

  ArrayView<const Segment<dim>> segments() const override
  {
    return make_array_view(all_segments);
  }

  void setup(const MeshView<dim> &new_mesh, const Collectives &collectives) override
  {
    mesh = std::make_unique<MeshView<dim>>(new_mesh);
    const auto &handler = fields.dof_handler();
    IndexSet relevant;
    DoFTools::extract_locally_relevant_dofs(handler, relevant);
    DynamicSparsityPattern pattern(relevant);
    DoFTools::make_sparsity_pattern(handler, pattern, fields.constraints(), false);
    const IndexSet &owned = handler.locally_owned_dofs();
    SparsityTools::distribute_sparsity_pattern(pattern, owned, handler.get_communicator(),
                                               relevant);
    matrix.reinit(owned, owned, pattern, handler.get_communicator());
    trial = fields[0];
    if (stations.empty())
      begin_cracks(collectives);
    describe_crack(collectives);
  }

  void begin_step(const StepContext &) override
  {
    pass = 0;
  }

  /// The crack releases the in-situ traction of its faces: external work n.sigma_0.[u], and the
  /// jump across all of it is -int u (x) grad d.
  void assemble(const StepContext &, const State &, Sink &sink) const override
  {
    LocalSystem local;
    for_damaged_cells(nullptr,
                      [&](const Cell &cell)
                      {
                        if (cell.station < 0)
                          return;
                        local.bulk = cell.bulk_dofs;
                        local.reinit();
                        for (const unsigned int q : cell.bulk.quadrature_point_indices())
                        {
                          const auto [pressing, shear] = released(cell, q);
                          const Tensor<1, dim> force =
                            cell.bulk.JxW(q) * (pressing * cell.slope[q] +
                                                (cell.slope[q] * normals[cell.station]) * shear);
                          for (const unsigned int i : cell.bulk.dof_indices())
                            local.residual(i) += force * cell.displacement.value(i, q);
                        }
                        sink.add(local);
                      });
  }

  /// The energy is convex in u and in d, but not in both: its minimum in d, then again that in u
  /// (alternate minimisation; Bourdin et al. 2000).
  Verdict advance(const StepContext &, const State &state, const Collectives &collectives) override
  {
    constexpr unsigned int max_passes = 90;
    double volume = 0.;
    for (const Segment<dim> &segment : all_segments)
      volume += segment.area * value(segment.opening, state.current);
    if (collectives.sum(volume) < -1e-10 * length * length)
      return {Verdict::Kind::stop,
              "the faces of the crack overlap, and the model 'phase_field' has no contact"};
    const Vector next = minimum_in_d(&state, fields[0]);
    Vector change = fields.owned_vector();
    change = trial;
    change -= next;
    Verdict verdict;
    verdict.advances = stations.size() - n_committed;
    if (change.linfty_norm() < tolerance)
      return verdict;
    if (++pass > max_passes)
      // No shorter step helps where the load is the same from the start.
      return {std::isfinite(scene.crack_pressure) ? Verdict::Kind::stop : Verdict::Kind::reject,
              "the crack does not come to rest in " + std::to_string(max_passes) + " passes"};
    trial = next;
    describe_crack(collectives);
    if (stations.size() > n_committed && breaks_large_cells)
      return {cell_size > 0. ? Verdict::Kind::reject : Verdict::Kind::stop,
              "the crack has come to cells larger than those it began in, which 'Fracture/"
              "phase_field/Cell size' refines ahead of it, step by step"};
    verdict.kind = Verdict::Kind::topology_changed;
    return verdict;
  }

  bool commit(const StepContext &, const State &) override
  {
    Vector owned = fields.owned_vector();
    owned = trial;
    fields.set(0, owned);
    n_committed = stations.size();
    return false;
  }

  void rollback() override
  {
    trial = fields[0];
    stations.resize(n_committed);
    describe_crack(Collectives(mesh->triangulation.get_communicator()));
  }

  std::vector<std::string> take_messages() override
  {
    return std::exchange(messages, {});
  }

  /// As far as the crack loads the rock, and by as much again, so that the mesh is not another
  /// whenever it has grown.
  void wanted_cell_size(const parallel::distributed::Triangulation<dim> &triangulation,
                        std::vector<float> &sizes) const override
  {
    if (cell_size == 0.)
      return;
    const double block = reach * (stations.empty() ? cells_per_length * cell_size : length);
    for (const auto &cell : triangulation.active_cell_iterators())
    {
      double distance = std::numeric_limits<double>::infinity();
      for (const auto &crack : scene.cracks)
        distance = std::min(distance, crack.distance(cell->center()) - block);
      for (Point<dim> place : stations)
      {
        for (unsigned int k = 0; k < dim; ++k)
          place[k] = block * std::round(place[k] / block);
        distance = std::min(distance, place.distance(cell->center()) - 2. * block);
      }
      if (cell->is_locally_owned() && distance < 0.5 * cell->diameter())
        sizes[cell->active_cell_index()] =
          std::min<float>(sizes[cell->active_cell_index()], cell_size);
    }
  }

  void save(boost::archive::binary_oarchive &archive) const override
  {
    std::vector<std::pair<double, double>> places;
    for (const Point<dim> &place : stations)
      places.emplace_back(place[0], place[1]);
    archive << places << length << initial_energy << n_tips;
  }

  void load(boost::archive::binary_iarchive &archive) override
  {
    std::vector<std::pair<double, double>> places;
    archive >> places >> length >> initial_energy >> n_tips;
    stations.clear();
    for (const auto &[x, y] : places)
      stations.emplace_back(x, y);
    n_committed = stations.size();
  }

  FractureSummary summary(const State &state, const Collectives &collectives) const override
  {
    std::vector<double> sums = measure(&state);
    collectives.sum(sums);
    FractureSummary result;
    result.n_tips = n_tips;
    // What fades around a tip is worth exactly l/2 of crack (README.md).
    result.length = result.broken_length = sums[0] - 0.5 * n_tips * length;
    result.dissipated_energy = sums[1] - initial_energy;
    result.stored_energy = -sums[2]; // the core counts the rock as whole
    return result;
  }

private:
  /// How far from a station it is, in lengths l, that the crack loads the rock: d is 0.0025 there.
  static constexpr double reach = 6.;

  template <class Use>
  void for_damaged_cells(const State *state, const Use &use, const bool all = false) const
  {
    const auto &fe = mesh->dof_handler.get_fe();
    const QGauss<dim> points(fe.degree + 1);
    FEValues<dim> bulk(mesh->mapping, fe, points,
                       update_values | update_gradients | update_JxW_values |
                         update_quadrature_points),
      own(mesh->mapping, fields.dof_handler().get_fe(), points, update_values | update_gradients);
    Cell here{bulk, own, bulk[FEValuesExtractors::Vector(0)], {}, {}, {}, {}, {}, {}, {}, 0., -1};
    here.bulk_dofs.resize(fe.n_dofs_per_cell());
    here.own_dofs.resize(GeometryInfo<dim>::vertices_per_cell);
    here.d.resize(points.size());
    here.slope.resize(points.size());
    here.u.resize(points.size());
    here.strain.resize(points.size());
    for (const auto &cell : mesh->dof_handler.active_cell_iterators())
    {
      if (!cell->is_locally_owned())
        continue;
      const DoFHandler<dim>::active_cell_iterator twin(&mesh->triangulation, cell->level(),
                                                       cell->index(), &fields.dof_handler());
      twin->get_dof_indices(here.own_dofs);
      if (!all && std::all_of(here.own_dofs.begin(), here.own_dofs.end(),
                              [this](const auto i) { return trial(i) < 1e-8; }))
        continue;
      bulk.reinit(cell);
      own.reinit(twin);
      cell->get_dof_indices(here.bulk_dofs);
      own.get_function_values(trial, here.d);
      own.get_function_gradients(trial, here.slope);
      if (state != nullptr)
      {
        here.displacement.get_function_values(state->current.bulk, here.u);
        here.displacement.get_function_symmetric_gradients(state->current.bulk, here.strain);
      }
      here.rock = scene.rock.at(cell->material_id(), cell->center());
      here.excess = 1. + std::sqrt(cell->measure()) / (2. * length);
      here.station = station_of_cell[cell->active_cell_index()];
      use(here);
    }
  }

  /// What the rock has carried across the crack: a normal stress, which acts along grad d as the
  /// fluid does, and a shear traction. The stress along the crack is no load on it, though the
  /// ends of the damaged rock are blunt.
  std::pair<double, Tensor<1, dim>> released(const Cell &cell, const unsigned int q) const
  {
    const Tensor<1, dim> &n = normals[cell.station];
    const Tensor<1, dim> traction = scene.in_situ_stress(cell.bulk.quadrature_point(q)) * n;
    return {n * traction, traction - (n * traction) * n};
  }

  /// The damage that minimises the energy for given displacements, no less than it was.
  /// @param state null: nothing loads the rock
  Vector minimum_in_d(const State *state, const Vector &at_least)
  {
    Vector right_side = fields.owned_vector(), d = right_side, lower = right_side;
    matrix = 0.;
    FullMatrix<double> A(GeometryInfo<dim>::vertices_per_cell);
    dealii::Vector<double> b(A.m());
    for_damaged_cells(
      state,
      [&](const Cell &cell)
      {
        A = 0.;
        b = 0.;
        const double pressure = state != nullptr && cell.station >= 0
                                  ? state->pressure_of(key(cell.station), state->current)
                                  : 0.;
        const double G_c = cell.rock.energy_release_rate / cell.excess;
        const LinearStiffness<dim> hooke(cell.rock);
        for (const unsigned int q : cell.bulk.quadrature_point_indices())
        {
          const double w = cell.bulk.JxW(q), driving = (1. - residual_stiffness) * cell.strain[q] *
                                                       hooke.stress(cell.strain[q]);
          Tensor<1, dim> work; // of the fluid and of the released traction, per slope of d
          if (cell.station >= 0)
          {
            const auto [pressing, shear] = released(cell, q);
            work = (pressure + pressing) * cell.u[q] + (shear * cell.u[q]) * normals[cell.station];
          }
          for (unsigned int i = 0; i < A.m(); ++i)
          {
            const double N = cell.own.shape_value(i, q);
            const Tensor<1, dim> grad = cell.own.shape_grad(i, q);
            b(i) += w * (driving * N - work * grad);
            for (unsigned int j = 0; j < A.m(); ++j)
              A(i, j) += w * ((driving + G_c / length) * N * cell.own.shape_value(j, q) +
                              G_c * length * (grad * cell.own.shape_grad(j, q)));
          }
        }
        fields.constraints().distribute_local_to_global(A, b, cell.own_dofs, matrix, right_side);
      },
      true);
    matrix.compress(VectorOperation::add);
    right_side.compress(VectorOperation::add);
    d = trial;
    lower = at_least;
    minimise(matrix, right_side, lower, fields.constraints(), d);
    return d;
  }

  /// The scene's cracks: d = 1 in the cells that they pass, and what follows around them.
  void begin_cracks(const Collectives &collectives)
  {
    Vector lower = fields.owned_vector();
    double smallest = std::numeric_limits<double>::infinity(), mouths = 0.;
    for (const auto &cell : fields.dof_handler().active_cell_iterators())
      if (cell->is_locally_owned() && is_cracked(cell->center(), std::sqrt(cell->measure())))
      {
        smallest = std::min(smallest, std::sqrt(cell->measure()));
        mouths += cell->at_boundary();
        for (const unsigned int v : cell->vertex_indices())
          lower(cell->vertex_dof_index(v, 0)) = 1.;
      }
    lower.compress(VectorOperation::insert);
    smallest = collectives.min(smallest);
    if (!std::isfinite(smallest))
      throw InputError("No crack of the scene is as long as the cells that it lies in, which the "
                       "model 'phase_field' needs: see 'Fracture/phase_field/Cell size'.");
    length = cells_per_length * smallest;
    n_tips = 2 * scene.cracks.size() - std::lround(collectives.sum(mouths));
    messages.push_back(
      "Cracks of the model 'phase_field' fade over l = " + to_string(length, dimension::length) +
      "; volumes are wrong by about l over a crack's length.");
    for (const auto &crack : scene.cracks)
      for (unsigned int i = 0; i + 1 < crack.points.size(); ++i)
      {
        const Tensor<1, dim> along = crack.points[i + 1] - crack.points[i];
        const unsigned int n = std::max(1., std::round(along.norm() / length));
        for (unsigned int k = 0; k < n; ++k)
          stations.push_back(crack.points[i] + (k + 0.5) / n * along);
      }
    n_committed = stations.size();
    station_of_cell.assign(mesh->triangulation.n_active_cells(), -1);
    trial = lower;
    fields.set(0, minimum_in_d(nullptr, trial));
    trial = fields[0];
    std::vector<double> sums = measure(nullptr);
    collectives.sum(sums);
    initial_energy = sums[1];
  }

  /// Whether the middle of a cell is beside a crack, not beyond its end, and near. Of the two cells
  /// at a crack along their edge, it is the one to the right or above.
  bool is_cracked(const Point<dim> &centre, const double size) const
  {
    for (const auto &crack : scene.cracks)
      for (unsigned int i = 0; i + 1 < crack.points.size(); ++i)
      {
        const Tensor<1, dim> along = crack.points[i + 1] - crack.points[i];
        const Tensor<1, dim> off =
          centre - crack.points[i] - 1e-6 * size * Tensor<1, dim>({1., 1.});
        const double t = off * along / along.norm_square();
        if (t > 0. && t < 1. && (off - t * along).norm() < 0.5 * size)
          return true;
      }
    return false;
  }

  std::uint64_t key(const unsigned int station) const
  {
    return Key().add(stations[station], 1e-6 * length);
  }

  /// What hangs on trial. Stations: a new one in the nearest cell that has broken farther than l
  /// from all others, until there is none.
  void describe_crack(const Collectives &collectives)
  {
    ++terms_version;
    std::vector<std::pair<double, double>> broken;
    double large = 0.;
    for (const auto &cell : fields.dof_handler().active_cell_iterators())
      if (cell->is_locally_owned())
      {
        double least = 1.;
        for (const unsigned int v : cell->vertex_indices())
          least = std::min<double>(least, trial(cell->vertex_dof_index(v, 0)));
        large = std::max(large, least > 0.9 ? std::sqrt(cell->measure()) : 0.);
        if (least > 0.9)
          broken.emplace_back(cell->center()[0], cell->center()[1]);
      }
    breaks_large_cells = collectives.max(large) > 1.5 * length / cells_per_length;
    broken = collectives.gather(broken);
    std::sort(broken.begin(), broken.end()); // the same on any number of ranks
    while (true)
    {
      double nearest = std::numeric_limits<double>::infinity();
      Point<dim> next;
      for (const auto &[x, y] : broken)
      {
        double distance = std::numeric_limits<double>::infinity();
        for (const Point<dim> &place : stations)
          distance = std::min(distance, place.distance({x, y}));
        if (distance > 0.999 * length && distance < nearest * (1. - 1e-10))
        {
          nearest = distance;
          next = {x, y};
        }
      }
      if (!std::isfinite(nearest))
        break;
      stations.push_back(next);
    }
    station_of_cell.assign(mesh->triangulation.n_active_cells(), -1);
    for (const auto &cell : mesh->triangulation.active_cell_iterators())
    {
      double nearest = reach * length;
      for (unsigned int k = 0; k < stations.size() && !cell->is_artificial(); ++k)
        if (const double r = stations[k].distance(cell->center()); r < nearest * (1. - 1e-10))
        {
          nearest = r;
          station_of_cell[cell->active_cell_index()] = k;
        }
    }
    list_segments(collectives);
  }

  /// A w = -int u.grad d over the cells of a station (Bourdin, Chukwudozie and Yoshioka 2012), A
  /// the length of the crack there.
  void list_segments(const Collectives &collectives)
  {
    const unsigned int n = stations.size();
    std::vector<std::map<types::global_dof_index, double>> volume(n);
    std::vector<double> sums(4 * n, 0.); // area; (grad d)(grad d) xx, yy, xy
    for_damaged_cells(nullptr,
                      [&](const Cell &cell)
                      {
                        double *const sum = sums.data() + 4 * cell.station;
                        for (unsigned int q = 0; cell.station >= 0 && q < cell.d.size(); ++q)
                        {
                          const double w = cell.bulk.JxW(q);
                          const Tensor<1, dim> &slope = cell.slope[q];
                          sum[0] += w * density(cell, q);
                          sum[1] += w * slope[0] * slope[0];
                          sum[2] += w * slope[1] * slope[1];
                          sum[3] += w * slope[0] * slope[1];
                          for (const unsigned int i : cell.bulk.dof_indices())
                            volume[cell.station][cell.bulk_dofs[i]] -=
                              w * (slope * cell.displacement.value(i, q));
                        }
                      });
    const std::vector<double> mine = sums;
    collectives.sum(sums);
    normals.clear();
    for (unsigned int k = 0; k < n; ++k)
    {
      SymmetricTensor<2, dim> across;
      across[0][0] = sums[4 * k + 1];
      across[1][1] = sums[4 * k + 2];
      across[0][1] = sums[4 * k + 3];
      normals.push_back(eigenvectors(across)[0].second);
    }
    const auto beside = neighbours(collectives);
    all_segments.clear();
    for (unsigned int k = 0; k < n; ++k)
    {
      if (volume[k].empty())
        continue;
      Segment<dim> segment;
      segment.key = key(k);
      segment.centre = stations[k];
      segment.normal = normals[k];
      segment.area = sums[4 * k];
      segment.neighbours = beside[k];
      for (const auto &[dof, coefficient] : volume[k])
      {
        segment.opening.bulk.push_back(dof);
        segment.opening.bulk_coefficients.push_back(coefficient / segment.area);
      }
      segment.pore_pressure.constant =
        mine[4 * k] / segment.area * scene.in_situ_pore_pressure(segment.centre);
      all_segments.push_back(std::move(segment));
    }
  }

  /// Stations whose cells have a face in common, no farther than two next to one another.
  std::vector<std::vector<Segment<dim>::Neighbour>> neighbours(const Collectives &collectives) const
  {
    std::vector<std::pair<int, int>> pairs;
    for (const auto &cell : mesh->triangulation.active_cell_iterators())
      for (const unsigned int f : cell->face_indices())
        if (cell->is_locally_owned() && !cell->at_boundary(f) && cell->neighbor(f)->is_active())
          pairs.push_back(std::minmax({station_of_cell[cell->active_cell_index()],
                                       station_of_cell[cell->neighbor(f)->active_cell_index()]}));
    pairs = collectives.gather(pairs);
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    std::vector<std::vector<Segment<dim>::Neighbour>> result(stations.size());
    for (const auto &[a, b] : pairs)
      if (a >= 0 && a != b && stations[a].distance(stations[b]) < 2. * length)
      {
        const double half = 0.5 * stations[a].distance(stations[b]);
        result[a].push_back({key(b), half, 1.});
        result[b].push_back({key(a), half, 1.});
      }
    return result;
  }

  /// Length of crack per area (d^2/l + l |grad d|^2)/2, corrected for the cells [1/m].
  double density(const Cell &cell, const unsigned int q) const
  {
    return 0.5 * (cell.d[q] * cell.d[q] / length + length * cell.slope[q].norm_square()) /
           cell.excess;
  }

  /// Of the owned cells: length of the crack [m], its energy, and that which the rock has lost.
  std::vector<double> measure(const State *state) const
  {
    std::vector<double> sums(3, 0.);
    for_damaged_cells(state,
                      [&](const Cell &cell)
                      {
                        const LinearStiffness<dim> hooke(cell.rock);
                        for (const unsigned int q : cell.bulk.quadrature_point_indices())
                        {
                          const double w = cell.bulk.JxW(q);
                          if (cell.station >= 0)
                            sums[0] += w * density(cell, q);
                          sums[1] += w * density(cell, q) * cell.rock.energy_release_rate;
                          sums[2] += w * lost_stiffness(cell.d[q]) * 0.5 * cell.strain[q] *
                                     hooke.stress(cell.strain[q]);
                        }
                      });
    return sums;
  }

  static double lost_stiffness(const double d)
  {
    return (1. - residual_stiffness) * (1. - (1. - d) * (1. - d));
  }

  unsigned int version() const override
  {
    return terms_version;
  }

  /// The stiffness that damage has taken away.
  void assemble(const StepContext &, const IndexSet &, Sink &sink) const override
  {
    LocalSystem local;
    for_damaged_cells(nullptr,
                      [&](const Cell &cell)
                      {
                        local.bulk = cell.bulk_dofs;
                        local.reinit();
                        const LinearStiffness<dim> hooke(cell.rock);
                        for (const unsigned int q : cell.bulk.quadrature_point_indices())
                          for (unsigned int j = 0; j < local.bulk.size(); ++j)
                          {
                            const auto stress =
                              cell.bulk.JxW(q) * lost_stiffness(cell.d[q]) *
                              hooke.stress(cell.displacement.symmetric_gradient(j, q));
                            for (unsigned int i = 0; i < local.bulk.size(); ++i)
                              local.matrix(i, j) -=
                                stress * cell.displacement.symmetric_gradient(i, q);
                          }
                        sink.add(local);
                      });
  }

  const Scene<dim> &scene;
  const double cells_per_length, cell_size, tolerance;
  double length = 0.;         ///< l [m]
  double initial_energy = 0.; ///< of the scene's cracks [J/m]
  unsigned int n_tips = 0;

  std::unique_ptr<MeshView<dim>> mesh;
  NodalFields<dim> fields; ///< d as committed
  Vector trial;            ///< d within the step
  Matrix matrix;           ///< of the energy, by d

  /// Places along the crack, those of the step last. The cells that are nearest to one are a piece
  /// of the crack to the fluid.
  std::vector<Point<dim>> stations;
  unsigned int n_committed = 0;
  std::vector<int> station_of_cell;    ///< by active cell index; -1: the crack is far
  std::vector<Tensor<1, dim>> normals; ///< of the crack at stations
  std::vector<Segment<dim>> all_segments;

  bool breaks_large_cells = false;
  unsigned int terms_version = 0, pass = 0;
  std::vector<std::string> messages;
};
} // namespace phase_field


extern "C" void stockwork_register(stockwork::FractureModelRegistry &registry)
{
  using namespace stockwork;
  FractureModelEntry entry;
  entry.description = "A damage field that is 1 along cracks and fades beside them (AT2).";
  entry.declare_parameters = [](dealii::ParameterHandler &prm)
  {
    prm.declare_entry("Cells per length", "2", Quantity(dimension::number, Range::closed(1., 100.)),
                      "The length over which a crack fades, in cells along the scene's cracks.");
    prm.declare_entry(
      "Cell size", "0", Quantity(dimension::length, Range::non_negative()),
      "Wanted size of the cells around the crack [m]; zero: that of the given mesh.");
    prm.declare_entry("Tolerance", "0.01", Quantity(dimension::number, Range::closed(1e-10, 0.1)),
                      "Displacement and damage take turns until no d changes by more.");
  };
  entry.create_2d = [](dealii::ParameterHandler &prm, const Scene<2> &scene)
  { return std::make_unique<phase_field::PhaseField>(prm, scene); };
  registry.add("phase_field", entry);
}
