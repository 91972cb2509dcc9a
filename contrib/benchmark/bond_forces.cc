// Time the bond forces of a plate of sites in 3-D, beside the memory bandwidth of this machine.
//
//   ninja bond_forces_benchmark && contrib/benchmark/bond_forces_benchmark [NX NY NZ [M]]
//
// The plate (default 316 x 316 x 10 sites of full horizon, m = 3, the plate of the LAMMPS run of
// doc/performance.md) has a crack across half of it. One evaluation is one force on each site from
// all bonds of its horizon; a directed bond is one such contribution, whole or broken. Printed are
// medians of CPU time. LAMMPS' PERI package, bond-based, takes 16 ns per directed bond and step.
#include "fracture/peridynamics/bond_forces.h"
#include "fracture/peridynamics/lattice_moduli.h"
#include "fracture/peridynamics/state_based.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>

using namespace stockwork;
using namespace stockwork::peridynamics;

namespace
{
double cpu_seconds()
{
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

/// Median CPU time of @p f in seconds.
template <typename Function>
double median_time(const unsigned int repeat, const Function &f)
{
  f(); // pages and caches
  std::vector<double> times;
  for (unsigned int r = 0; r < repeat; ++r)
  {
    const double start = cpu_seconds();
    f();
    times.push_back(cpu_seconds() - start);
  }
  std::sort(times.begin(), times.end());
  return times[repeat / 2];
}

/// STREAM's triad a = b + s c on arrays far larger than the caches [B/s], 24 B per element.
double triad_bandwidth()
{
  const std::size_t n = 40'000'000;
  std::vector<double> a(n, 0.), b(n, 1.), c(n, 2.);
  const double time = median_time(7,
                                  [&]
                                  {
                                    double *__restrict const to = a.data();
                                    const double *const left = b.data(), *const right = c.data();
                                    for (std::size_t i = 0; i < n; ++i)
                                      to[i] = left[i] + 3. * right[i];
                                  });
  if (a[n / 2] != 7.)
    std::abort();
  return 24. * n / time;
}

void run(const char *name,
         const std::array<unsigned int, 3> &plate,
         const unsigned int m,
         const VolumeRule rule,
         const bool state_based,
         const double bandwidth)
{
  const double spacing = 1e-3;
  RockProperties rock;
  rock.young_modulus = 1e10;
  rock.poisson_ratio = state_based ? 0.2 : 0.25;
  const auto stencil = horizon_stencil<3>(m, rule);
  const BondLaw law = state_based ? state_based_law<3>(rock, stencil, spacing)
                                  : bond_based_law<3>(rock, stencil, spacing);
  LatticeBox<3> box{{{1, 1, 1}}};
  unsigned int margin = BondForces<3>(box, stencil, law, spacing).margin();
  for (unsigned int d = 0; d < 3; ++d)
    box.size[d] = plate[d] + 2 * margin;
  BondForces<3> forces(box, stencil, law, spacing);

  LatticeField<3> u, force;
  BrokenBonds broken(box.n_sites(), stencil.size());
  for (unsigned int d = 0; d < 3; ++d)
  {
    u[d].resize(box.n_sites());
    force[d].resize(box.n_sites());
  }
  std::size_t n_sites = 0, n_broken = 0;
  for (std::size_t site = 0; site < box.n_sites(); ++site)
  {
    const auto at = box.position(site);
    for (unsigned int d = 0; d < 3; ++d)
      u[d][site] = 1e-6 * std::sin(0.01 * (at[0] + 2. * at[1] + 3. * at[2] + d));
    if (!box.inside(site, margin))
      continue;
    ++n_sites;
    if (at[0] > box.size[0] / 2) // the crack: between two rows, half way through the plate
      continue;
    for (unsigned int b = 0; b < stencil.size(); ++b)
      if ((at[1] < box.size[1] / 2) != (at[1] + stencil[b].offset[1] < box.size[1] / 2))
      {
        broken.set(site, b);
        ++n_broken;
      }
  }

  const double time = median_time(9, [&] { forces.evaluate(u, broken, force); });
  const double n_bonds = static_cast<double>(n_sites) * stencil.size();
  // Displacements read, forces read (before they are overwritten) and written, theta likewise.
  const double bytes = (3. * 24. + (state_based ? 32. : 0.)) * n_sites;
  std::printf("%-28s %4zu bonds, %7zu sites, %.2f %% broken: %6.3f ns per directed bond, %5.2f B "
              "per bond, %4.1f GB/s = %4.1f %% of triad\n",
              name, stencil.size(), n_sites, 100. * n_broken / n_bonds, 1e9 * time / n_bonds,
              bytes / n_bonds, 1e-9 * bytes / time, 100. * bytes / time / bandwidth);
}
} // namespace

int main(int argc, char **argv)
{
  std::array<unsigned int, 3> plate{{316, 316, 10}};
  for (int d = 0; d < 3 && argc >= 4; ++d)
    plate[d] = std::atoi(argv[1 + d]);
  const unsigned int m = argc >= 5 ? std::atoi(argv[4]) : 3;
  const double bandwidth = triad_bandwidth();
  std::printf("triad %.1f GB/s\n", 1e-9 * bandwidth);
  run("bond-based, exact volumes", plate, m, VolumeRule::exact, false, bandwidth);
  run("bond-based, centre in ball", plate, m, VolumeRule::full, false, bandwidth);
  run("state-based, exact volumes", plate, m, VolumeRule::exact, true, bandwidth);
}
