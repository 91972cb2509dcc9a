#pragma once

#include <deal.II/base/symmetric_tensor.h>

#include "stockwork/rock/rock.h"

namespace stockwork
{
/// Hooke's law of a rock in the dimensions of the run: plane strain or plane stress in two. The
/// one place where stress follows from strain in linear rock.
template <int dim>
class LinearStiffness
{
public:
  explicit LinearStiffness(const RockProperties &rock)
    : isotropic(!rock.stiffness)
  {
    if (isotropic)
    {
      lambda = rock.lame_lambda();
      mu = rock.shear_modulus();
    }
    else
      set_anisotropic(*rock.stiffness, rock.plane_stress);
  }

  bool is_isotropic() const
  {
    return isotropic;
  }

  /// Stress of a strain since in situ [Pa], without the pressure's part.
  dealii::SymmetricTensor<2, dim> stress(const dealii::SymmetricTensor<2, dim> &strain) const
  {
    if (!isotropic)
      return general * strain;
    dealii::SymmetricTensor<2, dim> result = 2. * mu * strain;
    const double mean = lambda * trace(strain);
    for (unsigned int d = 0; d < dim; ++d)
      result[d][d] += mean;
    return result;
  }

  dealii::SymmetricTensor<4, dim> tensor() const
  {
    if (!isotropic)
      return general;
    const auto identity = dealii::unit_symmetric_tensor<dim>();
    return lambda * outer_product(identity, identity) + 2. * mu * dealii::identity_tensor<dim>();
  }

  /// Mean stress per volumetric strain when all directions are strained alike; with two dimensions
  /// those in the plane [Pa]. lambda + 2 G / dim where isotropic.
  double bulk_modulus() const
  {
    return isotropic ? lambda + 2. * mu / dim : mean_bulk_modulus(general);
  }

  /// The shear modulus, in anisotropic rock its mean over all directions (Voigt) [Pa].
  double shear_modulus() const
  {
    return isotropic ? mu : mean_shear_modulus(general);
  }

  /// Of any stiffness: 1 : C : 1 / dim^2.
  static double mean_bulk_modulus(const dealii::SymmetricTensor<4, dim> &stiffness)
  {
    const auto identity = dealii::unit_symmetric_tensor<dim>();
    return (identity * (stiffness * identity)) / (dim * dim);
  }

  /// Of any stiffness: what is left of C_ijij without the part that changes the volume.
  static double mean_shear_modulus(const dealii::SymmetricTensor<4, dim> &stiffness)
  {
    double all = 0.;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < dim; ++j)
        all += stiffness[i][j][i][j];
    return (all - dim * mean_bulk_modulus(stiffness)) / (dim * (dim + 1.) - 2.);
  }

private:
  void set_anisotropic(const dealii::SymmetricTensor<4, 3> &stiffness, const bool plane_stress)
  {
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = i; j < dim; ++j)
        for (unsigned int k = 0; k < dim; ++k)
          for (unsigned int l = k; l < dim; ++l)
            general[i][j][k][l] =
              stiffness[i][j][k][l] -
              (plane_stress ? stiffness[i][j][2][2] * stiffness[2][2][k][l] / stiffness[2][2][2][2]
                            : 0.);
  }

  bool isotropic;
  double lambda = 0., mu = 0.;
  dealii::SymmetricTensor<4, dim> general;
};
} // namespace stockwork
