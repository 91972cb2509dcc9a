// Mandel's problem in the quarter x, y >= 0 of the block.
#include "verification/analytical/mandel.h"

#include "stockwork/base/error.h"
#include "stockwork/base/quantity.h"

#include "verification/reference/problems.h"

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
  explicit MandelReference(const analytical::MandelParameters &parameters)
    : solution(std::make_shared<MandelField>(parameters))
  {
  }

  std::string name() const override
  {
    return "Mandel (1953)";
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
};
} // namespace


Made<2> make_mandel(const ParameterHandler &prm, const ReferenceInput<2> &input)
{
  if (prm.get("Load").empty())
    throw EntryError("Verification/Load", "", "a force per length, such as '1 MN/m'");
  return std::make_unique<MandelReference>(analytical::MandelParameters{
    medium(input.rock), input.upper[0] - input.lower[0], input.upper[1] - input.lower[1],
    get_quantity(prm, "Load", dimension::force_per_length)});
}
} // namespace stockwork::reference
