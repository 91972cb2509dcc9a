// Two beams along x, joined by a cohesive layer beyond a crack that starts at the left; their ends
// are moved apart by equal displacements.
#include "verification/analytical/double_cantilever.h"

#include "stockwork/base/error.h"
#include "stockwork/base/quantity.h"

#include "verification/reference/problems.h"

#include <cmath>

namespace stockwork::reference
{
using namespace dealii;

namespace
{
class DoubleCantileverReference : public ReferenceSolution<2>
{
public:
  DoubleCantileverReference(const analytical::CohesiveDoubleCantileverParameters &parameters,
                            const std::function<double(double)> &displacement,
                            const double end_time)
    : beams(parameters)
    , displacement(displacement)
  {
    // The greatest load, and what has been dissipated: the layer unloads to the origin and the
    // beams are elastic, so that half the load times the opening is stored.
    const unsigned int n = 400;
    const double end = 2. * displacement(end_time);
    double work = 0.;
    openings.push_back(0.);
    loads.push_back(0.);
    dissipated.push_back(0.);
    for (unsigned int i = 1; i <= n; ++i)
    {
      openings.push_back(end * i / n);
      loads.push_back(beams.at(openings.back()).force);
      work += 0.5 * (loads[i] + loads[i - 1]) * (openings[i] - openings[i - 1]);
      dissipated.push_back(work - 0.5 * loads[i] * openings[i]);
    }
  }

  std::string name() const override
  {
    return "Double cantilever beam with a bilinear cohesive layer (Euler-Bernoulli)";
  }

  std::map<std::string, double> values(const double time) const override
  {
    const double opening = 2. * displacement(time);
    if (opening <= 0.)
      return {};
    const double place = opening / openings.back() * (openings.size() - 1.);
    const unsigned int i = std::min(static_cast<std::size_t>(place), openings.size() - 2);
    const double share = place - i;
    double peak = 0.;
    for (unsigned int k = 0; k <= i; ++k)
      peak = std::max(peak, loads[k]);
    const double force = beams.at(opening).force;
    const double energy = (1. - share) * dissipated[i] + share * dissipated[i + 1];
    // Both ends move by half the opening, so that their force does twice the work.
    std::map<std::string, double> result{{"load", 2. * force},
                                         {"peak_load", 2. * std::max(peak, force)}};
    if (energy > 0.01 * dissipated.back()) // else any error is a large one
      result["dissipated_energy"] = energy;
    return result;
  }

private:
  analytical::CohesiveDoubleCantilever beams;
  std::function<double(double)> displacement;
  std::vector<double> openings, loads, dissipated;
};
} // namespace


Made<2> make_double_cantilever(const ParameterHandler &prm, const ReferenceInput<2> &input)
{
  if (input.cracks.size() != 1)
    throw InputError("The reference solution of the double cantilever needs one initial crack.");
  const RockProperties &rock = input.rock.main();
  if (!(rock.tensile_strength > 0.) || !(rock.energy_release_rate > 0.))
    throw InputError("The reference solution of the double cantilever needs the rock's tensile "
                     "strength and critical energy release rate.");
  if (!(input.maximum_displacement(input.end_time) > 0.))
    throw InputError("The reference solution of the double cantilever needs ends that are moved "
                     "apart, 'Boundary conditions/Displacement y'.");
  const double share = get_quantity(prm, "Elastic share", dimension::number);
  const double strength = rock.tensile_strength, energy = rock.energy_release_rate;
  const double tip = std::max(input.cracks[0].front()[0], input.cracks[0].back()[0]);
  return std::make_unique<DoubleCantileverReference>(
    analytical::CohesiveDoubleCantileverParameters{
      {rock.plane_modulus(), 0.5 * (input.upper[1] - input.lower[1]), tip - input.lower[0], energy},
      strength,
      strength * strength / (share * 2. * energy)},
    input.maximum_displacement, input.end_time);
}
} // namespace stockwork::reference
