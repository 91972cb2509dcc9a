// A fracture model in a shared library, as small as one can be: a band of crushed rock, too
// finely broken to follow single cracks, whose stiffness is a fraction of the intact rock's. It
// puts a law of its own in place of the rock's in the cells of the band.
#include "stockwork/fracture/registry.h"

#include <deal.II/base/patterns.h>

#include <vector>

namespace
{
using namespace dealii;
using namespace stockwork;

/// Softer than the rock that it has inside. What the stress is, the pressure's part aside, shrinks
/// by the factor, and with it the energy.
class CrushedRock : public RockLaw
{
public:
  CrushedRock(const RockLaw &intact, const double factor)
    : intact(intact)
    , factor(factor)
  {
  }

  void evaluate(ArrayView<const RockState> states, ArrayView<RockResponse> responses) const override
  {
    intact.evaluate(states, responses);
    for (unsigned int q = 0; q < states.size(); ++q)
    {
      RockResponse &response = responses[q];
      const SymmetricTensor<2, 3> lost =
        (1. - factor) * (response.stress_by_strain * states[q].strain);
      response.stress -= lost;
      response.energy -= 0.5 * (lost * states[q].strain);
      response.stress_by_strain *= factor;
    }
  }

  double used(const RockState &) const override
  {
    return 0.; // it has no strength to use up
  }

  double margin(const RockState &) const override
  {
    return 0.; // it is never what the elements know
  }

private:
  const RockLaw &intact;
  const double factor;
};


template <int dim>
class SoftenedBand : public FractureModel<dim>
{
public:
  SoftenedBand(const ParameterHandler &prm, const Scene<dim> &scene)
    : low(prm.get_double("From"))
    , high(prm.get_double("To"))
    , crushed(scene.rock_law(0), prm.get_double("Stiffness factor"))
  {
  }

  Requirements requirements() const override
  {
    Requirements requirements;
    // The law inside is that of the rock outside of regions.
    requirements.regional_rock = RegionalRock::none;
    requirements.law = &crushed;
    return requirements;
  }

  CellRole<dim> role(const typename FractureModel<dim>::CellIterator &cell) const override
  {
    CellRole<dim> role;
    const double height = cell->center()[dim - 1];
    if (height > low && height < high)
      role.law = &crushed;
    return role;
  }

private:
  const double low, high; ///< the band, along the last coordinate [m]
  const CrushedRock crushed;
};


template <int dim>
std::unique_ptr<SoftenedBand<dim>> create(ParameterHandler &prm, const Scene<dim> &scene)
{
  return std::make_unique<SoftenedBand<dim>>(prm, scene);
}
} // namespace


// Called when the library is loaded.
extern "C" void stockwork_register(FractureModelRegistry &registry)
{
  FractureModelEntry entry;
  entry.description = "A band of crushed rock, softer than the rest.";
  entry.declare_parameters = [](ParameterHandler &prm)
  {
    using Patterns::Double;
    prm.declare_entry("From", "-1e300", Double(),
                      "Begin of the band along the last coordinate [m]");
    prm.declare_entry("To", "1e300", Double(), "End of the band [m]");
    prm.declare_entry("Stiffness factor", "0.5", Double(1e-6, 1.),
                      "Stiffness of the crushed rock over that of the intact rock");
  };
  entry.create_2d = create<2>;
  entry.create_3d = create<3>;
  registry.add("softened_band", entry);
}
