#include "verification/analytical/double_cantilever.h"

#include <cmath>

namespace stockwork::analytical
{
namespace
{
double bending_stiffness(const DoubleCantileverParameters &beam)
{
  return beam.modulus * std::pow(beam.arm_height, 3) / 12.;
}


// The zero of a function that is negative at `lower` and positive at `upper`.
template <typename Function>
double bisect(double lower, double upper, const Function &f)
{
  for (int i = 0; i < 100 && upper - lower > 1e-15 * upper; ++i)
  {
    const double middle = 0.5 * (lower + upper);
    (f(middle) < 0. ? lower : upper) = middle;
  }
  return 0.5 * (lower + upper);
}
} // namespace


BrittleDoubleCantilever::BrittleDoubleCantilever(const DoubleCantileverParameters &parameters)
  : parameters(parameters)
  , stiffness(bending_stiffness(parameters))
{
}


double BrittleDoubleCantilever::opening_at(const double crack_length) const
{
  // G = P^2 a^2 / (E I) = G_c and opening = 2 P a^3 / (3 E I).
  return 2. / 3. * crack_length * crack_length * std::sqrt(parameters.fracture_energy / stiffness);
}


double BrittleDoubleCantilever::opening_at_onset() const
{
  return opening_at(parameters.crack_length);
}


double BrittleDoubleCantilever::crack_length(const double opening) const
{
  if (opening <= opening_at_onset())
    return parameters.crack_length;
  return std::sqrt(1.5 * opening * std::sqrt(stiffness / parameters.fracture_energy));
}


double BrittleDoubleCantilever::force(const double opening) const
{
  return 1.5 * stiffness * opening / std::pow(crack_length(opening), 3);
}


CohesiveDoubleCantilever::CohesiveDoubleCantilever(
  const CohesiveDoubleCantileverParameters &parameters)
  : parameters(parameters)
  , stiffness(bending_stiffness(parameters.beam))
  , elastic_opening(parameters.strength / parameters.initial_stiffness)
  , final_opening(2. * parameters.beam.fracture_energy / parameters.strength)
  , elastic_wave_number(std::pow(0.5 * parameters.initial_stiffness / stiffness, 0.25))
  , softening_wave_number(
      std::pow(2. * parameters.strength / (final_opening - elastic_opening) / stiffness, 0.25))
{
}


// From the front of the softening layer, where the opening is elastic_opening. Ahead of it the
// deflection is exp(-b x) (cos(b x) elastic_opening/2 + sin(b x) slope_parameter).
CohesiveDoubleCantilever::Section
CohesiveDoubleCantilever::rear_of_softening(const double softening_length,
                                            const double slope_parameter) const
{
  const double b = elastic_wave_number, w = 0.5 * elastic_opening, c = slope_parameter;
  const Section front{w - 0.5 * final_opening, b * (w - c), -2. * b * b * c,
                      -2. * b * b * b * (c + w)};

  const double r = softening_wave_number, x = r * softening_length;
  const double cosh_part = 0.5 * (front.y + front.y2 / (r * r));
  const double cos_part = 0.5 * (front.y - front.y2 / (r * r));
  const double sinh_part = 0.5 * (front.y1 / r + front.y3 / (r * r * r));
  const double sin_part = 0.5 * (front.y1 / r - front.y3 / (r * r * r));
  const double even = cosh_part * std::cosh(x) + sinh_part * std::sinh(x);
  const double odd = cosh_part * std::sinh(x) + sinh_part * std::cosh(x);
  const double turning = cos_part * std::cos(x) + sin_part * std::sin(x);
  const double turned = -cos_part * std::sin(x) + sin_part * std::cos(x);
  return {even + turning, r * (odd + turned), r * r * (even - turning), r * r * r * (odd - turned)};
}


// The slope parameter is the one for which the arm's moment vanishes at the load point.
CohesiveDoubleCantilever::Section
CohesiveDoubleCantilever::equilibrium(const double traction_free_length,
                                      const double softening_length) const
{
  const auto moment = [&](const double slope_parameter)
  {
    const Section rear = rear_of_softening(softening_length, slope_parameter);
    return rear.y2 + traction_free_length * rear.y3;
  };
  // The moment is linear in it.
  const double scale = elastic_opening;
  const double without = moment(0.), slope = (moment(scale) - without) / scale;
  return rear_of_softening(softening_length, -without / slope);
}


CohesiveDoubleCantilever::State CohesiveDoubleCantilever::state(const double traction_free_length,
                                                                const double softening_length) const
{
  const double a = traction_free_length;
  const Section rear = equilibrium(a, softening_length);
  const double deflection = rear.y + 0.5 * final_opening + rear.y1 * a + rear.y2 * a * a / 3.;
  return {2. * deflection, stiffness * rear.y2 / a, a, softening_length};
}


double CohesiveDoubleCantilever::softening_length_in_growth(const double traction_free_length) const
{
  const auto remaining = [&](const double length)
  { return equilibrium(traction_free_length, length).y; };
  const double step = 0.05 / softening_wave_number;
  double upper = step;
  while (remaining(upper) < 0.)
    upper += step;
  return bisect(upper - step, upper, remaining);
}


CohesiveDoubleCantilever::State CohesiveDoubleCantilever::at(const double opening) const
{
  const double a0 = parameters.beam.crack_length;

  State elastic = state(a0, 0.);
  if (opening <= elastic.opening)
  {
    elastic.force *= opening / elastic.opening;
    elastic.opening = opening;
    return elastic;
  }

  const double limit = softening_length_in_growth(a0);
  if (opening <= state(a0, limit).opening)
    return state(
      a0,
      bisect(0., limit, [&](const double length) { return state(a0, length).opening - opening; }));

  const auto excess = [&](const double a)
  { return state(a, softening_length_in_growth(a)).opening - opening; };
  double upper = 1.2 * a0;
  while (excess(upper) < 0.)
    upper *= 1.2;
  const double a = bisect(a0, upper, excess);
  return state(a, softening_length_in_growth(a));
}
} // namespace stockwork::analytical
