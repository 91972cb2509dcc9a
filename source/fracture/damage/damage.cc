#include "fracture/damage/damage.h"

#include <boost/serialization/vector.hpp>

#include "discontinuity/contact.h"
#include "flow/permeability_tensor.h"
#include "fracture/damage/first_cracks.h"
#include "stockwork/base/error.h"
#include "stockwork/base/quantity.h"
#include "stockwork/exchange/released_traction.h"
#include "stockwork/fracture/needs.h"
#include "stockwork/fracture/registry.h"
#include "stockwork/rock/linear_stiffness.h"

#include <algorithm>
#include <cmath>
#include <numeric>
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
/// back (Bazant and Oh 1983) [Pa].
double greatest_strength(const RockProperties &rock, const double size)
{
  return 0.9 * std::sqrt(2. * rock.plane_modulus() * rock.energy_release_rate / size);
}
} // namespace


template <int dim>
Damage<dim>::Damage(const Parameters &parameters, const Scene<dim> &scene)
  : parameters(parameters)
  , scene(scene)
  , band(parameters.linear_jumps)
{
  needs::energy_release_rate(scene.rock, "damage");
  needs::energy_of_all_modes(scene.rock.main(), "damage",
                             "whose cracks have one energy, whatever the mode");
  check_strengths();
  needs::initial_crack(scene, "damage");
  for (const auto &crack : scene.cracks)
    if (crack.kind == InitialCrack<dim>::Kind::propped)
      throw EntryError(crack.entry, crack.text, "no propped crack with 'Fracture/Model = damage'");
}


template <int dim>
void Damage<dim>::check_strengths() const
{
  // A fluid's pressure far above the strength breaks no cell whose opening must be so large.
  if (!std::isnan(scene.crack_pressure))
    return;
  for (unsigned int region = 0; region <= Rock::max_regions; ++region)
  {
    const RockProperties &rock = scene.rock(region);
    const double length = rock.plane_modulus() * rock.energy_release_rate /
                          (rock.tensile_strength * rock.tensile_strength);
    if (!(length > scene.domain_size))
      continue;
    const double least =
      std::sqrt(rock.plane_modulus() * rock.energy_release_rate / scene.domain_size);
    throw EntryError(region == 0 ? "Rock/Tensile strength"
                                 : "Rock/Region " + std::to_string(region) + "/Tensile strength",
                     to_string(rock.tensile_strength, dimension::stress),
                     "nothing (an empty entry: the model chooses), or more than " +
                       to_string(least, dimension::stress) +
                       ", with 'Fracture/Model = damage' and fluid: below, the process zone "
                       "E'G_c/T^2 is longer than the domain");
  }
}


template <int dim>
void Damage<dim>::setup(const MeshView<dim> &d, const Collectives &collectives)
{
  mesh_view = std::make_unique<MeshView<dim>>(d);
  band.setup(d);
  if (!started)
    start(collectives);
  find_segments();
}


template <int dim>
void Damage<dim>::find_segments()
{
  springs = slip_springs();
  all_segments = band.segments(scene.in_situ_pore_pressure);
  for (unsigned int i = 0; i < all_segments.size(); ++i)
  {
    Segment<dim> &segment = all_segments[i];
    const CrackCell<dim> &crack = band.cells[band.owned()[i].number];
    // Half of Carter's leak-off in the middle of the process zone, where the tip of an elastic
    // fracture with the same toughness would be. What is broken, such as a notch of the deck, has
    // bare faces however narrow it is.
    segment.bare_aperture = broken_share(crack) < 1. ? 0.7 * law(crack).critical : 0.;
    // Zhang et al., Eqs 23 and 24: with D the compressibility of the pores grows by 1/(1 - D). That
    // of the rock is 1/K for grains that are not compressed. At D = 1 it would be infinite.
    const double integrity = std::max(1. - damage(crack), parameters.least_integrity);
    const RockProperties rock = scene.rock.at(crack.region, crack.centre());
    segment.damaged_storage = crack.size_across() / (rock.bulk_modulus() * integrity);
    if (parameters.tensor_fluid)
    {
      // The intact rock's, alpha^2/K, is in the elements of the pore pressure already.
      segment.damaged_storage *= std::pow(rock.biot_coefficient, 2) * (1. - integrity);
      permeability_tensor::leave_to_pores(segment);
    }
  }
}


