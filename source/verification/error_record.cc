#include "verification/error_record.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/numerics/vector_tools.h>

#include <cmath>

namespace stockwork
{
using namespace dealii;

template <int dim>
ErrorRecord<dim>::ErrorRecord(const ReferenceSolution<dim> &reference,
                              const double                  start_time,
                              const double                  end_time)
  : reference(reference)
  , start_time(start_time)
  , end_time(end_time)
{}


template <int dim>
void
ErrorRecord<dim>::add(const std::string &quantity,
                      const double       time,
                      const double       dt,
                      const double       error)
{
  Error &record = all[quantity];
  record.final  = error;
  if (time >= start_time + 0.05 * (end_time - start_time))
    {
      record.integral += error * dt;
      record.duration += dt;
    }
}


template <int dim>
void
ErrorRecord<dim>::add_fields(const double                              time,
                             const double                              dt,
                             const Mapping<dim>                       &mapping,
                             const DoFHandler<dim>                    &dof_handler,
                             const TrilinosWrappers::MPI::BlockVector &solution)
{
  const auto field = reference.field();
  if (!field)
    return;
  field->set_time(time);
  const unsigned int n_components = dof_handler.get_fe().n_components();
  const QGauss<dim>  quadrature(dof_handler.get_fe().degree + 2);
  Vector<double>     per_cell(dof_handler.get_triangulation().n_active_cells());

  auto zero = solution;
  zero      = 0.;
  const auto norm = [&](const auto &vector, const ComponentSelectFunction<dim> &selected) {
    VectorTools::integrate_difference(
      mapping, dof_handler, vector, *field, per_cell, quadrature, VectorTools::L2_norm, &selected);
    return VectorTools::compute_global_error(dof_handler.get_triangulation(),
                                             per_cell,
                                             VectorTools::L2_norm);
  };
  const auto compare = [&](const std::string &name, const ComponentSelectFunction<dim> &selected) {
    const double size = norm(zero, selected);
    if (size > 0.)
      add(name, time, dt, norm(solution, selected) / size);
  };
  compare("displacement",
          ComponentSelectFunction<dim>(std::make_pair(0u, static_cast<unsigned int>(dim)),
                                       n_components));
  if (n_components > dim)
    compare("pore_pressure", ComponentSelectFunction<dim>(dim, n_components));
}


template <int dim>
void
ErrorRecord<dim>::add_values(const double                         time,
                             const double                         dt,
                             const std::map<std::string, double> &values)
{
  for (const auto &[quantity, expected] : reference.values(time))
    {
      const auto position = values.find(quantity);
      if (position != values.end() && expected != 0. && std::isfinite(position->second))
        add(quantity, time, dt, std::abs(position->second - expected) / std::abs(expected));
    }
}


template class ErrorRecord<2>;
template class ErrorRecord<3>;
} // namespace stockwork
