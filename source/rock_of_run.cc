#include "rock_of_run.h"

#include "stockwork/base/error.h"
#include "stockwork/base/parameters.h"

#include "base/parameter_tree.h"

#include <algorithm>
#include <sstream>

namespace stockwork
{
using namespace dealii;

template <int dim>
void check_rock(const RunContext &run,
                const Case<dim> &the_case,
                const CoupledSystem<dim> &system,
                ParameterHandler &prm)
{
  NonlinearRock<dim> *const rock = system.nonlinear_rock();
  if (rock == nullptr)
    return;
  std::pair<std::string, types::material_id> replaced; // law and region
  bool flows = false;
  for (const auto &cell : system.bulk_dofs().active_cell_iterators())
    if (cell->is_locally_owned() && rock->answers(cell) &&
        the_case.model->role(cell).skip_stiffness != nullptr)
    {
      replaced = {rock->laws.name(cell->material_id()), cell->material_id()};
      flows = rock->law(cell).n_history() == 0;
    }
  if (Utilities::MPI::max(flows ? 1 : 0, run.communicator) == 1)
    throw EntryError("Rock/Permeability decay stress",
                     value_of(prm, {"Rock"}, "Permeability decay stress"),
                     "nothing (an empty entry) where the fracture model '" + the_case.model_name +
                       "' provides the stiffness of the rock itself: the elements do not know the "
                       "stress there");
  for (const auto &[law, number] : Utilities::MPI::all_gather(run.communicator, replaced))
    if (const std::string region = "Region " + std::to_string(number); !law.empty())
      throw EntryError(number == 0 || value_of(prm, {"Rock", region}, "Law").empty()
                         ? "Rock/Law"
                         : "Rock/" + region + "/Law",
                       law,
                       "elastic where the fracture model '" + the_case.model_name +
                         "' provides the stiffness of the rock itself: give the region that it "
                         "works in, or all rock, the law 'elastic', or take a model whose cracks "
                         "cut cells");

  const auto shares = Utilities::MPI::all_gather(
    run.communicator,
    [&]()
    {
      const auto mine = rock->in_situ_share();
      return std::make_pair(mine.used, std::make_pair(mine.place, mine.region));
    }());
  const auto worst = *std::max_element(
    shares.begin(), shares.end(), [](const auto &a, const auto &b) { return a.first < b.first; });
  constexpr double rounding = 1e-10; // on the surface is not beyond it
  if (worst.first <= 1. + rounding)
    return;
  const auto &[place, region] = worst.second;
  std::ostringstream allowed;
  allowed << "a state that the rock can bear: at (" << place
          << ") m the in-situ stress and pore pressure take " << 100. * worst.first
          << " per cent of the strength given in 'Rock/"
          << (region == 0 ? std::string() : "Region " + std::to_string(region) + "/")
          << rock->laws.name(region) << "' (see also 'In situ/Stress across the plane')";
  throw EntryError("In situ/Stress", value_of(prm, {"In situ"}, "Stress"), allowed.str());
}


template <int dim>
void pass_on_remarks(RunContext &run,
                     const CoupledSystem<dim> &system,
                     std::set<std::string> &passed_on)
{
  NonlinearRock<dim> *const rock = system.nonlinear_rock();
  if (rock == nullptr)
    return;
  const std::set<std::string> &mine = rock->totals().remarks;
  if (Utilities::MPI::max(mine.size(), run.communicator) == 0)
    return;
  const std::vector<std::string> here(mine.begin(), mine.end());
  for (const auto &of_rank : Utilities::MPI::all_gather(run.communicator, here))
    for (const std::string &remark : of_rank)
      if (passed_on.insert(remark).second)
        run.warn(remark);
}


template <int dim>
void say_how_far_rock_went(const RunContext &run, const CoupledSystem<dim> &system)
{
  NonlinearRock<dim> *const rock = system.nonlinear_rock();
  if (rock == nullptr || !rock->remembers())
    return;
  const double volume = Utilities::MPI::sum(rock->totals().yielded_volume, run.communicator);
  const double used = Utilities::MPI::max(rock->totals().maximum_used, run.communicator);
  if (volume > 0.)
    run.out << "The rock has yielded in " << volume << (dim == 2 ? " m^2" : " m^3") << "."
            << std::endl;
  else
    run.out << "The rock has stayed linear: at most " << 100. * used
            << " per cent of its strength were used at the end." << std::endl;
}


template void
check_rock<2>(const RunContext &, const Case<2> &, const CoupledSystem<2> &, ParameterHandler &);
template void pass_on_remarks<2>(RunContext &, const CoupledSystem<2> &, std::set<std::string> &);
template void say_how_far_rock_went<2>(const RunContext &, const CoupledSystem<2> &);
template void
check_rock<3>(const RunContext &, const Case<3> &, const CoupledSystem<3> &, ParameterHandler &);
template void pass_on_remarks<3>(RunContext &, const CoupledSystem<3> &, std::set<std::string> &);
template void say_how_far_rock_went<3>(const RunContext &, const CoupledSystem<3> &);
} // namespace stockwork
