// A phase-field model of brittle fracture (AT2; Bourdin, Francfort and Marigo 2000) in a shared
// library of its own: a crack is where a damage field d on the mesh is 1, and fades into the rock
// over a length l. README.md has the equations.
#include "stockwork/base/error.h"
#include "stockwork/base/quantity.h"
#include "stockwork/exchange/diffuse_crack.h"
#include "stockwork/exchange/field_cell.h"
#include "stockwork/exchange/surroundings.h"
#include "stockwork/fracture/needs.h"
#include "stockwork/fracture/registry.h"
#include "stockwork/mesh/nodal_energy.h"
#include "stockwork/rock/linear_stiffness.h"

#include <cmath>

namespace phase_field
{
using namespace dealii;
using namespace stockwork;

constexpr int dim = 2;

/// Of the stiffness, what is left where d = 1, so that displacements stay unique there.
constexpr double residual_stiffness = 1e-6;

/// A locally owned cell, and what is at its points.
struct Cell : FieldCell<dim>
{
  using FieldCell<dim>::FieldCell;

  std::vector<double> d;
  std::vector<Tensor<1, dim>> slope, u; ///< grad d; u and strain where there is a state
  std::vector<SymmetricTensor<2, dim>> strain;
  RockProperties rock;
  double excess; ///< of a crack's length where d = 1 in one row of cells: see README.md
  int station;   ///< see DiffuseCrack
};


class PhaseField : public FractureModel<dim>, private KeptTerms
{
  using Vector = NodalFields<dim>::Vector;

public:
  PhaseField(ParameterHandler &prm, const Scene<dim> &scene)
    : scene(scene)
    , cells_per_length(get_quantity(prm, "Cells per length", dimension::number))
    , cell_size(get_quantity(prm, "Cell size", dimension::length))
    , tolerance(get_quantity(prm, "Tolerance", dimension::number))
    , fields({"phase_field"})
  {
    needs::initial_crack(scene, "phase_field");
    needs::open_cracks(scene, "phase_field");
    needs::energy_release_rate(scene.rock, "phase_field");
    needs::energy_of_all_modes(scene.rock.main(), "phase_field",
                               "whose cracks have one energy, whatever the mode");
    needs::no_given_strength(scene.rock.main(), "phase_field",
                             "where the strength follows from the energy release rate and the "
                             "length over which a crack fades");
    if (scene.has_pore_pressure)
      throw InputError("The model 'phase_field' needs dry rock ('Rock/Bulk model' = elastic).");
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
    return make_array_view(crack.segments());
  }

  void setup(const MeshView<dim> &new_mesh, const Collectives &collectives) override
  {
    mesh = std::make_unique<MeshView<dim>>(new_mesh);
    energy.reinit(fields);
    trial = fields[0];
    if (crack.stations().empty())
      begin_crack(collectives);
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
                            cell.bulk.JxW(q) *
                            (pressing * cell.slope[q] +
                             (cell.slope[q] * crack.normal(cell.station)) * shear);
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
    for (const Segment<dim> &segment : crack.segments())
      volume += segment.area * value(segment.opening, state.current);
    if (collectives.sum(volume) < -1e-10 * length * length)
      return {Verdict::Kind::stop,
              "the faces of the crack overlap, and the model 'phase_field' has no contact"};
    const Vector next = minimum_in_d(&state, fields[0]);
    Vector change = fields.owned_vector();
    change = trial;
    change -= next;
    Verdict verdict;
    verdict.advances = crack.n_new();
    if (change.linfty_norm() < tolerance)
      return verdict;
    if (++pass > max_passes)
      // No shorter step helps where the load is the same from the start.
      return {std::isfinite(scene.crack_pressure) ? Verdict::Kind::stop : Verdict::Kind::reject,
              "the crack does not come to rest in " + std::to_string(max_passes) + " passes"};
    trial = next;
    describe_crack(collectives);
    if (crack.n_new() > 0 && breaks_large_cells)
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
    crack.commit();
    return false;
  }

  void rollback() override
  {
    trial = fields[0];
    crack.rollback();
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
    const double block = reach * (length > 0. ? length : cells_per_length * cell_size);
    request_cell_size(triangulation, scene.cracks, block, cell_size, sizes);
    request_cell_size(triangulation,
                      Surroundings<dim>(in_blocks(crack.stations(), block), 2. * block), cell_size,
                      sizes);
  }

  void save(boost::archive::binary_oarchive &archive) const override
  {
    archive << crack << length << initial_energy << n_tips;
  }

