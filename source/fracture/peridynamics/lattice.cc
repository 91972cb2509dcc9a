#include "fracture/peridynamics/lattice.h"

#include "fracture/peridynamics/driving_elongation.h"
#include "fracture/peridynamics/lattice_moduli.h"
#include "fracture/peridynamics/state_based.h"

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>

namespace stockwork::peridynamics
{
using dealii::Point;
using dealii::SymmetricTensor;
using dealii::Tensor;

namespace
{
/// Stiffness that broken bonds keep where a site has lost nearly all of them.
constexpr double remaining_share = 1e-6;
/// Of the bonds' stiffness at a free face, where about half of them are gone.
constexpr double most_correction = 2.;
/// Of `driving_of_equal_strain`. At the least Poisson's ratio (softens_by_equal_strain()) that is
/// zero, and only what is not quite equal drives the softening.
constexpr double least_driving = 0.2;

double share_left(const double damage)
{
  return std::max(1. - damage, 1. / most_correction);
}
} // namespace


template <int dim>
Lattice<dim>::Lattice(const Parameters<dim> &parameters, const Scene<dim> &scene)
  : parameters(parameters)
  , scene(scene)
  , stencil(horizon_stencil<dim>(parameters.horizon, parameters.volumes))
{
}


template <int dim>
void Lattice<dim>::setup(const ZoneShape<dim> &shape,
                         const MeshView<dim> &mesh_view,
                         const Collectives &collectives)
{
  zone.setup(shape, parameters.cell_size, stencil, parameters.state_based,
             parameters.explicit_steps, scene.moves_side, parameters.free_boundaries, mesh_view,
             collectives);
  unbreakable.clear();
  if (!parameters.unbreakable.empty())
    for (const Site<dim> &site : zone.sites())
      unbreakable.push_back(std::any_of(
        parameters.unbreakable.begin(), parameters.unbreakable.end(),
        [&](const auto &box)
        { return box.point_inside(zone.position(site.place), same_place * zone.spacing()); }));
  regions.clear();
  for (const auto &cell : mesh_view.triangulation.active_cell_iterators())
    regions.push_back(cell->material_id());
  rock_of_bonds.reinit(
    zone, stencil, scene.rock,
    [this](const RockProperties &rock)
    { return rock.energy_release_rate * std::pow(trapping(rock), 2); },
    [&](const unsigned int cell, const Point<dim> &centre)
    { return scene.rock.at(regions[cell], centre); },
    collectives);
  bonds.reinit(zone, stencil);
  set_law(zone.spacing());
  in_situ_is_zero = true;
  for (const unsigned int i : zone.peridynamic_sites())
  {
    const Point<dim> place = zone.position(zone.sites()[i].place);
    in_situ_is_zero = in_situ_is_zero && scene.in_situ_stress(place).norm() == 0. &&
                      (!scene.has_pore_pressure || scene.in_situ_pore_pressure(place) == 0.);
  }
  in_situ_is_zero = collectives.max(in_situ_is_zero ? 0. : 1.) == 0.;
}


template <int dim>
void Lattice<dim>::find_damage()
{
  damage.assign(zone.sites().size(), 0.);
  for (const unsigned int i : bonds.damaged_sites())
    damage[i] = bonds.damage(i);
}


template <int dim>
void Lattice<dim>::set_law(const double spacing)
{
  const RockProperties &rock = scene.rock.main();
  const double horizon = parameters.horizon * spacing;
  law = parameters.state_based ? state_based_law<dim>(rock, stencil, spacing)
                               : bond_based_law<dim>(rock, stencil, spacing);
  coefficients = bond_coefficients<dim>(stencil, law, spacing);
  strain_of_pressure = 1. / (dim * lattice_moduli<dim>(stencil, law, spacing).bulk());
  softening.first = 1. / std::sqrt(parameters.softening);
  softening.last = std::sqrt(parameters.softening);
  BondLaw springs = law;
  springs.dilatation_modulus = 0.;
  // What bonds across a plane take is what springs do, see DrivingElongation.
  const double at_one = crossing_energy<dim>(stencil, springs, spacing, 1.);
  // Squares of what drives bonds over their stretch: where rock is stretched by the same in all
  // directions (the same of all bonds, for their dilatation goes with stiffness times length), and
  // of bonds across a plane, in the mean, when nothing but its opening strains them (the energy of
  // dilatations counts twice, see DrivingElongation).
  double of_equal_strain = 1., of_opening = 1.;
  if (!coefficients.empty())
  {
    const BondCoefficients<dim> &bond = coefficients.front();
    of_equal_strain = 1. + 4. * dim * law.dilatation_modulus *
                             dealii::Utilities::fixed_power<dim>(spacing) * bond.dilatation /
                             (bond.stiffness * bond.length);
    of_opening = 2. * crossing_energy<dim>(stencil, law, spacing, 1.) / at_one - 1.;
  }
  driving_of_equal_strain = std::max(least_driving, std::sqrt(std::max(0., of_equal_strain)));
  const double of_continuum = continuum_critical_stretch<dim>(rock, horizon);
  // Where the lattice does not trap fractures, all that counts is what crossing bonds hold.
  critical_stretch = !std::isnan(parameters.stretch_factor)
                       ? parameters.stretch_factor * of_continuum
                     : softening.brittle() ? of_continuum * trapping(rock)
                                           : std::sqrt(rock.energy_release_rate / at_one);
  softening.first = critical_stretch / std::sqrt(parameters.softening);
  softening.last = critical_stretch * std::sqrt(parameters.softening);
  energy_across = at_one * critical_stretch * critical_stretch;
  // A crack takes at_one (s_0/trapping)^2, so 2 at_one s_0 y/trapping^2 less if bonds break when
  // they are driven by y less. The opening of a cell that gets wet is the stretch at which it does
  // over the root of of_opening; and a stretch x, the same in all directions, drives bonds that are
  // about to break by x (of_opening + of_equal_strain)/(2 of_opening^1/2) more.
  if (parameters.effective_stretch && !parameters.in_bonds && at_one > 0.)
    relief_by_fluid = spacing * softening.when_wet() / softening.first *
                      std::pow(trapping(rock), 2) / (at_one * (of_opening + of_equal_strain));
}


template <int dim>
double Lattice<dim>::trapping(const RockProperties &rock) const
{
  if (parameters.softening > 1.)
    return 1.;
  return trapping_factor(parameters.horizon, parameters.state_based
                                               ? rock.lame_lambda() / rock.shear_modulus() - 1.
                                               : 0.);
}


template <int dim>
double Lattice<dim>::elongation(const unsigned int site,
                                const unsigned int bond,
                                const std::vector<double> &u) const
{
  const FarEnd end = zone.far_end(site, bond);
  double sum = 0.;
  for (unsigned int d = 0; d < dim; ++d)
    sum += coefficients[bond].direction[d] *
           ((end.mirrored >> d & 1 ? -1. : 1.) * u[end.site * dim + d] - u[site * dim + d]);
  return sum;
}


template <int dim>
SymmetricTensor<2, dim> Lattice<dim>::effective_in_situ_stress(const unsigned int site,
                                                               const unsigned int bond,
                                                               const Point<dim> &place) const
{
  SymmetricTensor<2, dim> effective = scene.in_situ_stress(place);
  if (scene.has_pore_pressure)
    effective += (rock_of_bonds.is_uniform() ? scene.rock.main().biot_coefficient
                                             : rock_of_bonds.biot_coefficient(site, bond)) *
                 scene.in_situ_pore_pressure(place) * dealii::unit_symmetric_tensor<dim>();
  return effective;
}


template <int dim>
double Lattice<dim>::in_situ_stretch(const unsigned int site, const unsigned int bond) const
{
  if (in_situ_is_zero)
    return 0.;
  const Point<dim> middle = zone.position(zone.sites()[site].place) +
                            0.5 * coefficients[bond].length * coefficients[bond].direction;
  const RockProperties &rock = scene.rock.main();
  const double lambda = rock.lame_lambda(), mu = rock.shear_modulus();
  const SymmetricTensor<2, dim> effective = effective_in_situ_stress(site, bond, middle);
  const SymmetricTensor<2, dim> strain =
    (effective -
     lambda / (dim * lambda + 2. * mu) * trace(effective) * dealii::unit_symmetric_tensor<dim>()) /
    (2. * mu);
  const Tensor<1, dim> &e = coefficients[bond].direction;
  return e * (strain * e) / rock_of_bonds.modulus(site, bond);
}


template <int dim>
double Lattice<dim>::dilatation_factor(const unsigned int site) const
{
  return parameters.surface_correction ? 1. / share_left(corrected_damage[site]) : 1.;
}


template <int dim>
double Lattice<dim>::share_that_lacks(const unsigned int site) const
{
  return damage[site] == 0.               ? 0.
         : !parameters.surface_correction ? 1.
                                          : 1. - corrected_damage[site] / damage[site];
}


template <int dim>
double Lattice<dim>::find_dilatation(const unsigned int i,
                                     std::vector<unsigned int> &family,
                                     std::vector<Tensor<1, dim>> &functional) const
{
  const Site<dim> &site = zone.sites()[i];
  family.resize(stencil.size() + 1);
  family.back() = i;
  for (unsigned int b = 0; b < stencil.size(); ++b)
    family[b] = zone.far_end(i, b).site;
  // Bonds that lead out of the zone hold.
  dilatation_functional(
    coefficients, [&](const unsigned int b) { return site.peridynamic && bonds.is_broken(i, b); },
    functional);
  for (unsigned int b = 0; b < stencil.size(); ++b)
    for (unsigned int d = 0; d < dim; ++d)
      if (zone.far_end(i, b).mirrored >> d & 1)
        functional[b][d] = -functional[b][d];
  const double factor = dilatation_factor(i);
  return dilatation_modulus(i) * dealii::Utilities::fixed_power<dim>(zone.spacing()) * site.share *
         factor * factor;
}


template <int dim>
double Lattice<dim>::stiffness(const unsigned int site, const unsigned int bond) const
{
  if (!bonds.is_broken(site, bond))
    return correction(site, bond) * uncorrected_stiffness(site, bond);
  const unsigned int far = zone.far_end(site, bond).site;
  return is_nearly_detached(std::max(damage[site], damage[far]))
           ? remaining_share * uncorrected_stiffness(site, bond)
           : 0.;
}


template <int dim>
double Lattice<dim>::correction(const unsigned int site, const unsigned int bond) const
{
  if (!parameters.surface_correction)
    return 1.;
  const unsigned int far = zone.far_end(site, bond).site;
  return 2. / (share_left(corrected_damage[site]) + share_left(corrected_damage[far]));
}


template <int dim>
double Lattice<dim>::energy_at_unit_stretch(const BondView &view) const
{
  double energy = 0.;
  for (const auto &[s, b] : bonds.views_of(view.first, view.second))
    energy += 0.25 * zone.sites()[s].share * volume_share(s, b) * coefficients[b].stiffness *
              coefficients[b].length * coefficients[b].length;
  return energy;
}


template <int dim>
SymmetricTensor<2, dim> Lattice<dim>::strain_of_traction(const Tensor<1, dim> &n,
                                                         const Tensor<1, dim> &traction) const
{
  const LatticeModuli moduli = lattice_moduli<dim>(stencil, law, zone.spacing());
  const double normal = traction * n;
  const Tensor<1, dim> shear = traction - normal * n;
  SymmetricTensor<2, dim> strain =
    normal * strain_of_pressure * dealii::unit_symmetric_tensor<dim>();
  for (unsigned int i = 0; i < dim; ++i)
    for (unsigned int j = i; j < dim; ++j)
      strain[i][j] +=
        (n[i] * shear[j] + n[j] * shear[i]) / (i == j ? moduli.c11 - moduli.c12 : 2. * moduli.c44);
  return strain;
}


template <int dim>
SymmetricTensor<2, dim> Lattice<dim>::dry_strain(const unsigned int site,
                                                 const unsigned int bond,
                                                 const Point<dim> &place,
                                                 const Tensor<1, dim> &normal) const
{
  return strain_of_traction(normal, effective_in_situ_stress(site, bond, place) * normal);
}


template <int dim>
double Lattice<dim>::dry_stretch(const unsigned int site,
                                 const unsigned int bond,
                                 const Point<dim> &place,
                                 const Tensor<1, dim> &normal) const
{
  const Tensor<1, dim> &e = coefficients[bond].direction;
  return e * (dry_strain(site, bond, place, normal) * e) * coefficients[bond].stiffness /
         stiffness(site, bond);
}


template <int dim>
double Lattice<dim>::strength() const
{
  const RockProperties &rock = scene.rock.main();
  return (dim * rock.lame_lambda() + 2. * rock.shear_modulus()) * softening.first /
         driving_of_equal_strain;
}


template <int dim>
void Lattice<dim>::append_family(const unsigned int site, std::vector<unsigned int> &sites) const
{
  for (unsigned int b = 0; b < stencil.size(); ++b)
    sites.push_back(zone.far_end(site, b).site);
}


template <int dim>
double Lattice<dim>::push(const BondView &view) const
{
  double sum = 0.;
  for (const auto &[s, b] : bonds.views_of(view.first, view.second))
    sum += 0.5 * zone.sites()[s].share * coefficients[b].stiffness * coefficients[b].length;
  return sum;
}


/// What breaks a bond is its energy; bonds beside a crack are stiffer.
template <int dim>
double Lattice<dim>::equivalent_stretch(const unsigned int site,
                                        const unsigned int bond,
                                        const double elongation,
                                        const double relative_energy) const
{
  const double whole = volume_share(site, bond) * relative_energy * coefficients[bond].stiffness;
  return whole > 0.
           ? std::sqrt(stiffness(site, bond) / whole) * elongation / coefficients[bond].length
           : 0.;
}


template <int dim>
double Lattice<dim>::driving_stretch(const unsigned int site,
                                     const unsigned int bond,
                                     const double elongation,
                                     const double dilatation_force,
                                     const double relative_energy) const
{
  const double driving =
    driving_elongation(elongation, dilatation_force, stiffness(site, bond)).value;
  return equivalent_stretch(site, bond, driving, relative_energy);
}


template <int dim>
double Lattice<dim>::strength(const unsigned int site, const unsigned int bond) const
{
  return strength() *
         std::sqrt(rock_of_bonds.energy(site, bond) * rock_of_bonds.modulus(site, bond));
}

template class Lattice<2>;
template class Lattice<3>;
} // namespace stockwork::peridynamics
