#pragma once

#include "fracture/peridynamics/stencil.h"

namespace stockwork::peridynamics
{
/// The elastic law of all bonds of a uniform lattice with spacing h and sites of volume V = h^d (in
/// 2-D per metre of thickness). Bond-based and ordinary state-based peridynamics are one law with
/// one more constant; both are a sum of squares of linear functionals of the displacement,
///
///   W = sum over bonds (once each) of  1/2 k (e . (u_j - u_i))^2
///     + sum over sites of              1/2 A V theta_i^2,   theta_i = sum_b g_b e_b . (u_j - u_i),
///
/// with k = c beta V^2/|xi| (Eq. 27 of Sun et al. 2021), g = d beta V/q and the weighted volume
/// q = sum_b beta V |xi|, the sum over the *whole* stencil: a site that loses bonds keeps its q,
/// and the energy can only fall when a bond breaks. theta is the trace of a homogeneous strain.
///
/// A is zero for bond-based peridynamics, which implies lambda = G, Poisson's ratio 1/4 (1/3 in
/// plane stress). For the linear peridynamic solid (Silling et al. 2007, with influence function
/// 1/|xi|) it is lambda - G: see state_based.h.
struct BondLaw
{
  double micromodulus;            ///< c, bond force per stretch and per V^2 [N/m^(2d)]
  double dilatation_modulus = 0.; ///< A [Pa]
  double weighted_volume;         ///< q [m^(d+1)]

  /// Without, only the two ends of a bond are coupled; with, all sites of one family are, that is,
  /// sites up to two horizons apart.
  bool state_based() const
  {
    return dilatation_modulus != 0.;
  }
};

/// A bond of the stencil as assembly needs it.
template <int dim>
struct BondCoefficients
{
  dealii::Tensor<1, dim> direction; ///< e, from the site to its neighbour
  double length;                    ///< |xi| [m]
  double stiffness;                 ///< k, force per elongation [N/m]
  double dilatation;                ///< g, theta per elongation [1/m]
};

/// The coefficients of all bonds of @p stencil, in its order, at lattice spacing @p spacing [m].
template <int dim>
std::vector<BondCoefficients<dim>> bond_coefficients(const std::vector<StencilBond<dim>> &stencil,
                                                     const BondLaw &law,
                                                     const double spacing);
} // namespace stockwork::peridynamics
