#include "verification/reference_solution.h"

#include "stockwork/base/error.h"

namespace stockwork
{
using namespace dealii;

void
declare_reference_parameters(ParameterHandler &prm)
{
  prm.enter_subsection("Verification");
  prm.declare_entry("Reference", "none", Patterns::Selection("none"), "Analytical solution of the case.");
  prm.declare_entry("Reference factor",
                    "1",
                    Patterns::Double(),
                    "Multiplies the reference. Other than 1 only in tests that a comparison can fail.");
  prm.declare_entry("Start from reference",
                    "false",
                    Patterns::Bool(),
                    "Take displacement and pore pressure at the start time from the reference.");
  prm.leave_subsection();
}


bool
starts_from_reference(ParameterHandler &prm)
{
  prm.enter_subsection("Verification");
  const bool result = prm.get_bool("Start from reference");
  prm.leave_subsection();
  return result;
}


template <int dim>
std::unique_ptr<ReferenceSolution<dim>>
make_reference(ParameterHandler &, const ReferenceInput<dim> &)
{
  return {};
}


template std::unique_ptr<ReferenceSolution<2>>
make_reference<2>(ParameterHandler &, const ReferenceInput<2> &);
template std::unique_ptr<ReferenceSolution<3>>
make_reference<3>(ParameterHandler &, const ReferenceInput<3> &);
} // namespace stockwork
