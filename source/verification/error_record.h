#pragma once

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/mapping.h>

#include "stockwork/exchange/cell_role.h"
#include "stockwork/exchange/state.h"
#include "verification/reference_solution.h"

#include <functional>
#include <map>
#include <string>
#include <vector>

namespace stockwork
{
/// Collects the errors of a run against a reference solution: relative, at the end, and averaged
/// over time after the first 5 % of the run.
///
/// Quantities: displacement and pore_pressure (in the L2 norm), peak_pore_pressure (the greatest
/// pressure so far at the reference's point of observation), and whatever scalars the reference and
/// the statistics both know.
template <int dim>
class ErrorRecord
{
public:
  struct Error
  {
    double final = 0.;
    double integral = 0.;
    double duration = 0.;

    double mean() const
    {
      return duration > 0. ? integral / duration : final;
    }

    template <class Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &final &integral &duration;
    }
  };

  ErrorRecord(const ReferenceSolution<dim> &reference, double start_time, double end_time);

  using Role =
    std::function<CellRole<dim>(const typename dealii::DoFHandler<dim>::active_cell_iterator &)>;

  /// Relative L2 errors of displacement and pore pressure at the end of a step; in cells that a
  /// crack cuts, with the functions that jump there. Collective.
  void add_fields(double time,
                  double dt,
                  const dealii::Mapping<dim> &mapping,
                  const dealii::DoFHandler<dim> &dof_handler,
                  const Unknowns &solution,
                  const Role &role);

  /// Relative errors of scalars that both sides know.
  void add_values(double time, double dt, const std::map<std::string, double> &values);

  const std::map<std::string, Error> &errors() const
  {
    return all.front();
  }

  /// Against the reference times one of its wrong factors.
  const std::map<std::string, Error> &errors_against(const unsigned int wrong_factor) const
  {
    return all[1 + wrong_factor];
  }

  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    archive &all &peak &peak_reference;
  }

  /// Whether errors are formed at a time: it may be the last one only, or the reference may not
  /// reach so far.
  bool compares(double time) const;

private:
  /// @param error against the reference times a factor
  void add(const std::string &quantity,
           double time,
           double dt,
           const std::function<double(double factor)> &error);

  const ReferenceSolution<dim> &reference;
  double start_time, end_time;
  std::vector<double> factors;                   ///< of the reference; the first is one
  std::vector<std::map<std::string, Error>> all; ///< by factor
  double peak = 0., peak_reference = 0.;
};
} // namespace stockwork
