#pragma once

#include "fracture/peridynamics/bond_law.h"
#include "stockwork/rock/rock.h"

namespace stockwork::peridynamics
{
/// Stiffness of the infinite lattice under homogeneous strain, which has cubic symmetry [Pa].
struct LatticeModuli
{
  double c11, c12, c44;
  int dim;

  /// (C11 + (d-1) C12)/d: in 2-D the area modulus, for a bond-based plane 0.8 E.
  double bulk() const
  {
    return (c11 + (dim - 1) * c12) / dim;
  }

  /// The mean of the shear modulus over all directions of the lattice (Voigt).
  double mean_shear() const
  {
    return dim == 2 ? ((c11 - c12) / 2. + c44) / 2. : (c11 - c12 + 3. * c44) / 5.;
  }

  /// (C11 - C12)/(2 C44): one for an isotropic lattice.
  double anisotropy() const
  {
    return (c11 - c12) / (2. * c44);
  }
};

/// C_ijkl = 1/2 c sum_b beta V |xi| e_i e_j e_k e_l + A delta_ij delta_kl.
template <int dim>
LatticeModuli lattice_moduli(const std::vector<StencilBond<dim>> &stencil,
                             const BondLaw &law,
                             const double spacing);

/// q = sum_b beta V |xi| [m^(d+1)]; in the limit of a fine lattice 2 pi delta^3/3 (2-D), pi
/// delta^4.
template <int dim>
double weighted_volume(const std::vector<StencilBond<dim>> &stencil, const double spacing);

/// Bond-based law of @p rock, calibrated: c = 2 d (d+2) G/q with the lattice's own sum q. Then C11
/// + (d-1) C12 is exact and the mean shear modulus is, too; what remains is the anisotropy, 3 % for
/// m = 3 with exact volumes and none with VolumeRule::isotropic.
template <int dim>
BondLaw bond_based_law(const RockProperties &rock,
                       const std::vector<StencilBond<dim>> &stencil,
                       const double spacing);

/// Poisson's ratio of a bond-based rock, for which lambda = G: 1/4, and 1/3 in plane stress.
double bond_based_poisson_ratio(const bool plane_stress);

/// Energy per area [J/m^2] in a lattice all of whose bonds across a plane between two layers of
/// sites have @p stretch, and no others.
template <int dim>
double crossing_energy(const std::vector<StencilBond<dim>> &stencil,
                       const BondLaw &law,
                       const double spacing,
                       const double stretch);

/// The stretch for which the crossing energy is G_c when sums are integrals [-]. Eq. 19 (plane
/// strain and plane stress) and sqrt(5 G_c/(9 K delta)) in 3-D (Silling and Askari 2005), all of
/// them (G_c/(g delta G))^1/2 with g = 6/pi in a plane and 3 in space. Of state-based bonds as
/// well, which take what springs do, see DrivingElongation.
template <int dim>
double continuum_critical_stretch(const RockProperties &rock, const double horizon);

/// What a critical stretch is multiplied by so that a crack along the lattice grows steadily at
/// G_c: the inverse square root of J/G_c that it needs at the hardest bond of each cell. For plane
/// strain and exact volumes that is 1.785 (m = 2), 1.477 (3), 1.38 (4), 1.215 (5) and 1.157 (6),
/// found by growing a crack in a large lattice (tests/unit/peridynamics_trapping_test.cc), the same
/// for isotropic volumes from m = 3 on. A study that took J from a domain integral in smaller
/// bodies found 1.31 (m = 3, rising with the body) and 1.17 (4). State-based, m = 3: 1.65 at
/// Poisson's ratio 0, 1.59 at 0.15, 1.39 at 0.35, 1.34 at 0.4 (1.8 at 0.45, which is refused);
/// for other m the excess over one is taken to change alike. In 3-D the same is taken: a crack
/// through a slab of four cells then takes 0.84 G_c (m = 3; 0.90 in a plane).
/// @param dilatation BondLaw::dilatation_modulus over the shear modulus
double trapping_factor(const unsigned int m, const double dilatation = 0.);

} // namespace stockwork::peridynamics
