// Intact rock: the model that does nothing, with the interface's defaults.
#include "stockwork/fracture/registry.h"

namespace stockwork
{
namespace none
{
void register_model(FractureModelRegistry &registry);

void register_model(FractureModelRegistry &registry)
{
  FractureModelEntry entry;
  entry.description = "Intact rock without any fracture.";
  entry.create_2d = [](dealii::ParameterHandler &, const Scene<2> &)
  { return std::make_unique<FractureModel<2>>(); };
  entry.create_3d = [](dealii::ParameterHandler &, const Scene<3> &)
  { return std::make_unique<FractureModel<3>>(); };
  registry.add("none", entry);
}
} // namespace none
} // namespace stockwork
