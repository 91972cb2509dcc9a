// Intact rock: the model that does nothing.
#include "stockwork/fracture/registry.h"

namespace stockwork
{
namespace none
{
void register_model(FractureModelRegistry &registry);

namespace
{
template <int dim>
class IntactRock : public FractureModel<dim>
{
public:
  Requirements requirements() const override
  {
    Requirements requirements;
    requirements.has_fracture = false;
    requirements.random_rock = true;
    return requirements;
  }
};
} // namespace

void register_model(FractureModelRegistry &registry)
{
  FractureModelEntry entry;
  entry.description = "Intact rock without any fracture.";
  entry.create_2d = [](dealii::ParameterHandler &, const Scene<2> &)
  { return std::make_unique<IntactRock<2>>(); };
  entry.create_3d = [](dealii::ParameterHandler &, const Scene<3> &)
  { return std::make_unique<IntactRock<3>>(); };
  registry.add("none", entry);
}
} // namespace none
} // namespace stockwork
