// A flat, round crack in an infinite body under given net pressure (Sneddon 1946), or half or a
// quarter of it beside planes of symmetry.
#include "verification/analytical/line_crack.h"

#include "stockwork/base/error.h"

#include "verification/reference/problems.h"

#include <cmath>

namespace stockwork::reference
{
using namespace dealii;

namespace
{
class PennyCrackField : public Field<3>
{
public:
  PennyCrackField(const Disc<3> &disc,
                  const analytical::PennyCrack &crack,
                  const bool has_pore_pressure)
    : Field<3>(has_pore_pressure)
    , disc(disc)
    , crack(crack)
  {
  }

protected:
  void evaluate(const Point<3> &point, Tensor<1, 3> &displacement, double &pressure) const override
  {
    const Tensor<1, 3> from_centre = point - disc.centre;
    const double z = from_centre * disc.normal;
    const Tensor<1, 3> aside = from_centre - z * disc.normal;
    const double r = aside.norm();
    const auto u = crack.displacement(r, z);
    displacement = u[1] * disc.normal;
    if (r > 0.)
      displacement += u[0] / r * aside;
    pressure = 0.;
  }

private:
  Disc<3> disc;
  analytical::PennyCrack crack;
};


class PennyCrackReference : public ReferenceSolution<3>
{
public:
  PennyCrackReference(const Disc<3> &disc,
                      const analytical::PennyCrackParameters &parameters,
                      const double share,
                      const bool has_pore_pressure)
    : crack(parameters)
    , area(numbers::PI * disc.radius * disc.radius)
    , share(share)
    , solution(std::make_shared<PennyCrackField>(disc, crack, has_pore_pressure))
  {
  }

  std::string name() const override
  {
    return "Penny-shaped crack in an infinite body (Sneddon 1946)";
  }

  std::shared_ptr<Function<3>> field() const override
  {
    return solution;
  }

  std::map<std::string, double> values(double) const override
  {
    return {{"fracture_volume", share * crack.volume()}, {"equivalent_length", share * area}};
  }

private:
  analytical::PennyCrack crack;
  double area, share;
  std::shared_ptr<PennyCrackField> solution;
};
} // namespace


double share_of_disc(const ReferenceInput<3> &input)
{
  if (input.discs.empty())
    throw InputError("The reference solution of a round crack needs an initial crack, a disc.");
  const Disc<3> &disc = input.discs[0];
  const double small = 1e-8 * (input.upper - input.lower).norm();
  double share = 1.;
  for (unsigned int d = 0; d < 3; ++d)
    for (const double wall : {input.lower[d], input.upper[d]})
      if (std::abs(disc.centre[d] - wall) < small)
      {
        share *= 0.5;
        if (std::abs(disc.normal[d]) > 1e-8)
          throw InputError("The reference solution of a round crack is for planes of symmetry "
                           "that cut the crack at right angles.");
      }
  return share;
}


Made<3> make_penny_crack(const ParameterHandler &, const ReferenceInput<3> &input)
{
  const double share = share_of_disc(input);
  if (!std::isfinite(input.crack_pressure))
    throw InputError("The reference solution of a pressurised crack needs its pressure given, "
                     "'Cracks/Fluid pressure'.");
  if (input.layered || input.has_stress_gradient || input.discs.size() > 1)
    throw InputError("The reference solution of a round crack is for one crack, rock without "
                     "regions and in-situ stress without a gradient.");
  const RockProperties &rock = input.rock.main();
  const Disc<3> &disc = input.discs[0];
  return std::make_unique<PennyCrackReference>(
    disc,
    analytical::PennyCrackParameters{rock.young_modulus, rock.poisson_ratio, disc.radius,
                                     input.crack_pressure},
    share, input.has_pore_pressure);
}
} // namespace stockwork::reference