template <int dim>
double Damage<dim>::damage(const CrackCell<dim> &crack) const
{
  const double mean =
    std::accumulate(crack.greatest.begin(), crack.greatest.end(), 0.) / crack.greatest.size();
  return law(crack).damage(mean, rock_stiffness(crack));
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
            << " Pa: it is lowered to " << most
            << " Pa, and the energy of fracture stays. Cells of "
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
    unsigned int n_shared = 0;
    double length = 0.;
    for (CrackCell<dim> &cell : passed)
    {
      length += cell.area();
      if (std::any_of(all.begin(), all.end(),
                      [&](const auto &other) { return other.id == cell.id; }))
      {
        ++n_shared;
        continue;
      }
      if (laws.count(cell.region) == 0)
        choose_strength(cell.region, cell.size());
      if (crack.kind == InitialCrack<dim>::Kind::open)
        cell.greatest.fill(law(cell).critical);
      press_in_situ(cell);
      all.push_back(cell);
    }
    if (2 * n_shared >= passed.size())
      throw EntryError(crack.entry, crack.text,
                       "cracks with cells of their own; half of this one's or more hold another. "
                       "Smaller cells, or cracks further apart, will do");
    for (const std::string &text :
         misfit_of_cells(crack, passed, length, !std::isnan(scene.crack_pressure)))
      messages.push_back(text);
  }
  band.replace(all);
  committed = all;
  n_initial = all.size();
  initial_size = 0.;
  for (const CrackCell<dim> &cell : all)
    initial_size = std::max(initial_size, cell.size());
  if (parameters.growth)
    for (const std::string &text : doubts_about_growth(all, scene))
      messages.push_back(text);
  if (parameters.cell_size > 1.5 * initial_size)
  {
    std::ostringstream text;
    text << "'Cell size' = " << parameters.cell_size
         << " m is without effect: the cells of the mesh "
         << "along the cracks are smaller already, " << initial_size << " m.";
    messages.push_back(text.str());
  }
}


template <int dim>
double Damage<dim>::largest_cell(const CrackCell<dim> &crack) const
{
  const RockProperties &rock = scene.rock(crack.region);
  const double strength = laws.at(crack.region).strength,
               length = rock.plane_modulus() * rock.energy_release_rate / (strength * strength);
  return std::max(initial_size, (dim == 2 ? 0.5 : 1.) * length) * (1. + 1e-6);
}


template <int dim>
void Damage<dim>::begin_step(const StepContext &context)
{
  // A single pass does not find out that faces part: they have from the start.
  if (context.restarts && !started)
    for (CrackCell<dim> &crack : band.cells)
      crack.carried = 0.;
  n_presses = 0;
  n_advances = n_moving = n_cracked = 0;
  needs_mesh = arrested = false;
  n_messages_before = messages.size();
  laws_before = laws;
  find_segments();
}


template <int dim>
ContactLaw Damage<dim>::contact_law(const CrackCell<dim> &crack) const
{
  return {contact_stiffness * rock_stiffness(crack), parameters.friction};
}


template <int dim>
void Damage<dim>::press_in_situ(CrackCell<dim> &crack) const
{
  const Tensor<1, dim> traction = scene.in_situ_stress(crack.middle()) * crack.normal;
  const double across = traction * crack.normal,
               pressure = std::isnan(scene.crack_pressure)
                            ? scene.in_situ_pore_pressure(crack.middle())
                            : scene.crack_pressure;
  const Tensor<1, dim> shear = traction - across * crack.normal;
  crack.carried = std::min(across + pressure, 0.);
  if (crack.greatest[0] < law(crack).critical)
    crack.held = shear;
  else
    crack.slip = -shear / contact_law(crack).stiffness;
}


template <int dim>
double Damage<dim>::broken_share(const CrackCell<dim> &crack) const
{
  const SeamLaw of_rock = law(crack);
  double sum = 0.;
  for (const double greatest : crack.greatest)
    sum += 1. - of_rock.kept(greatest);
  return sum / crack.greatest.size();
}


template <int dim>
ContactResponse<dim> Damage<dim>::contact(const CrackCell<dim> &crack,
                                          const Tensor<1, dim> &jump) const
{
  return contact_law(crack).template evaluate<dim>(crack.normal, jump, crack.slip,
                                                   broken_share(crack), crack.carried);
}


template <int dim>
Tensor<1, dim> Damage<dim>::seam_jump(const CrackCell<dim> &crack, const Tensor<1, dim> &jump) const
{
  return jump + crack.carried / contact_law(crack).stiffness * crack.normal;
}


template <int dim>
SeamResponse<dim> Damage<dim>::seam(const CrackCell<dim> &crack,
                                    const unsigned int point,
                                    const Tensor<1, dim> &jump) const
{
  return law(crack).template evaluate<dim>(crack.normal, seam_jump(crack, jump),
                                           crack.greatest[point]);
}


