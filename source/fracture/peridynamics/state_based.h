#pragma once

#include "fracture/peridynamics/bond_law.h"
#include "stockwork/rock/rock.h"

namespace stockwork::peridynamics
{
/// The linear peridynamic solid (Silling et al. 2007) with the influence function 1/|xi|, for any
/// Poisson's ratio, in plane strain, plane stress and in space. With q and theta of bond_law.h, its
/// energy density at a site,
///
///   W = 1/2 kappa theta^2 + 1/2 (d (d+2) G/q) sum_b (beta V/|xi|) (elongation - theta |xi|/d)^2,
///
/// is, the squares written out, that of bonds with c = 2 d (d+2) G/q and of (lambda - G) theta^2/2
/// besides, lambda being Lame's constant (of the plane, in plane stress; kappa = lambda + 2 G/d).
/// For lambda = G nothing is left but bonds.
///
/// On a lattice with its own q, theta of a homogeneous strain is its trace and the bonds' mean
/// shear modulus is G, so bulk and mean shear modulus are exact for every m and every volume rule;
/// with VolumeRule::isotropic the lattice has no other moduli. The energy is positive for kappa >
/// 0, also when bonds are broken: q is the whole stencil's, so (sum elongation)^2 is bounded by the
/// bonds.
template <int dim>
BondLaw state_based_law(const RockProperties &rock,
                        const std::vector<StencilBond<dim>> &stencil,
                        const double spacing);

/// Whether bonds that soften would set free energy where rock is stretched by the same in all
/// directions, see DrivingElongation: 1 + 2 d (lambda - G)/((d + 2) G) is not negative. From a
/// Poisson's ratio of 0 on in a plane, of 1/14 in space.
template <int dim>
bool softens_by_equal_strain(const RockProperties &rock)
{
  constexpr double least = (dim - 2.) / (2. * dim); // lambda/G
  return rock.stiffness ||                          // refused where it is of no use
         rock.lame_lambda() > (least - 1e-9) * rock.shear_modulus();
}

/// The dilatation of a site as a linear functional: theta = sum_b coefficients[b] . u_b +
/// coefficients[n] . u, with u_b the displacement of the neighbour over bond b of n, u its own.
///
/// This is what assembly needs beside the bonds: a site gives stiffness A V coefficients x
/// coefficients to all of its family, itself included, so sites two horizons apart are coupled. It
/// takes part in every row within its horizon, whether its own row is a bond's or a finite
/// element's; the horizons of finite-element vertices around the zone must hence be uniform, too.
/// A bond that breaks changes the functionals of its two ends.
/// @param is_broken of the site's bonds, by index; broken ones do not count
template <int dim, typename Predicate>
void dilatation_functional(const std::vector<BondCoefficients<dim>> &bonds,
                           const Predicate &is_broken,
                           std::vector<dealii::Tensor<1, dim>> &coefficients)
{
  coefficients.assign(bonds.size() + 1, dealii::Tensor<1, dim>());
  for (unsigned int b = 0; b < bonds.size(); ++b)
    if (!is_broken(b))
    {
      coefficients[b] = bonds[b].dilatation * bonds[b].direction;
      coefficients.back() -= coefficients[b];
    }
}
} // namespace stockwork::peridynamics
