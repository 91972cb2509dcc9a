// How long the next step may be, by how far tips have come.
#include <doctest/doctest.h>

#include <cmath>

#include "coupling/stepper.h"

namespace stockwork::step_limit_test
{
TEST_CASE("the next step follows how far tips have come in this one")
{
  Verdict verdict;
  CHECK(std::isinf(step_limit(verdict, 2., 2.))); // no fracture has a say
  verdict.advances = 0;
  CHECK(step_limit(verdict, 2., 2.) == 2.5);
  verdict.advances = 1;
  CHECK(step_limit(verdict, 2., 2.) == 1.6);
  verdict.advances = 2;
  CHECK(step_limit(verdict, 2., 8.) == 1.2);
  verdict.held_back = true;
  CHECK(step_limit(verdict, 2., 8.) == 1.);
  verdict.length_is_right = true;
  CHECK(step_limit(verdict, 2., 8.) == 8.);
}
} // namespace stockwork::step_limit_test
