#pragma once

#include "stockwork/rock/law.h"

#include <limits>

namespace stockwork
{
/// A rock that is linear whatever happens: the elements know it by its constants, and ask nothing.
class LinearRockLaw : public RockLaw
{
public:
  bool is_linear() const override
  {
    return true;
  }

  void evaluate(dealii::ArrayView<const RockState>, dealii::ArrayView<RockResponse>) const override
  {
  }

  double used(const RockState &) const override
  {
    return 0.;
  }

  double margin(const RockState &) const override
  {
    return std::numeric_limits<double>::infinity();
  }
};
} // namespace stockwork
