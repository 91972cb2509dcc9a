#include "verification/error_record.h"

#include "exchange/cell_evaluator.h"

#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace stockwork
{
using namespace dealii;

template <int dim>
ErrorRecord<dim>::ErrorRecord(const ReferenceSolution<dim> &reference,
                              const double start_time,
                              const double end_time)
  : reference(reference)
  , start_time(start_time)
  , end_time(end_time)
  , factors(reference.wrong_factors)
{
  factors.insert(factors.begin(), 1.);
  all.resize(factors.size());
}


template <int dim>
void ErrorRecord<dim>::add(const std::string &quantity,
                           const double time,
                           const double dt,
                           const std::function<double(double factor)> &error)
{
  for (unsigned int k = 0; k < factors.size(); ++k)
  {
    Error &record = all[k][quantity];
    record.final = error(factors[k]);
    if (time >= start_time + 0.05 * (end_time - start_time))
    {
      record.integral += record.final * dt;
      record.duration += dt;
    }
  }
}


template <int dim>
bool ErrorRecord<dim>::compares(const double time) const
{
  constexpr double same_time = 1e-12;
  return reference.reaches(time) &&
         (reference.compares_every_step || time >= end_time * (1. - same_time));
}


namespace
{
/// Between the computed fields and the reference, integrated over cells.
template <int dim>
struct Difference
{
  const Function<dim> &field;
  const Unknowns &solution;

  /// Of the displacement, then of the pressure: squares of the difference d and of the reference r,
  /// and their product. For |computed - f r|^2 = |d + (1-f) r|^2.
  std::vector<double> squares = std::vector<double>(6, 0.);

  Difference(const Function<dim> &field, const Unknowns &solution)
    : field(field)
    , solution(solution)
    , expected(field.n_components)
  {
  }

  void add(const CellEvaluator<dim> &cell)
  {
    cell.displacement(solution, displacement);
    cell.pressure(solution, pressure);
    for (unsigned int q = 0; q < cell.n_points(); ++q)
    {
      field.vector_value(cell.point(q), expected);
      for (unsigned int c = 0; c < expected.size(); ++c)
      {
        const double difference = (c < dim ? displacement[q][c] : pressure[q]) - expected(c);
        const double weight = cell.weight(q);
        const unsigned int first = c < dim ? 0 : 3;
        squares[first] += difference * difference * weight;
        squares[first + 1] += expected(c) * expected(c) * weight;
        squares[first + 2] += difference * expected(c) * weight;
      }
    }
  }

private:
  std::vector<Tensor<1, dim>> displacement;
  std::vector<double> pressure;
  Vector<double> expected;
};
} // namespace


template <int dim>
void ErrorRecord<dim>::add_fields(const double time,
                                  const double dt,
                                  const Mapping<dim> &mapping,
                                  const DoFHandler<dim> &dof_handler,
                                  const Unknowns &solution,
                                  const Role &role)
{
  const auto field = reference.field();
  if (!field || !compares(time))
    return;
  field->set_time(time);
  const auto &fe = dof_handler.get_fe();
  const unsigned int n_components = fe.n_components();
  AssertDimension(field->n_components, n_components);
  const QGauss<dim> quadrature(fe.degree + 2);
  CellEvaluator<dim> evaluator(mapping, fe, quadrature,
                               update_values | update_quadrature_points | update_JxW_values);
  const auto point = reference.observation_point();
  double observed = -std::numeric_limits<double>::infinity();
  Difference<dim> difference(*field, solution);
  for (const auto &cell : dof_handler.active_cell_iterators())
    if (cell->is_locally_owned())
    {
      evaluator.reinit(cell, role(cell).cut);
      difference.add(evaluator);
      if (point && n_components > dim)
        for (const unsigned int v : cell->vertex_indices())
          if (cell->vertex(v).distance(*point) < 1e-8 * cell->diameter())
            observed = solution.bulk(cell->vertex_dof_index(v, dim));
    }
  const MPI_Comm communicator = dof_handler.get_communicator();
  std::vector<double> &squares = difference.squares;
  Utilities::MPI::sum(squares, communicator, squares);
  for (unsigned int k = 0; k < 2; ++k)
    if (const double *s = squares.data() + 3 * k; s[1] > 0.)
      add(k == 0 ? "displacement" : "pore_pressure", time, dt,
          [&](const double f)
          {
            const double square = s[0] + 2. * (1. - f) * s[2] + (1. - f) * (1. - f) * s[1];
            return std::sqrt(std::max(square, 0.) / s[1]) / std::abs(f);
          });

  if (point && n_components > dim)
  {
    peak = std::max(peak, Utilities::MPI::max(observed, communicator));
    peak_reference = std::max(peak_reference, field->value(*point, dim));
    add("peak_pore_pressure", time, dt,
        [&](const double f)
        { return std::abs(peak - f * peak_reference) / std::abs(f * peak_reference); });
  }
}


template <int dim>
void ErrorRecord<dim>::add_values(const double time,
                                  const double dt,
                                  const std::map<std::string, double> &values)
{
  if (!compares(time))
    return;
  const auto find = [&values](const std::string &column)
  {
    const auto position = values.find(column);
    return position != values.end() ? position->second : std::numeric_limits<double>::quiet_NaN();
  };
  for (const auto &[quantity, value] : reference.values(time))
  {
    const double expected = value;
    const double found = find(quantity);
    if (expected != 0. && std::isfinite(found))
      add(quantity, time, dt,
          [&](const double f) { return std::abs(found - f * expected) / std::abs(f * expected); });
  }
}


template class ErrorRecord<2>;
template class ErrorRecord<3>;
} // namespace stockwork
