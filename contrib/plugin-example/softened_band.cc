// A fracture model in a shared library, as small as one can be: a band of crushed rock, too
// finely broken to follow single cracks, whose stiffness is a fraction of the intact rock's.
#include "stockwork/fracture/registry.h"

#include <deal.II/base/patterns.h>

namespace
{
template <int dim>
class SoftenedBand : public stockwork::FractureModel<dim>
{
public:
  SoftenedBand(const double low, const double high, const double factor)
    : low(low)
    , high(high)
    , factor(factor)
  {
  }

  stockwork::Requirements requirements() const override
  {
    stockwork::Requirements requirements;
    requirements.changes_bulk = true;
    return requirements;
  }

  void bulk_coefficients(const typename stockwork::FractureModel<dim>::CellIterator &,
                         const std::vector<dealii::Point<dim>> &points,
                         std::vector<stockwork::BulkCoefficients<dim>> &coefficients) const override
  {
    for (unsigned int q = 0; q < points.size(); ++q)
      if (points[q][dim - 1] > low && points[q][dim - 1] < high)
        coefficients[q].stiffness *= factor;
  }

private:
  const double low, high; ///< the band, along the last coordinate [m]
  const double factor;    ///< stiffness over that of the intact rock
};


template <int dim>
std::unique_ptr<stockwork::FractureModel<dim>> create(dealii::ParameterHandler &prm,
                                                      const stockwork::Scene<dim> &)
{
  return std::make_unique<SoftenedBand<dim>>(prm.get_double("From"), prm.get_double("To"),
                                             prm.get_double("Stiffness factor"));
}
} // namespace


// Called when the library is loaded.
extern "C" void stockwork_register(stockwork::FractureModelRegistry &registry)
{
  stockwork::FractureModelEntry entry;
  entry.description = "A band of crushed rock, softer than the rest.";
  entry.declare_parameters = [](dealii::ParameterHandler &prm)
  {
    using dealii::Patterns::Double;
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
