// Wells in the rock, far from its boundary: lines in plane strain, points in 3-D.
#include "verification/analytical/continuous_source.h"

#include "stockwork/base/error.h"
#include "stockwork/base/quantity.h"

#include "verification/reference/problems.h"

#include <algorithm>
#include <cmath>

namespace stockwork::reference
{
using namespace dealii;

namespace
{
template <int dim>
analytical::ContinuousSource unit_source(const Rock &rock)
{
  using Shape = analytical::ContinuousSource::Shape;
  return {dim == 2 ? Shape::line : Shape::point, medium(rock)};
}


/// Every change of a rate is a new source from its time on.
template <int dim>
class SourcesField : public Field<dim>
{
public:
  SourcesField(const Rock &rock, const std::vector<ReferenceSource<dim>> &wells)
    : Field<dim>(true)
    , unit(unit_source<dim>(rock))
    , wells(wells)
  {
  }

  /// At a distance of a well's only point, by all wells [Pa].
  double
  pressure_beside(const ReferenceSource<dim> &well, const double radius, const double t) const
  {
    double pressure = 0.;
    for (const ReferenceSource<dim> &other : wells)
      for_changes(other,
                  [&](const double start, const double rate)
                  {
                    const double r = std::max(radius, other.points[0].distance(well.points[0]));
                    pressure += rate * unit.pressure(r, t - start);
                  });
    return pressure;
  }

protected:
  void
  evaluate(const Point<dim> &point, Tensor<1, dim> &displacement, double &pressure) const override
  {
    for (const ReferenceSource<dim> &well : wells)
    {
      const Tensor<1, dim> from = point - well.points[0];
      const double r = std::max(from.norm(), 1e-12 * std::max(point.norm(), 1.));
      for_changes(well,
                  [&](const double start, const double rate)
                  {
                    const double t = this->get_time() - start;
                    pressure += rate * unit.pressure(r, t);
                    displacement += rate * unit.displacement(r, t) / r * from;
                  });
    }
  }

private:
  template <class Action>
  static void for_changes(const ReferenceSource<dim> &well, const Action &action)
  {
    double before = 0.;
    for (const auto &[time, rate] : well.rates)
    {
      action(time, rate - before);
      before = rate;
    }
  }

  analytical::ContinuousSource unit;
  std::vector<ReferenceSource<dim>> wells;
};


template <int dim>
class SourcesReference : public ReferenceSolution<dim>
{
public:
  explicit SourcesReference(const ReferenceInput<dim> &input)
    : solution(std::make_shared<SourcesField<dim>>(input.rock, input.sources))
    , wells(input.sources)
    , in_situ_pressure(input.in_situ_pressure)
  {
  }

  std::string name() const override
  {
    return dim == 2 ? "Theis (1935)" : "Rudnicki (1986)";
  }

  std::shared_ptr<Function<dim>> field() const override
  {
    return solution;
  }

  std::map<std::string, double> values(const double time) const override
  {
    std::map<std::string, double> result;
    for (const ReferenceSource<dim> &well : wells)
      if (well.borehole_radius > 0.)
        result["well_" + std::to_string(well.number) + "_borehole_pressure"] =
          in_situ_pressure + solution->pressure_beside(well, well.borehole_radius, time);
    return result;
  }

  /// A well whose pressure comes to its bound has another rate than the deck's.
  void check_bounds(const double end_time) const
  {
    for (const ReferenceSource<dim> &well : wells)
      for (std::size_t i = 0; i < well.rates.size() && well.borehole_radius > 0.; ++i)
      {
        const double end = i + 1 < well.rates.size() ? well.rates[i + 1].first : end_time;
        const double pressure =
          in_situ_pressure + solution->pressure_beside(well, well.borehole_radius, end);
        if (pressure < well.minimum_pressure)
          throw InputError("It is of wells whose rate is given: that of well " +
                           std::to_string(well.number) + " would come to " +
                           to_string(pressure, dimension::pressure) +
                           ", below its 'Minimum pressure'.");
      }
  }

private:
  std::shared_ptr<SourcesField<dim>> solution;
  std::vector<ReferenceSource<dim>> wells;
  double in_situ_pressure;
};
} // namespace


template <int dim>
Made<dim> make_sources(const ParameterHandler &, const ReferenceInput<dim> &input)
{
  if (input.sources.empty() || input.sources.size() != input.n_wells)
    throw InputError("It is of wells that open into the rock and whose rate is given: 'Wells/Well "
                     "1/Opens into = rock', 'Control = rate'.");
  const double extent = input.lower.distance(input.upper);
  for (const ReferenceSource<dim> &well : input.sources)
  {
    if (well.borehole_radius > 0. && well.borehole_radius < 1e-9 * extent)
      throw InputError("It is of boreholes of at least a billionth of the mesh: is the unit of "
                       "'Borehole radius' right?");
    if (well.rates.empty())
      throw InputError("It is of rates that are constant or in pieces.");
    if (well.points.size() > 1)
      throw InputError("It is of wells with one perforation each.");
    if (well.fraction != 1. && input.n_wells > 1)
      throw InputError("It is of one well, where planes of symmetry pass through it.");
  }
  if (input.layered || !input.cracks.empty() || input.rock.main().plane_stress)
    throw InputError("It is of uniform rock without cracks, in two dimensions in plane strain.");
  auto reference = std::make_unique<SourcesReference<dim>>(input);
  reference->check_bounds(input.end_time);
  return reference;
}


template Made<2> make_sources<2>(const ParameterHandler &, const ReferenceInput<2> &);
template Made<3> make_sources<3>(const ParameterHandler &, const ReferenceInput<3> &);
} // namespace stockwork::reference
