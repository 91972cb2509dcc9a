// Waves across the rim of the peridynamic zone: a strip that cannot expand sideways, elements on
// the left, bonds on the right, and a pulse that comes from the elements. Lengths in cells, wave
// speed one.
#include <doctest/doctest.h>

#include "fracture/peridynamics/lattice_moduli.h"

#include <deal.II/lac/lapack_full_matrix.h>
#include <deal.II/lac/vector.h>

#include <cmath>

namespace stockwork::peridynamics_seam_test
{
using namespace stockwork::peridynamics;
using Matrix = dealii::LAPACKFullMatrix<double>;
using Vector = dealii::Vector<double>;

namespace
{
enum class Mass
{
  consistent, ///< of the elements, in all rows: what the model takes
  lumped      ///< rho V_i in the rows of bonds
};

/// Force per displacement between layers k cells apart, k from 1; sum k^2 w_k is the modulus, one.
std::vector<double> layer_stiffness(const unsigned int m)
{
  RockProperties rock;
  rock.poisson_ratio = 0.25;
  rock.young_modulus = 1. / 1.2;
  rock.plane_stress = false;
  const auto stencil = horizon_stencil<2>(m, VolumeRule::isotropic);
  const auto bonds = bond_coefficients<2>(stencil, bond_based_law<2>(rock, stencil, 1.), 1.);
  std::vector<double> stiffness(m, 0.);
  for (unsigned int b = 0; b < stencil.size(); ++b)
    if (const int k = stencil[b].offset[1]; k > 0)
      stiffness[k - 1] += bonds[b].stiffness * bonds[b].direction[1] * bonds[b].direction[1];
  return stiffness;
}

/// A strip of n nodes; those from `seam` on that have a whole horizon are peridynamic.
struct Strip
{
  Strip(const unsigned int n, const unsigned int seam, const unsigned int m, const Mass mass)
    : stiffness(n)
    , masses(n)
    , n(n)
  {
    stiffness = 0.;
    masses = 0.;
    const std::vector<double> layers = layer_stiffness(m);
    for (unsigned int i = 0; i < n; ++i)
    {
      const bool bonds = i >= seam && i + m + 1 < n;
      for (const int side : {-1, 1})
      {
        const auto couple = [&](const unsigned int k, const double k_layer)
        {
          stiffness(i, i) += k_layer;
          stiffness(i, i + side * static_cast<int>(k)) -= k_layer;
        };
        if (side < 0 ? i == 0 : i == n - 1)
          continue;
        if (bonds)
          for (unsigned int k = 1; k <= m; ++k)
            couple(k, layers[k - 1]);
        else
          couple(1, 1.);
        masses(i, i) += bonds && mass == Mass::lumped ? 0.5 : 1. / 3.;
        if (!bonds || mass == Mass::consistent)
          masses(i, i + side) += 1. / 6.;
      }
    }
  }

  Matrix stiffness, masses;
  unsigned int n;
};

/// A pulse of the given length, 100 cells from the left end, runs to the right for some time.
struct Motion
{
  Motion(const Strip &strip, const double length, const double end, const double dt)
    : u(strip.n)
    , v(strip.n)
  {
    for (unsigned int i = 0; i < strip.n; ++i)
      if (const double x = (i - 100.) / length; std::abs(x) < 0.5)
      {
        u(i) = 0.5 + 0.5 * std::cos(2. * M_PI * x);
        v(i) = M_PI / length * std::sin(2. * M_PI * x);
      }
    // Newmark's scheme with beta = 1/4, gamma = 1/2, is the trapezoidal rule.
    Matrix system(strip.masses);
    system *= 4. / (dt * dt);
    system.add(1., strip.stiffness);
    system.compute_lu_factorization();
    Vector next(strip.n), product(strip.n), known(strip.n);
    for (double t = 0.; t < end; t += dt)
    {
      known = v;
      known *= 4. / dt;
      known.add(4. / (dt * dt), u);
      strip.masses.vmult(next, known);
      strip.stiffness.vmult(product, u);
      next -= product;
      system.solve(next);
      for (unsigned int i = 0; i < strip.n; ++i)
        v(i) = 2. / dt * (next(i) - u(i)) - v(i);
      u = next;
    }
  }

  /// Of the elements between the first nodes.
  double energy(const unsigned int n_nodes) const
  {
    double sum = 0.;
    for (unsigned int i = 0; i + 1 < n_nodes; ++i)
      sum += 0.5 * (u(i + 1) - u(i)) * (u(i + 1) - u(i)) +
             (v(i) * v(i) + v(i) * v(i + 1) + v(i + 1) * v(i + 1)) / 6.;
    return sum;
  }

  Vector u, v;
};

/// Energy that comes back into the elements, over what was sent: that of the difference to a strip
/// of elements alone, for they leave short waves behind, too.
double reflected_energy(const unsigned int m, const double length, const Mass mass)
{
  const unsigned int n = 300, seam = 150;
  const double end = 110., dt = 0.25;
  const Motion sent(Strip(n, n, m, mass), length, 0., dt),
    alone(Strip(n, n, m, mass), length, end, dt);
  Motion back(Strip(n, seam, m, mass), length, end, dt);
  back.u -= alone.u;
  back.v -= alone.v;
  return back.energy(seam) / sent.energy(n);
}
} // namespace


TEST_CASE("peridynamics: long waves pass between elements and bonds, short ones return")
{
  double sum = 0.;
  const std::vector<double> layers = layer_stiffness(3);
  for (unsigned int k = 1; k <= 3; ++k)
    sum += k * k * layers[k - 1];
  REQUIRE(sum == doctest::Approx(1.).epsilon(1e-12));

  for (const auto &[length, most] : {std::make_pair(4., 0.5), {8., 0.022}, {16., 0.0019}})
  {
    const double reflected = reflected_energy(3, length, Mass::consistent);
    CAPTURE(length);
    CAPTURE(reflected);
    CHECK(reflected < most);
    CHECK(reflected > 0.5 * most);
  }
  // A mass of its own for every node makes the lattice slower than the elements.
  CHECK(reflected_energy(3, 8., Mass::lumped) > 0.1);
  CHECK(reflected_energy(3, 16., Mass::lumped) > 0.004);
}
} // namespace stockwork::peridynamics_seam_test
