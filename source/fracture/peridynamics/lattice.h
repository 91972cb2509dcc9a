#pragma once

#include "fracture/peridynamics/bond_set.h"
#include "fracture/peridynamics/parameters.h"
#include "fracture/peridynamics/rock_of_bonds.h"
#include "fracture/peridynamics/softening.h"
#include "stockwork/exchange/scene.h"

#include <vector>

namespace stockwork::peridynamics
{
/// Rock as bonds: where its sites are, which bonds are broken, how stiff the others are, and what
/// they feel of the stress in situ. What softens between whole and broken is the model's.
template <int dim>
class Lattice
{
public:
  Lattice(const Parameters<dim> &parameters, const Scene<dim> &scene);

  /// The bonds of cells of this size [m].
  void set_law(double spacing);

  /// Collective. As the mesh has it, with all bonds whole.
  void setup(const ZoneShape<dim> &shape,
             const MeshView<dim> &mesh_view,
             const Collectives &collectives);

  /// `damage` by the bonds that are broken now.
  void find_damage();

  /// Append the sites that a site's bonds lead to.
  void append_family(unsigned int site, std::vector<unsigned int> &sites) const;

  /// In the cell at a place.
  const RockProperties &rock_at(const Place<dim> &place) const
  {
    return scene.rock(regions[zone.active_cell_index(place)]);
  }

  /// A bond of a site in 'Unbreakable'.
  bool never_breaks(unsigned int site, unsigned int bond) const
  {
    return !unbreakable.empty() &&
           (unbreakable[site] || unbreakable[zone.far_end(site, bond).site]);
  }

  /// Isotropic effective stress at which bonds begin to break, or to soften, in the rock outside of
  /// regions [Pa].
  double strength() const;

  /// The same at a bond, by the rock at its middle.
  double strength(unsigned int site, unsigned int bond) const;

  // What they feel in situ.

  /// At a place on a bond, with its Biot coefficient [Pa].
  dealii::SymmetricTensor<2, dim> effective_in_situ_stress(unsigned int site,
                                                           unsigned int bond,
                                                           const dealii::Point<dim> &place) const;

  /// Stretch that a bond has in the intact rock, by the effective in-situ stress.
  double in_situ_stretch(unsigned int site, unsigned int bond) const;

  /// Of a bond across a dry plane, by the effective in-situ traction at a place on it, which a
  /// fracture there would release.
  double dry_stretch(unsigned int site,
                     unsigned int bond,
                     const dealii::Point<dim> &place,
                     const dealii::Tensor<1, dim> &normal) const;

  /// The strain of the lattice by that traction.
  dealii::SymmetricTensor<2, dim> dry_strain(unsigned int site,
                                             unsigned int bond,
                                             const dealii::Point<dim> &place,
                                             const dealii::Tensor<1, dim> &normal) const;

  /// Strain of the lattice under a stress that has this traction on a plane of this normal, and is
  /// the same in all directions along this plane and across it, but for shear.
  dealii::SymmetricTensor<2, dim> strain_of_traction(const dealii::Tensor<1, dim> &normal,
                                                     const dealii::Tensor<1, dim> &traction) const;

  // Of a bond of a peridynamic site.

  /// Under displacements of all sites [m].
  double elongation(unsigned int site, unsigned int bond, const std::vector<double> &u) const;

  /// By how much less there is to a bond where its ends have less than a cell of rock; zero: it is
  /// absent.
  double volume_share(const unsigned int site, const unsigned int bond) const
  {
    const FarEnd far = zone.far_end(site, bond);
    return far.absent ? 0. : zone.sites()[site].volume * zone.sites()[far.site].volume;
  }

  /// Of a bond that holds, by the rock there is to it [N/m].
  double uncorrected_stiffness(const unsigned int site, const unsigned int bond) const
  {
    return volume_share(site, bond) * coefficients[bond].stiffness *
           rock_of_bonds.modulus(site, bond);
  }

  /// Where bonds are broken the others are stiffer by V over the mean of V_left of both ends, so
  /// that a free face is not too soft (Le and Bobaru 2018, the volume method), once a tip has left
  /// them behind: near it, bonds are stretched, and to make them stiffer then would add energy, 5 %
  /// of G_c.
  double correction(unsigned int site, unsigned int bond) const;

  /// Force per elongation [N/m], corrected. A site with hardly any bond left keeps a little of the
  /// broken ones.
  double stiffness(unsigned int site, unsigned int bond) const;

  /// Elastic energy of a bond in the rock outside of regions, all of its views, at stretch one
  /// [J/m].
  double energy_at_unit_stretch(const BondView &view) const;

