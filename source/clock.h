#pragma once

#include "coupling/stepper.h"

namespace stockwork
{
/// Where a run stands between two steps.
struct Clock
{
  double time = 0.;      ///< [s]
  double dt = 0.;        ///< proposed for the next step [s]
  unsigned int step = 0; ///< the last one

  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    archive &time &dt &step;
  }
};


/// But for the rounding of a sum of steps.
inline bool has_ended(const Clock &clock, const StepControl &control)
{
  return clock.time >= control.end_time * (1. - 1e-12);
}
} // namespace stockwork
