// Cryer's sphere (octant, 3-D) and de Leeuw's cylinder (quarter disc, 2-D): the surface is drained
// and loaded.
#include "verification/analytical/cryer.h"

#include "verification/analytical/constants.h"
#include "verification/reference/problems.h"

#include <boost/math/interpolators/cardinal_cubic_b_spline.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace stockwork::reference
{
using namespace dealii;

namespace
{
/// The series at one time, tabulated over the radius: at early times it has 2000 terms, and errors
/// are formed at hundreds of thousands of points. Over s with r = R sin(pi s/2) the first
/// interval at the surface is 1e-6 R wide, a thousandth of the thinnest layer that the series can
/// represent; the relative error of the interpolation is below 1e-8.
class Table
{
public:
  Table(const analytical::CryerAtTime &solution, const double radius)
    : radius(radius)
  {
    std::vector<double> pressures, strains;
    for (unsigned int i = 0; i <= n_intervals; ++i)
    {
      // Not quite from the centre, where the displacement over r is its limit.
      const double r =
        std::max(radius * std::sin(0.5 * analytical::pi * i / n_intervals), 1e-6 * radius);
      pressures.push_back(solution.pressure(r));
      strains.push_back(solution.displacement(r) / r);
    }
    // Both ends are level: fields are even in r at the centre, and dr/ds = 0 at the surface.
    pressure_spline = Spline(pressures.begin(), pressures.end(), 0., 1. / n_intervals, 0., 0.);
    strain_spline = Spline(strains.begin(), strains.end(), 0., 1. / n_intervals, 0., 0.);
  }

  double pressure(const double r) const
  {
    return pressure_spline(place(r));
  }

  /// Radial displacement over r.
  double strain(const double r) const
  {
    return strain_spline(place(r));
  }

private:
  static constexpr unsigned int n_intervals = 1000;
  using Spline = boost::math::interpolators::cardinal_cubic_b_spline<double>;

  double place(const double r) const
  {
    return std::asin(std::min(r / radius, 1.)) * 2. / analytical::pi;
  }

  double radius;
  Spline pressure_spline, strain_spline;
};


template <int dim>
class CryerField : public Field<dim>
{
public:
  explicit CryerField(const analytical::CryerParameters &parameters)
    : Field<dim>(true)
    , cryer(parameters)
    , radius(parameters.radius)
    , now(cryer.at(0.), radius)
  {
  }

  void set_time(const double time) override
  {
    if (time != this->get_time())
      now = Table(cryer.at(time), radius);
    Function<dim>::set_time(time);
  }

protected:
  void
  evaluate(const Point<dim> &point, Tensor<1, dim> &displacement, double &pressure) const override
  {
    const double r = point.norm();
    displacement = now.strain(r) * point;
    pressure = now.pressure(r);
  }

private:
  analytical::Cryer cryer;
  double radius;
  Table now;
};


template <int dim>
class CryerReference : public ReferenceSolution<dim>
{
public:
  explicit CryerReference(const analytical::CryerParameters &parameters)
    : solution(std::make_shared<CryerField<dim>>(parameters))
  {
  }

  std::string name() const override
  {
    return dim == 2 ? "de Leeuw (1965)" : "Cryer (1963)";
  }

  std::shared_ptr<Function<dim>> field() const override
  {
    return solution;
  }

  std::optional<Point<dim>> observation_point() const override
  {
    return Point<dim>();
  }

private:
  std::shared_ptr<CryerField<dim>> solution;
};
} // namespace


template <int dim>
Made<dim> make_cryer(const ParameterHandler &, const ReferenceInput<dim> &input)
{
  using Shape = analytical::CryerParameters::Shape;
  return std::make_unique<CryerReference<dim>>(
    analytical::CryerParameters{dim == 2 ? Shape::cylinder : Shape::sphere, medium(input.rock),
                                input.upper[0], -input.normal_traction("surface", 0.)});
}


template Made<2> make_cryer<2>(const ParameterHandler &, const ReferenceInput<2> &);
template Made<3> make_cryer<3>(const ParameterHandler &, const ReferenceInput<3> &);
} // namespace stockwork::reference
