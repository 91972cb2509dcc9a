// Forcing terms of an inexact Newton method, coupling/forcing_term.h.
#include "coupling/forcing_term.h"

#include <doctest/doctest.h>

#include <cmath>

namespace stockwork
{
TEST_CASE("linear solves follow the square of what the residual has fallen by")
{
  ForcingTerm term;
  CHECK(term.next(1., 1e12, false) == doctest::Approx(1e-3));
  CHECK(term.next(0.1, 1e11, false) == doctest::Approx(1e-3));
  CHECK(term.next(0.01 * 0.1, 1e9, false) == doctest::Approx(1e-5));
  CHECK(term.next(1e-9, 1e3, false) == doctest::Approx(3e-4)); // and stop at the end
  CHECK(term.next(1e-12, 1.1, false) == doctest::Approx(0.1));
}

TEST_CASE("linear solves are exact once an iteration gains little or is shortened")
{
  ForcingTerm little, shortened;
  for (ForcingTerm *term : {&little, &shortened})
    CHECK(term->next(1., 1e8, false) > 1e-4);
  CHECK(little.next(0.6, 1e8, false) == ForcingTerm::exact);
  CHECK(shortened.next(0.1, 1e8, true) == ForcingTerm::exact);
  for (ForcingTerm *term : {&little, &shortened})
    CHECK(term->next(0.05, 1e8, false) == ForcingTerm::exact);
}

TEST_CASE("Newton's method with these linear solves stays quadratic")
{
  // x^2 = 2, with an increment that is wrong by the share that is allowed.
  ForcingTerm term;
  double x = 3., residual = x * x - 2.;
  unsigned int n = 0;
  for (; std::abs(residual) > 1e-12 && n < 20; ++n)
  {
    const double eta = term.next(std::abs(residual), std::abs(residual) / 1e-12, false);
    x -= (1. - eta) * residual / (2. * x);
    residual = x * x - 2.;
  }
  CHECK(n <= 6); // five where all are exact
}
} // namespace stockwork
