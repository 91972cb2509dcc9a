#pragma once

#include "solvers/extra_layout.h"
#include "solvers/linear_system.h"

#include <utility>
#include <vector>

class Epetra_CrsMatrix;

namespace stockwork
{
/// Increment, residual or scaling: values of all unknowns. `extra` has those that this rank sees,
/// see ExtraLayout.
struct SystemVector
{
  dealii::TrilinosWrappers::MPI::BlockVector bulk;
  std::vector<double> extra;

  /// Become a copy of a vector that may have another layout; deal.II's assignment wants as many
  /// blocks as there are.
  void copy_from(const SystemVector &other)
  {
    bulk.reinit(other.bulk, true);
    bulk = other.bulk;
    extra = other.extra;
  }
};

/// A LinearSystem made fit for use: its triplets are summed over the ranks, sorted, and put where
/// products need them, and a symmetric diagonal scaling is known.
///
/// The scaling of an unknown is d_i = 1 / max(sqrt|a_ii|, max_j |a_ij| d_j), the maximum over the
/// unknowns scaled before it. Where the matrix is definite that is |a_ii|^(-1/2); rows of a saddle
/// point with a small or no diagonal entry get a sound size from their couplings.
class SystemOperator
{
public:
  /// One entry; bulk indices are global dof indices.
  struct Entry
  {
    dealii::types::global_dof_index row;
    dealii::types::global_dof_index column;
    double value;
  };

  /// What couples extra unknowns to the bulk and to one another. Indices of extra unknowns are
  /// places in the operator's ExtraLayout.
  struct Border
  {
    unsigned int n = 0;             ///< extra unknowns
    std::vector<Entry> bulk_extra;  ///< in rows of this rank, by column, then row
    std::vector<Entry> extra_bulk;  ///< in columns of this rank, by row, then column
    std::vector<Entry> extra_extra; ///< in rows of this rank; all, if all are seen everywhere
  };

  /// Whether every rank has all extra unknowns, and their block of the matrix, or its share.
  enum class Extra
  {
    everywhere,
    shared_out
  };

  /// `bulk_scaling`: of an earlier system with the same bulk, or null.
  SystemOperator(const LinearSystem &,
                 MPI_Comm,
                 const dealii::TrilinosWrappers::MPI::BlockVector *bulk_scaling = nullptr,
                 Extra extra = Extra::everywhere);

  /// dst = J src. The vectors must not be the same.
  void vmult(SystemVector &dst, const SystemVector &src) const;

  /// r = R + J dx
  void residual(SystemVector &r, const SystemVector &dx) const;

  /// Euclidean norm of the scaled vector, |D r|; see LinearReport.
  double scaled_norm(const SystemVector &r) const;

  /// A zero vector of the right layout.
  SystemVector make_vector() const;

  /// The system's residual R.
  SystemVector load() const;

  const SystemVector &scaling() const
  {
    return scale;
  }

  /// Of the extra unknowns that this rank sees in another layout with the same owners. Collective.
  std::vector<double> scaling_in(const ExtraLayout &) const;

  const Border &border() const
  {
    return own_border;
  }

  /// Add entries that may be anybody's to a border of @p n unknowns that every rank sees.
  /// Collective.
  void extend(Border &border,
              unsigned int n,
              const Triplets &bulk_extra,
              const Triplets &extra_bulk,
              const Triplets &extra_extra) const;

  /// Entries where they belong: with the rank that owns their row, an unknown of the bulk.
  /// Collective.
  std::vector<Entry> to_owners_of_rows(const Triplets &) const;

  /// The same, with the rank that `hosts` names for their column, an extra unknown by its number
  /// that this rank sees.
  std::vector<Entry> to_hosts_of_columns(const Triplets &, const std::vector<double> &hosts) const;

  /// Entries in rows of this rank, by column, then row.
  const std::vector<Entry> &bulk_extra() const
  {
    return own_border.bulk_extra;
  }

  /// Entries in columns of this rank, by row, then column.
  const std::vector<Entry> &extra_bulk() const
  {
    return own_border.extra_bulk;
  }

  /// Entries in rows of this rank, by row, then column; all, if all are seen everywhere.
  const std::vector<Entry> &extra_extra() const
  {
    return own_border.extra_extra;
  }

  const ExtraLayout &extra_layout() const
  {
    return layout;
  }

  /// Of all ranks.
  unsigned int n_extra() const
  {
    return layout.size();
  }

  dealii::types::global_dof_index n_bulk() const
  {
    return offsets.back();
  }

  /// First global dof index of a block.
  dealii::types::global_dof_index offset(const unsigned int block) const
  {
    return offsets[block];
  }

  /// A bulk unknown of this rank.
  static double &entry(dealii::TrilinosWrappers::MPI::BlockVector &, unsigned int block, int local);
  static double
  entry(const dealii::TrilinosWrappers::MPI::BlockVector &, unsigned int block, int local);

  /// Block and local index of a global dof index owned by this rank.
  std::pair<unsigned int, int> locate(dealii::types::global_dof_index) const;

  /// Values of a vector at the columns that this rank's rows of a matrix touch, by local column.
  static std::vector<double> at_columns(const Epetra_CrsMatrix &,
                                        const dealii::TrilinosWrappers::MPI::Vector &);

  const LinearSystem &system() const
  {
    return *linear_system;
  }

private:
  /// Send the entries of the system's border to their ranks, each of which sees what it needs.
  void share_out_border();

  void scale_bulk();

  void scale_extra();

  const LinearSystem *linear_system;
  MPI_Comm communicator;
  std::vector<dealii::types::global_dof_index> offsets; ///< of the blocks, and the end
  ExtraLayout layout;
  Border own_border;
  SystemVector scale;
};
} // namespace stockwork
