#include "verification/analytical/kgd_leak_off.h"

#include "verification/analytical/constants.h"

#include <algorithm>
#include <cmath>

namespace stockwork::analytical
{
namespace
{
/// exp(S^2) erfc(S) + 2 S/sqrt(pi) - 1.
double carter_function(const double S)
{
  if (S < 1e-3) // where three numbers cancel
    return S * S * (1. - 4. * S / (3. * std::sqrt(pi)));
  // exp overflows; the second term of the asymptotic series is below 1e-3 of the first
  const double scaled_erfc = S > 20. ? 1. / (S * std::sqrt(pi)) : std::exp(S * S) * std::erfc(S);
  return scaled_erfc + 2. * S / std::sqrt(pi) - 1.;
}
} // namespace


double
carter_half_length(const double rate, const double width, const double coefficient, const double t)
{
  if (coefficient == 0.)
    return rate * t / (2. * width);
  if (width == 0.)
    return rate * std::sqrt(t) / (2. * pi * coefficient);
  const double S = 2. * coefficient * std::sqrt(pi * t) / width;
  return rate * width / (8. * pi * coefficient * coefficient) * carter_function(S);
}


LeakingFracture
leaking_kgd(const KgdParameters &parameters, const LeakOffCoefficient &leak_off, const double t)
{
  const Kgd impermeable(parameters);
  const double longest = impermeable.half_length(t);
  // The impermeable fracture was so long at this time; its length grows as t^(2/3).
  const auto time_of = [&](const double length) { return t * std::pow(length / longest, 1.5); };
  const auto width_at = [&](const double length)
  { return parameters.rate * time_of(length) / (2. * length); };
  const auto carter_length = [&](const double length)
  {
    const double C =
      leak_off.at_closure + leak_off.per_net_pressure * impermeable.inlet_pressure(time_of(length));
    return carter_half_length(parameters.rate, width_at(length), std::max(C, 0.), t);
  };

  // A longer fracture is wider, and by Carter shorter: one root.
  double low = std::log(1e-9 * longest), high = std::log(longest);
  for (unsigned int i = 0; i < 60; ++i)
  {
    const double middle = 0.5 * (low + high);
    (carter_length(std::exp(middle)) > std::exp(middle) ? low : high) = middle;
  }
  const double length = std::exp(0.5 * (low + high));
  return {length, time_of(length) / t};
}
} // namespace stockwork::analytical
