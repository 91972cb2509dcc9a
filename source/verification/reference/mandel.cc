// Mandel's problem in the quarter x, y >= 0 of the block.
#include "verification/analytical/mandel.h"

#include "stockwork/base/error.h"
#include "stockwork/base/quantity.h"
#include "stockwork/rock/linear_stiffness.h"

#include "verification/reference/problems.h"

#include <algorithm>
#include <cmath>

namespace stockwork::reference
{
using namespace dealii;

namespace
{
class MandelField : public Field<2>
{
public:
  explicit MandelField(const analytical::MandelParameters &parameters)
    : Field<2>(true)
    , mandel(parameters)
    , now(mandel.at(0.))
  {
  }

  void set_time(const double time) override
  {
    if (time != get_time())
      now = mandel.at(time);
    Function<2>::set_time(time);
  }

protected:
  void evaluate(const Point<2> &point, Tensor<1, 2> &displacement, double &pressure) const override
  {
    displacement[0] = now.displacement_x(point[0]);
    displacement[1] = now.displacement_y(point[1]);
    pressure = now.pressure(point[0]);
  }

private:
  analytical::Mandel mandel;
  analytical::MandelAtTime now;
};


class MandelReference : public ReferenceSolution<2>
{
public:
  MandelReference(const analytical::MandelParameters &parameters, const bool is_layered)
    : solution(std::make_shared<MandelField>(parameters))
    , is_layered(is_layered)
  {
  }

  std::string name() const override
  {
    return is_layered ? "Mandel's problem in layered rock (Abousleiman et al. 1996)"
                      : "Mandel (1953)";
  }

  std::shared_ptr<Function<2>> field() const override
  {
    return solution;
  }

  std::optional<Point<2>> observation_point() const override
  {
    return Point<2>();
  }

private:
  std::shared_ptr<MandelField> solution;
  bool is_layered;
};


/// @throws InputError unless the rock is symmetric about the axes of the block
analytical::BlockRock block_rock(const RockProperties &rock, const Fluid &fluid)
{
  const SymmetricTensor<4, 2> c = LinearStiffness<2>(rock).tensor();
  const SymmetricTensor<2, 2> k = rock.permeability_tensor<2>();
  constexpr double rounding = 1e-9;
  if (std::max(std::abs(c[0][0][0][1]), std::abs(c[1][1][0][1])) > rounding * c[0][0][0][0] ||
      std::abs(k[0][1]) > rounding * k.norm())
    throw InputError("'mandel' is of layers along or across the plates: 'Rock/Normal of the "
                     "layers' along an axis");
  return {c[0][0][0][0],
          c[0][0][1][1],
          c[1][1][1][1],
          rock.biot_coefficient,
          rock.inverse_biot_modulus,
          k[0][0] / fluid.viscosity};
}
} // namespace


Made<2> make_mandel(const ParameterHandler &prm, const ReferenceInput<2> &input)
{
  if (prm.get("Load").empty())
    throw EntryError("Verification/Load", "", "a force per length, such as '1 MN/m'");
  const RockProperties &rock = input.rock.main();
  if (rock.plane_stress || input.layered)
    throw InputError("'mandel' is in plane strain, and all of one rock");
  return std::make_unique<MandelReference>(
    analytical::MandelParameters{block_rock(rock, input.rock.fluid()),
                                 input.upper[0] - input.lower[0], input.upper[1] - input.lower[1],
                                 get_quantity(prm, "Load", dimension::force_per_length)},
    rock.stiffness || !rock.has_isotropic_permeability());
}
} // namespace stockwork::reference
