// Bonds that have a stiffness of their own: against the box kernel, and against a sum bond by bond.
#include <doctest/doctest.h>

#include "fracture/peridynamics/lattice_moduli.h"
#include "fracture/peridynamics/uneven_bonds.h"
#include "lattice_rock.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace stockwork::uneven_bonds_test
{
using namespace stockwork::peridynamics;

namespace
{
/// A box of sites with a random displacement.
template <int dim>
struct Lattice
{
  explicit Lattice(const unsigned int row = 23)
    : stencil(horizon_stencil<dim>(2, VolumeRule::exact))
    , law(bond_based_law<dim>(lattice_rock(0.25), stencil, spacing))
    , bonds(bond_coefficients(stencil, law, spacing))
  {
    box.size.fill(11);
    box.size[0] = row;
    for (const StencilBond<dim> &bond : stencil)
      strides.push_back(box.stride(bond.offset));
    for (unsigned int d = 0; d < dim; ++d)
    {
      force[d].assign(box.n_sites(), 0.);
      for (std::size_t i = 0; i < box.n_sites(); ++i)
        u[d].push_back(random(generator));
    }
    for (std::size_t i = 0; i < box.n_sites(); ++i)
    {
      const unsigned int x = box.position(i)[0], margin = 2 + UnevenBonds<dim>::overhang;
      if (box.inside(i, 2) && x >= margin && x + margin < box.size[0])
        inside.push_back(i);
    }
  }

  double elongation(const std::size_t site, const unsigned int b) const
  {
    double sum = 0.;
    for (unsigned int d = 0; d < dim; ++d)
      sum += bonds[b].direction[d] * (u[d][site + strides[b]] - u[d][site]);
    return sum;
  }

  static constexpr double spacing = 0.5;
  std::mt19937 generator;
  std::uniform_real_distribution<double> random{-1., 1.};
  const std::vector<StencilBond<dim>> stencil;
  const BondLaw law;
  const std::vector<BondCoefficients<dim>> bonds;
  LatticeBox<dim> box;
  std::vector<std::ptrdiff_t> strides;
  LatticeField<dim> u, force;
  std::vector<std::size_t> inside; ///< where sites may be
};

constexpr double infinite = std::numeric_limits<double>::infinity();
} // namespace

TEST_CASE_TEMPLATE("Rows of any length are swept as their sites are one by one",
                   Dim,
                   std::integral_constant<int, 2>,
                   std::integral_constant<int, 3>)
{
  constexpr int dim = Dim::value;
  Lattice<dim> lattice(48);
  BondForces<dim> kernel(lattice.box, lattice.stencil, lattice.law, lattice.spacing);
  std::array<int, dim> corner;
  corner.fill(2);
  const std::size_t first = lattice.box.stride(corner);
  constexpr double limit = 3.5; // some are beyond
  struct Result
  {
    LatticeField<dim> force;
    std::vector<double> energy;
    std::vector<std::size_t> stretched;
  };
  const auto sweep = [&](const std::vector<typename BondForces<dim>::Span> &spans)
  {
    Result result{lattice.force, std::vector<double>(lattice.box.n_sites()), {}};
    kernel.sweep_only(spans);
    kernel.evaluate(lattice.u, result.force, limit, &result.stretched);
    kernel.energies(lattice.u, result.energy);
    auto &sites = result.stretched;
    std::sort(sites.begin(), sites.end());
    sites.erase(std::unique(sites.begin(), sites.end()), sites.end());
    return result;
  };
  std::vector<typename BondForces<dim>::Span> alone;
  for (unsigned int length = 1; length <= 44; ++length)
  {
    CAPTURE(length);
    alone.push_back({first + length - 1, 1});
    const Result expected = sweep(alone), in_a_row = sweep({{first, length}});
    CHECK(in_a_row.stretched == expected.stretched);
    double off = 0., of_energy = 0.; // beside the row, too
    for (std::size_t i = 0; i < lattice.box.n_sites(); ++i)
    {
      for (unsigned int d = 0; d < dim; ++d)
        off = std::max(off, std::abs(in_a_row.force[d][i] - expected.force[d][i]));
      of_energy = std::max(of_energy, std::abs(in_a_row.energy[i] - expected.energy[i]));
    }
    CHECK(off < 1e-13 * lattice.bonds.front().stiffness);
    CHECK(of_energy < 1e-13 * lattice.bonds.front().stiffness);
    if (length == 44)
      CHECK(!expected.stretched.empty());
  }
}

TEST_CASE_TEMPLATE("Where all bonds are those of the lattice, forces and energies are the kernel's",
                   Dim,
                   std::integral_constant<int, 2>,
                   std::integral_constant<int, 3>)
{
  constexpr int dim = Dim::value;
  Lattice<dim> lattice;
  UnevenBonds<dim> uneven(lattice.bonds, lattice.box, lattice.strides);
  BondForces<dim> kernel(lattice.box, lattice.stencil, lattice.law, lattice.spacing);
  std::vector<typename BondForces<dim>::Span> spans;
  for (const std::size_t site : lattice.inside)
  {
    spans.push_back({site, 1});
    uneven.add(site);
    for (unsigned int b = 0; b < lattice.bonds.size(); ++b)
      uneven.set(site, b, lattice.bonds[b].stiffness, infinite);
  }
  kernel.sweep_only(spans);
  LatticeField<dim> expected = lattice.force;
  kernel.evaluate(lattice.u, expected, infinite, nullptr);
  std::vector<double> energy(lattice.box.n_sites()), expected_energy = energy;
  kernel.energies(lattice.u, expected_energy);
  uneven.end_start();
  uneven.evaluate(lattice.u, lattice.force, nullptr);
  uneven.energies(lattice.u, energy);
  for (const std::size_t site : lattice.inside)
  {
    CHECK(energy[site] == doctest::Approx(expected_energy[site]).epsilon(1e-13));
    for (unsigned int d = 0; d < dim; ++d)
      CHECK(std::abs(lattice.force[d][site] - expected[d][site]) <
            1e-13 * lattice.bonds.front().stiffness);
  }
}

TEST_CASE_TEMPLATE("Each bond has its stiffness and its limit, also where rows have shared theirs",
                   Dim,
                   std::integral_constant<int, 2>,
                   std::integral_constant<int, 3>)
{
  constexpr int dim = Dim::value;
  Lattice<dim> lattice;
  const unsigned int n = lattice.bonds.size();
  UnevenBonds<dim> uneven(lattice.bonds, lattice.box, lattice.strides);
  // Every third site is none of them, and keeps the force that it has.
  std::vector<std::size_t> sites;
  for (const std::size_t site : lattice.inside)
    if (site % 3 != 0)
      sites.push_back(site);
  std::vector<std::vector<double>> stiffness(lattice.box.n_sites(), std::vector<double>(n, 2.)),
    limit(lattice.box.n_sites(), std::vector<double>(n, infinite));
  for (const std::size_t site : sites)
  {
    uneven.add(site);
    for (unsigned int b = 0; b < n; ++b)
      uneven.set(site, b, 2., infinite);
  }
  uneven.end_start();
  const auto change = [&](const std::size_t site, const unsigned int b)
  {
    stiffness[site][b] = 2. + lattice.random(lattice.generator);
    limit[site][b] = lattice.elongation(site, b) + (site % 2 == 0 ? -1e-6 : 1e-6);
    uneven.set(site, b, stiffness[site][b], limit[site][b]);
  };
  for (std::size_t k = 0; k < sites.size(); k += 5)
    change(sites[k], k % n);
  for (std::size_t k = 0; k < sites.size(); k += 7)
    change(sites[k], (k + 1) % n);

  std::vector<std::size_t> beyond;
  uneven.evaluate(lattice.u, lattice.force, &beyond);
  std::vector<double> energy(lattice.box.n_sites());
  uneven.energies(lattice.u, energy);
  std::vector<std::size_t> expected_beyond;
  for (const std::size_t site : lattice.inside)
  {
    std::array<double, dim> force{};
    double stored = 0.;
    bool is_beyond = false;
    for (unsigned int b = 0; b < n && site % 3 != 0; ++b)
    {
      const double elongation = lattice.elongation(site, b);
      is_beyond = is_beyond || elongation > limit[site][b];
      stored += 0.25 * stiffness[site][b] * elongation * elongation;
      for (unsigned int d = 0; d < dim; ++d)
        force[d] += stiffness[site][b] * elongation * lattice.bonds[b].direction[d];
    }
    if (is_beyond)
      expected_beyond.push_back(site);
    CHECK(energy[site] == doctest::Approx(stored).epsilon(1e-13));
    for (unsigned int d = 0; d < dim; ++d)
      CHECK(std::abs(lattice.force[d][site] - force[d]) < 1e-12);
  }
  std::sort(beyond.begin(), beyond.end());
  CHECK(beyond == expected_beyond);
}
} // namespace stockwork::uneven_bonds_test
