#pragma once

#include <deal.II/fe/mapping.h>
#include <deal.II/grid/tria.h>

#include "discontinuity/crack_path.h"
#include "discontinuity/near_tip_field.h"

#include <array>
#include <memory>
#include <vector>

namespace stockwork
{
/// A tip that has functions of its own: the leading terms of the elastic displacement around it in
/// opening (0) and shear (1), cut off at a radius,
///
///   F(r, theta) = chi(r/R) sqrt(r/R) f(theta)
///
/// with the angular parts f of NearTipField, which jump by one, so that a coefficient is about the
/// opening (slip) at the distance R [m], if chi were one there (Chahine, Laborde and Renard 2008,
/// with the fields as vectors). What is added to the finite elements is F - I_h F with the nodal
/// interpolant I_h: the same space, but ordinary displacements keep their meaning at the nodes.
template <int dim>
struct CrackTip
{
  unsigned int crack = 0;
  CrackEnd end = CrackEnd::first;
  dealii::Point<dim> point;
  dealii::Tensor<1, dim> along;              ///< unit vector out of the crack
  double radius = 0.;                        ///< R [m]
  std::shared_ptr<const NearTipField> field; ///< of this tip's direction
  std::array<unsigned int, 2> extra{{0, 0}};

  /// Unit vector to the left of `along`.
  dealii::Tensor<1, dim> across() const;

  /// Side of the crack as seen along the crack's own direction.
  enum class Side : unsigned char
  {
    by_place, ///< on the crack itself: the left, plus side
    plus,
    minus
  };

  struct Value
  {
    dealii::Tensor<1, dim> value;
    dealii::Tensor<2, dim> gradient; ///< [i][j] = F_i,j
  };

  /// F of a mode at a point, whose side overrules its place where a crack runs beside its line.
  Value evaluate(const unsigned int mode, const dealii::Point<dim> &x, const Side side) const;

  /// The mean along a piece of the same crack of the jump of F, plus less minus side.
  dealii::Tensor<1, dim> mean_jump(const unsigned int mode, const CrackPiece<dim> &piece) const;
};

/// F - I_h F of one tip at points of a cell: [(q * 2 + mode)], for displacements of a polynomial
/// degree. A piece of the tip's own crack in the cell tells the side of a point.
template <int dim>
std::vector<typename CrackTip<dim>::Value>
shifted_tip_functions(const CrackTip<dim> &tip,
                      const dealii::Mapping<dim> &mapping,
                      const typename dealii::Triangulation<dim>::active_cell_iterator &cell,
                      const std::vector<dealii::Point<dim>> &unit_points,
                      const unsigned int degree,
                      const CrackPiece<dim> *piece);

/// The greatest radius that keeps the functions of an end of a crack on its straight part, inside
/// the domain and clear of hanging nodes. Collective.
template <int dim>
double maximum_tip_radius(const dealii::parallel::distributed::Triangulation<dim> &triangulation,
                          const std::vector<dealii::Point<dim>> &polyline,
                          const CrackEnd end,
                          const Collectives &collectives);
} // namespace stockwork
