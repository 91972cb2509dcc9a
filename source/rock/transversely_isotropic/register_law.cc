// Linear rock in layers: one plane in which all directions are alike, and its normal.
#include "stockwork/rock/linear_law.h"
#include "stockwork/rock/registry.h"

#include "stockwork/base/error.h"
#include "stockwork/base/quantity.h"

#include <deal.II/lac/full_matrix.h>

#include <cmath>

namespace stockwork
{
namespace transversely_isotropic
{
using namespace dealii;

void register_law(RockLawRegistry &registry);

namespace
{
void declare_parameters(ParameterHandler &prm)
{
  prm.declare_entry("Young modulus along", "", Quantity(dimension::stress, Range::positive(), ""),
                    "E of stress along the layers, drained. Required.");
  prm.declare_entry("Young modulus across", "", Quantity(dimension::stress, Range::positive(), ""),
                    "E' of stress across the layers, drained. Required.");
  prm.declare_entry("Poisson ratio along", "",
                    Quantity(dimension::number, Range::open(-1., 1.), ""),
                    "nu: stress along the layers, contraction along them too. Required.");
  prm.declare_entry("Poisson ratio across", "", Quantity(dimension::number, Range::finite(), ""),
                    "nu': stress across the layers, contraction along them. Required; (1 - nu) E' "
                    "> 2 nu'^2 E.");
  prm.declare_entry("Shear modulus across", "", Quantity(dimension::stress, Range::positive(), ""),
                    "G' of shear in a plane with the normal of the layers. Required.");
}


struct Constants
{
  double along, across;             ///< E, E' [Pa]
  double ratio_along, ratio_across; ///< nu, nu'
  double shear;                     ///< G' [Pa]
};


Constants parse(const ParameterHandler &prm, const std::string &path)
{
  const auto get =
    [&](const std::string &entry, const Dimension &dimension, const std::string &allowed)
  {
    const auto value = get_optional_quantity(prm, entry, dimension);
    if (!value)
      throw EntryError(path + "/" + entry, "", allowed);
    return *value;
  };
  const std::string modulus = "a stress > 0 Pa, such as '20 GPa'";
  const Constants c{get("Young modulus along", dimension::stress, modulus),
                    get("Young modulus across", dimension::stress, modulus),
                    get("Poisson ratio along", dimension::number, "a number, such as '0.2'"),
                    get("Poisson ratio across", dimension::number, "a number, such as '0.2'"),
                    get("Shear modulus across", dimension::stress, modulus)};
  // Beyond, what is left of the weaker directions is rounding.
  constexpr double most = 1e4;
  for (const auto &[entry, value] : {std::make_pair("Young modulus across", c.across),
                                     std::make_pair("Shear modulus across", c.shear)})
    if (value > most * c.along || value * most < c.along)
      throw EntryError(path + "/" + entry, prm.get(entry),
                       "a stress within a factor of 10000 of 'Young modulus along'");
  // Otherwise some deformation would set energy free.
  if ((1. - c.ratio_along) * c.across <= 2. * c.ratio_across * c.ratio_across * c.along)
    throw EntryError(path + "/Poisson ratio across", prm.get("Poisson ratio across"),
                     "a number below " +
                       std::to_string(std::sqrt(0.5 * (1. - c.ratio_along) * c.across / c.along)) +
                       " in size: (1 - nu) E' > 2 nu'^2 E");
  return c;
}


/// In axes of the rock, with the normal of the layers along the last.
SymmetricTensor<4, 3> in_axes_of_rock(const Constants &c)
{
  FullMatrix<double> normal(3, 3); // compliance of the normal stresses
  normal(0, 0) = normal(1, 1) = 1. / c.along;
  normal(0, 1) = normal(1, 0) = -c.ratio_along / c.along;
  normal(0, 2) = normal(1, 2) = normal(2, 0) = normal(2, 1) = -c.ratio_across / c.across;
  normal(2, 2) = 1. / c.across;
  normal.gauss_jordan();
  SymmetricTensor<4, 3> stiffness;
  for (unsigned int i = 0; i < 3; ++i)
    for (unsigned int j = 0; j < 3; ++j)
      stiffness[i][i][j][j] = normal(i, j);
  stiffness[0][1][0][1] = 0.5 * c.along / (1. + c.ratio_along);
  stiffness[0][2][0][2] = stiffness[1][2][1][2] = c.shear;
  return stiffness;
}


/// Rows: axes of the rock, the last of which is the normal.
Tensor<2, 3> frame_of(const Tensor<1, 3> &normal)
{
  unsigned int least = 0; // any direction that is not the normal's
  for (unsigned int d = 1; d < 3; ++d)
    if (std::abs(normal[d]) < std::abs(normal[least]))
      least = d;
  Tensor<1, 3> other;
  other[least] = 1.;
  Tensor<2, 3> frame;
  frame[0] = cross_product_3d(other, normal);
  frame[0] /= frame[0].norm();
  frame[1] = cross_product_3d(normal, frame[0]);
  frame[2] = normal;
  return frame;
}


SymmetricTensor<4, 3>
stiffness(const ParameterHandler &prm, const std::string &path, const RockProperties &properties)
{
  const SymmetricTensor<4, 3> own = in_axes_of_rock(parse(prm, path));
  if (properties.layer_normal.norm() == 0.)
    throw EntryError("Rock/Normal of the layers", "",
                     "a direction, such as '0, 1', with the law 'transversely isotropic'");
  const Tensor<2, 3> frame = frame_of(properties.layer_normal);
  SymmetricTensor<4, 3> turned;
  for (unsigned int i = 0; i < 3; ++i)
    for (unsigned int j = i; j < 3; ++j)
    {
      // What a unit strain of these components meets: C : e in the rock's axes, turned back.
      SymmetricTensor<2, 3> strain;
      strain[i][j] = i == j ? 1. : 0.5;
      const Tensor<2, 3> there = frame * Tensor<2, 3>(strain) * transpose(frame);
      const Tensor<2, 3> stress = transpose(frame) * Tensor<2, 3>(own * symmetrize(there)) * frame;
      for (unsigned int k = 0; k < 3; ++k)
        for (unsigned int l = k; l < 3; ++l)
          turned[k][l][i][j] = stress[k][l];
    }
  return turned;
}
} // namespace


void register_law(RockLawRegistry &registry)
{
  RockLawEntry entry;
  entry.description = "Linear, in layers: five constants and 'Rock/Normal of the layers'.";
  entry.declare_parameters = declare_parameters;
  entry.stiffness = stiffness;
  entry.create = [](const ParameterHandler &, const std::string &, const RockProperties &rock)
  { return std::make_unique<LinearRockLaw>(rock); };
  registry.add("transversely isotropic", entry);
}
} // namespace transversely_isotropic
} // namespace stockwork
