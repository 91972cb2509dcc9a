#include "solvers/linear_solver.h"

#include "solvers/block_amg.h"
#include "solvers/bordered_solver.h"
#include "solvers/direct_solver.h"
#include "solvers/lagged_solver.h"
#include "stockwork/base/error.h"
#include "stockwork/base/quantity.h"

#include <algorithm>
#include <cmath>
#include <sstream>

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
  prm.declare_entry(
    "Type", "auto", Selection("auto|direct|bordered|iterative"),
    "direct: one sparse factor of everything. bordered: a lasting factor of the "
    "rock and a small dense system for the fracture; the rock's lasts as long as it "
    "stays as it is, and in porous rock the time step. iterative: Krylov method with "
    "multigrid, and a sparse one for the fracture; for large three-dimensional "
    "problems. auto: iterative above a size in 3-D, else bordered; direct in porous rock "
    "without a fracture, and in 2-D where the fracture is large beside the rock; in 3-D, once "
    "2500 bonds soften (bond-based ones), iterations with the factor of an earlier matrix.");
  prm.declare_entry(
    "Direct below", "auto", Quantity(dimension::number, Range::non_negative(), "auto"),
    "Number of bulk unknowns in 3-D up to which Type = auto makes a factor of the rock, and "
    "of rows that yield up to which multigrid is helped by a factor of these. auto: 200000 "
    "in elastic rock without pores, whose factor lasts as long as the mesh, else 30000.");
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
  direct_below.reset();
  if (const auto number = get_optional_quantity(prm, "Direct below", dimension::number))
  {
    if (*number != std::floor(*number))
      throw InputError("'Linear solver/Direct below' is '" + prm.get("Direct below") +
                       "'; allowed is auto or a whole number of unknowns");
    direct_below = static_cast<unsigned int>(std::min(*number, 4e9));
  }
  max_iterations = prm.get_integer("Maximum iterations");
  restart = prm.get_integer("Restart");
  prm.leave_subsection();
}

unsigned int LinearSolverParameters::largest_factor(const BulkStructure &structure) const
{
  return direct_below.value_or(structure.keeps_its_factor() ? largest_lasting_factor : 30000);
}


namespace
{
/// Chooses anew for each system, which may gain or lose fracture unknowns.
class AutomaticSolver : public LinearSolver
{
public:
  AutomaticSolver(const LinearSolverParameters &parameters,
                  const BulkStructure &structure,
                  const MPI_Comm communicator)
    : parameters(parameters)
    , dim(structure.dim)
    , largest_factor(parameters.largest_factor(structure))
    , communicator(communicator)
  {
  }

  bool wants_hierarchy(const dealii::types::global_dof_index n_dofs) const override
  {
    return dim == 3 && n_dofs > largest_factor;
  }

  bool sees_rock_change(const LinearSystem &system, const SystemStamps &stamps) const override
  {
    return wants_hierarchy(system.residual_bulk.size()) ||
           (system.elastic && bordered && bordered->sees_rock_change(system, stamps));
  }

  LinearReport solve(const LinearSystem &system,
                     const SystemStamps &stamps,
                     const double tolerance,
                     dealii::TrilinosWrappers::MPI::BlockVector &dx_bulk,
                     std::vector<double> &dx_extra) override
  {
    const auto solve_with = [&](LinearSolver &solver, unsigned int &n_systems)
    {
      const LinearReport report = solver.solve(system, stamps, tolerance, dx_bulk, dx_extra);
      n_systems += report.is_good_enough();
      return report;
    };
    if (wants_hierarchy(system.residual_bulk.size()))
      return solve_with(get<BlockAmgSolver>(iterative, parameters, communicator), n_iterative);
    // In elastic rock without a fracture as well: one may come, and the factor will serve.
    if (system.elastic)
    {
      if (lagged || has_many_bonds(system))
      {
        bordered.reset();
        return solve_with(get<LaggedSolver>(lagged, communicator), n_lagged);
      }
      if (!has_large_fracture(system))
        return solve_with(get<BorderedSolver>(bordered, communicator), n_bordered);
      bordered.reset();
      return solve_with(get<DirectSolver>(direct, communicator), n_direct);
    }
    const bool tries_factor = !system.residual_extra.empty() && rock_may_have_factor(stamps);
    if (tries_factor)
      try
      {
        const LinearReport report =
          solve_with(get<BorderedSolver>(bordered, communicator), n_bordered);
        if (report.is_good_enough())
        {
          n_failures = 0;
          return report;
        }
      }
      catch (const SolveError &)
      {
      }
    const LinearReport report = solve_with(get<DirectSolver>(direct, communicator), n_direct);
    if (tries_factor)
    {
      ++n_failures; // singular without its fracture, or nearly so, if all together is not
      failed_rock = stamps.bulk_values;
    }
    return report;
  }

