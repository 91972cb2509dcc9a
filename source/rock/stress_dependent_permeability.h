#pragma once

#include "stockwork/rock/law.h"
#include "stockwork/rock/rock.h"

#include <memory>

namespace stockwork
{
/// Rock whose permeability falls with the mean effective stress (Zhang et al. 2022, Eq. 28),
///
///   k = k_0 exp(-sigma'_m / s),    sigma'_m = -(tr sigma)/3 - alpha p
///
/// with the stress s = sigma_0/zeta of that equation and total stress and pore pressure, in situ
/// and since. In tension it grows, up to a million times k_0: beyond that the numbers are no longer
/// those of pores, and it is kept, which is said. The paper does not say which effective stress;
/// Biot's is what its rock deforms by. In all else it is the rock inside.
class StressDependentPermeability : public RockLaw
{
public:
  StressDependentPermeability(std::unique_ptr<RockLaw> inside, const RockProperties &properties);

  bool is_linear() const override
  {
    return false;
  }

  bool is_symmetric() const override
  {
    return inside->is_symmetric();
  }

  bool changes_permeability() const override
  {
    return true;
  }

  std::vector<HistoryField> history() const override
  {
    return inside->history();
  }

  void evaluate(dealii::ArrayView<const RockState> states,
                dealii::ArrayView<RockResponse> responses) const override;

  double used(const RockState &state) const override
  {
    return inside->used(state);
  }

  double margin(const RockState &) const override
  {
    return 0.; // the least change of stress counts
  }

  std::string describe() const override
  {
    return inside->describe();
  }

private:
  const std::unique_ptr<RockLaw> inside;
  const dealii::SymmetricTensor<2, 3> unstressed; ///< k_0 [m^2]
  const double decay_stress, biot_coefficient;
};
} // namespace stockwork
