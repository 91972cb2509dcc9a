#include "reference_table.h"
#include "verification/analytical/constants.h"
#include "verification/analytical/hydraulic_fracture.h"
#include "verification/analytical/kgd_leak_off.h"
#include "verification/analytical/radial.h"

#include <doctest/doctest.h>

#include <cmath>
#include <memory>

namespace stockwork::analytical_hydraulic_fracture_test
{
using namespace stockwork::analytical;
using stockwork::test::ReferenceTable;
using stockwork::test::RelativeTo;

TEST_CASE("KGD with Carter leak-off, from strong efficiency to almost none")
{
  const double tolerance = 5e-4;
  for (const char *name : {"kgd_sun_carter", "kgd_carter_strong"})
  {
    CAPTURE(name);
    const ReferenceTable table(name);
    const double E = table.parameter("E"), nu = table.parameter("nu");
    const HydraulicFracture fracture(
      {{E, nu, table.parameter("mu"), std::sqrt(E / (1. - nu * nu) * table.parameter("Gc")),
        table.parameter("Q0")},
       table.parameter("C_L")},
      table(table.rows() - 1, "t_s"));
    const auto time = [&](const auto i) { return table(i, "t_s"); };
    const auto each = RelativeTo::each;
    CHECK_COLUMN(table, "l_m", tolerance, each,
                 [&](const auto i) { return fracture.half_length(time(i)); });
    CHECK_COLUMN(table, "w0_m", tolerance, each,
                 [&](const auto i) { return fracture.inlet_opening(time(i)); });
    CHECK_COLUMN(table, "p0_Pa", tolerance, each,
                 [&](const auto i) { return fracture.inlet_pressure(time(i)); });
    CHECK_COLUMN(table, "V_fracture_m2", tolerance, each,
                 [&](const auto i) { return fracture.fracture_volume(time(i)); });
    CHECK_COLUMN(table, "V_leaked_m2", tolerance, each,
                 [&](const auto i) { return fracture.leaked_volume(time(i)); });
  }
}

TEST_CASE("KGD with Carter leak-off: no leak-off gives the similarity solution")
{
  const KgdParameters fluid{3e10, 0.25, 1e-3, 1e6, 1e-4};
  const Kgd impermeable(fluid);
  const HydraulicFracture fracture({fluid, 0.}, 100.);
  for (const double t : {1e-3, 1., 77.})
  {
    const double x = 0.83 * impermeable.half_length(t);
    CHECK(fracture.half_length(t) == doctest::Approx(impermeable.half_length(t)).epsilon(1e-5));
    CHECK(fracture.opening(x, t) == doctest::Approx(impermeable.opening(x, t)).epsilon(1e-4));
    CHECK(fracture.pressure(x, t) == doctest::Approx(impermeable.pressure(x, t)).epsilon(1e-4));
    CHECK(fracture.leaked_volume(t) == doctest::Approx(0.).epsilon(1e-4));
  }
}

TEST_CASE("KGD between rollers")
{
  const ReferenceTable table("kgd_sun_box");
  const double E = table.parameter("E"), nu = table.parameter("nu");
  const KgdParameters fluid{E, nu, table.parameter("mu"),
                            std::sqrt(E / (1. - nu * nu) * table.parameter("Gc")),
                            table.parameter("Q0")};
  const HydraulicFracture fracture({fluid, 0., 8., 8.}, table(table.rows() - 1, "t_s"));
  const auto time = [&](const auto i) { return table(i, "t_s"); };
  const auto each = RelativeTo::each;
  const double tolerance = 5e-4;
  CHECK_COLUMN(table, "l_m", tolerance, each,
               [&](const auto i) { return fracture.half_length(time(i)); });
  CHECK_COLUMN(table, "w0_m", tolerance, each,
               [&](const auto i) { return fracture.inlet_opening(time(i)); });
  CHECK_COLUMN(table, "p0_Pa", tolerance, each,
               [&](const auto i) { return fracture.inlet_pressure(time(i)); });
  CHECK_COLUMN(table, "V_both_wings_m2", tolerance, each,
               [&](const auto i) { return fracture.fracture_volume(time(i)); });
  CHECK(fracture.valid_until() == doctest::Approx(time(table.rows() - 1)));

  // To a time at which the walls are passed: it ends before, and until then it is the same.
  const HydraulicFracture longer({fluid, 0., 8., 8.}, 100.);
  const double last = longer.valid_until();
  CHECK(longer.half_length(last) < 0.8 * 8.);
  CHECK(longer.half_length(last) > 0.7 * 8.);
  for (const double t : {0.5 * last, 0.9 * last, last})
  {
    const HydraulicFracture until({fluid, 0., 8., 8.}, t);
    CHECK(longer.half_length(t) == doctest::Approx(until.half_length(t)).epsilon(tolerance));
    CHECK(longer.inlet_pressure(t) == doctest::Approx(until.inlet_pressure(t)).epsilon(tolerance));
  }
}

namespace
{
HydraulicFracture radial(const double youngs_modulus,
                         const double viscosity,
                         const double toughness,
                         const double rate,
                         const double last_time)
{
  HydraulicFractureParameters parameters{{youngs_modulus, 0.25, viscosity, toughness, rate}};
  parameters.shape = CrackShape::penny;
  return HydraulicFracture(parameters, last_time);
}
} // namespace

TEST_CASE("radial fracture: viscosity vertex")
{
  // The table was computed on another grid, to 4e-7 in the radius.
  const ReferenceTable table("penny_M_vertex_profile");
  const double E = 3e10, nu = 0.25, mu = 1e-3, Q0 = 0.0265, t = 100.;
  const HydraulicFracture fracture = radial(E, mu, 0., Q0, t);
  const double modulus = E / (1. - nu * nu), eps = std::cbrt(12. * mu / (modulus * t));
  const double L = std::pow(modulus * std::pow(Q0, 3) * std::pow(t, 4) / (12. * mu), 1. / 9.);
  const double R = fracture.half_length(t);
  CHECK(R / L == doctest::Approx(0.697837).epsilon(2e-6));
  CHECK(fracture.fracture_volume(t) == doctest::Approx(Q0 * t).epsilon(1e-5));
  CHECK_COLUMN(table, "Omega", 2e-5, RelativeTo::largest,
               [&](const auto i) { return fracture.opening(table(i, "rho") * R, t) / (eps * L); });
  CHECK_COLUMN(table, "Pi", 2e-4, RelativeTo::largest,
               [&](const auto i)
               { return fracture.pressure(table(i, "rho") * R, t) / (eps * modulus); });
}

TEST_CASE("radial fracture: histories near both vertices")
{
  const ReferenceTable table("radial_pkn_benchmarks");
  const HydraulicFracture tough = radial(3e10, 1e-6, 3e6, 0.0265, 400.);
  const HydraulicFracture viscous = radial(3e10, 1e-3, 0., 0.0265, 400.);
  double last_difference = 1.;
  for (std::size_t i = 0; i < table.rows(); ++i)
  {
    const double t = table(i, "t_s"), R = table(i, "R_or_L_m");
    if (table.text(i, "case") == "penny_viscosity")
    {
      CHECK(viscous.half_length(t) == doctest::Approx(R).epsilon(5e-6));
      CHECK(viscous.inlet_opening(t) == doctest::Approx(table(i, "w0_m")).epsilon(2e-5));
    }
    else if (table.text(i, "case") == "penny_toughness")
    {
      // The table has no viscosity, whose effect fades as toughness grows in time.
      const double difference = 1. - tough.half_length(t) / R;
      CHECK(difference > 0.);
      CHECK(difference < 1e-4);
      CHECK(difference < last_difference);
      CHECK(tough.inlet_opening(t) == doctest::Approx(table(i, "w0_m")).epsilon(5e-4));
      CHECK(tough.pressure(0.5 * R, t) == doctest::Approx(table(i, "p0_Pa")).epsilon(1e-3));
      last_difference = difference;
    }
  }
}

TEST_CASE("radial fracture: the radius between the vertices, from those of the vertices")
{
  for (const double toughness : {0., 1e6, 2e6, 3e6, 1e7})
  {
    const KgdParameters fluid{3e10, 0.25, 1e-3, toughness, 0.0265};
    HydraulicFractureParameters parameters{fluid};
    parameters.shape = CrackShape::penny;
    const HydraulicFracture fracture(parameters, 400.);
    CAPTURE(radial_toughness(fluid, 400.));
    for (const double t : {40., 400.})
      CHECK(radial_radius(fluid, t) == doctest::Approx(fracture.half_length(t)).epsilon(0.005));
  }
  CHECK(radial_toughness({1., 0., 1. / 12., 1. / (4. * std::sqrt(2. / pi)), 1.}, 1.) ==
        doctest::Approx(1.));
  CHECK(radial_toughness({1., 0., 1. / 12., 1., 1.}, 512.) ==
        doctest::Approx(2. * radial_toughness({1., 0., 1. / 12., 1., 1.}, 1.)));
}

TEST_CASE("radial fracture with Carter leak-off")
{
  // From a little leak-off to 97 % of the fluid lost, near toughness and near viscosity.
  const ReferenceTable table("penny_carter_si");
  const double rate = 0.0265;
  for (const char *name : {"toughness", "toughness_strong_leakoff", "viscosity_strong_leakoff"})
  {
    std::unique_ptr<HydraulicFracture> fracture;
    for (std::size_t i = 0; i < table.rows(); ++i)
      if (table.text(i, "case") == name && table(i, "t_s") >= 1.)
      {
        if (!fracture)
        {
          HydraulicFractureParameters parameters{
            {3e10, 0.25, table(i, "mu_Pa_s"), table(i, "KIc_Pa_sqrt_m"), rate}};
          parameters.leak_off_coefficient = table(i, "C_L_m_per_sqrt_s");
          parameters.shape = CrackShape::penny;
          fracture = std::make_unique<HydraulicFracture>(parameters, 1000.);
        }
        const double t = table(i, "t_s"), R = table(i, "R_m");
        INFO(name, " at ", t, " s");
        CHECK(fracture->half_length(t) == doctest::Approx(R).epsilon(5e-4));
        CHECK(fracture->inlet_opening(t) == doctest::Approx(table(i, "w0_m")).epsilon(5e-4));
        CHECK(fracture->pressure(0.5 * R, t) ==
              doctest::Approx(table(i, "p_half_radius_Pa")).epsilon(1e-3));
        CHECK(fracture->fracture_volume(t) / (rate * t) ==
              doctest::Approx(table(i, "efficiency")).epsilon(5e-4));
      }
  }
}

TEST_CASE("Carter's length: what is injected is in the fracture or has leaked")
{
  const double rate = 2e-4, width = 3e-4, C = 2e-5, end = 500.;
  // Two wings of two faces: 8 C int_0^l sqrt(t - t0) dx = 4 C int_0^t l(t0)/sqrt(t - t0) dt0.
  double leaked = 0.;
  const unsigned int n = 20000;
  for (unsigned int i = 0; i < n; ++i)
  {
    // t0 = end (1 - s^2): no singular end
    const double s = (i + 0.5) / n;
    leaked += 8. * C * std::sqrt(end) * carter_half_length(rate, width, C, end * (1. - s * s)) / n;
  }
  const double stored = 2. * width * carter_half_length(rate, width, C, end);
  CHECK(stored / (rate * end) < 0.5);
  CHECK(stored + leaked == doctest::Approx(rate * end).epsilon(1e-4));
}

TEST_CASE("Carter's length: its limits, and no jump between the series")
{
  CHECK(carter_half_length(2e-4, 3e-4, 0., 500.) == doctest::Approx(500. / 3.));
  CHECK(carter_half_length(2e-4, 3e-4, 1e-12, 500.) == doctest::Approx(500. / 3.).epsilon(1e-6));
  CHECK(carter_half_length(2e-4, 1e-12, 2e-5, 500.) ==
        doctest::Approx(carter_half_length(2e-4, 0., 2e-5, 500.)).epsilon(1e-6));
  for (const double S : {1e-3, 20.})
  {
    const double C = 2e-5, t = 500., width = 2. * C * std::sqrt(pi * t) / S;
    CHECK(carter_half_length(2e-4, width * 1.000001, C, t) * 1.000001 ==
          doctest::Approx(carter_half_length(2e-4, width / 1.000001, C, t)).epsilon(1e-5));
  }
}

TEST_CASE("A leaking KGD fracture: beside the solution of Adachi & Detournay")
{
  for (const char *name : {"kgd_sun_carter", "kgd_carter_strong"})
  {
    CAPTURE(name);
    const ReferenceTable table(name);
    const double E = table.parameter("E"), nu = table.parameter("nu");
    const KgdParameters fluid{E, nu, table.parameter("mu"),
                              std::sqrt(E / (1. - nu * nu) * table.parameter("Gc")),
                              table.parameter("Q0")};
    const auto last = table.rows() - 1;
    const double t = table(last, "t_s");
    const auto estimate = leaking_kgd(fluid, {table.parameter("C_L"), 0.}, t);
    CHECK(estimate.half_length == doctest::Approx(table(last, "l_m")).epsilon(0.03));
    CHECK(estimate.efficiency ==
          doctest::Approx(table(last, "V_fracture_m2") / (fluid.rate * t)).epsilon(0.05));
  }
}

TEST_CASE("A leaking KGD fracture: without leak-off, and where the net pressure drives it")
{
  const KgdParameters fluid{3e10, 0.25, 1e-3, 1e6, 1e-4};
  const Kgd impermeable(fluid);
  const auto tight = leaking_kgd(fluid, {}, 100.);
  CHECK(tight.efficiency == doctest::Approx(1.).epsilon(1e-9));
  CHECK(tight.half_length == doctest::Approx(impermeable.half_length(100.)).epsilon(1e-9));

  // A coefficient that is the same at the net pressure of the end.
  const auto constant = leaking_kgd(fluid, {2e-5, 0.}, 100.);
  const double length = constant.half_length;
  const double net =
    impermeable.inlet_pressure(100. * std::pow(length / impermeable.half_length(100.), 1.5));
  CHECK(constant.efficiency < 0.8);
  CHECK(leaking_kgd(fluid, {1e-5, 1e-5 / net}, 100.).half_length ==
        doctest::Approx(length).epsilon(1e-6));
}
} // namespace stockwork::analytical_hydraulic_fracture_test
