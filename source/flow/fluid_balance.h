#pragma once

#include <boost/serialization/access.hpp>

namespace stockwork
{
/// Fluid volumes [m^3], or [m^2] per unit thickness in 2-D, of the part that is modelled: half of
/// what is pumped for a half model.
struct FluidVolumes
{
  double injected = 0.;     ///< by wells, and by what holds segments at a given pressure
  double outflow = 0.;      ///< the same, where it comes out
  double in_fractures = 0.; ///< gained by the fractures, with the compression of their fluid
  double in_boreholes = 0.; ///< gained by the boreholes
  double leaked = 0.;       ///< from fractures into the rock
  double in_rock = 0.;      ///< what wells in the rock have put into its pores

  /// What is missing.
  double defect() const
  {
    return injected - outflow - in_fractures - in_boreholes - leaked - in_rock;
  }

  FluidVolumes &operator+=(const FluidVolumes &other)
  {
    injected += other.injected;
    outflow += other.outflow;
    in_fractures += other.in_fractures;
    in_boreholes += other.in_boreholes;
    leaked += other.leaked;
    in_rock += other.in_rock;
    return *this;
  }

  template <class Archive>
  void serialize(Archive &ar, const unsigned int)
  {
    ar &injected &outflow &in_fractures &in_boreholes &leaked &in_rock;
  }
};

/// Where the fluid is, by the differences of the time scheme itself. With backward Euler they are
/// the differences of the volumes; with other schemes the totals may depart from them by the error
/// of the scheme, and `fracture_volume` is what is there.
struct FluidBalance
{
  FluidVolumes step;           ///< in this step
  FluidVolumes total;          ///< since the start, this step included
  double fracture_volume = 0.; ///< sum of A w, but for vapour
  double relative_error = 0.;  ///< |step.defect()| over what moved in the step
};
} // namespace stockwork
