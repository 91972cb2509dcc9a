#include "fracture/peridynamics/foresight.h"

#include "exchange/flat_parts.h"
#include "fracture/peridynamics/lattice_moduli.h"
#include "fracture/peridynamics/state_based.h"
#include "fracture/peridynamics/wording.h"
#include "stockwork/base/error.h"
#include "stockwork/base/quantity.h"
#include "stockwork/fracture/needs.h"
#include "verification/analytical/kgd.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace stockwork::peridynamics
{
using dealii::Point;
using dealii::SymmetricTensor;
using dealii::Tensor;

namespace
{
/// In-situ stress along a crack less that across it, over the strength, below which pressure and
/// length are off by less than 1 %.
constexpr double equal_stress = 0.1;
/// That above which bonds break without end in the first step, or faces overlap, whatever its
/// length.
constexpr double hopeless_stress = 2.5;

/// Bonds that cross the way of a crack feel the stress along it as well, and the faces release only
/// that across it.
template <int dim>
void foresee_stress(const Lattice<dim> &lattice,
                    const double spacing,
                    std::vector<std::string> &messages)
{
  const Scene<dim> &scene = lattice.scene;
  double worst = equal_stress * lattice.strength();
  std::string message;
  const std::string closure = std::string("'Fracture/peridynamics/Closure = in bonds'") +
                              (dim == 2 ? " with 'Tracking = path'" : "");
  for (const InitialCrack<dim> &crack : scene.cracks)
    for (const auto &[middle, normal] : flat_parts(crack))
    {
      const SymmetricTensor<2, dim> stress = scene.in_situ_stress(middle);
      const double across = normal * (stress * normal);
      const SymmetricTensor<2, dim> difference =
        stress - across * dealii::unit_symmetric_tensor<dim>();
      const double along = (trace(stress) - across) / (dim - 1),
                   shear = (stress * normal - across * normal).norm(), unequal = difference.norm();
      if (unequal <= worst)
        continue;
      worst = unequal;
      if (unequal > hopeless_stress * lattice.strength())
        throw InputError(
          "In situ/Stress: along the crack '" + crack.text + "' it is " + megapascals(along) +
          ", across it " + megapascals(across) +
          (shear > 1e-6 * unequal ? ", with a shear stress of " + megapascals(shear) : "") +
          ". Bonds ahead of the crack feel the difference, and hold " +
          megapascals(lattice.strength()) + " with cells of " + text(spacing) +
          " m. With more than " + text(hopeless_stress) +
          " times that, runs fail in their first steps. Use " + closure + ", a smaller difference" +
          (dim == 2 ? ", smaller cells, or 'cohesive_xfem'." : " or smaller cells."));
      message =
        "The in-situ stress along the crack '" + crack.text + "', " + megapascals(along) +
        ", is not that across it, " + megapascals(across) +
        (shear > 1e-6 * unequal ? ", and there is a shear stress of " + megapascals(shear) : "") +
        ". Bonds ahead of the crack feel all of it, and what they hold, " +
        megapascals(lattice.strength()) + " with cells of " + text(spacing) + " m, is " +
        (unequal > lattice.strength() ? "less" : "little more") +
        ": expect pressures and lengths that are wrong by ten per cent and more, or no " +
        "convergence. Use " + closure + (dim == 2 ? " or 'cohesive_xfem'." : ".");
    }
  if (!message.empty())
    messages.push_back(message);
}


/// With the pressure in the bonds, stress along a crack is not felt, but the shear stress on it is:
/// it slides the faces. On a path that shears its way ahead; without, all bonds about the ends.
template <int dim>
void foresee_shear(const Lattice<dim> &lattice,
                   const double spacing,
                   std::vector<std::string> &messages)
{
  for (const InitialCrack<dim> &crack : lattice.scene.cracks)
    for (const auto &[middle, normal] : flat_parts(crack))
    {
      const Tensor<1, dim> traction = lattice.scene.in_situ_stress(middle) * normal;
      const double shear = (traction - (traction * normal) * normal).norm();
      if (shear <= lattice.strength())
        continue;
      messages.push_back(
        "On the crack '" + crack.text + "' the in-situ shear stress is " + megapascals(shear) +
        ", which slides its faces, and bonds hold " + megapascals(lattice.strength()) +
        " with cells of " + text(spacing) +
        " m: without a path those about its ends break, in the first step even. Use " +
        (dim == 3 ? "smaller cells."
                  : "'Fracture/peridynamics/Tracking = path', smaller cells, or 'cohesive_xfem'."));
      return;
    }
}


/// At rest no step converges with it; in motion the rock beside the crack comes to pieces, and the
/// run goes on.
template <int dim>
void foresee_given_pressure(const Lattice<dim> &lattice,
                            const double spacing,
                            std::vector<std::string> &messages)
{
  const Parameters<dim> &parameters = lattice.parameters;
  const Scene<dim> &scene = lattice.scene;
  for (const InitialCrack<dim> &crack : scene.cracks)
    for (const auto &[middle, normal] : flat_parts(crack))
    {
      const double across = normal * (scene.in_situ_stress(middle) * normal),
                   net = scene.crack_pressure + across;
      if (net < lattice.strength())
        continue;
      if (parameters.tracked && across >= lattice.strength())
        return; // refuse_in_situ_tension() says it better
      const std::string what =
        "in the crack '" + crack.text + "' the net pressure is " + megapascals(net) +
        ", and bonds of cells of " + text(spacing) + " m hold " + megapascals(lattice.strength()) +
        "; beyond that they break over an area where a crack should be. Cells of less than " +
        text(std::pow(lattice.strength() / net, 2) * spacing) +
        " m hold it ('Fracture/peridynamics/Cell size')";
      if (!parameters.has_inertia)
        throw EntryError("Cracks/Fluid pressure", megapascals(scene.crack_pressure),
                         "less: " + what);
      messages.push_back("'Cracks/Fluid pressure': " + what + ".");
      return;
    }
}


/// A path goes by the stress that is averaged over some horizons ahead of its tip. Where the crack
/// is no longer than that, its ends and its direction are in the average.
template <int dim>
void foresee_short_cracks(const Lattice<dim> &lattice,
                          const double spacing,
                          std::vector<std::string> &messages)
{
  constexpr double most_horizons = 2.;
  const double horizon = lattice.parameters.horizon * spacing;
  if (!lattice.parameters.tracked)
    return;
  for (const InitialCrack<dim> &crack : lattice.scene.cracks)
  {
    const auto parts = flat_parts(crack);
    const bool oblique = std::any_of(parts.begin(), parts.end(),
                                     [](const auto &part)
                                     { return std::abs(part.second[0] * part.second[1]) > 1e-6; });
    if (!oblique || crack.size() > (1. + same_place) * most_horizons * horizon)
      continue;
    messages.push_back("The crack '" + crack.text + "' is oblique to the mesh, and with " +
                       text(crack.size()) + " m no longer than two horizons, of " + text(horizon) +
                       " m: the path that begins there may have a wrong direction, and another "
                       "with other cells. Cells of less than " +
                       text(crack.size() / (most_horizons * lattice.parameters.horizon)) +
                       " m would do ('Fracture/peridynamics/Cell size'), or 'cohesive_xfem'.");
    return;
  }
}


/// Bonds that nothing guides follow the mesh's axes. Of a crack of 3 m at 10 to 60 degrees, on
/// cells of a tenth to a thirtieth of it, 1.8 to 2.6 m count as broken, and pressures and apertures
/// are off by up to a quarter and a half (doc/laboratory/peridynamics_paths.md). One that stays
/// within half a cell is as one along the mesh.
template <int dim>
void foresee_oblique_cracks(const Lattice<dim> &lattice,
                            const double spacing,
                            std::vector<std::string> &messages)
{
  const Parameters<dim> &parameters = lattice.parameters;
  if (dim == 3 || parameters.tracked || !std::isnan(lattice.scene.crack_pressure))
    return;
  for (const InitialCrack<dim> &crack : lattice.scene.cracks)
    for (unsigned int leg = 0;
         crack.kind != InitialCrack<dim>::Kind::cohesive && leg + 1 < crack.points.size(); ++leg)
    {
      const Tensor<1, dim> along = crack.points[leg + 1] - crack.points[leg];
      if (std::min(std::abs(along[0]), std::abs(along[1])) < 0.5 * spacing)
        continue;
      messages.push_back(
        "The crack '" + crack.text +
        "' is oblique to the mesh, and no path is tracked: it counts as shorter than in the deck, "
        "'broken_length' by up to two fifths and 'equivalent_length' by a fifth, its pressure may "
        "be off by a quarter and its aperture by a half" +
        (parameters.growth ? ", and it grows along the axes of the mesh" : "") +
        ". Use 'Fracture/peridynamics/Tracking = path' ('Fluid = network'; 'Closure = in bonds'), "
        "or 'cohesive_xfem' with 20 cells along the crack.");
      return;
    }
}


/// The least compression of the rock at the middle of a crack, of its grains in porous rock [Pa].
template <int dim>
double least_compression(const Scene<dim> &scene, const InitialCrack<dim> &crack)
{
  double least = std::numeric_limits<double>::max();
  for (const auto &[middle, normal] : flat_parts(crack))
  {
    double tension = eigenvalues(scene.in_situ_stress(middle))[0];
    if (scene.has_pore_pressure)
      tension += scene.rock.main().biot_coefficient * scene.in_situ_pore_pressure(middle);
    least = std::min(least, -tension);
  }
  return least > 0. ? least : 0.; // no "-0 MPa"
}

/// What the scene's greatest rate drives through its rock, as a plane fracture without walls; none
/// in three dimensions, without a crack or a rate.
template <int dim>
std::optional<analytical::KgdParameters> driven_fracture(const Scene<dim> &scene)
{
  if (dim != 2 || scene.cracks.empty() || !(scene.injection_rate > 0.))
    return std::nullopt;
  const RockProperties &rock = scene.rock.main();
  return analytical::KgdParameters{rock.young_modulus, rock.plane_stress ? 0. : rock.poisson_ratio,
                                   scene.rock.fluid().viscosity, rock.toughness(),
                                   scene.injection_rate};
}


/// The pressure of a fracture in an infinite body is greatest when it is short. It is taken when
/// each wing has the length of the crack, or of a horizon. Bonds left to themselves hold it if it
/// is below their strength. Where a path leads, the rock beside it has to hold, and has less to
/// bear: kgd/viscosity came to its end at 3.2 times the strength (0.385 MPa m^0.5, no stress) and
/// at 2.9 times strength and compression (0.01 MPa m^0.5, 0.3 MPa), and did not at 6.1 and 8.2
/// (doc/laboratory/viscous_bonds.md). That is with fluid that sucks without end: with one that
/// cavitates prm/branching came to its end at 7 to 218 times.
template <int dim>
void foresee_pressure(const Lattice<dim> &lattice,
                      const double spacing,
                      std::vector<std::string> &messages)
{
  constexpr double beside_a_path = 4.;
  const Parameters<dim> &parameters = lattice.parameters;
  const Scene<dim> &scene = lattice.scene;
  const auto fracture = driven_fracture(scene);
  if (!fracture)
    return;
  const analytical::Kgd kgd(*fracture);
  double wing = parameters.horizon * spacing, compression = std::numeric_limits<double>::max();
  for (const InitialCrack<dim> &crack : scene.cracks)
  {
    wing = std::max(wing, crack.size());
    compression = std::min(compression, least_compression(scene, crack));
  }
  // Lengths are as t^(2/3).
  const double time = std::pow(wing / kgd.half_length(1.), 1.5);
  const double pressure = kgd.inlet_pressure(time), strength = lattice.strength();
  const double held = parameters.tracked ? beside_a_path * (strength + compression) : strength;
  if (pressure < held)
    return;
  const double finer = std::pow(strength / pressure, 2) * spacing;
  messages.push_back(
    "A fracture of this rock, fluid and rate (K_m = " + text(fracture->dimensionless_toughness()) +
    ") needs a net pressure of " + megapascals(pressure) + " when its wings are " + text(wing) +
    " m long, and the bonds of cells of " + text(spacing) + " m hold " + megapascals(strength) +
    (parameters.tracked
       ? ", in rock under " + megapascals(compression) +
           " of stress in situ: cracks may begin in the rock beside the fracture, and the run may "
           "end. Rock that is pressed together by " +
           megapascals(pressure / beside_a_path - strength) +
           " would hold ('In situ/Stress'); so does 'cohesive_xfem', where none begin."
       : ": they may break over an area where a crack should be. Cells of " + text(finer) +
           " m would do ('Fracture/peridynamics/Cell size'), or 'cohesive_xfem', or "
           "'Fracture/peridynamics/Tracking = path' with 'Closure = in bonds'."));
}
} // namespace


template <int dim>
void refuse_what_bonds_do_not_know(const Parameters<dim> &parameters, const Scene<dim> &scene)
{
  // lambda/G at a Poisson's ratio of 0.4. So far the calibration of brittle bonds is right to 3 per
  // cent (trapping_factor()); at 0.45 cracks would take a third more than G_c, at 0.49 they broke
  // in pieces (doc/laboratory/bonds_any_rock.md).
  constexpr double most_brittle = 4. * (1. + 1e-9);
  needs::cracks_without_proppant(scene, "peridynamics");
  if (parameters.in_bonds && parameters.softening == 1.)
    for (const InitialCrack<dim> &crack : scene.cracks)
      if (crack.kind == InitialCrack<dim>::Kind::cohesive)
        throw EntryError("Cracks/Cohesive", crack.text,
                         "nothing with brittle bonds and 'Fracture/peridynamics/Closure = in "
                         "bonds', where fluid opens only bonds that have softened");
  for (unsigned int region = 0; region <= Rock::max_regions; ++region)
  {
    const RockProperties &rock = scene.rock(region);
    const std::string path =
      region == 0 ? std::string("Rock") : "Rock/Region " + std::to_string(region);
    if (rock.stiffness)
      throw EntryError(path + "/Law", "an anisotropic one",
                       "'elastic' with 'Fracture/Model = peridynamics': bonds are as stiff in one "
                       "direction as in another");
    const double nu = bond_based_poisson_ratio(rock.plane_stress);
    if (parameters.state_based && !softens_by_equal_strain<dim>(rock) &&
        (parameters.in_bonds || parameters.growth))
      throw EntryError(path + "/Poisson ratio", text(rock.poisson_ratio),
                       std::string(dim == 2 ? "0" : "0.072 (1/14)") +
                         " and more with state-based bonds that may break, or whose law has the "
                         "pressure; less with 'Growth = false' and 'Closure = conserving'");
    if (parameters.state_based && parameters.softening == 1. && parameters.growth &&
        rock.lame_lambda() > most_brittle * rock.shear_modulus())
      throw EntryError(path + "/Poisson ratio", text(rock.poisson_ratio),
                       "0.4 or less with state-based bonds that are brittle ('Softening = 1')");
    if (!parameters.state_based && std::abs(rock.poisson_ratio - nu) > 1e-6)
      throw EntryError(
        path + "/Poisson ratio", text(rock.poisson_ratio),
        std::string(rock.plane_stress ? "1/3" : "0.25") + " with bond-based peridynamics" +
          (rock.plane_stress ? " in plane stress" : "") + "; others with 'Bond law = state-based'");
    if (parameters.as_published &&
        (rock.is_random() || rock.young_modulus != scene.rock.main().young_modulus ||
         rock.biot_coefficient != scene.rock.main().biot_coefficient))
      throw EntryError("Fracture/peridynamics/Closure", "as published",
                       "'conserving' or 'in bonds' where the rock differs from place to place, "
                       "which the paper does not have");
    if (!parameters.growth)
      continue;
    needs::no_given_strength(
      rock, "peridynamics",
      "where the strength follows from the energy release rate and the cells' size", path);
    needs::energy_of_all_modes(rock, "peridynamics",
                               "whose bonds break by what they hold, whatever the mode", path);
    if (rock.is_random() && rock.random->varies(RandomField::tensile_strength))
      throw EntryError(path + "/Random field/Properties", "one with 'tensile strength'",
                       "a list without it with the fracture model 'peridynamics', where the "
                       "strength follows from the energy release rate and the cells' size; "
                       "'cohesive_xfem' and 'damage' take it");
  }
}


template <int dim>
void refuse_explicit_steps(const Parameters<dim> &parameters, const Scene<dim> &scene)
{
  if (!parameters.explicit_steps)
    return;
  const auto refuse = [](const std::string &allowed)
  { throw EntryError("Time/Scheme", "explicit", allowed); };
  if (parameters.state_based)
    refuse("Newmark with 'Bond law = state-based'");
  if (std::isnan(scene.crack_pressure))
    refuse("Newmark with fluid whose pressure is to be found; a given one is "
           "'Cracks/Fluid pressure', and in dry cracks 0 Pa");
  if (parameters.as_published || parameters.tensor_fluid)
    refuse("Newmark, or 'Fracture/peridynamics/Closure = auto' and 'Fluid = network': no "
           "fluid flows");
  if (scene.crack_pressure < 0.)
    throw EntryError("Cracks/Fluid pressure", to_string(scene.crack_pressure, dimension::pressure),
                     "0 or more with 'Time/Scheme = explicit', where nothing keeps the faces of a "
                     "crack from passing through one another");
  if (scene.crack_pressure != 0. && parameters.softening > 1.)
    refuse("Newmark, or brittle bonds ('Fracture/peridynamics/Softening = 1'): those that "
           "soften have no given pressure in explicit steps");
}


template <int dim>
std::vector<std::string> foresee(const Lattice<dim> &lattice, const double spacing)
{
  std::vector<std::string> messages;
  foresee_oblique_cracks(lattice, spacing, messages);
  if (!lattice.parameters.growth)
    return messages;
  if (!lattice.parameters.in_bonds)
    foresee_stress(lattice, spacing, messages);
  else if (!lattice.parameters.tracked)
    foresee_shear(lattice, spacing, messages);
  if (lattice.scene.crack_pressure > 0.)
    foresee_given_pressure(lattice, spacing, messages);
  foresee_short_cracks(lattice, spacing, messages);
  foresee_pressure(lattice, spacing, messages);
  return messages;
}

template void refuse_what_bonds_do_not_know(const Parameters<2> &, const Scene<2> &);
template void refuse_what_bonds_do_not_know(const Parameters<3> &, const Scene<3> &);
template void refuse_explicit_steps(const Parameters<2> &, const Scene<2> &);
template void refuse_explicit_steps(const Parameters<3> &, const Scene<3> &);
template std::vector<std::string> foresee(const Lattice<2> &, double);
template std::vector<std::string> foresee(const Lattice<3> &, double);
} // namespace stockwork::peridynamics
