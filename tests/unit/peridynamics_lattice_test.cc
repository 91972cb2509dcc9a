// The uniform lattice of peridynamics: bond volumes, stiffness, energy of a cut, calibration.
#include <doctest/doctest.h>

#include "fracture/peridynamics/driving_elongation.h"
#include "fracture/peridynamics/lattice_moduli.h"
#include "fracture/peridynamics/softening.h"
#include "fracture/peridynamics/state_based.h"
#include "lattice_rock.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace stockwork::peridynamics_lattice_test
{
using namespace stockwork::peridynamics;

namespace
{
/// Eq. 8b of Sun et al., and 12 E/(pi delta^4) in 3-D (Silling and Askari 2005): the micromodulus
/// that is exact when the sum over the horizon is an integral. Both are 2 d (d+2) G/q.
template <int dim>
double continuum_micromodulus(const RockProperties &rock, const double horizon)
{
  const double d3 = horizon * horizon * horizon;
  const double q = (dim == 2 ? 2. * M_PI * d3 / 3. : M_PI * d3 * horizon);
  return 2. * dim * (dim + 2.) * rock.shear_modulus() / q;
}

/// The law with the constants of the continuum.
template <int dim>
BondLaw uncalibrated(const RockProperties &rock, const double horizon)
{
  return {continuum_micromodulus<dim>(rock, horizon), 0., 1.};
}

/// Percent.
double error(const double value, const double exact)
{
  return 100. * (value / exact - 1.);
}

const double spacing = 0.125;
} // namespace

TEST_CASE("the study's table: stiffness and energy of a line with the constants of the continuum")
{
  // Errors in percent of C11, C12, their sum and the energy of a grid-aligned line; plane strain.
  // Values of an independent prototype; it printed the energy for m = 3 and 4 only.
  struct Row
  {
    VolumeRule rule;
    unsigned int m;
    double c11, c12, bulk, line, precision;
  };
  const double none = std::nan("");
  for (const Row &row : {Row{VolumeRule::full, 2, 18., -32., 5.4, none, 0.5},
                         Row{VolumeRule::full, 3, 5.3, 0.5, 4.1, 2.6, 0.05},
                         Row{VolumeRule::full, 4, -2.6, -7.3, -3.8, -7.1, 0.05},
                         Row{VolumeRule::ramp, 2, -14., -32., -18., none, 0.5},
                         Row{VolumeRule::ramp, 3, -13., -13., -13., -18., 0.5},
                         Row{VolumeRule::ramp, 4, -12., -11., -12., -16., 0.5},
                         Row{VolumeRule::exact, 2, 5.2, -4.3, 2.8, none, 0.05},
                         Row{VolumeRule::exact, 3, 2.2, -1.0, 1.4, 2.8, 0.05},
                         Row{VolumeRule::exact, 4, 1.1, -0.2, 0.8, 1.5, 0.05}})
  {
    CAPTURE(row.m);
    const auto stencil = horizon_stencil<2>(row.m, row.rule);
    const double horizon = row.m * spacing;
    const RockProperties r = lattice_rock(0.25);
    const BondLaw law = uncalibrated<2>(r, horizon);
    const double E = r.young_modulus;
    const auto moduli = lattice_moduli(stencil, law, spacing);
    CHECK(std::abs(error(moduli.c11, 1.2 * E) - row.c11) <= row.precision);
    CHECK(std::abs(error(moduli.c12, 0.4 * E) - row.c12) <= row.precision);
    CHECK(std::abs(error(moduli.c11 + moduli.c12, 1.6 * E) - row.bulk) <=
          std::min(row.precision, row.m == 2 ? 0.5 : 1.));
    if (!std::isnan(row.line))
    {
      const double s_c = continuum_critical_stretch<2>(r, horizon);
      CHECK(std::abs(error(crossing_energy(stencil, law, spacing, s_c), 100.) - row.line) <=
            row.precision);
    }
  }
}

TEST_CASE("number of bonds")
{
  CHECK(horizon_stencil<2>(3, VolumeRule::full).size() == 28);
  CHECK(horizon_stencil<2>(3, VolumeRule::exact).size() == 44);
  CHECK(horizon_stencil<2>(4, VolumeRule::exact).size() == 68);
  // Neighbours within 3 spacings in the cubic lattice.
  CHECK(horizon_stencil<3>(3, VolumeRule::full).size() == 122);
}

TEST_CASE_TEMPLATE("exact shares fill the horizon",
                   D,
                   std::integral_constant<int, 2>,
                   std::integral_constant<int, 3>)
{
  constexpr int dim = D::value;
  for (unsigned int m = 2; m <= 6; ++m)
  {
    double sum = 1.; // the site's own cell
    for (const auto &bond : horizon_stencil<dim>(m, VolumeRule::exact))
      sum += bond.volume_fraction;
    CHECK(sum ==
          doctest::Approx(dim == 2 ? M_PI * m * m : 4. / 3. * M_PI * m * m * m).epsilon(1e-12));
  }
}

TEST_CASE("the share of a cell on the axis of a ball")
{
  // Cap: cell (3,0,0) of m = 3 is [2.5,3.5] x [-.5,.5]^2; by the midpoint rule on 400^2 columns.
  double volume = 0.;
  const int n = 400;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
    {
      const double y = (i + 0.5) / n - 0.5, z = (j + 0.5) / n - 0.5;
      volume += (std::sqrt(9. - y * y - z * z) - 2.5) / (n * n);
    }
  for (const auto &bond : horizon_stencil<3>(3, VolumeRule::exact))
    if (bond.offset == std::array<int, 3>{{3, 0, 0}} ||
        bond.offset == std::array<int, 3>{{0, 0, -3}})
      CHECK(bond.volume_fraction == doctest::Approx(volume).epsilon(1e-6));
}

TEST_CASE_TEMPLATE("forward bonds and their opposites",
                   D,
                   std::integral_constant<int, 2>,
                   std::integral_constant<int, 3>)
{
  constexpr int dim = D::value;
  for (const auto rule : {VolumeRule::exact, VolumeRule::isotropic, VolumeRule::full})
  {
    const auto stencil = horizon_stencil<dim>(3, rule);
    for (unsigned int b = 0; b < stencil.size(); ++b)
    {
      const auto &back = stencil[opposite(b, stencil.size())];
      for (unsigned int d = 0; d < dim; ++d)
        CHECK(back.offset[d] == -stencil[b].offset[d]);
      CHECK(back.volume_fraction == stencil[b].volume_fraction);
      int last = 0;
      for (const int component : stencil[b].offset)
        last = component != 0 ? component : last;
      CHECK((last > 0) == (b < stencil.size() / 2));
    }
  }
}

TEST_CASE_TEMPLATE("calibrated, the bulk modulus and the mean shear modulus are exact",
                   D,
                   std::integral_constant<int, 2>,
                   std::integral_constant<int, 3>)
{
  constexpr int dim = D::value;
  for (const bool plane_stress : {false, true})
  {
    if (dim == 3 && plane_stress)
      continue;
    const RockProperties r = lattice_rock(bond_based_poisson_ratio(plane_stress), plane_stress);
    const double lambda = r.lame_lambda(), G = r.shear_modulus();
    CHECK(lambda == doctest::Approx(G).epsilon(1e-14));
    for (const auto rule : {VolumeRule::exact, VolumeRule::isotropic, VolumeRule::full})
      for (unsigned int m = 2; m <= 6; ++m)
      {
        CAPTURE(m);
        const auto stencil = horizon_stencil<dim>(m, rule);
        const BondLaw law = bond_based_law<dim>(r, stencil, spacing);
        const auto moduli = lattice_moduli(stencil, law, spacing);
        CHECK(moduli.bulk() == doctest::Approx(lambda + 2. * G / dim).epsilon(1e-13));
        CHECK(moduli.mean_shear() == doctest::Approx(G).epsilon(1e-13));
        if (rule == VolumeRule::isotropic)
        {
          CHECK(moduli.anisotropy() == doctest::Approx(1.).epsilon(1e-12));
          CHECK(moduli.c11 == doctest::Approx(lambda + 2. * G).epsilon(1e-12));
        }
      }
  }
}

TEST_CASE_TEMPLATE("state-based, any Poisson's ratio has the same two moduli exact",
                   D,
                   std::integral_constant<int, 2>,
                   std::integral_constant<int, 3>)
{
  constexpr int dim = D::value;
  for (const double poisson_ratio : {0.15, 0.25, 0.35})
    for (const bool plane_stress : {false, true})
    {
      if (dim == 3 && plane_stress)
        continue;
      const RockProperties r = lattice_rock(poisson_ratio, plane_stress);
      const double lambda = r.lame_lambda(), G = r.shear_modulus();
      for (const auto rule :
           {VolumeRule::exact, VolumeRule::isotropic, VolumeRule::full, VolumeRule::ramp})
        for (unsigned int m = 2; m <= 6; ++m)
        {
          CAPTURE(m);
          const auto stencil = horizon_stencil<dim>(m, rule);
          const auto moduli =
            lattice_moduli(stencil, state_based_law<dim>(r, stencil, spacing), spacing);
          CHECK(moduli.bulk() == doctest::Approx(lambda + 2. * G / dim).epsilon(1e-13));
          CHECK(moduli.mean_shear() == doctest::Approx(G).epsilon(1e-13));
          if (rule == VolumeRule::isotropic)
          {
            CHECK(moduli.c12 == doctest::Approx(lambda).epsilon(1e-12));
            CHECK(moduli.c44 == doctest::Approx(G).epsilon(1e-12));
          }
        }
    }
}

TEST_CASE("state-based rock of the bond-based ratio is bond-based")
{
  const auto stencil = horizon_stencil<3>(3, VolumeRule::exact);
  const BondLaw law = state_based_law<3>(lattice_rock(0.25), stencil, spacing);
  CHECK(std::abs(law.dilatation_modulus) < 1e-14 * lattice_rock(0.25).young_modulus);
  CHECK(law.micromodulus == bond_based_law<3>(lattice_rock(0.25), stencil, spacing).micromodulus);
}

TEST_CASE_TEMPLATE("calibrated, a cut at the critical stretch takes G_c",
                   D,
                   std::integral_constant<int, 2>,
                   std::integral_constant<int, 3>)
{
  constexpr int dim = D::value;
  // int_0^1 theta^2 dz/(s delta) with theta of a site z delta from the plane: the integral of |xi|
  // over the cap beyond it. In 3-D theta = 6 (1/4 - z/3 + z^4/12), in a plane
  // theta = (2/pi) (acos z - z/2 ((1 - z^2)^1/2 + z^2 acosh(1/z))).
  const double of_dilatations = dim == 2 ? 0.3225997 / (6. / M_PI) : 26. / 45. / 3.;
  for (const double poisson_ratio : {0.15, 0.25, 0.35})
    for (const auto rule : {VolumeRule::exact, VolumeRule::isotropic})
      for (unsigned int m = 3; m <= 6; ++m)
      {
        CAPTURE(poisson_ratio);
        CAPTURE(m);
        const RockProperties r = lattice_rock(poisson_ratio);
        const auto stencil = horizon_stencil<dim>(m, rule);
        const BondLaw law = state_based_law<dim>(r, stencil, spacing);
        BondLaw springs = law;
        springs.dilatation_modulus = 0.;
        const double energy = crossing_energy(stencil, springs, spacing,
                                              continuum_critical_stretch<dim>(r, m * spacing));
        CHECK(std::abs(error(energy, 100.)) < 18. / (m * m));
        if (m == 6)
          CHECK(std::abs(error(energy, 100.)) < 0.4);
        const double over_springs = crossing_energy(stencil, law, spacing, 1.) /
                                    crossing_energy(stencil, springs, spacing, 1.);
        CHECK(over_springs ==
              doctest::Approx(1. + of_dilatations * (r.lame_lambda() / r.shear_modulus() - 1.))
                .epsilon(0.4 / (m * m)));
      }
}

// A column of sites is pulled apart across a plane, stretched along it as well. Bonds across the
// plane soften by what drives them; what the work leaves is the energy of springs, at any stretch.
TEST_CASE_TEMPLATE("state-based bonds that soften take what springs do",
                   D,
                   std::integral_constant<int, 2>,
                   std::integral_constant<int, 3>)
{
  constexpr int dim = D::value;
  const int m = dim == 2 ? 3 : 2;
  const SofteningLaw softening{5e-5, 2e-4};
  const auto stencil = horizon_stencil<dim>(m, VolumeRule::exact);
  for (const double poisson_ratio : {0.1, 0.25, 0.35})
    for (const double along : {-2e-5, 0., 3e-5}) // strain
    {
      CAPTURE(poisson_ratio);
      CAPTURE(along);
      const BondLaw law = state_based_law<dim>(lattice_rock(poisson_ratio), stencil, spacing);
      const auto bonds = bond_coefficients<dim>(stencil, law, spacing);
      struct BondAbove
      {
        int layer, bond;
        double damage = 0.;
      };
      std::vector<BondAbove> across; // once each, from below
      for (int layer = -m; layer < 0; ++layer)
        for (unsigned int b = 0; b < stencil.size(); ++b)
          if (layer + stencil[b].offset[dim - 1] >= 0)
            across.push_back({layer, static_cast<int>(b)});
      const double volume = std::pow(spacing, dim);
      const auto elongation = [&](const BondAbove &bond, const double opening)
      {
        const double sine = bonds[bond.bond].direction[dim - 1];
        return opening * sine + along * bonds[bond.bond].length * (1. - sine * sine);
      };
      // Dilatations of the layers at an opening: of the bonds that hold, less what is damaged.
      const auto dilatations = [&](const double opening)
      {
        std::vector<double> theta(2 * m, along * (dim - 1));
        for (const BondAbove &bond : across)
        {
          const double g = bonds[bond.bond].dilatation, e = elongation(bond, opening),
                       change =
                         g * (opening * bonds[bond.bond].direction[dim - 1] - bond.damage * e);
          theta[bond.layer + m] += change;
          theta[bond.layer + stencil[bond.bond].offset[dim - 1] + m] += change;
        }
        return theta;
      };
      const double most = 1.5 * softening.last * (m + 1) * (m + 1) * spacing;
      const unsigned int n_steps = 4000;
      double lost = 0.;
      for (unsigned int i = 1; i <= n_steps; ++i)
      {
        const double opening = i * most / n_steps;
        const std::vector<double> theta = dilatations(opening);
        for (BondAbove &bond : across)
        {
          const auto &[direction, length, k, g] = bonds[bond.bond];
          const double e = elongation(bond, opening),
                       force = law.dilatation_modulus * volume * g *
                               (theta[bond.layer + m] +
                                theta[bond.layer + stencil[bond.bond].offset[dim - 1] + m]);
          const double damage =
            std::max(bond.damage, softening.damage(driving_elongation(e, force, k).value / length));
          lost += (0.5 * k * e * e + e * force) * (damage - bond.damage);
          bond.damage = damage;
        }
      }
      CHECK(std::all_of(across.begin(), across.end(),
                        [](const BondAbove &bond) { return bond.damage == 1.; }));
      BondLaw springs = law;
      springs.dilatation_modulus = 0.;
      const double expected = crossing_energy<dim>(stencil, springs, spacing,
                                                   std::sqrt(softening.first * softening.last));
      CHECK(lost / std::pow(spacing, dim - 1) == doctest::Approx(expected).epsilon(0.005));
    }
}

TEST_CASE("what calibration leaves: the anisotropy C11/(3 C12) of the study")
{
  for (const auto &[m, ratio] : {std::pair{3u, 1.033}, {4u, 1.013}})
  {
    const auto stencil = horizon_stencil<2>(m, VolumeRule::exact);
    const auto moduli =
      lattice_moduli(stencil, bond_based_law<2>(lattice_rock(0.25), stencil, spacing), spacing);
    CHECK(std::abs(moduli.c11 / (3. * moduli.c12) - ratio) < 0.0005);
  }
}

TEST_CASE("constants of the continuum")
{
  const double E = 1e10, delta = 0.3, G_c = 100.;
  CHECK(continuum_micromodulus<2>(lattice_rock(0.25), delta) ==
        doctest::Approx(9.6 * E / (M_PI * std::pow(delta, 3))));
  // Eq. 8b of Sun et al., plane stress, nu = 1/3.
  CHECK(continuum_micromodulus<2>(lattice_rock(1. / 3., true), delta) ==
        doctest::Approx(9. * E / (M_PI * std::pow(delta, 3))));
  CHECK(continuum_micromodulus<3>(lattice_rock(0.25), delta) ==
        doctest::Approx(12. * E / (M_PI * std::pow(delta, 4))));
  // Eq. 19, and Silling and Askari with K = 2E/3.
  CHECK(continuum_critical_stretch<2>(lattice_rock(0.25), delta) ==
        doctest::Approx(std::sqrt(5. * M_PI * G_c / (12. * E * delta))));
  CHECK(continuum_critical_stretch<2>(lattice_rock(1. / 3., true), delta) ==
        doctest::Approx(std::sqrt(4. * M_PI * G_c / (9. * E * delta))));
  CHECK(continuum_critical_stretch<3>(lattice_rock(0.25), delta) ==
        doctest::Approx(std::sqrt(5. * G_c / (9. * 2. / 3. * E * delta))));
}

TEST_CASE("without calibration the bulk modulus converges with the square of the spacing")
{
  for (unsigned int m = 2; m <= 6; ++m)
  {
    CAPTURE(m);
    const double horizon = m * spacing;
    const double plane = error(weighted_volume(horizon_stencil<2>(m, VolumeRule::exact), spacing),
                               2. * M_PI * std::pow(horizon, 3) / 3.);
    const double space = error(weighted_volume(horizon_stencil<3>(m, VolumeRule::exact), spacing),
                               M_PI * std::pow(horizon, 4));
    CHECK(plane * m * m == doctest::Approx(12.25).epsilon(0.09));
    CHECK(space * m * m == doctest::Approx(15.75).epsilon(0.06));
  }
}

TEST_CASE("trapping falls with the horizon")
{
  for (unsigned int m = 2; m < 6; ++m)
    CHECK(trapping_factor(m) < trapping_factor(m + 1));
  CHECK(trapping_factor(6) < 1.);
}
} // namespace stockwork::peridynamics_lattice_test
