// What a run has shown of its assumptions.
#include <doctest/doctest.h>

#include "outcome_audit.h"

using stockwork::Outcome;

TEST_CASE("suction is remembered when it is over")
{
  Outcome outcome;
  outcome.has_pressure(-3e5, 1.);
  outcome.has_pressure(-2e5, 2.);
  outcome.has_pressure(1e6, 3.);
  CHECK(outcome.minimum_pressure == 1e6);
  CHECK(outcome.least_pressure == -3e5);
  CHECK(outcome.last_suction == 2.);
}
