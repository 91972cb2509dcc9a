#include "solvers/displacement_multigrid.h"

#include "solvers/aggregation.h"
#include "solvers/node_matrix.h"

#include <Epetra_CrsMatrix.h>
#include <ml_epetra_utils.h>

namespace stockwork
{
using namespace dealii;

namespace
{
/// Of the Chebyshev polynomial before and after the correction.
constexpr unsigned int smoother_degree = 2;
} // namespace

struct DisplacementMultigrid::Smoother
{
  virtual ~Smoother() = default;
  virtual void smooth(double *x, const double *b, bool zero_start) const = 0;
  virtual void residual(double *r, const double *b, const double *x) const = 0;
};

template <int dim>
struct DisplacementMultigrid::SmootherOf : Smoother
{
  explicit SmootherOf(const Epetra_CrsMatrix &a)
    : matrix(a)
  {
  }

  void smooth(double *x, const double *b, const bool zero_start) const override
  {
    matrix.smooth(x, b, smoother_degree, zero_start);
  }

  void residual(double *r, const double *b, const double *x) const override
  {
    matrix.residual(r, b, x);
  }

  NodeMatrix<dim> matrix;
};

DisplacementMultigrid::DisplacementMultigrid() = default;

DisplacementMultigrid::~DisplacementMultigrid() = default;

void DisplacementMultigrid::build(const TrilinosWrappers::SparseMatrix &matrix,
                                  const DisplacementHierarchy &displacement)
{
  hierarchy = &displacement;
  smoother.reset();
  modes.clear();
  for (const auto &mode : displacement.rigid_body_modes)
    modes.insert(modes.end(), mode.begin(), mode.end());

  const Epetra_CrsMatrix *aggregated = &matrix.trilinos_matrix();
  if (displacement.from_linear && displacement.nodes_together)
  {
    if (displacement.dim == 2)
      smoother = std::make_unique<SmootherOf<2>>(matrix.trilinos_matrix());
    else
      smoother = std::make_unique<SmootherOf<3>>(matrix.trilinos_matrix());
    const auto &prolongation = *displacement.from_linear;
    Epetra_CrsMatrix *product = nullptr;
    ML_Epetra::ML_Epetra_PtAP(matrix.trilinos_matrix(), prolongation.trilinos_matrix(), product);
    linear_matrix.reset(product);
    aggregated = linear_matrix.get();
    const auto fine = prolongation.locally_owned_range_indices(),
               linear = prolongation.locally_owned_domain_indices();
    const auto communicator = matrix.get_mpi_communicator();
    defect.reinit(fine, communicator);
    correction.reinit(fine, communicator);
    coarse_defect.reinit(linear, communicator);
    coarse_correction.reinit(linear, communicator);
  }

  auto list = aggregation_parameters();
  if (smoother)
    // The linear level costs a twentieth of the quadratic one; solved better, iterations do not
    // grow.
    list.set("cycle applications", 3);
  const auto n_rows = static_cast<std::size_t>(aggregated->NumMyRows());
  const auto n_modes = static_cast<int>(displacement.rigid_body_modes.size());
  if (n_modes > 0 && displacement.rigid_body_modes.front().size() == n_rows)
  {
    list.set("null space: type", "pre-computed");
    list.set("null space: dimension", n_modes);
    list.set("null space: vectors", modes.data());
    if (displacement.nodes_together)
      list.set("PDE equations", static_cast<int>(displacement.dim));
  }
  aggregation.initialize(*aggregated, list);
}

void DisplacementMultigrid::vmult(TrilinosWrappers::MPI::Vector &dst,
                                  const TrilinosWrappers::MPI::Vector &src) const
{
  if (!smoother)
  {
    aggregation.vmult(dst, src);
    return;
  }
  double *x = dst.trilinos_vector()[0];
  const double *b = src.trilinos_vector()[0];
  smoother->smooth(x, b, true);
  smoother->residual(defect.trilinos_vector()[0], b, x);
  hierarchy->from_linear->Tvmult(coarse_defect, defect);
  aggregation.vmult(coarse_correction, coarse_defect);
  hierarchy->from_linear->vmult(correction, coarse_correction);
  dst += correction;
  smoother->smooth(x, b, false);
}
} // namespace stockwork
