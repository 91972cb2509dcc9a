// Contact with friction: the conditions themselves, and the tangent against differences.
#include <doctest/doctest.h>

#include "discontinuity/contact_law.h"

namespace stockwork::contact_law_test
{
using doctest::Approx;

namespace
{
using dealii::Point;
using dealii::Tensor;

const ContactLaw law{1e12, 0.6};

const Tensor<1, 2> n = Point<2>(-0.28, 0.96), along = Point<2>(0.96, 0.28);

ContactResponse<2> evaluate(const double gap,
                            const double shear_gap,
                            const double slip,
                            const double broken = 1.,
                            const double carried = 0.)
{
  return law.evaluate<2>(n, gap * n + shear_gap * along, slip * along, broken, carried);
}
} // namespace

TEST_CASE("open faces carry nothing, and slip as they move")
{
  const auto open = evaluate(1e-5, 3e-4, 0.);
  CHECK(open.normal == 0.);
  CHECK(open.shear.norm() == 0.);
  CHECK(open.slip * along == Approx(3e-4));
}

TEST_CASE("closed faces stick below the bound and slip at it, either way")
{
  for (const double sign : {-1., 1.})
  {
    const auto sticks = evaluate(-1e-5, sign * 2e-6, 0.);
    CHECK(sticks.normal == Approx(-1e7));
    CHECK(sticks.shear * along == Approx(sign * 2e6));
    CHECK(sticks.slip.norm() == 0.);

    const auto slips = evaluate(-1e-5, sign * 1e-4, 0.);
    CHECK(slips.shear * along == Approx(sign * 0.6e7));
    CHECK(std::abs(slips.shear * n) < 1e-3);
    CHECK(slips.slip * along == Approx(sign * (1e-4 - 0.6e-5)));

    // Back a little: it sticks again, with the traction going down along the stiffness.
    const auto back = evaluate(-1e-5, sign * 0.98e-4, slips.slip * along);
    CHECK(back.slip * along == Approx(slips.slip * along));
    CHECK(back.shear * along == Approx(sign * 0.4e7));
  }
}

TEST_CASE("under what they carried before, faces hardly overlap, and part with it")
{
  double carried = 0., gap = -1e-5;
  for (unsigned int step = 0; step < 2; ++step)
  {
    carried = evaluate(gap, 0., 0., 1., carried).normal;
    CHECK(carried == Approx(-1e7));
    gap = (-1e7 - carried) / 1e12; // which the same load asks for next
  }
  CHECK(std::abs(gap) < 1e-18);
  CHECK(evaluate(2e-5, 0., 0., 1., carried).normal == 0.);
  CHECK(evaluate(0., 1e-4, 0., 1., carried).shear * along == Approx(0.6e7)); // rubs by all of it
}

TEST_CASE("faces that carried pressure and shear stay where they are while these stay")
{
  const auto at_rest = evaluate(0., 0., 4e6 / 1e12, 1., -1e7);
  CHECK(at_rest.normal == -1e7);
  CHECK(at_rest.shear * along == Approx(-4e6));
  CHECK(at_rest.slip * along == Approx(4e-6));
}

TEST_CASE("what still holds does not rub")
{
  CHECK(evaluate(-1e-5, 1e-4, 0., 0.25).shear * along == Approx(0.25 * 0.6e7));
  CHECK(evaluate(-1e-5, 1e-4, 0., 0.25).normal == Approx(-1e7));
  CHECK(ContactLaw{1e12, 0.}.evaluate<2>(n, -1e-5 * n + 1e-4 * along, {}).shear.norm() == 0.);
}

TEST_CASE("friction never gives work")
{
  Tensor<1, 3> slip;
  double work = 0.;
  for (unsigned int i = 1; i <= 200; ++i)
  {
    const Tensor<1, 3> jump = Point<3>(1e-4 * std::sin(0.1 * i), 7e-5 * std::cos(0.17 * i),
                                       -1e-5 * (1. + std::sin(0.3 * i)));
    const auto response = law.evaluate<3>(Point<3>(0., 0., 1.), jump, slip);
    const double done = response.shear * (response.slip - slip);
    CHECK(done >= 0.);
    CHECK(response.shear.norm() <= -0.6 * response.normal * (1. + 1e-12));
    work += done;
    slip = response.slip;
  }
  CHECK(work > 100.);
}

namespace
{
template <int dim>
void check_tangent(const Tensor<1, dim> &normal, const std::vector<Tensor<1, dim>> &shear_gaps)
{
  const double h = 1e-11;
  for (const double gap : {-2e-5, -1e-6, 1e-6})
    for (const Tensor<1, dim> &shear_gap : shear_gaps)
      for (const double broken : {0.3, 1.})
      {
        const Tensor<1, dim> jump = gap * normal + shear_gap;
        const auto exact = law.evaluate<dim>(normal, jump, {}, broken);
        for (unsigned int j = 0; j < dim; ++j)
        {
          Tensor<1, dim> step;
          step[j] = h;
          const auto more = law.evaluate<dim>(normal, jump + step, {}, broken),
                     less = law.evaluate<dim>(normal, jump - step, {}, broken);
          const Tensor<1, dim> slope =
            ((more.normal - less.normal) * normal + more.shear - less.shear) / (2. * h);
          for (unsigned int i = 0; i < dim; ++i)
            CHECK(std::abs(exact.tangent[i][j] - slope[i]) < 1e-4 * law.stiffness);
        }
      }
}
} // namespace

TEST_CASE("tangent against differences")
{
  std::vector<Tensor<1, 2>> in_plane;
  for (const double s : {-1e-4, -3e-7, 0., 2e-7, 1e-4})
    in_plane.push_back(s * along);
  check_tangent<2>(n, in_plane);
  const Tensor<1, 3> normal = Point<3>(0.48, 0.6, 0.64), one = Point<3>(0.8, 0., -0.6),
                     other = dealii::cross_product_3d(normal, one);
  check_tangent<3>(normal, {1e-4 * one, -3e-7 * other, 0. * one, 2e-7 * one + 1e-7 * other,
                            -4e-5 * one + 6e-5 * other});
}
} // namespace stockwork::contact_law_test
