// A beam along x with a crack from below in its middle, held at its ends and loaded from above.
#include "verification/analytical/three_point_bending.h"

#include "stockwork/base/error.h"

#include "verification/reference/problems.h"

#include <algorithm>
#include <cmath>

namespace stockwork::reference
{
using namespace dealii;

namespace
{
class ThreePointBendingReference : public ReferenceSolution<2>
{
public:
  explicit ThreePointBendingReference(const double greatest_load)
    : greatest_load(greatest_load)
  {
  }

  std::string name() const override
  {
    return "Notched beam in three-point bending, brittle (polynomial of ASTM E399)";
  }

  std::map<std::string, double> values(double) const override
  {
    return {{"peak_load", greatest_load}};
  }

private:
  double greatest_load;
};
} // namespace


Made<2> make_three_point_bending(const ParameterHandler &, const ReferenceInput<2> &input)
{
  const double span = input.upper[0] - input.lower[0], depth = input.upper[1] - input.lower[1];
  if (std::abs(span - 4. * depth) > 1e-6 * span)
    throw InputError("The reference solution of three-point bending needs a beam along x that is "
                     "four times as long as deep.");
  if (input.cracks.size() != 1)
    throw InputError("The reference solution of three-point bending needs one initial crack.");
  const RockProperties &rock = input.rock.main();
  if (!(rock.energy_release_rate > 0.))
    throw InputError("The reference solution of three-point bending needs the rock's critical "
                     "energy release rate.");
  const auto &crack = input.cracks[0];
  const double notch = std::max(crack.front()[1], crack.back()[1]) - input.lower[1];
  const double toughness = std::sqrt(rock.plane_modulus() * rock.energy_release_rate);
  return std::make_unique<ThreePointBendingReference>(
    toughness * std::pow(depth, 1.5) /
    (span * analytical::three_point_bending_factor(notch / depth)));
}
} // namespace stockwork::reference
