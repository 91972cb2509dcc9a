// The example with a mesh from gmsh, contrib/gmsh, in rock without a damaged zone: a hole in an
// infinite body (Lame 1852, Kirsch 1898; e.g. Jaeger, Cook & Zimmerman 2007, section 8.5).
#include <doctest/doctest.h>

#include <cmath>

#include "scenario.h"

namespace stockwork::borehole_test
{
namespace
{
constexpr double radius = 0.1, young = 20e9, poisson = 0.25;
constexpr double shear_modulus = young / (2. * (1. + poisson));

/// What a pressure in the hole adds.
dealii::Tensor<1, 2> lame(const dealii::Point<2> &x, const double pressure)
{
  return pressure * radius * radius / (2. * shear_modulus * x.norm_square()) * x;
}

/// What the hole adds to a body under the stresses s_x and s_y, tension positive, plane strain.
dealii::Tensor<1, 2> kirsch(const dealii::Point<2> &x, const double s_x, const double s_y)
{
  const double r = x.norm(), theta = std::atan2(x[1], x[0]), ratio = radius * radius / (r * r);
  const double mean = 0.5 * (s_x + s_y), deviator = 0.5 * (s_x - s_y);
  const double factor = r * ratio / (2. * shear_modulus);
  const double u_r =
    factor * (mean + deviator * (4. * (1. - poisson) - ratio) * std::cos(2. * theta));
  const double u_theta =
    -factor * deviator * (2. * (1. - 2. * poisson) + ratio) * std::sin(2. * theta);
  dealii::Tensor<1, 2> u;
  u[0] = u_r * std::cos(theta) - u_theta * std::sin(theta);
  u[1] = u_r * std::sin(theta) + u_theta * std::cos(theta);
  return u;
}

/// Greatest error of the displacement at a vertex up to five radii from the hole's centre, relative
/// to the greatest displacement. The walls are at 50 radii, and cost (1/50)^2 at the hole.
template <class Solution>
double error_of(const std::vector<std::string> &loads, const Solution &solution)
{
  std::vector<std::string> settings{"Rock/Region 1/Young modulus=20 GPa"};
  settings.insert(settings.end(), loads.begin(), loads.end());
  Scenario scenario(STOCKWORK_SOURCE "/contrib/gmsh/borehole.prm", settings);
  scenario.advance();
  double error = 0., greatest = 0.;
  for (const auto &cell : scenario.system.bulk_dofs().active_cell_iterators())
    for (const unsigned int v : cell->vertex_indices())
      if (const auto &x = cell->vertex(v); x.norm() < 5. * radius)
      {
        auto difference = solution(x);
        greatest = std::max(greatest, difference.norm());
        for (unsigned int d = 0; d < 2; ++d)
          difference[d] -= scenario.stepper.committed.bulk(cell->vertex_dof_index(v, d));
        error = std::max(error, difference.norm());
      }
  return error / greatest;
}
} // namespace


TEST_CASE("Lame: a borehole under pressure, in a mesh from gmsh")
{
  const auto solution = [](const auto &x) { return lame(x, 25e6); };
  CHECK(error_of({}, solution) < 0.002);
  // The comparison can fail.
  CHECK(error_of({"Boundary conditions/Normal traction=borehole: -25.1 MPa"}, solution) > 0.002);
}


TEST_CASE("Kirsch: a borehole in stressed rock, in a mesh from gmsh")
{
  const std::string x = "borehole: -30e6*x/sqrt(x*x+y*y)", y = "borehole: -20e6*y/sqrt(x*x+y*y)";
  CHECK(error_of({"Boundary conditions/Normal traction=", "Boundary conditions/Traction x=" + x,
                  "Boundary conditions/Traction y=" + y},
                 [](const auto &x) { return kirsch(x, -30e6, -20e6); }) < 0.004);
}
} // namespace stockwork::borehole_test
