// Isotropic linear rock, which the elements know by themselves: the constants in subsection Rock.
#include "stockwork/rock/linear_law.h"
#include "stockwork/rock/registry.h"

namespace stockwork
{
namespace elastic
{
void register_law(RockLawRegistry &registry);

void register_law(RockLawRegistry &registry)
{
  RockLawEntry entry;
  entry.description = "Isotropic and linear.";
  entry.create = [](const dealii::ParameterHandler &, const std::string &,
                    const RockProperties &rock) { return std::make_unique<LinearRockLaw>(rock); };
  registry.add("elastic", entry);
}
} // namespace elastic
} // namespace stockwork
