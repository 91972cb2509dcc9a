#include "solvers/aggregation.h"

#include <ml_MultiLevelPreconditioner.h>

namespace stockwork
{
Teuchos::ParameterList aggregation_parameters()
{
  Teuchos::ParameterList list;
  ML_Epetra::SetDefaults("SA", list);
  list.set("ML output", 0);
  list.set("smoother: type", "Chebyshev");
  list.set("smoother: sweeps", 2);
  list.set("aggregation: type", "Uncoupled");
  list.set("aggregation: threshold", 0.);
  list.set("coarse: type", "Amesos-KLU");
  list.set("coarse: max size", 1000);
  return list;
}
} // namespace stockwork
