#pragma once

#include <deal.II/fe/fe.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping.h>

#include "exchange/bulk_layout.h"

#include <memory>
#include <vector>

namespace stockwork
{
/// Integrals of products of shape functions over one cell, from which every constant-coefficient
/// matrix of Biot's equations is a linear combination:
///
///   gradients [(i*dim+j) n_u^2 + a n_u + b] = int d_i N_a d_j N_b
///   masses    [a n_u + b]                   = int N_a N_b
///   divergences [(i*n_p + a) n_u + b]       = int P_a d_i N_b
///   pressure_gradients [a n_p + b]          = int grad P_a . grad P_b
///   pressure_masses    [a n_p + b]          = int P_a P_b
///   pressure_means     [a]                  = int P_a
///
/// On axis-parallel boxes they are multiples of those of the unit cell, so no quadrature is done.
template <int dim>
class CellIntegrals
{
public:
  CellIntegrals(const dealii::Mapping<dim> &mapping, const dealii::FiniteElement<dim> &fe);

  /// Returns whether the integrals have changed: boxes of equal size have equal integrals.
  bool reinit(const typename dealii::DoFHandler<dim>::active_cell_iterator &cell);

  BulkLayout<dim> layout;

  std::vector<double> gradients;
  std::vector<double> masses;
  std::vector<double> divergences;
  std::vector<double> pressure_gradients;
  std::vector<double> pressure_masses;
  std::vector<double> pressure_means;
  double volume = 0.;

private:
  /// All integrals of the unit cell; the pressure gradients by direction.
  struct UnitCell
  {
    std::vector<double> gradients, masses, divergences, pressure_gradients, pressure_masses,
      pressure_means;
  };

  void by_scaling(const dealii::Tensor<1, dim> &extents);

  void by_quadrature();

  dealii::Tensor<1, dim> box; ///< edge lengths of the last cell, zero if it was no box
  dealii::FEValues<dim> fe_values;
  UnitCell unit;
  std::vector<double> shape_gradients; ///< scratch, [d * n_u + a]
  std::vector<double> shape_values;    ///< scratch, [a]
};

/// Is the cell a box parallel to the axes? If so, `extents` are its edge lengths.
template <int dim>
bool is_axis_parallel_box(const typename dealii::Triangulation<dim>::cell_iterator &cell,
                          dealii::Tensor<1, dim> &extents);
} // namespace stockwork
