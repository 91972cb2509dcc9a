#include "solvers/linear_solver.h"

#include "solvers/direct_solver.h"
#include "stockwork/base/error.h"

namespace stockwork
{
namespace
{
constexpr const char *section = "Linear solver";
}

void LinearSolverParameters::declare_parameters(dealii::ParameterHandler &prm)
{
  using namespace dealii::Patterns;
  prm.enter_subsection(section);
  prm.declare_entry("Type", "auto", Selection("auto|direct|bordered|iterative"),
                    "direct: one sparse factor of everything. bordered: a lasting factor of the "
                    "rock and a small dense system for the fracture; for elastic rock. iterative: "
                    "Krylov method with algebraic multigrid; for large three-dimensional problems "
                    "without fracture unknowns. auto: bordered in elastic rock with a fracture, "
                    "iterative above a size in 3-D, else direct.");
  prm.declare_entry("Direct below", "60000", Integer(0),
                    "Number of bulk unknowns in 3-D up to which auto chooses the direct solver.");
  prm.declare_entry("Maximum iterations", "200", Integer(1), "Of the iterative solver.");
  prm.declare_entry("Restart", "50", Integer(2), "Basis vectors FGMRES keeps before a restart.");
  prm.leave_subsection();
}

void LinearSolverParameters::parse_parameters(dealii::ParameterHandler &prm)
{
  prm.enter_subsection(section);
  const std::string name = prm.get("Type");
  type = name == "direct"      ? Type::direct
         : name == "bordered"  ? Type::bordered
         : name == "iterative" ? Type::iterative
                               : Type::automatic;
  direct_below = prm.get_integer("Direct below");
  max_iterations = prm.get_integer("Maximum iterations");
  restart = prm.get_integer("Restart");
  prm.leave_subsection();
}

std::unique_ptr<LinearSolver>
make_linear_solver(const LinearSolverParameters &, const BulkStructure &, const MPI_Comm comm)
{
  return std::make_unique<DirectSolver>(comm);
}
} // namespace stockwork
