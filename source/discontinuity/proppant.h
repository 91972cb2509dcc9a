#pragma once

#include "discontinuity/discontinuity.h"

#include <functional>
#include <vector>

namespace stockwork
{
/// To what proppant holds the faces of a piece apart [m]: a (1 - x^2)^(3/2) of the greatest, a,
/// with x from 0 in the middle of the crack as the deck gives it, or at its mouth on the boundary,
/// to 1 at its tips. With this power the faces close smoothly and the stress at the tips stays
/// finite (Barenblatt 1962), so that the proppant alone does not make the crack grow; an ellipse,
/// and the more a pack of uniform thickness, would. Where the crack has grown there is none.
template <int dim>
double propped_gap(const InitialCrack<dim> &crack, const CrackPath<dim> &path, unsigned int piece);

/// The same by crack and piece, for FaceContact; null where proppant keeps no faces apart. Both
/// arguments must outlive it.
template <int dim>
std::function<double(unsigned int, unsigned int)>
propped_gaps(const std::vector<InitialCrack<dim>> &cracks, const Discontinuity<dim> &discontinuity);

/// The faces of propped cracks keep their distance, and conduct by the proppant: what opens is the
/// room beside it.
/// @param segments of @p discontinuity
template <int dim>
void add_proppant(const std::vector<InitialCrack<dim>> &cracks,
                  const Discontinuity<dim> &discontinuity,
                  std::vector<Segment<dim>> &segments);
} // namespace stockwork
