#include "physics_choice/decisions.h"

#include "scene_estimates.h"

#include <iomanip>
#include <sstream>

namespace stockwork
{
PhysicsDecision decide_lubrication(const Case<2> &the_case)
{
  const double K_m = plane_fracture(the_case, first_pumping(the_case)).dimensionless_toughness();
  return kept("pressure gradients along the fracture",
              "K_m = " + with_digits(K_m, 2) +
                (K_m > 4. ? ": the pressure is nearly uniform, but one pressure for all of the "
                            "fracture would make no step cheaper"
                          : ": the flow along the fracture decides"));
}
} // namespace stockwork
