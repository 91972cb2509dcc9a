// Isotropic linear rock, which the elements know by themselves: the constants in subsection Rock.
#include "stockwork/rock/registry.h"

#include <limits>

namespace stockwork
{
namespace elastic
{
void register_law(RockLawRegistry &registry);

namespace
{
class Elastic : public RockLaw
{
public:
  bool is_linear() const override
  {
    return true;
  }

  void evaluate(dealii::ArrayView<const RockState>, dealii::ArrayView<RockResponse>) const override
  {
  }

  double used(const RockState &) const override
  {
    return 0.;
  }

  double margin(const RockState &) const override
  {
    return std::numeric_limits<double>::infinity();
  }
};
} // namespace


void register_law(RockLawRegistry &registry)
{
  RockLawEntry entry;
  entry.description = "Isotropic and linear.";
  entry.create = [](const dealii::ParameterHandler &, const std::string &, const RockProperties &)
  { return std::make_unique<Elastic>(); };
  registry.add("elastic", entry);
}
} // namespace elastic
} // namespace stockwork
