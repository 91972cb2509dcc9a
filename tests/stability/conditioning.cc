// How a crack that leaves a small share of its cells on one side conditions the stiffness of rock
// and crack:
//
//   conditioning DECK [--set ENTRY=VALUE ...]
//
// The unknowns that are added for the crack count by what is cut off, so the matrix as it stands is
// worse the less that is, down to the clearance that crossings keep from a cell's corners
// (crack_path.h); scaled by its diagonal it is as good as with halves.
#include "scenario.h"

#include "stockwork/base/command_line.h"
#include "stockwork/base/lone_process.h"

#include <deal.II/lac/lapack_full_matrix.h>

#include <iostream>
#include <map>

using namespace stockwork;

namespace
{
/// Greatest over least eigenvalue of the symmetric stiffness.
double condition_number(const dealii::FullMatrix<double> &stiffness)
{
  const unsigned int n = stiffness.m();
  dealii::LAPACKFullMatrix<double> matrix(n, n);
  matrix = stiffness;
  dealii::Vector<double> eigenvalues;
  dealii::FullMatrix<double> eigenvectors;
  const double greatest = stiffness.frobenius_norm();
  matrix.compute_eigenvalues_symmetric(-greatest, 2. * greatest, 0., eigenvalues, eigenvectors);
  return eigenvalues(eigenvalues.size() - 1) / eigenvalues(0);
}

/// Of displacements, the crack's among them, that no boundary condition gives.
dealii::FullMatrix<double> stiffness(Scenario &scenario)
{
  const auto &constraints = scenario.system.mesh_view().constraints;
  std::vector<unsigned int> free;
  for (unsigned int i = 0; i < scenario.n_unknowns(); ++i)
    if (const unsigned int field = scenario.field(i);
        (field == 0 && !constraints.is_constrained(i)) || field == 2)
      free.push_back(i);
  dealii::FullMatrix<double> result(free.size(), free.size());
  result.extract_submatrix_from(scenario.matrix(), free, free);
  result.symmetrize(); // but for rounding
  return result;
}

void scale_by_diagonal(dealii::FullMatrix<double> &matrix)
{
  std::vector<double> root(matrix.m());
  for (unsigned int i = 0; i < matrix.m(); ++i)
    root[i] = std::sqrt(matrix(i, i));
  for (unsigned int i = 0; i < matrix.m(); ++i)
    for (unsigned int j = 0; j < matrix.n(); ++j)
      matrix(i, j) /= root[i] * root[j];
}
} // namespace


int main(int argc, char **argv)
{
  start_lone_process_quickly();
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const CommandLine command_line = parse_command_line(argc, argv);

  std::map<double, double> plain, scaled; // by the share
  std::cout << "share  condition number, plain  scaled by the diagonal\n";
  for (const double share : {0.5, 0.1, 0.01, 1e-3, 1e-5, 1e-8})
  {
    std::ostringstream height; // cells of 1 m
    height << share << " m";
    std::vector<std::string> settings = command_line.overrides;
    settings.push_back("Cracks/Open=0, " + height.str() + " -> 4 m, " + height.str());
    settings.push_back("Wells/Well 1/Perforations=0, " + height.str());
    Scenario scenario(command_line.deck, settings);
    scenario.begin_step();
    dealii::FullMatrix<double> matrix = stiffness(scenario);
    plain[share] = condition_number(matrix);
    scale_by_diagonal(matrix);
    scaled[share] = condition_number(matrix);
    std::cout << share << "  " << plain[share] << "  " << scaled[share] << '\n';
  }
  bool right = plain[1e-3] > 9. * plain[0.01] && plain[0.01] > 9. * plain[0.1];
  for (const double share : {1e-5, 1e-8})
    right = right && plain[share] < 1.001 * plain[1e-3];
  for (const auto &[share, number] : scaled)
    right = right && number < 1.01 * scaled[0.5];
  std::cout << (right ? "as it should be\n" : "NOT as it should be\n");
  return right ? 0 : 1;
}
