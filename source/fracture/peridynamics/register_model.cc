#include "fracture/peridynamics/peridynamics.h"
#include "stockwork/fracture/registry.h"

namespace stockwork::peridynamics
{
void register_model(FractureModelRegistry &registry);

void register_model(FractureModelRegistry &registry)
{
  FractureModelEntry entry;
  entry.description = "Bonds between the vertices of uniform cells in a zone around the cracks "
                      "(peridynamics), finite elements elsewhere.";
  entry.declare_parameters = Parameters<2>::declare;
  entry.create_2d = [](dealii::ParameterHandler &prm, const Scene<2> &scene)
  { return std::make_unique<Peridynamics<2>>(Parameters<2>::parse(prm, scene), scene); };
  entry.create_3d = [](dealii::ParameterHandler &prm, const Scene<3> &scene)
  { return std::make_unique<Peridynamics<3>>(Parameters<3>::parse(prm, scene), scene); };
  registry.add("peridynamics", entry);
}
} // namespace stockwork::peridynamics
