#pragma once

#include "flow/network_segment.h"

#include "stockwork/rock/rock.h"

#include <deal.II/base/parameter_handler.h>

#include <boost/serialization/vector.hpp>

#include <limits>
#include <vector>

namespace stockwork
{
/// Steps with inertia, while a tip runs fast against waves: so short that they resolve these
/// ('Time/Waves resolved above').
class WaveSteps
{
public:
  static void declare_parameters(dealii::ParameterHandler &prm);

  void parse_parameters(dealii::ParameterHandler &prm);

  /// Whether the deck asks for it.
  bool are_wanted() const;

  /// The fracture is new: its segments say how far tips come, and which rock they run through.
  template <int dim>
  void set_segments(const std::vector<NetworkSegment<dim>> &segments, const Rock &rock);

  /// The longest step that resolves waves, half of what the fastest takes through a segment [s].
  double longest() const
  {
    return resolved;
  }

  /// The speed of a tip over that of Rayleigh waves, if it comes into so many segments within the
  /// next dt [s]: a mean over the last five. (Where tips take turns, that of them together.) Zero
  /// before it has come into a second one.
  double tip_speed(double dt, unsigned int advances) const;

  /// Whether steps shall resolve waves at this speed.
  bool is_fast(const double speed) const
  {
    return speed > threshold;
  }

  /// A step is accepted.
  void accept(double dt, unsigned int advances);

  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    archive &steps;
  }

private:
  /// A step in which a tip has advanced, and what follows until the next one. The first may be
  /// rest.
  struct Step
  {
    double dt;
    unsigned int advances;

    template <class Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &dt &advances;
    }
  };

  double threshold = std::numeric_limits<double>::infinity(); ///< over the speed of Rayleigh waves
  double rayleigh_speed = 0.;                                 ///< the least [m/s]
  double segment_size = 0.;                                   ///< in the mean [m]
  double resolved = std::numeric_limits<double>::infinity();  ///< longest()
  std::vector<Step> steps; ///< the last ones, as many as it takes for the speed
};
} // namespace stockwork