  std::unique_ptr<CondensedSystem>
  condense(const LinearSystem &system, const SystemStamps &stamps, const double tolerance) override
  {
    if (!system.elastic || !bordered || has_large_fracture(system) ||
        wants_hierarchy(system.residual_bulk.size()))
      return nullptr;
    auto condensed = bordered->condense(system, stamps, tolerance);
    if (condensed)
      ++n_bordered;
    return condensed;
  }

  std::string choices() const override
  {
    std::ostringstream text;
    const auto add = [&](const unsigned int n, const char *name)
    {
      if (n > 0)
        text << (text.str().empty() ? "" : ", ") << n << " by " << name;
    };
    add(n_bordered, "a lasting factor of the rock (bordered)");
    add(n_lagged, "iterations with the factor of an earlier matrix");
    add(n_direct, "a factor of everything (direct)");
    add(n_iterative, "multigrid (iterative)");
    return text.str();
  }

private:
  /// Whether its dense block takes more than a factor of all unknowns would, which in a plane goes
  /// with the power 3/2 of the rock's. Fractures have up to 4 times the root of the rock's
  /// unknowns; where bonds soften in a cloud (`branching/toughness/0.001`) it was 14 in the mean,
  /// 1791 beside 5580, and a factor of all took 0.6 of the time and a tenth of the memory.
  bool has_large_fracture(const LinearSystem &system) const
  {
    constexpr double largest = 8.;
    return dim == 2 && system.residual_extra.size() >
                         largest * std::sqrt(static_cast<double>(system.residual_bulk.size()));
  }

  /// Whether a solution for each of the bonds that soften, and a dense block of them, takes more
  /// than iterations with a lasting factor: in `radial/toughness/peridynamics`, fine, with as many
  /// (38844 unknowns of the rock) about as much, with 6500 three times.
  bool has_many_bonds(const LinearSystem &system) const
  {
    constexpr unsigned int many = 2500;
    return dim == 3 && !system.definite && system.n_mechanical_extra > many;
  }

  /// A rock that was singular without its fracture (closed, and nothing can be compressed) still is
  /// as long as it does not change; after a few of them others will be, too.
  bool rock_may_have_factor(const SystemStamps &stamps) const
  {
    constexpr unsigned int most_failures = 3;
    return n_failures == 0 || (n_failures < most_failures && stamps.bulk_values != failed_rock);
  }

  template <class Solver, class... Arguments>
  static LinearSolver &get(std::unique_ptr<LinearSolver> &solver, const Arguments &...arguments)
  {
    if (!solver)
      solver = std::make_unique<Solver>(arguments...);
    return *solver;
  }

  LinearSolverParameters parameters;
  unsigned int dim, largest_factor;
  MPI_Comm communicator;
  std::unique_ptr<LinearSolver> direct, bordered, lagged, iterative;
  unsigned int n_direct = 0, n_bordered = 0, n_lagged = 0, n_iterative = 0; ///< systems
  unsigned int n_failures = 0;  ///< of the rock's factor, one after another
  unsigned int failed_rock = 0; ///< SystemStamps::bulk_values of the last of them
};
} // namespace

std::unique_ptr<LinearSolver> make_linear_solver(const LinearSolverParameters &parameters,
                                                 const BulkStructure &structure,
                                                 const MPI_Comm communicator)
{
  switch (parameters.type)
  {
  case LinearSolverParameters::Type::direct:
    return std::make_unique<DirectSolver>(communicator);
  case LinearSolverParameters::Type::bordered:
    return std::make_unique<BorderedSolver>(communicator);
  case LinearSolverParameters::Type::iterative:
    return std::make_unique<BlockAmgSolver>(parameters, communicator);
  default:
    return std::make_unique<AutomaticSolver>(parameters, structure, communicator);
  }
}
} // namespace stockwork
