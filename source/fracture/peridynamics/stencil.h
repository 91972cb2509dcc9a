#pragma once

#include <deal.II/base/tensor.h>

#include <array>
#include <vector>

namespace stockwork::peridynamics
{
/// How much of a neighbour's cell counts as inside the horizon.
enum class VolumeRule
{
  /// The area (volume) of the cell inside the disc (ball), cells centred outside included.
  exact,
  /// As exact, times 1 + a (sum_i n_i^4 - 3/(d+2)), n the bond's direction and a such that the
  /// lattice is isotropic. A few per cent; then quadratic displacement fields are exact, too.
  isotropic,
  /// All of the cell if its centre is inside.
  full,
  /// A share that falls linearly over the last cell, for cells centred inside: the usual rule of
  /// meshless codes, and the least accurate one.
  ramp
};

/// One bond of every site of a uniform lattice.
template <int dim>
struct StencilBond
{
  std::array<int, dim> offset; ///< of the neighbour, in lattice spacings
  double volume_fraction;      ///< share of the neighbour's cell that counts, beta

  double length() const; ///< in lattice spacings
  dealii::Tensor<1, dim> direction() const;
};

/// All bonds of a site whose horizon is @p m spacings, which is all there is to know about a
/// uniform lattice: sites differ in what is broken, not in their bonds.
///
/// Bonds are ordered. The first half is *forward*: the last non-zero component of the offset is
/// positive, so the neighbour lies at a greater z (y, x) and later in memory; bond i + n/2 is the
/// opposite of bond i, to the last digit. A loop over all sites and the first half sees each bond
/// once.
template <int dim>
std::vector<StencilBond<dim>> horizon_stencil(const unsigned int m, const VolumeRule rule);

/// Index of the same bond as seen from its other end, in a stencil of @p size bonds.
inline unsigned int opposite(const unsigned int bond, const unsigned int size)
{
  return bond < size / 2 ? bond + size / 2 : bond - size / 2;
}
} // namespace stockwork::peridynamics
