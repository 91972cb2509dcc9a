#pragma once

#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/point.h>
#include <deal.II/base/symmetric_tensor.h>

namespace stockwork
{
/// In-situ total stress and pore pressure. The unknowns are measured from this state, which is
/// taken to be in equilibrium; all of it acts where a fracture releases it.
///
/// Linear in the vertical coordinate (the last one): sigma(z) = sigma_0 + gradient (z - z_0).
template <int dim>
class InSitu
{
public:
  static void declare_parameters(dealii::ParameterHandler &prm);

  void parse_parameters(dealii::ParameterHandler &prm);

  /// Total stress, tension positive [Pa].
  dealii::SymmetricTensor<2, dim> stress(const dealii::Point<dim> &point) const;

  /// Pore pressure [Pa].
  double pore_pressure(const dealii::Point<dim> &point) const;

  bool is_zero() const
  {
    return stress_0.norm() == 0. && stress_gradient.norm() == 0. && pressure_0 == 0. &&
           pressure_gradient == 0.;
  }

private:
  dealii::SymmetricTensor<2, dim> stress_0, stress_gradient;
  double pressure_0 = 0., pressure_gradient = 0., datum = 0.;
};
} // namespace stockwork
