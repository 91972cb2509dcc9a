#include <doctest/doctest.h>

#include <cmath>

#include "discontinuity/near_tip_field.h"
#include "rock/plane_elasticity.h"
#include "verification/analytical/anisotropic_crack.h"

namespace stockwork::anisotropic_crack_test
{
using namespace dealii;

namespace
{
/// Layered rock with its layers along x, by its stiffness in the plane.
SymmetricTensor<4, 3> layered()
{
  SymmetricTensor<4, 3> c;
  const double values[3][3] = {{45e9, 9e9, 11e9}, {9e9, 20e9, 9e9}, {11e9, 9e9, 45e9}};
  for (unsigned int i = 0; i < 3; ++i)
    for (unsigned int j = 0; j < 3; ++j)
      c[i][i][j][j] = values[i][j];
  c[0][1][0][1] = c[1][2][1][2] = 6e9;
  c[0][2][0][2] = 17e9;
  return c;
}

RockProperties layered_rock()
{
  RockProperties rock;
  rock.stiffness = layered();
  return rock;
}

/// Gradient [i][j] = u_i,j by central differences.
template <class Field>
Tensor<2, 2> gradient_of(const Field &u, const Point<2> &x, const double h)
{
  Tensor<2, 2> result;
  for (unsigned int j = 0; j < 2; ++j)
  {
    Point<2> there = x, here = x;
    there[j] += h;
    here[j] -= h;
    const Tensor<1, 2> slope = (u(there) - u(here)) / (2. * h);
    for (unsigned int i = 0; i < 2; ++i)
      result[i][j] = slope[i];
  }
  return result;
}
} // namespace

TEST_CASE("E' of a crack in isotropic rock is E/(1-nu^2) in any direction")
{
  RockProperties rock;
  rock.young_modulus = 20e9;
  rock.poisson_ratio = 0.2;
  const auto stiffness = LinearStiffness<2>(rock).tensor();
  for (const double angle : {0., 0.3, 1.2, 2.9})
  {
    const PlaneElasticity elasticity(stiffness, direction(angle));
    // Equal roots are found to half the digits.
    CHECK(elasticity.plane_modulus() == doctest::Approx(rock.plane_modulus()).epsilon(1e-6));
    CHECK(elasticity.is_degenerate());
  }
  CHECK(minimum_plane_modulus(stiffness) == doctest::Approx(rock.plane_modulus()).epsilon(1e-6));
}

TEST_CASE("along an axis of the layers E' is that of Sih, Paris and Irwin (1965), Eq. 29")
{
  const LinearStiffness<2> rock(layered_rock());
  const auto c = rock.tensor();
  const double det = c[0][0][0][0] * c[1][1][1][1] - std::pow(c[0][0][1][1], 2);
  for (const bool across : {false, true})
  {
    const unsigned int x = across ? 1 : 0, y = 1 - x;
    const double a11 = c[y][y][y][y] / det, a22 = c[x][x][x][x] / det, a12 = -c[0][0][1][1] / det,
                 a66 = 1. / c[0][1][0][1];
    const double compliance =
      std::sqrt(0.5 * a11 * a22) * std::sqrt(std::sqrt(a22 / a11) + (2. * a12 + a66) / (2. * a11));
    const PlaneElasticity elasticity(c, direction(across ? 0.5 * numbers::PI : 0.));
    CHECK(elasticity.plane_modulus() == doctest::Approx(1. / compliance).epsilon(1e-12));
    CHECK(std::abs(elasticity.crack_compliance[0][1]) < 1e-12 * compliance);
  }
}

TEST_CASE("the field around a tip leaves the faces free of traction and jumps by one")
{
  const LinearStiffness<2> rock(layered_rock());
  for (const double angle : {0., 0.5, 2.1})
  {
    const NearTipField field(rock, direction(angle));
    Tensor<2, 2> frame;
    frame[0] = direction(angle);
    frame[1] = direction(angle + 0.5 * numbers::PI);
    for (const unsigned int mode : {0u, 1u})
    {
      const auto plus = field(mode, numbers::PI), minus = field(mode, -numbers::PI);
      const Tensor<1, 2> jump = plus.value - minus.value;
      CHECK(jump[mode == 0 ? 1 : 0] == doctest::Approx(1.).epsilon(1e-10));
      CHECK(std::abs(jump[mode == 0 ? 0 : 1]) < 1e-10);
      for (const double theta : {numbers::PI, -numbers::PI, 0.7})
      {
        const auto f = field(mode, theta);
        const double h = 1e-6 * (theta > 3. ? -1. : 1.); // inwards
        const Tensor<1, 2> slope =
          (4. * field(mode, theta + h).value - field(mode, theta + 2. * h).value - 3. * f.value) /
          (2. * h);
        CHECK((slope - f.derivative).norm() < 1e-6);
      }
      // Traction at r = 1 behind the tip.
      for (const auto &f : {plus, minus})
      {
        Tensor<2, 2> gradient;
        for (unsigned int i = 0; i < 2; ++i)
        {
          gradient[i][0] = -0.5 * f.value[i];
          gradient[i][1] = -f.derivative[i];
        }
        const Tensor<2, 2> strain = transpose(frame) * gradient * frame;
        const SymmetricTensor<2, 2> stress = rock.stress(symmetrize(strain));
        // In opening there is no stress at all; in shear one along the crack.
        CHECK((stress * frame[1]).norm() < 1e-12 * 6e9 * gradient.norm());
        CHECK((stress.norm() > 0.1 * 6e9 * gradient.norm()) == (mode == 1));
      }
    }
  }
}

TEST_CASE("a pressurised crack in layered rock: load on its faces, equilibrium, jump")
{
  const LinearStiffness<2> rock(layered_rock());
  const double angle = 0.4, a = 1.5, p = 2e6, t = 0.7e6;
  const Point<2> centre(0.3, -0.2);
  const analytical::AnisotropicCrack crack(rock.tensor(), centre, a, angle, p, t);
  const Tensor<1, 2> along = direction(angle), normal = direction(angle + 0.5 * numbers::PI);
  const auto u = [&](const Point<2> &x) { return crack.displacement(x); };
  const auto stress = [&](const Point<2> &x, const double h)
  { return rock.stress(symmetrize(gradient_of(u, x, h))); };
  for (const double s : {-0.9, 0., 0.6})
    for (const double side : {1., -1.})
    {
      const Point<2> face = centre + s * along + side * 1e-4 * normal;
      const Tensor<1, 2> traction = stress(face, 2e-5) * normal;
      CHECK(traction * normal == doctest::Approx(-p).epsilon(1e-3));
      CHECK(traction * along == doctest::Approx(-t).epsilon(2e-3));
    }
  const double h = 1e-3;
  for (const Point<2> &x : {Point<2>(1., 2.), Point<2>(-2.5, 0.3), Point<2>(2.2, 0.5)})
  {
    Tensor<1, 2> divergence;
    for (unsigned int j = 0; j < 2; ++j)
    {
      Point<2> there = x, here = x;
      there[j] += h;
      here[j] -= h;
      const auto slope = (stress(there, h) - stress(here, h)) / (2. * h);
      for (unsigned int i = 0; i < 2; ++i)
        divergence[i] += slope[i][j];
    }
    CHECK(divergence.norm() < 1e-4 * stress(x, h).norm());
  }
  const Tensor<1, 2> jump = u(centre + 1e-9 * normal) - u(centre - 1e-9 * normal);
  CHECK(jump * normal == doctest::Approx(crack.opening()).epsilon(1e-6));
  // Clapeyron: the energy release rate is the change of half the work of the loads with a.
  const auto energy = [&](const double size)
  {
    const PlaneElasticity elasticity(rock.tensor(), along);
    Tensor<1, 2> load;
    load[0] = t;
    load[1] = p;
    return 0.5 * numbers::PI * size * size * (load * (elasticity.crack_compliance * load));
  };
  // Both tips move when a grows.
  CHECK((energy(a + h) - energy(a - h)) / (4. * h) ==
        doctest::Approx(crack.energy_release_rate()).epsilon(1e-9));
}
} // namespace stockwork::anisotropic_crack_test
