#pragma once

// A small linear system given as a dense matrix, for solvers to be compared with a dense solve on
// any number of ranks.

#include <deal.II/base/mpi.h>
#include <deal.II/lac/block_sparsity_pattern.h>
#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/vector.h>

#include "solvers/linear_solver.h"

#include <cmath>
#include <memory>

namespace stockwork::dense_system
{
using namespace dealii;

inline const MPI_Comm comm = MPI_COMM_WORLD;

/// A number in (-1, 1) that depends on i and j only.
inline double noise(const unsigned int i, const unsigned int j)
{
  return std::sin(12.9898 * (i + 1) + 78.233 * (j + 1) + 0.37 * (i + 1) * (j + 1));
}

/// A small system given as a dense matrix: bulk blocks of sizes n_u and n_p, then extra unknowns.
/// Entries couple unknowns at most `band` apart within the bulk, and a few with each extra one.
struct DenseSystem
{
  unsigned int n_u, n_p, n_extra;
  FullMatrix<double> J;
  Vector<double> R;
  unsigned int n_mechanical = 0; ///< of the extra unknowns

  unsigned int n_bulk() const
  {
    return n_u + n_p;
  }

  Vector<double> solution() const
  {
    FullMatrix<double> inverse(J);
    inverse.gauss_jordan();
    Vector<double> x(R.size());
    inverse.vmult(x, R);
    x *= -1.;
    return x;
  }
};

/// K positive definite; [K -Q; -Q^T -S] when there is a second block; extra unknowns with or
/// without a diagonal entry. `decades` separates the units of the two bulk blocks.
inline DenseSystem make_dense(const unsigned int n_u,
                              const unsigned int n_p,
                              const unsigned int n_extra,
                              const double decades = 0.,
                              const double asymmetry = 0.,
                              const double border_asymmetry = 0.)
{
  DenseSystem d;
  d.n_u = n_u;
  d.n_p = n_p;
  d.n_extra = n_extra;
  const unsigned int n = n_u + n_p + n_extra;
  d.J.reinit(n, n);
  d.R.reinit(n);
  for (unsigned int i = 0; i < n_u; ++i)
    for (unsigned int j = 0; j < n_u; ++j)
      if (i == j)
        d.J(i, j) = 6. + noise(i, i);
      else if (std::max(i, j) - std::min(i, j) <= 3)
        d.J(i, j) = noise(std::max(i, j), std::min(i, j)) + asymmetry * noise(i, j);
  for (unsigned int i = 0; i < n_p; ++i)
  {
    const unsigned int row = n_u + i;
    for (unsigned int j = 0; j < n_p; ++j)
      if (i == j)
        d.J(row, row) = -3. + noise(i, i);
      else if (std::max(i, j) - std::min(i, j) == 1)
        d.J(row, n_u + j) = 0.5 * noise(std::max(i, j), std::min(i, j));
    for (unsigned int j = 0; j < n_u; ++j)
      if (j / 2 == i || j / 3 == i)
        d.J(row, j) = d.J(j, row) = noise(row, j);
  }
  for (unsigned int e = 0; e < n_extra; ++e)
  {
    const unsigned int row = n_u + n_p + e;
    // As in a fracture: openings couple to the bulk and have stiffness, pressures couple to
    // openings and have next to no diagonal entry.
    if (e % 2 == 0)
    {
      d.J(row, row) = 8.;
      for (unsigned int k = 0; k < 4; ++k)
      {
        const unsigned int j = (7 * e + 3 * k) % (n_u + n_p);
        d.J(row, j) = noise(row, j);
        d.J(j, row) = noise(row, j) + (asymmetry + border_asymmetry) * noise(j, row);
      }
    }
    else
    {
      d.J(row, row - 1) = d.J(row - 1, row) = 1. + 0.3 * noise(row, e);
      d.J(row, row) = e % 4 == 1 ? 0. : -1e-3;
    }
  }
  for (unsigned int i = 0; i < n; ++i)
    d.R(i) = noise(i, 3 * i + 1);
  const double unit = std::pow(10., -decades);
  for (unsigned int i = n_u; i < n_u + n_p; ++i)
  {
    for (unsigned int j = 0; j < n; ++j)
    {
      d.J(i, j) *= unit;
      d.J(j, i) *= unit;
    }
    d.R(i) *= unit;
  }
  return d;
}

/// The owned part of [0, n) on this rank.
inline IndexSet owned(const unsigned int n)
{
  const unsigned int me = Utilities::MPI::this_mpi_process(comm),
                     p = Utilities::MPI::n_mpi_processes(comm);
  IndexSet set(n);
  set.add_range(n * me / p, n * (me + 1) / p);
  return set;
}

inline std::unique_ptr<LinearSystem> distribute(const DenseSystem &d)
{
  auto result = std::make_unique<LinearSystem>();
  LinearSystem &system = *result;
  std::vector<IndexSet> sets = {owned(d.n_u)};
  if (d.n_p > 0)
    sets.push_back(owned(d.n_p));
  const unsigned int n_blocks = sets.size();
  BlockDynamicSparsityPattern pattern(n_blocks, n_blocks);
  const std::vector<unsigned int> start = {0, d.n_u, d.n_u + d.n_p};
  for (unsigned int b = 0; b < n_blocks; ++b)
    for (unsigned int c = 0; c < n_blocks; ++c)
      pattern.block(b, c).reinit(sets[b].size(), sets[c].size());
  pattern.collect_sizes();
  for (unsigned int b = 0; b < n_blocks; ++b)
    for (const auto i : sets[b])
      for (unsigned int j = 0; j < d.n_bulk(); ++j)
        if (d.J(start[b] + i, j) != 0. || start[b] + i == j)
          pattern.add(start[b] + i, j);
  system.bulk.reinit(sets, pattern, comm);
  system.residual_bulk.reinit(sets, comm);
  for (unsigned int b = 0; b < n_blocks; ++b)
    for (const auto i : sets[b])
    {
      for (unsigned int j = 0; j < d.n_bulk(); ++j)
        if (d.J(start[b] + i, j) != 0.)
          system.bulk.set(start[b] + i, j, d.J(start[b] + i, j));
      system.residual_bulk(start[b] + i) = d.R(start[b] + i);
    }
  system.bulk.compress(VectorOperation::insert);
  if (d.n_p > 0)
  {
    system.fixed_stress_mass.reinit(system.bulk.block(1, 1));
    for (const auto i : sets[1])
      system.fixed_stress_mass.set(i, i, std::abs(0.5 * d.J(d.n_u + i, d.n_u + i)));
    system.fixed_stress_mass.compress(VectorOperation::insert);
  }
  system.residual_bulk.compress(VectorOperation::insert);

  // Every rank contributes some of every extra entry, owner or not.
  const double p = Utilities::MPI::n_mpi_processes(comm);
  for (unsigned int e = 0; e < d.n_extra; ++e)
  {
    const unsigned int row = d.n_bulk() + e;
    for (unsigned int j = 0; j < d.n_bulk(); ++j)
    {
      if (d.J(row, j) != 0.)
        system.extra_bulk.add(e, j, d.J(row, j) / p);
      if (d.J(j, row) != 0.)
        system.bulk_extra.add(j, e, d.J(j, row) / p);
    }
    for (unsigned int f = 0; f < d.n_extra; ++f)
      if (d.J(row, d.n_bulk() + f) != 0.)
      {
        system.extra_extra.add(e, f, 0.25 * d.J(row, d.n_bulk() + f) / p);
        system.extra_extra.add(e, f, 0.75 * d.J(row, d.n_bulk() + f) / p);
      }
    system.residual_extra.push_back(d.R(row));
  }
  system.n_mechanical_extra = d.n_mechanical;
  system.symmetric = true;
  for (unsigned int i = 0; i < d.J.m(); ++i)
    for (unsigned int j = 0; j < i; ++j)
      system.symmetric &= (d.J(i, j) == d.J(j, i));
  system.elastic = system.definite = d.n_p == 0;
  for (unsigned int i = 0; i < d.n_u; ++i)
    for (unsigned int j = 0; j < i; ++j)
      system.definite &= (d.J(i, j) == d.J(j, i));
  return result;
}

/// Largest error of a solution, relative to the largest entry of its block.
inline double error(const DenseSystem &d,
                    const TrilinosWrappers::MPI::BlockVector &bulk,
                    const std::vector<double> &extra)
{
  const Vector<double> exact = d.solution();
  double worst = 0.;
  const auto check = [&](const unsigned int begin, const unsigned int end, auto value)
  {
    double size = 1e-300, difference = 0.;
    for (unsigned int i = begin; i < end; ++i)
    {
      size = std::max(size, std::abs(exact(i)));
      if (const double *x = value(i - begin))
        difference = std::max(difference, std::abs(*x - exact(i)));
    }
    worst = std::max(worst, Utilities::MPI::max(difference, comm) / size);
  };
  double x;
  const auto of_block = [&](const unsigned int b)
  {
    return [&, b](const unsigned int i) -> const double *
    {
      if (!bulk.block(b).in_local_range(i))
        return nullptr;
      x = bulk.block(b)(i);
      return &x;
    };
  };
  check(0, d.n_u, of_block(0));
  if (d.n_p > 0)
    check(d.n_u, d.n_bulk(), of_block(1));
  check(d.n_bulk(), d.J.m(), [&](const unsigned int i) { return &extra[i]; });
  return worst;
}

struct Run
{
  LinearReport report;
  double error;
  std::shared_ptr<LinearSystem> system; ///< whose matrix a preconditioner that is kept refers to
};

inline Run solve(LinearSolver &solver, const DenseSystem &d, const SystemStamps &stamps)
{
  std::shared_ptr<LinearSystem> system = distribute(d);
  TrilinosWrappers::MPI::BlockVector bulk(system->residual_bulk);
  std::vector<double> extra;
  const auto report = solver.solve(*system, stamps, 1e-12, bulk, extra);
  return {report, error(d, bulk, extra), system};
}
} // namespace stockwork::dense_system
