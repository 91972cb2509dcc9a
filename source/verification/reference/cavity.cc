#include "stockwork/base/error.h"
#include "stockwork/base/quantity.h"

#include "rock/laws.h"
#include "rock/mohr_coulomb/law.h"
#include "verification/analytical/mohr_coulomb_cavity.h"
#include "verification/reference/perfectly_plastic.h"
#include "verification/reference/problems.h"

namespace stockwork::reference
{
using namespace dealii;

namespace
{
template <int dim>
class CavityField : public Field<dim>
{
public:
  CavityField(const analytical::MohrCoulombCavity::Parameters &parameters,
              const std::function<double(double)> &wall_pressure)
    : Field<dim>(false)
    , cavity(parameters)
    , wall_pressure(wall_pressure)
  {
  }

  void set_time(const double time) override
  {
    Function<dim>::set_time(time);
    cavity.set_wall_pressure(wall_pressure(time));
  }

  analytical::MohrCoulombCavity cavity;

protected:
  void
  evaluate(const Point<dim> &point, Tensor<1, dim> &displacement, double &pressure) const override
  {
    const double r = point.norm();
    displacement = cavity.displacement(r) / r * point;
    pressure = 0.;
  }

private:
  std::function<double(double)> wall_pressure;
};


template <int dim>
class CavityReference : public ReferenceSolution<dim>
{
public:
  CavityReference(const analytical::MohrCoulombCavity::Parameters &parameters,
                  const std::function<double(double)> &wall_pressure)
    : solution(std::make_shared<CavityField<dim>>(parameters, wall_pressure))
    , radius(parameters.radius)
  {
  }

  bool is_of_yielding_rock() const override
  {
    return true;
  }

  std::string name() const override
  {
    return dim == 2 ? "borehole in Mohr-Coulomb rock" : "spherical cavity in Mohr-Coulomb rock";
  }

  std::shared_ptr<Function<dim>> field() const override
  {
    return solution;
  }

  std::map<std::string, double> values(const double time) const override
  {
    solution->set_time(time);
    return {{"plastic_radius", solution->cavity.plastic_radius()},
            {"wall_displacement", solution->cavity.displacement(radius)}};
  }

  std::optional<Point<dim>> place_of_displacement() const override
  {
    Point<dim> place;
    place[0] = radius;
    return place;
  }

  void add_derived(std::map<std::string, double> &values) const override
  {
    // Of the quarter ring, or the octant of a shell; along the x axis the displacement is its first
    // component.
    const double yielded = values["yielded_volume"] / numbers::PI;
    values["plastic_radius"] = dim == 2 ? std::sqrt(radius * radius + 4. * yielded)
                                        : std::cbrt(radius * radius * radius + 6. * yielded);
    values["wall_displacement"] = values["displacement_x"];
  }

private:
  std::shared_ptr<CavityField<dim>> solution;
  double radius;
};
} // namespace


template <int dim>
Made<dim> make_cavity(const ParameterHandler &, const ReferenceInput<dim> &input)
{
  const std::string name = dim == 2 ? "borehole" : "cavity", quoted = "'" + name + "'";
  const auto *law = dynamic_cast<const mohr_coulomb::MohrCoulomb *>(input.law);
  if (law == nullptr)
    throw InputError(quoted + " is of rock with 'Rock/Law = mohr coulomb'");
  require_perfectly_plastic(law->surface(), name);
  if (!(input.hole_radius > 0.))
    throw InputError(quoted +
                     " is in a 'Mesh/Shape = " + (dim == 2 ? "quarter ring'" : "octant of shell'"));
  if (input.has_pore_pressure)
    throw InputError(quoted + " knows no pore pressure: 'Rock/Bulk model = elastic'");
  if (input.layered || input.has_stress_gradient)
    throw InputError(quoted + " is in uniform rock and stress");
  const SymmetricTensor<2, 3> stress = input.in_situ_stress;
  const double mean = trace(stress) / 3.;
  if (!(deviator(stress).norm() <= 1e-9 * std::abs(mean)) || !(mean < 0.))
    throw InputError(quoted + " is in compression that is the same in all directions" +
                     (dim == 2 ? ", also 'In situ/Stress across the plane'" : ""));
  const RockProperties &rock = input.rock.main();
  const mohr_coulomb::Strength &strength = law->surface();
  const analytical::MohrCoulombCavity::Parameters parameters{
    rock.young_modulus,      rock.poisson_ratio,
    strength.cohesion,       strength.friction_angle,
    strength.dilation_angle, -mean - input.in_situ_pressure,
    input.hole_radius,       dim - 1};
  // Loads are over in situ; a pull on the wall takes pressure from it.
  const auto wall_pressure = [parameters, traction = input.normal_traction](const double time)
  { return parameters.in_situ - traction("wall", time); };
  double last = wall_pressure(input.start_time), sense = 0.;
  for (unsigned int i = 1; i <= 100; ++i)
  {
    const double now =
      wall_pressure(input.start_time + 0.01 * i * (input.end_time - input.start_time));
    if (now < -1e-9 * parameters.in_situ)
      throw InputError(
        quoted + " is of a wall that is pressed, by no less than the pore pressure; "
                 "the normal traction on 'wall' pulls by more than the in-situ stress allows");
    if ((now - last) * sense < 0.)
      throw InputError(quoted + " is of a wall pressure that only falls or only rises; the normal "
                                "traction on 'wall' turns back");
    sense = now != last ? now - last : sense;
    last = now;
  }
  return std::make_unique<CavityReference<dim>>(parameters, wall_pressure);
}


template Made<2> make_cavity(const ParameterHandler &, const ReferenceInput<2> &);
template Made<3> make_cavity(const ParameterHandler &, const ReferenceInput<3> &);
} // namespace stockwork::reference
