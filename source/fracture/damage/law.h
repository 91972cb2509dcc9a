#pragma once

#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/base/tensor.h>

#include <algorithm>
#include <cmath>

namespace stockwork::damage
{
/// Traction that rock still carries across a crack that opens in it.
template <int dim>
struct SeamResponse
{
  dealii::Tensor<1, dim> traction;         ///< on the plus side [Pa]
  dealii::SymmetricTensor<2, dim> tangent; ///< by the jump [Pa/m]
  double greatest = 0.;                    ///< equivalent opening reached, the history to be [m]
};

/// The law of a crack in a band of cells (Bazant and Oh 1983), written for the opening and not for
/// the strain of the band, so that the energy per area is that of the rock whatever the size of the
/// cells is. With the equivalent opening (Ortiz and Pandolfi 1999)
///
///   e = sqrt(<w>^2 + b s^2),   k(g) = T/w_0 up to w_0, T (w_c - g)/((w_c - w_0) g) up to w_c, 0
///   beyond,   g = max(e, what it was),   t = k(g) (<w> n + b s),
///
/// w the opening, s the slip, T the strength and w_c = 2 G_c/T: unloading to the origin. That
/// traction has a potential, so the tangent is symmetric. In Zhang et al. (2022), Eqs 12 to 16, the
/// elastic strain of the band counts as opening, and damage is of the cell in one equation and of
/// the band in the next; here the elastic strain stays in the rock, see damage().
struct SeamLaw
{
  double strength;    ///< T [Pa]
  double start;       ///< w_0, at the peak [m]
  double critical;    ///< w_c, where nothing is carried any more [m]
  double shear_ratio; ///< b: shear modulus over that of uniaxial strain

  /// @param energy G_c [J/m^2]
  /// @param elastic_share w_0 over w_c
  static SeamLaw of_rock(const double strength,
                         const double energy,
                         const double elastic_share,
                         const double shear_ratio)
  {
    const double critical = 2. * energy / strength;
    return {strength, elastic_share * critical, critical, shear_ratio};
  }

  /// k(g) [Pa/m]
  double stiffness(const double g) const
  {
    if (g <= start)
      return strength / start;
    return g < critical ? strength * (critical - g) / ((critical - start) * g) : 0.;
  }

  /// Share of the area that still holds; the rest rubs where faces touch (Alfano and Sacco 2006).
  double kept(const double g) const
  {
    return stiffness(g) / stiffness(0.);
  }

  /// @param normal unit, from the minus to the plus side
  /// @param jump of the displacement, plus less minus side [m]
  /// @param greatest the committed equivalent opening [m]
  template <int dim>
  SeamResponse<dim> evaluate(const dealii::Tensor<1, dim> &normal,
                             const dealii::Tensor<1, dim> &jump,
                             const double greatest) const
  {
    const double w = jump * normal;
    const dealii::Tensor<1, dim> slip = jump - w * normal;
    const double open = std::max(w, 0.);
    const double e = std::sqrt(open * open + shear_ratio * slip.norm_square());
    SeamResponse<dim> response;
    response.greatest = std::max(e, greatest);
    const double k = stiffness(response.greatest);
    const dealii::Tensor<1, dim> v = open * normal + shear_ratio * slip;
    response.traction = k * v;
    const auto across = dealii::symmetrize(dealii::outer_product(normal, normal));
    response.tangent = k * shear_ratio * (dealii::unit_symmetric_tensor<dim>() - across);
    if (w > 0.)
      response.tangent += k * across;
    if (e > greatest && e > start && e < critical)
    {
      const double slope = -strength * critical / ((critical - start) * e * e);
      response.tangent += slope / e * dealii::symmetrize(dealii::outer_product(v, v));
    }
    return response;
  }

  /// Energy dissipated until the equivalent opening was @p greatest [J/m^2]: the area between the
  /// curve and the line back to the origin.
  double dissipation(const double greatest) const
  {
    return 0.5 * strength * critical * std::clamp((greatest - start) / (critical - start), 0., 1.);
  }

  /// D of the whole cell, by which it is softer across than the intact rock: crack and rock in
  /// series, 1 - D = k/(k + A/h).
  /// @param rock A/h: modulus of uniaxial strain over the size of the cell across [Pa/m]
  double damage(const double greatest, const double rock) const
  {
    return greatest <= start ? 0. : rock / (rock + stiffness(greatest));
  }
};
} // namespace stockwork::damage
