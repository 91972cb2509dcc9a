#pragma once

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/mapping.h>
#include <deal.II/lac/trilinos_parallel_block_vector.h>

#include "verification/reference_solution.h"

#include <map>
#include <string>

namespace stockwork
{
/// Collects the errors of a run against a reference solution: relative, at the end, and averaged
/// over time after the first 5 % of the run.
template <int dim>
class ErrorRecord
{
public:
  struct Error
  {
    double final    = 0.;
    double integral = 0.;
    double duration = 0.;

    double
    mean() const
    {
      return duration > 0. ? integral / duration : final;
    }

    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      archive &final &integral &duration;
    }
  };

  ErrorRecord(const ReferenceSolution<dim> &reference, double start_time, double end_time);

  /// Relative L2 errors of displacement and pore pressure at the end of a step. Collective.
  void
  add_fields(double                                            time,
             double                                            dt,
             const dealii::Mapping<dim>                       &mapping,
             const dealii::DoFHandler<dim>                    &dof_handler,
             const dealii::TrilinosWrappers::MPI::BlockVector &solution);

  /// Relative errors of scalars that both sides know.
  void
  add_values(double time, double dt, const std::map<std::string, double> &values);

  const std::map<std::string, Error> &
  errors() const
  {
    return all;
  }

  template <class Archive>
  void
  serialize(Archive &archive, const unsigned int)
  {
    archive &all;
  }

private:
  void
  add(const std::string &quantity, double time, double dt, double error);

  const ReferenceSolution<dim> &reference;
  double                        start_time, end_time;
  std::map<std::string, Error>  all;
};
} // namespace stockwork
