#pragma once

#include <mpi.h>

#include <string>
#include <utility>
#include <vector>

#include "stockwork/fracture/summary.h"

namespace stockwork
{
/// A piece of a fracture with values on it: a line in 2-D, a polygon of three or four corners in
/// 3-D.
template <int dim>
struct FracturePiece
{
  std::vector<dealii::Point<dim>> corners;
  std::vector<std::pair<std::string, double>> values;

  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    archive &corners &values;
  }
};

/// The .vtu file of all pieces; every rank gives its own. All pieces have the same values, in the
/// same order. Collective. The text is empty if there are no pieces, and everywhere but on rank 0.
/// @throws SolveError naming a value that is not a number
template <int dim>
std::string fracture_file(const std::vector<FracturePiece<dim>> &pieces, MPI_Comm communicator);

/// The same of lines, in space as well.
template <int dim>
std::string bond_file(const std::vector<FracturePiece<dim>> &bonds, MPI_Comm communicator);
} // namespace stockwork
