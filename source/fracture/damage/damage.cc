#include "fracture/damage/damage.h"

#include "mesh/geometry.h"

#include <deal.II/base/mpi.h>

#include <boost/serialization/vector.hpp>

#include "stockwork/base/error.h"
#include "stockwork/base/quantity.h"
#include "stockwork/exchange/released_traction.h"
#include "stockwork/fracture/registry.h"
#include "stockwork/rock/linear_stiffness.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace stockwork::damage
{
using dealii::Point;
using dealii::SymmetricTensor;
using dealii::Tensor;

namespace
{
/// Of faces that touch, in stiffnesses of the rock over a cell: about three times that of the
/// unbroken seam.
constexpr double contact_stiffness = 20.;


/// A cell of this size holds no more energy than its crack takes; with more strength it would snap
/// back (physics.md, 6) [Pa].
double greatest_strength(const RockProperties &rock, const double size)
{
  return 0.9 * std::sqrt(2. * rock.plane_modulus() * rock.energy_release_rate / size);
}
} // namespace


template <int dim>
Damage<dim>::Damage(const Parameters &parameters, const Scene<dim> &scene)
  : parameters(parameters)
  , scene(scene)
{
  if (!(scene.rock.main().energy_release_rate > 0.))
    throw InputError("The damage model needs the rock's energy release rate G_c (Rock / Energy "
                     "release rate, or Fracture toughness).");
  if (scene.cracks.empty())
    throw InputError("The damage model needs an initial crack or notch to grow from.");
  for (const auto &crack : scene.cracks)
    if (crack.kind == InitialCrack<dim>::Kind::propped)
      throw EntryError(crack.entry, crack.text, "no propped crack with 'Fracture/Model = damage'");
}


template <int dim>
void Damage<dim>::setup(const MeshView<dim> &d, const Collectives &collectives)
{
  mesh_view = std::make_unique<MeshView<dim>>(d);
  band.setup(d);
  if (!started)
    start(collectives);
  all_segments = band.segments(scene.in_situ_pore_pressure);
}


template <int dim>
double Damage<dim>::rock_stiffness(const CrackCell<dim> &crack) const
{
  const auto across = dealii::symmetrize(dealii::outer_product(crack.normal, crack.normal));
  const LinearStiffness<dim> hooke(scene.rock.at(crack.region, crack.centre()));
  return across * hooke.stress(across) / crack.size_across();
}


template <int dim>
void Damage<dim>::choose_strength(const dealii::types::material_id region, const double size)
{
  const RockProperties &rock = scene.rock(region);
  const double energy = rock.energy_release_rate, modulus = rock.plane_modulus();
  double strength = rock.tensile_strength;
  std::ostringstream message;
  const double most = greatest_strength(rock, size);
  if (std::isnan(strength))
  {
    // Fewer, and a crack advances by jumps; more, and the process zone is as long as the crack, in
    // three dimensions above all, where cells are few.
    constexpr double cells = dim == 2 ? 4. : 2.;
    strength = std::sqrt(modulus * energy / (cells * size));
    message << "Tensile strength: " << strength << " Pa, chosen so that the cohesive length is "
            << cells << " cells of " << size << " m.";
  }
  else if (strength > most)
  {
    message << "Cells of " << size << " m are too large for a tensile strength of " << strength
            << " Pa: it is lowered to " << most << " Pa, and the energy of fracture stays. Cells of "
            << 0.25 * modulus * energy / (strength * strength) << " m would resolve it.";
    strength = most;
  }
  else if (const double length = modulus * energy / (strength * strength);
           size > 0.25 * length * (1. + 1e-6))
    message << "The cohesive length E'G_c/T^2 = " << length << " m is not resolved by cells of "
            << size << " m; pressure and width will be too large. Use cells of at most "
            << 0.25 * length << " m, or a lower tensile strength.";
  if (!message.str().empty())
    messages.push_back(message.str());
  laws[region] = law_of(rock, strength);
}


template <int dim>
SeamLaw Damage<dim>::law_of(const RockProperties &rock, const double strength) const
{
  const LinearStiffness<dim> hooke(rock);
  const double shear = hooke.shear_modulus(),
               uniaxial = hooke.bulk_modulus() + (2. - 2. / dim) * shear;
  return SeamLaw::of_rock(strength, rock.energy_release_rate, parameters.elastic_share,
                          shear / uniaxial);
}


template <int dim>
SeamLaw Damage<dim>::law(const CrackCell<dim> &crack) const
{
  const SeamLaw &of_region = laws.at(crack.region);
  const RockProperties &scale = scene.rock(crack.region);
  if (!scale.is_random())
    return of_region;
  const RockProperties here = scene.rock.at(crack.region, crack.centre());
  const double factor = scale.random->factors(crack.centre())[RandomField::tensile_strength];
  return law_of(here, std::min(factor * of_region.strength, greatest_strength(here, crack.size())));
}


template <int dim>
void Damage<dim>::start(const Collectives &collectives)
{
  messages.clear();
  laws.clear();
  std::vector<CrackCell<dim>> all;
  for (const auto &crack : scene.cracks)
  {
    std::vector<CrackCell<dim>> passed = collectives.gather(band.passed(crack));
    std::sort(passed.begin(), passed.end(),
              [](const auto &a, const auto &b) { return a.id < b.id; });
    if (passed.empty())
      throw EntryError(crack.entry, crack.text,
                       "a crack that is longer than half a cell; this one passes none");
    for (CrackCell<dim> &cell : passed)
    {
      if (std::any_of(all.begin(), all.end(), [&](const auto &other) { return other.id == cell.id; }))
        continue;
      if (laws.count(cell.region) == 0)
        choose_strength(cell.region, cell.size());
      if (crack.kind == InitialCrack<dim>::Kind::open)
        cell.greatest = law(cell).critical;
      all.push_back(cell);
    }
  }
  band.replace(all);
  committed = all;
}


template <int dim>
void Damage<dim>::begin_step(const StepContext &)
{
  n_presses = 0;
  n_advances = 0;
  needs_mesh = false;
  n_messages_before = messages.size();
}


template <int dim>
typename Damage<dim>::Touch Damage<dim>::touch(const CrackCell<dim> &crack,
                                               const double opening) const
{
  const double stiffness = contact_stiffness * rock_stiffness(crack);
  const double traction = std::min(crack.carried + stiffness * opening, 0.);
  return {traction, traction < 0. ? stiffness : 0.};
}


template <int dim>
void Damage<dim>::assemble(const StepContext &, const State &state, Sink &sink) const
{
  LocalSystem local;
  std::vector<Tensor<1, dim>> jumps(dim);
  for (unsigned int d = 0; d < dim; ++d)
    jumps[d][d] = 1.;
  for (const auto &owned : band.owned())
  {
    const CrackCell<dim> &crack = band.cells[owned.number];
    const Tensor<1, dim> jump = band.jump(owned.number, state.current.extra);
    const double area = crack.area();
    const SeamResponse<dim> seam =
      law(crack).template evaluate<dim>(crack.normal, jump, crack.greatest);
    const Touch touching = touch(crack, jump * crack.normal);
    local.extra.clear();
    for (unsigned int d = 0; d < dim; ++d)
      local.extra.push_back(dim * owned.number + d);
    local.reinit();
    add_released_traction<dim>(scene, crack.centre(), crack.normal, area, jumps, local.residual);
    const Tensor<1, dim> traction = seam.traction + touching.traction * crack.normal;
    for (unsigned int i = 0; i < dim; ++i)
    {
      local.residual(i) += area * traction[i];
      for (unsigned int j = 0; j < dim; ++j)
        local.matrix(i, j) = area * (seam.tangent[i][j] +
                                     touching.slope * crack.normal[i] * crack.normal[j]);
    }
    sink.add(local);
  }
}


template <int dim>
bool Damage<dim>::press_faces(const State &state)
{
  constexpr unsigned int enough = 4; // what is left by then goes with the next step
  if (n_presses == enough)
    return false;
  double opening = greatest_opening;
  for (unsigned int i = 0; i < band.cells.size(); ++i)
    opening = std::max(opening, band.jump(i, state.current.extra) * band.cells[i].normal);
  bool pressed = false;
  for (unsigned int i = 0; i < band.cells.size(); ++i)
  {
    CrackCell<dim> &crack = band.cells[i];
    if (crack.greatest < law(crack).critical)
      continue; // a seam that still holds would be torn when this pressure goes
    const double gap = band.jump(i, state.current.extra) * crack.normal;
    const Touch touching = touch(crack, gap);
    if (touching.traction == 0. || std::abs(gap) <= 0.005 * opening ||
        std::abs(gap) * touching.slope <= -0.01 * touching.traction)
      continue;
    crack.carried = touching.traction;
    pressed = true;
  }
  n_presses += pressed;
  return pressed;
}


template <int dim>
bool Damage<dim>::commit(const StepContext &, const State &state)
{
  started = true;
  for (unsigned int i = 0; i < band.cells.size(); ++i)
  {
    CrackCell<dim> &crack = band.cells[i];
    const Tensor<1, dim> jump = band.jump(i, state.current.extra);
    greatest_opening = std::max(greatest_opening, jump * crack.normal);
    crack.reached = std::max(crack.reached, reached_share(i, state));
    crack.greatest =
      law(crack).template evaluate<dim>(crack.normal, jump, crack.greatest).greatest;
    crack.carried = crack.greatest >= law(crack).critical
                      ? touch(crack, jump * crack.normal).traction
                      : 0.;
  }
  committed = band.cells;
  waits_for_mesh = needs_mesh;
  return false;
}


template <int dim>
void Damage<dim>::rollback()
{
  band.replace(committed);
  messages.resize(std::min(messages.size(), n_messages_before));
  begin_step({});
  all_segments = band.segments(scene.in_situ_pore_pressure);
}


template <int dim>
std::vector<std::string> Damage<dim>::take_messages()
{
  std::vector<std::string> taken;
  taken.swap(messages);
  n_messages_before = 0;
  return taken;
}


template <int dim>
void Damage<dim>::wanted_cell_size(
  const dealii::parallel::distributed::Triangulation<dim> &triangulation,
  std::vector<float> &sizes) const
{
  if (!mesh_view)
  {
    if (parameters.cell_size > 0.)
      for (const auto &cell : triangulation.active_cell_iterators())
        if (cell->is_locally_owned())
          for (const auto &crack : scene.cracks)
            if (crack.distance(cell->center()) <
                0.5 * cell->diameter() + parameters.rings_ahead * parameters.cell_size)
              sizes[cell->active_cell_index()] =
                std::min(sizes[cell->active_cell_index()], static_cast<float>(parameters.cell_size));
    return;
  }
  // A crack passes cells of one level only. TODO cells far from the front need fewer rings
  for (const auto &cell : triangulation.active_cell_iterators())
    if (cell->is_locally_owned())
    {
      const Point<dim> centre = cell->center();
      float &size = sizes[cell->active_cell_index()];
      for (const CrackCell<dim> &crack : band.cells)
      {
        const double h = crack.size();
        if (centre.distance(crack.centre()) < parameters.rings_ahead * h + 0.5 * cell->diameter())
          size = std::min(size, static_cast<float>(std::ldexp(
                                  cell_size(cell), cell->level() -
                                                     int(crack.id.get_child_indices().size()))));
      }
    }
}


template <int dim>
void Damage<dim>::save(boost::archive::binary_oarchive &archive) const
{
  std::vector<std::pair<dealii::types::material_id, double>> strengths;
  for (const auto &[region, law] : laws)
    strengths.emplace_back(region, law.strength);
  archive << committed << strengths << started << waits_for_mesh << greatest_opening;
}


template <int dim>
void Damage<dim>::load(boost::archive::binary_iarchive &archive)
{
  std::vector<std::pair<dealii::types::material_id, double>> strengths;
  archive >> committed >> strengths >> started >> waits_for_mesh >> greatest_opening;
  laws.clear();
  for (const auto &[region, strength] : strengths)
    laws[region] = law_of(scene.rock(region), strength);
  band.replace(committed);
  if (mesh_view)
  {
    begin_step({});
    all_segments = band.segments(scene.in_situ_pore_pressure);
  }
}


template <int dim>
FractureSummary Damage<dim>::summary(const State &state, const Collectives &) const
{
  FractureSummary result;
  for (unsigned int i = 0; i < band.cells.size(); ++i)
  {
    const CrackCell<dim> &crack = band.cells[i];
    const SeamLaw &seam = law(crack);
    const double area = crack.area();
    const Tensor<1, dim> jump = band.jump(i, state.current.extra);
    if (crack.greatest > seam.start)
      result.length += area * crack.reached;
    if (crack.greatest >= seam.critical)
      result.broken_length += area;
    result.n_tips += dim == 2 && band.is_front(i);
    const auto response = seam.template evaluate<dim>(crack.normal, jump, crack.greatest);
    result.stored_energy += 0.5 * area * (response.traction * jump);
    result.dissipated_energy += area * seam.dissipation(crack.greatest);
  }
  return result;
}


template <int dim>
void Damage<dim>::write_fields(const State &state, FieldSink<dim> &sink) const
{
  std::vector<double> damage(mesh_view->triangulation.n_active_cells(), 0.), opening(damage);
  for (const auto &owned : band.owned())
  {
    const CrackCell<dim> &crack = band.cells[owned.number];
    const unsigned int index = owned.cell->active_cell_index();
    const Tensor<1, dim> jump = band.jump(owned.number, state.current.extra);
    damage[index] = law(crack).damage(crack.greatest, rock_stiffness(crack));
    opening[index] = jump * crack.normal;
    if constexpr (dim == 2)
    {
      const Tensor<1, dim> along({crack.normal[1], -crack.normal[0]});
      const Point<dim> centre =
        crack.centre() - ((crack.centre() - crack.on_plane) * crack.normal) * crack.normal;
      std::vector<std::pair<std::string, double>> values{
        {"aperture", opening[index]}, {"slip", jump * along}, {"damage", damage[index]}};
      if (state.segment_pressure)
        values.emplace_back("fluid_pressure", state.segment_pressure(crack.key()));
      sink.add_fracture_piece(
        {centre - 0.5 * crack.area() * along, centre + 0.5 * crack.area() * along}, values);
    }
  }
  sink.add_cell_field("damage", damage);
  sink.add_cell_field("opening", opening);
}


template class Damage<2>;
template class Damage<3>;


namespace
{
template <int dim>
std::unique_ptr<Damage<dim>> create(dealii::ParameterHandler &prm, const Scene<dim> &scene)
{
  return std::make_unique<Damage<dim>>(Parameters::parse(prm), scene);
}
} // namespace


void register_model(FractureModelRegistry &registry);

void register_model(FractureModelRegistry &registry)
{
  FractureModelEntry entry;
  entry.description = "Bands of damaged cells, two and three dimensions (crack band).";
  entry.declare_parameters = Parameters::declare;
  entry.create_2d = create<2>;
  entry.create_3d = create<3>;
  registry.add("damage", entry);
}
} // namespace stockwork::damage
