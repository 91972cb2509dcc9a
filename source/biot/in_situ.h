#pragma once

#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/point.h>
#include <deal.II/base/symmetric_tensor.h>

#include "stockwork/exchange/scene.h"
#include "stockwork/rock/rock.h"

#include <optional>
#include <string>
#include <vector>

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

  /// Total stress in three dimensions, tension positive [Pa]. Where the case has two and the deck
  /// says nothing of the stress across the plane, it is that of plane strain: nu (s_xx + s_yy) of
  /// Biot's effective stress.
  dealii::SymmetricTensor<2, 3> tensor(const dealii::Point<dim> &point,
                                       const RockProperties &rock) const;

  /// Pore pressure [Pa].
  double pore_pressure(const dealii::Point<dim> &point) const;

  /// The state must be in equilibrium, and hold cracks that fluid is to fill closed.
  /// @param rock_density [kg/m^3], of which the gradient of the stress is the weight; zero: unknown
  /// @param fluid_filled cracks whose fluid pressure is computed
  /// @param warnings gets what is unusual
  /// @throws EntryError
  void check(dealii::ParameterHandler &prm,
             double rock_density,
             const std::vector<InitialCrack<dim>> &fluid_filled,
             std::vector<std::string> &warnings) const;

  bool has_gradient() const
  {
    return stress_gradient.norm() > 0. || pressure_gradient != 0.;
  }

  bool is_zero() const
  {
    return stress_0.norm() == 0. && stress_gradient.norm() == 0. && pressure_0 == 0. &&
           pressure_gradient == 0.;
  }

private:
  dealii::SymmetricTensor<2, dim> stress_0, stress_gradient;
  std::optional<double> across_plane; ///< in two dimensions [Pa]
  double pressure_0 = 0., pressure_gradient = 0., datum = 0.;
};
} // namespace stockwork