template <int dim>
void Damage<dim>::assemble(const StepContext &context, const State &state, Sink &sink) const
{
  if (parameters.tensor_fluid) // segments and owned cells of the band are in the same order
    for (unsigned int i = 0; i < all_segments.size(); ++i)
    {
      const Segment<dim> &segment = all_segments[i];
      permeability_tensor::add_flow(
        permeability_tensor::Cell<dim>(band.cells[band.owned()[i].number].vertices), segment,
        hydraulic_aperture_cubed(value(segment.opening, state.current),
                                 parameters.minimum_aperture),
        context.effective_dt() / scene.rock.fluid().viscosity, state, sink);
    }
  LocalSystem local;
  for (const auto &owned : band.owned())
  {
    const CrackCell<dim> &crack = band.cells[owned.number];
    const std::vector<Motion<dim>> &motions = band.motions(owned.number);
    local.extra.clear();
    std::vector<Tensor<1, dim>> at_middle;
    for (unsigned int k = 0; k < motions.size(); ++k)
    {
      local.extra.push_back(band.first_unknown(owned.number) + k);
      at_middle.push_back(motions[k].base);
    }
    local.reinit();
    const double area = crack.area(), share = area / CrackCell<dim>::n_points;
    add_released_traction<dim>(scene, crack.middle(), crack.normal, area, at_middle,
                               local.residual);
    const auto points = crack.points();
    const auto jumps = band.jumps(owned.number, state.current.extra);
    std::vector<Tensor<1, dim>> moved(motions.size());
    for (unsigned int q = 0; q < points.size(); ++q)
    {
      for (unsigned int k = 0; k < motions.size(); ++k)
        moved[k] = motions[k].at(points[q]);
      const SeamResponse<dim> held = seam(crack, q, jumps[q]);
      const Tensor<1, dim> traction =
        held.traction + law(crack).kept(crack.greatest[q]) * crack.held;
      for (unsigned int i = 0; i < moved.size(); ++i)
      {
        local.residual(i) += share * (traction * moved[i]);
        for (unsigned int j = 0; j < moved.size(); ++j)
          local.matrix(i, j) += share * (moved[i] * (held.tangent * moved[j]));
      }
    }
    const ContactResponse<dim> touching =
      contact(crack, band.jump(owned.number, state.current.extra));
    const Tensor<1, dim> traction = touching.normal * crack.normal + touching.shear;
    for (unsigned int i = 0; i < at_middle.size(); ++i)
    {
      local.residual(i) += area * (traction * at_middle[i]);
      for (unsigned int j = 0; j < at_middle.size(); ++j)
        local.matrix(i, j) += area * (at_middle[i] * (touching.tangent * at_middle[j]));
    }
    sink.add(local);
  }
  hold_stairs(state, sink);
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
    if (broken_share(crack) < 1.)
      continue; // a seam that still holds would be torn when this pressure goes
    const ContactResponse<dim> touching = contact(crack, band.jump(i, state.current.extra));
    const double gap = std::abs(touching.gap);
    if (touching.normal == 0. || gap <= 0.005 * opening ||
        gap * contact_law(crack).stiffness <= -0.01 * touching.normal)
      continue;
    crack.carried = touching.normal;
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
    const auto jumps = band.jumps(i, state.current.extra);
    greatest_opening = std::max(greatest_opening, band.jump(i, state.current.extra) * crack.normal);
    crack.reached = std::max(crack.reached, std::min(1., reached_share(i, state)));
    const ContactResponse<dim> touching = contact(crack, band.jump(i, state.current.extra));
    dissipated += crack.area() * (touching.shear * (touching.slip - crack.slip));
    for (unsigned int q = 0; q < jumps.size(); ++q)
    {
      const double before = crack.greatest[q];
      crack.greatest[q] = seam(crack, q, jumps[q]).greatest;
      dissipated += crack.area() / CrackCell<dim>::n_points *
                    (law(crack).dissipation(crack.greatest[q]) - law(crack).dissipation(before));
    }
    crack.slip = touching.slip;
    if (broken_share(crack) == 1.)
    {
      crack.carried = touching.normal;
      touched |= touching.normal < 0.;
    }
  }
  n_arrested = arrested && n_advances == 0 && std::isnan(scene.crack_pressure) ? n_arrested + 1 : 0;
  committed = band.cells;
  waits_for_mesh = needs_mesh;
  return false;
}


template <int dim>
void Damage<dim>::rollback()
{
  band.replace(committed);
  laws = laws_before;
  messages.resize(std::min(messages.size(), n_messages_before));
  begin_step({});
}


template <int dim>
std::vector<std::string> Damage<dim>::take_messages()
{
  std::vector<std::string> taken;
  taken.swap(messages);
  n_messages_before = 0;
  if (touched && !said)
  {
    said = true;
    taken.push_back(faces_touch(parameters.friction));
  }
  return taken;
}


template <int dim>
void Damage<dim>::save(boost::archive::binary_oarchive &archive) const
{
  std::vector<std::pair<dealii::types::material_id, double>> strengths;
  for (const auto &[region, law] : laws)
    strengths.emplace_back(region, law.strength);
  archive << committed << n_initial << initial_size << n_arrested << strengths << started
          << waits_for_mesh << greatest_opening << dissipated << touched << said;
}


template <int dim>
void Damage<dim>::load(boost::archive::binary_iarchive &archive)
{
  std::vector<std::pair<dealii::types::material_id, double>> strengths;
  archive >> committed >> n_initial >> initial_size >> n_arrested >> strengths >> started >>
    waits_for_mesh >> greatest_opening >> dissipated >> touched >> said;
  laws.clear();
  for (const auto &[region, strength] : strengths)
    laws[region] = law_of(scene.rock(region), strength);
  band.replace(committed);
  if (mesh_view)
  {
    begin_step({});
  }
}


template class Damage<2>;
template class Damage<3>;


namespace
{
template <int dim>
std::unique_ptr<Damage<dim>> create(dealii::ParameterHandler &prm, const Scene<dim> &scene)
{
  return std::make_unique<Damage<dim>>(Parameters::parse(prm, dim), scene);
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
