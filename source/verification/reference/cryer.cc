// Cryer's sphere (octant, 3-D) and de Leeuw's cylinder (quarter disc, 2-D): the surface is drained
// and loaded.
#include "verification/analytical/cryer.h"

#include "verification/reference/problems.h"

namespace stockwork::reference
{
using namespace dealii;

namespace
{
template <int dim>
class CryerField : public Field<dim>
{
public:
  explicit CryerField(const analytical::CryerParameters &parameters)
    : Field<dim>(true)
    , cryer(parameters)
    , now(cryer.at(0.))
  {
  }

  void set_time(const double time) override
  {
    if (time != this->get_time())
      now = cryer.at(time);
    Function<dim>::set_time(time);
  }

protected:
  void
  evaluate(const Point<dim> &point, Tensor<1, dim> &displacement, double &pressure) const override
  {
    const double r = point.norm();
    if (r > 0.)
      displacement = now.displacement(r) / r * point;
    pressure = now.pressure(r);
  }

private:
  analytical::Cryer cryer;
  analytical::CryerAtTime now;
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