  void load(boost::archive::binary_iarchive &archive) override
  {
    archive >> crack >> length >> initial_energy >> n_tips;
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
    Cell here(*mesh, fields);
    const unsigned int n_points = here.bulk.n_quadrature_points;
    here.d.resize(n_points);
    here.slope.resize(n_points);
    here.u.resize(n_points);
    here.strain.resize(n_points);
    for (const auto &cell : mesh->dof_handler.active_cell_iterators())
    {
      if (!cell->is_locally_owned())
        continue;
      here.find(cell);
      if (!all && std::all_of(here.own_dofs.begin(), here.own_dofs.end(),
                              [this](const auto i) { return trial(i) < 1e-8; }))
        continue;
      here.evaluate();
      here.own.get_function_values(trial, here.d);
      here.own.get_function_gradients(trial, here.slope);
      if (state != nullptr)
      {
        here.displacement.get_function_values(state->current.bulk, here.u);
        here.displacement.get_function_symmetric_gradients(state->current.bulk, here.strain);
      }
      here.rock = scene.rock.at(cell->material_id(), cell->center());
      here.excess = 1. + std::sqrt(cell->measure()) / (2. * length);
      here.station = crack.station(cell->active_cell_index());
      use(here);
    }
  }

  /// What the rock has carried across the crack: a normal stress, which acts along grad d as the
  /// fluid does, and a shear traction. The stress along the crack is no load on it, though the
  /// ends of the damaged rock are blunt.
  std::pair<double, Tensor<1, dim>> released(const Cell &cell, const unsigned int q) const
  {
    const Tensor<1, dim> &n = crack.normal(cell.station);
    const Tensor<1, dim> traction = scene.in_situ_stress(cell.bulk.quadrature_point(q)) * n;
    return {n * traction, traction - (n * traction) * n};
  }

  /// The damage that minimises the energy for given displacements, no less than it was.
  /// @param state null: nothing loads the rock
  Vector minimum_in_d(const State *state, const Vector &at_least)
  {
    energy.clear();
    FullMatrix<double> A(GeometryInfo<dim>::vertices_per_cell);
    dealii::Vector<double> b(A.m());
    for_damaged_cells(
      state,
      [&](const Cell &cell)
      {
        A = 0.;
        b = 0.;
        const double pressure = state != nullptr && cell.station >= 0
                                  ? state->pressure_of(crack.key(cell.station), state->current)
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
            work =
              (pressure + pressing) * cell.u[q] + (shear * cell.u[q]) * crack.normal(cell.station);
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
        energy.add(A, b, cell.own_dofs);
      },
      true);
    return energy.minimum(at_least, 1., trial);
  }

  /// The scene's cracks: d = 1 in the cells that they pass, and what follows around them.
  void begin_crack(const Collectives &collectives)
  {
    Vector lower = fields.owned_vector();
    double smallest = std::numeric_limits<double>::infinity(), mouths = 0.;
    for (const auto &cell : fields.dof_handler().active_cell_iterators())
      if (cell->is_locally_owned() &&
          std::any_of(scene.cracks.begin(), scene.cracks.end(),
                      [&](const InitialCrack<dim> &given)
                      { return passes(given, cell->center(), std::sqrt(cell->measure())); }))
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
    trial = lower;
    fields.set(0, minimum_in_d(nullptr, trial));
    trial = fields[0];
    std::vector<double> sums = measure(nullptr);
    collectives.sum(sums);
    initial_energy = sums[1];
    crack.begin(scene.cracks, length, reach * length);
  }

  /// What hangs on trial: where the crack is, and with A w = -int u.grad d over the cells of a
  /// station its opening (Bourdin, Chukwudozie and Yoshioka 2012), A the length of the crack there.
  void describe_crack(const Collectives &collectives)
  {
    ++terms_version;
    std::vector<Point<dim>> broken;
    double large = 0.;
    for (const auto &cell : fields.dof_handler().active_cell_iterators())
      if (cell->is_locally_owned())
      {
        double least = 1.;
        for (const unsigned int v : cell->vertex_indices())
          least = std::min<double>(least, trial(cell->vertex_dof_index(v, 0)));
        if (least <= 0.9)
          continue;
        broken.push_back(cell->center());
        large = std::max(large, std::sqrt(cell->measure()));
      }
    breaks_large_cells = collectives.max(large) > 1.5 * length / cells_per_length;
    crack.extend(broken, mesh->triangulation, collectives);
    std::vector<DiffuseCrack<dim>::Piece> pieces(crack.stations().size());
    for_damaged_cells(nullptr,
                      [&](const Cell &cell)
                      {
                        if (cell.station < 0)
                          return;
                        auto &piece = pieces[cell.station];
                        for (const unsigned int q : cell.bulk.quadrature_point_indices())
                        {
                          const double w = cell.bulk.JxW(q);
                          const Tensor<1, dim> &slope = cell.slope[q];
                          piece.area += w * density(cell, q);
                          piece.across += w * symmetrize(outer_product(slope, slope));
                          for (const unsigned int i : cell.bulk.dof_indices())
                            piece.volume[cell.bulk_dofs[i]] -=
                              w * (slope * cell.displacement.value(i, q));
                        }
                      });
    crack.list_segments(pieces, mesh->triangulation, scene.in_situ_pore_pressure, collectives);
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
  NodalEnergy<dim> energy; ///< by d
  DiffuseCrack<dim> crack;

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
