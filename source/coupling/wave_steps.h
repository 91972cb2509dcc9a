#pragma once

#include "stockwork/rock/rock.h"

#include <deal.II/base/parameter_handler.h>
#include <deal.II/distributed/tria.h>

#include <boost/serialization/vector.hpp>

#include <limits>
#include <vector>

namespace stockwork
{
/// How long steps may be with inertia: while a tip runs fast against waves, they are short enough
/// to resolve these ('Time/Waves resolved above'); else a front's speed is all that sets them.
class WaveSteps
{
public:
  static void declare_parameters(dealii::ParameterHandler &prm);

  void parse_parameters(dealii::ParameterHandler &prm);

  /// Of the first region's rock: tips are compared with its waves.
  void set_rock(const RockProperties &rock);

  /// Whether the deck asks for it.
  bool are_wanted() const;

  /// The mesh is new. Collective.
  template <int dim>
  void set_mesh(const dealii::parallel::distributed::Triangulation<dim> &triangulation,
                const Rock &rock);

  /// The longest in which waves are resolved, half of what the fastest takes through a cell [s].
  double longest() const
  {
    return resolved;
  }

  /// The speed of the fastest tip over that of Rayleigh waves, at least, when it has come by so
  /// many segments within the next dt [s]. Zero before it has come into a second one.
  double tip_speed(double dt, unsigned int advances) const;

  /// Whether this is fast.
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
  double rayleigh_speed = 0.;                                 ///< [m/s]
  double cell_size = 0.;                                      ///< the smallest [m]
  double resolved = std::numeric_limits<double>::infinity();  ///< longest()
  std::vector<Step> steps; ///< the last ones, as many as it takes for the speed
};
} // namespace stockwork
