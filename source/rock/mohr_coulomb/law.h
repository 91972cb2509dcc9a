#pragma once

#include "rock/mohr_coulomb/return_map.h"
#include "stockwork/rock/registry.h"

namespace stockwork::mohr_coulomb
{
/// Mohr-Coulomb rock, non-associated unless psi = phi (Wang 2016, section 2.2); perfectly plastic,
/// or with a cohesion that changes with the plastic strain; with a tension cut-off or without.
///
/// Porous rock yields by sigma + p, Terzaghi's effective stress, and deforms by sigma + alpha p,
/// Biot's. With elastic strain e = eps - eps^p,
///
///   sigma + p 1 = C : e + (1 - alpha) p 1,    zeta = alpha tr e + tr eps^p + p/M
///
/// each over in situ: plastic dilation opens pores and nothing else (Coussy 2004, with the
/// coefficient of the yield function, 1), so that d(sigma)/dp and -d(zeta)/d(eps) are alike where
/// the flow is associated. What changes the cohesion is dissipated: the energy stored is elastic.
class MohrCoulomb : public RockLaw
{
public:
  MohrCoulomb(const RockProperties &properties, const Strength &strength);

  bool is_symmetric() const override;

  std::vector<HistoryField> history() const override;

  void evaluate(dealii::ArrayView<const RockState> states,
                dealii::ArrayView<RockResponse> responses) const override;

  double used(const RockState &state) const override;

  double margin(const RockState &state) const override;

  std::string describe() const override;

  const Strength &surface() const
  {
    return strength;
  }

private:
  using Tensor2 = dealii::SymmetricTensor<2, 3>;

  /// Terzaghi's stress if no more strain becomes plastic.
  Tensor2 trial_stress(const RockState &state, const Tensor2 &elastic_strain) const;

  double lambda, mu, alpha, inverse_biot_modulus;
  Strength strength;
};
} // namespace stockwork::mohr_coulomb
