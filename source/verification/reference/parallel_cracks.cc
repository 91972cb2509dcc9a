// Equal cracks side by side, all under the same net pressure, in an infinite body.
#include "verification/analytical/parallel_cracks.h"

#include "stockwork/base/error.h"

#include "verification/reference/problems.h"

#include <cmath>

namespace stockwork::reference
{
using namespace dealii;

namespace
{
class ParallelCracksReference : public ReferenceSolution<2>
{
public:
  ParallelCracksReference(const analytical::ParallelCracksParameters &parameters,
                          const bool one_wing)
    : cracks(parameters)
    , n_cracks(parameters.n_cracks)
    , fraction(one_wing ? 0.5 : 1.)
  {
  }

  std::string name() const override
  {
    return "Parallel cracks in an infinite body (continuous dislocations)";
  }

  std::map<std::string, double> values(double) const override
  {
    double volume = 0.;
    for (unsigned int c = 0; c < n_cracks; ++c)
      volume += fraction * cracks.volume(c);
    const auto intensity = cracks.stress_intensity(0);
    return {{"fracture_volume", volume},
            {"inlet_aperture", cracks.opening(0, 0.)},
            {"stress_intensity_I", intensity.mode_I},
            {"stress_intensity_II", intensity.mode_II}};
  }

private:
  analytical::ParallelCracks cracks;
  unsigned int n_cracks;
  double fraction;
};
} // namespace


Made<2> make_parallel_cracks(const ParameterHandler &, const ReferenceInput<2> &input)
{
  if (input.cracks.size() < 2)
    throw InputError(
      "The reference solution of parallel cracks needs at least two initial cracks.");
  if (!std::isfinite(input.crack_pressure))
    throw InputError("The reference solution of parallel cracks needs their pressure given, "
                     "'Cracks/Fluid pressure'.");
  if (input.layered || input.has_stress_gradient)
    throw InputError("The reference solution of parallel cracks is for rock without regions and "
                     "in-situ stress without a gradient.");
  const double small = 1e-8 * (input.upper - input.lower).norm();
  const Point<2> first = input.cracks[0].front(), last = input.cracks[0].back();
  const bool one_wing = std::abs(std::min(first[0], last[0]) - input.lower[0]) < small;
  const double distance = std::abs(input.cracks[1].front()[1] - first[1]);
  for (unsigned int c = 0; c < input.cracks.size(); ++c)
    for (const Point<2> &end : {input.cracks[c].front(), input.cracks[c].back()})
      if (std::abs(end[1] - first[1] - c * distance) > small)
        throw InputError("The reference solution of parallel cracks needs cracks along the x axis, "
                         "at equal distances, the lowest first.");
  const RockProperties &rock = input.rock.main();
  return std::make_unique<ParallelCracksReference>(
    analytical::ParallelCracksParameters{
      rock.young_modulus, rock.poisson_ratio, (one_wing ? 1. : 0.5) * (last - first).norm(),
      distance, input.crack_pressure, static_cast<unsigned int>(input.cracks.size())},
    one_wing);
}
} // namespace stockwork::reference