  /// Of all views of a bond, stiffness times length, as far as it lies in the domain [N/m^2 times
  /// m^dim].
  double push(const BondView &view) const;

  /// Stretch of a bond, by the pressure that the deck gives the fluid in all cracks, as of a
  /// uniform stress.
  double stretch_of_given_pressure() const
  {
    return scene.crack_pressure * strain_of_pressure;
  }

  /// Stretch, of a bond of the lattice's stiffness in the rock outside of regions that has as much
  /// of the energy that it takes.
  /// @param relative_energy that it takes, over that of a bond in the rock outside of regions
  double equivalent_stretch(unsigned int site,
                            unsigned int bond,
                            double elongation,
                            double relative_energy) const;

  /// The same by what drives its damage.
  /// @param dilatation_force on it [N]
  double driving_stretch(unsigned int site,
                         unsigned int bond,
                         double elongation,
                         double dilatation_force,
                         double relative_energy) const;

  // Dilatations, of state-based bonds.

  /// Of a site: its energy per volume is half of it times the dilatation squared [Pa].
  double dilatation_modulus(unsigned int site) const
  {
    return rock_of_bonds.is_uniform() ? law.dilatation_modulus
                                      : rock_of_bonds.dilatation_modulus(site);
  }

  /// Whether any dilatation has an energy.
  bool has_dilatations() const
  {
    return parameters.state_based && (law.state_based() || !rock_of_bonds.is_uniform());
  }

  /// Force on a bond by the dilatation of one end, over that, where rock is under a uniform stress:
  /// the lattice's, whatever the rock is there [Pa m^(d-1)].
  double force_of_dilatation(const unsigned int bond) const
  {
    return law.dilatation_modulus * dealii::Utilities::fixed_power<dim>(zone.spacing()) *
           coefficients[bond].dilatation;
  }

  /// The force on a bond by those of both its ends.
  /// @param forces of sites, see Peridynamics::dilatation_forces()
  double force_of_dilatations(const unsigned int site,
                              const unsigned int bond,
                              const std::vector<double> &forces) const
  {
    return forces.empty() ? 0.
                          : coefficients[bond].dilatation *
                              (forces[site] + forces[zone.far_end(site, bond).site]);
  }

  /// Of what the dilatation of a site lacks by broken bonds, the share that the surface correction
  /// does not make up for.
  double share_that_lacks(unsigned int site) const;

  /// By `Surface correction`, of the dilatation of a site that has lost bonds: with it, a uniform
  /// expansion has the same dilatation as everywhere.
  double dilatation_factor(unsigned int site) const;

  /// The functional of a site's dilatation: theta = sum_k functional_k . u_k over sites k of its
  /// family.
  /// @return the modulus, of its energy: modulus/2 theta^2 [N/m times m^dim]
  double find_dilatation(unsigned int site,
                         std::vector<unsigned int> &family,
                         std::vector<dealii::Tensor<1, dim>> &functional) const;

  /// A site with hardly any bond left: a little of the broken ones holds it, see stiffness().
  static bool is_nearly_detached(const double damage)
  {
    return damage > 0.9;
  }

  const Parameters<dim> &parameters;
  const Scene<dim> &scene;

  const std::vector<StencilBond<dim>> stencil;
  Zone<dim> zone;
  BondSet<dim> bonds; ///< broken ones
  RockOfBonds<dim> rock_of_bonds;
  std::vector<dealii::types::material_id> regions; ///< of the rock, by active cell index
  std::vector<double> damage;                      ///< of all sites
  std::vector<double> corrected_damage; ///< what the surface correction, if any, makes up for
  bool in_situ_is_zero = true;

  BondLaw law;
  std::vector<BondCoefficients<dim>> coefficients;
  SofteningLaw softening;
  double critical_stretch = 0.;
  /// What all bonds across a plane take, as springs [J/m^2]: G_c of those that soften; less of
  /// brittle ones, by what the lattice traps cracks.
  double energy_across = 0.;
  double strain_of_pressure = 0.; ///< of the lattice, in each direction [1/Pa]
  double relief_by_fluid = 0.;    ///< stretch that a fluid's pressure relieves bonds of [1/Pa]
  /// What drives the damage of a bond, over its stretch, where rock is stretched by
  /// the same in all directions.
  double driving_of_equal_strain = 1.;

private:
  /// What the critical stretch of bonds in a rock is reduced by, see trapping_factor(); 1 of those
  /// that soften.
  double trapping(const RockProperties &rock) const;

  std::vector<bool> unbreakable; ///< sites; empty: none
};
} // namespace stockwork::peridynamics
