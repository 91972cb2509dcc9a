#include "reference_table.h"
#include "verification/analytical/kgd.h"

#include <doctest/doctest.h>

#include <map>

namespace stockwork::analytical_kgd_test
{
using namespace stockwork::analytical;
using stockwork::test::ReferenceTable;
using stockwork::test::RelativeTo;

namespace
{
KgdParameters parameters(const ReferenceTable &table)
{
  const double E = table.parameter("E"), nu = table.parameter("nu");
  return {E, nu, table.parameter("mu"), std::sqrt(E / (1. - nu * nu) * table.parameter("Gc")),
          table.parameter("Q0")};
}

// One solution per toughness.
const KgdSimilarity &similarity(const double toughness)
{
  static std::map<double, KgdSimilarity> solutions;
  return solutions.try_emplace(toughness, toughness).first->second;
}
} // namespace

TEST_CASE("KGD: coefficients of the similarity solution for every toughness")
{
  // The tables are trusted to six digits.
  const double tolerance = 1e-6;
  const ReferenceTable table("kgd_selfsimilar_coefficients");
  const auto each = RelativeTo::each;
  CHECK_COLUMN(table, "gamma", tolerance, each,
               [&](const auto i) { return similarity(table(i, "Km")).gamma(); });
  CHECK_COLUMN(table, "Omega0", tolerance, each,
               [&](const auto i) { return similarity(table(i, "Km")).Omega(0.); });
  CHECK_COLUMN(table, "Pi0", tolerance, each,
               [&](const auto i) { return similarity(table(i, "Km")).Pi(0.); });
}

TEST_CASE("KGD: profiles of the similarity solution")
{
  const ReferenceTable table("kgd_selfsimilar_profiles");
  CHECK_COLUMN(table, "Omega", 1e-6, RelativeTo::largest,
               [&](const auto i) { return similarity(table(i, "Km")).Omega(table(i, "xi")); });
  CHECK_COLUMN(table, "Pi", 1e-5, RelativeTo::largest,
               [&](const auto i) { return similarity(table(i, "Km")).Pi(table(i, "xi")); });
}

TEST_CASE("KGD: fractures in physical units")
{
  for (const std::string name :
       {"kgd_benchmark_toughness", "kgd_benchmark_viscosity", "kgd_wang_E10", "kgd_sun_halfmodel"})
  {
    CAPTURE(name);
    const ReferenceTable table(name);
    const Kgd fracture(parameters(table));
    const auto time = [&](const auto i) { return table(i, "t_s"); };
    const auto each = RelativeTo::each;
    CHECK_COLUMN(table, "l_m", 1e-6, each,
                 [&](const auto i) { return fracture.half_length(time(i)); });
    CHECK_COLUMN(table, "w0_m", 1e-6, each,
                 [&](const auto i) { return fracture.inlet_opening(time(i)); });
    CHECK_COLUMN(table, "p0_Pa", 1e-6, each,
                 [&](const auto i) { return fracture.inlet_pressure(time(i)); });
    CHECK_COLUMN(table, "V_both_wings_m2", 1e-6, each,
                 [&](const auto i) { return fracture.volume(time(i)); });

    const KgdToughnessVertex vertex(parameters(table));
    CHECK_COLUMN(table, "l_Kvertex_m", 1e-6, each,
                 [&](const auto i) { return vertex.half_length(time(i)); });
    CHECK_COLUMN(table, "w0_Kvertex_m", 1e-6, each,
                 [&](const auto i) { return vertex.inlet_opening(time(i)); });
    CHECK_COLUMN(table, "p0_Kvertex_Pa", 1e-6, each,
                 [&](const auto i) { return vertex.pressure(time(i)); });

    KgdParameters no_toughness = parameters(table);
    no_toughness.toughness = 0.;
    const Kgd viscosity_vertex(no_toughness);
    CHECK_COLUMN(table, "l_Mvertex_m", 1e-6, each,
                 [&](const auto i) { return viscosity_vertex.half_length(time(i)); });
  }
}

TEST_CASE("KGD: profiles in physical units")
{
  for (const std::string name :
       {"kgd_benchmark_toughness", "kgd_benchmark_viscosity", "kgd_wang_E10"})
  {
    CAPTURE(name);
    const Kgd fracture(parameters(ReferenceTable(name)));
    const ReferenceTable table(name + "_profiles");
    CHECK_COLUMN(table, "w_m", 1e-5, RelativeTo::largest,
                 [&](const auto i) { return fracture.opening(table(i, "x_m"), table(i, "t_s")); });
    // A difference of 1e-7 in l shows near the tip, where p falls without bound.
    CHECK_COLUMN(table, "p_Pa", 1e-4, RelativeTo::largest,
                 [&](const auto i) { return fracture.pressure(table(i, "x_m"), table(i, "t_s")); });
  }
}

TEST_CASE("KGD: the opening holds what was injected, and closes as the toughness demands")
{
  const KgdParameters fluid{3e10, 0.25, 1e-3, 1e6, 1e-4};
  const Kgd fracture(fluid);
  const double t = 20., l = fracture.half_length(t);
  double area = 0.;
  constexpr int n = 4000;
  for (int i = 0; i < n; ++i) // x = l sin(theta) removes the root at the tip
  {
    const double theta = 1.5707963267948966 * (i + 0.5) / n;
    area +=
      2. * fracture.opening(l * std::sin(theta), t) * l * std::cos(theta) * 1.5707963267948966 / n;
  }
  CHECK(area == doctest::Approx(fracture.volume(t)).epsilon(1e-5));

  const double distance = 1e-9 * l;
  const double K_prime = 4. * std::sqrt(2. / 3.14159265358979) * fluid.toughness;
  CHECK(
    fracture.opening(l - distance, t) ==
    doctest::Approx(K_prime / fluid.plane_strain_modulus() * std::sqrt(distance)).epsilon(1e-3));
  CHECK(fracture.opening(1.01 * l, t) == 0.);
}
} // namespace stockwork::analytical_kgd_test
