// A hole in Mohr-Coulomb rock, against tables that were found by other means: an ordinary
// differential equation of the raw equations, and incremental finite elements that know no zones.
#include <doctest/doctest.h>

#include "reference_table.h"
#include "verification/analytical/mohr_coulomb_cavity.h"

#include <cmath>

namespace stockwork::analytical_cavity_test
{
namespace
{
constexpr double degree = 3.14159265358979323846 / 180.;

/// Of plastic radius and wall displacement, relative.
double greatest_difference(const std::string &name, const double cohesion)
{
  const test::ReferenceTable table(name);
  REQUIRE(table.rows() > 20);
  double worst = 0.;
  for (std::size_t row = 0; row < table.rows(); ++row)
  {
    analytical::MohrCoulombCavity cavity(
      {1e10, 0.25, cohesion, 27. * degree, table(row, "psi_deg") * degree, 30e6, 0.1});
    cavity.set_wall_pressure(table(row, "p_wall_Pa"));
    const double u = table(row, "u_wall_m");
    worst = std::max({worst,
                      std::abs(cavity.plastic_radius() / 0.1 / table(row, "R_plastic_over_a") - 1.),
                      std::abs(cavity.displacement(0.1) - u) / std::max(std::abs(u), 1e-4)});
  }
  return worst;
}
} // namespace


TEST_CASE("Mohr-Coulomb cavity: plastic radius and wall displacement as tabled")
{
  for (const char *name : {"cavity_mc_convergence", "cavity_mc_expansion"})
  {
    CHECK(greatest_difference(name, 3e6) < 2e-7);
    CHECK(greatest_difference(name, 3.1e6) > 1e-3);
  }
}
} // namespace stockwork::analytical_cavity_test
