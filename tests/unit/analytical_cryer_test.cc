#include "reference_table.h"
#include "verification/analytical/cryer.h"
#include "verification/reference/problems.h"

#include <doctest/doctest.h>

#include <cmath>

namespace stockwork::analytical_cryer_test
{
using namespace stockwork::analytical;
using stockwork::test::ReferenceTable;
using stockwork::test::RelativeTo;

namespace
{
using Shape = CryerParameters::Shape;

Cryer cryer(const ReferenceTable &table, const Shape shape)
{
  return Cryer({shape,
                {table.parameter("E"), table.parameter("nu"), table.parameter("alpha"),
                 1. / table.parameter("Q"), table.parameter("k"), table.parameter("mu")},
                table.parameter("R"),
                table.parameter("P0")});
}

// The tables hold eight digits, so the last one is worth up to 5e-8.
constexpr double digits = 6e-8;
} // namespace

TEST_CASE("sphere and cylinder: histories")
{
  for (const auto &[name, shape] : {std::pair{"cryer_classic_history", Shape::sphere},
                                    std::pair{"cryer_nu025_history", Shape::sphere},
                                    std::pair{"deleeuw_classic_history", Shape::cylinder},
                                    std::pair{"deleeuw_nu025_history", Shape::cylinder}})
  {
    CAPTURE(name);
    const ReferenceTable table(name);
    const Cryer solution = cryer(table, shape);
    CHECK_COLUMN(table, "p_centre_Pa", digits, RelativeTo::largest,
                 [&](const auto i) { return solution.at(table(i, "t_s")).pressure(0.); });
    CHECK_COLUMN(table, "ur_surface_m", digits, RelativeTo::each,
                 [&](const auto i) { return solution.at(table(i, "t_s")).displacement(1.); });
    CHECK(solution.at(0.).pressure(0.3) == doctest::Approx(table.parameter("p0")).epsilon(1e-7));

    // The series reaches the undrained state as the square root of time.
    const double t = 1e-6 / solution.diffusivity();
    CHECK(solution.at(t).pressure(0.) ==
          doctest::Approx(solution.undrained_pressure()).epsilon(4e-3));
    CHECK(solution.at(t).displacement(0.7) ==
          doctest::Approx(solution.at(0.).displacement(0.7)).epsilon(4e-3).scale(1e-4));
  }
}

TEST_CASE("sphere and cylinder: pressure profiles")
{
  for (const auto &[name, shape] : {std::pair{"cryer_nu025_profiles", Shape::sphere},
                                    std::pair{"deleeuw_classic_profiles", Shape::cylinder}})
  {
    CAPTURE(name);
    const ReferenceTable table(name);
    const Cryer solution = cryer(table, shape);
    CHECK_COLUMN(table, "p_Pa", digits, RelativeTo::largest,
                 [&](const auto i)
                 { return solution.at(table(i, "t_s")).pressure(table(i, "r_m")); });
  }
}

TEST_CASE("sphere: the displacement inside follows from the pressure")
{
  // (lambda + 2 G) div u - alpha p is uniform.
  const ReferenceTable table("cryer_nu025_history");
  const Cryer solution = cryer(table, Shape::sphere);
  const auto now = solution.at(0.5);
  const double modulus = 1e8 * 0.75 / (1.25 * 0.5);
  const auto stress = [&](const double r)
  {
    const double h = 1e-4;
    const double divergence =
      (now.displacement(r + h) - now.displacement(r - h)) / (2. * h) + 2. * now.displacement(r) / r;
    return modulus * divergence - 0.9 * now.pressure(r);
  };
  CHECK(stress(0.2) == doctest::Approx(stress(0.5)).epsilon(1e-6));
  CHECK(stress(0.8) == doctest::Approx(stress(0.5)).epsilon(1e-6));
}
TEST_CASE("the field that errors are formed with is that of the series, at early times too")
{
  dealii::ParameterHandler prm;
  Rock::declare_parameters(prm);
  prm.parse_input_from_string("subsection Rock\n set Young modulus = 100 MPa\n"
                              " set Poisson ratio = 0\n set Biot coefficient = 1\n"
                              " set Biot modulus = inf\n set Permeability = 1e-12\nend\n"
                              "subsection Fluid\n set Viscosity = 1 cP\nend");
  Rock rock;
  rock.parse_parameters(prm);
  ReferenceInput<3> input{rock, {}, {2., 2., 2.}};
  input.normal_traction = [](const std::string &, double) { return -1e5; };
  const auto reference = reference::make_cryer<3>(prm, input);
  const auto field = reference->field();
  const Cryer solution({Shape::sphere, reference::medium(rock), 2., 1e5});
  for (const double time : {0., 1e-6, 1e-3, 0.1})
  {
    CAPTURE(time);
    field->set_time(time * 4. / solution.diffusivity());
    const CryerAtTime now = solution.at(time * 4. / solution.diffusivity());
    for (const double r : {0., 0.3, 1.234, 1.99, 1.9987, 1.99999, 2.})
    {
      CAPTURE(r);
      dealii::Vector<double> values(4);
      field->vector_value({0.6 * r, 0., 0.8 * r}, values);
      CHECK(std::abs(values(3) - now.pressure(r)) < 1e-6 * 1e5);
      CHECK(std::abs(std::hypot(values(0), values(2)) - std::abs(now.displacement(r))) <
            1e-6 * std::abs(now.displacement(2.)) + 1e-300);
    }
  }
}
} // namespace stockwork::analytical_cryer_test
