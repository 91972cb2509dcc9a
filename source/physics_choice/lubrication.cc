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
                (K_m > 4. ? ": the pressure is nearly uniform, and yet nothing is gained, for the "
                            "program has no form of the flow with one pressure per fracture"
                          : ": the flow along the fracture decides"));
}
} // namespace stockwork
