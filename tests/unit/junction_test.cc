// A crack that ends on another one: the rock in three parts, or in four.
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_accessor.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_q.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/householder.h>
#include <deal.II/lac/vector.h>

#include <doctest/doctest.h>

#include "discontinuity/discontinuity.h"
#include "stockwork/base/error.h"

namespace stockwork::junction_test
{
using dealii::Point;
using dealii::Tensor;

namespace
{
/// Q1 displacements on the square [-1, 1]^2, and cracks in it.
struct Body
{
  explicit Body(const unsigned int n)
    : triangulation(MPI_COMM_WORLD)
    , fe(dealii::FE_Q<2>(1), 2)
    , dof_handler(triangulation)
    , mapping(1)
    , collectives(MPI_COMM_WORLD)
    , cracks(2.8)
  {
    dealii::GridGenerator::subdivided_hyper_cube(triangulation, n, -1., 1.);
    dof_handler.distribute_dofs(fe);
    constraints.close();
    cracks.setup({triangulation, dof_handler, mapping, constraints, false}, collectives);
  }

  void cut(const std::vector<std::vector<Point<2>>> &polylines)
  {
    std::vector<InitialCrack<2>> given;
    for (const auto &polyline : polylines)
    {
      given.emplace_back();
      given.back().points = polyline;
    }
    cracks.cut(given, collectives);
  }

  dealii::parallel::distributed::Triangulation<2> triangulation;
  dealii::FESystem<2> fe;
  dealii::DoFHandler<2> dof_handler;
  dealii::MappingQ<2> mapping;
  dealii::AffineConstraints<double> constraints;
  Collectives collectives;
  Discontinuity<2> cracks;
};

/// The line through a point at an angle to the first axis [degrees].
struct Line
{
  Point<2> through;
  double angle;

  Point<2> at(const double distance) const
  {
    const double a = angle * dealii::numbers::PI / 180.;
    return through + distance * Point<2>(std::cos(a), std::sin(a));
  }

  bool left(const Point<2> &p) const
  {
    const Tensor<1, 2> along = at(1.) - through, to = p - through;
    return along[0] * to[1] - along[1] * to[0] > 0.;
  }
};

/// Where a point lies beside a crack: in cells that it cuts, by its piece; in others that the first
/// crack cuts, by how far along that they are, for the second is bent to end there.
bool on_plus_side(const Discontinuity<2> &cracks,
                  const unsigned int crack,
                  const Line &line,
                  const dealii::CellId &cell,
                  const Point<2> &centre,
                  const Point<2> &unit_point)
{
  if (const CrackPiece<2> *piece = cracks.piece_in(cell, crack))
    return piece->plus_side(unit_point);
  const CrackPath<2> &path = cracks.paths()[crack];
  for (const CrackEnd end : {CrackEnd::first, CrackEnd::last})
    if (path.ends_on[static_cast<int>(end)] == 0)
      if (const CrackPiece<2> *first = cracks.piece_in(cell, 0))
        return (first->along * (first->centre() - path.tip(end)) > 0.) ==
               (path.piece_at(end).normal() * first->along > 0.);
  return line.left(centre);
}

/// Integrals of the gradient of each extra function over the body, less what its jump says they are
/// but for the boundary of the body: zero for functions inside.
std::map<std::pair<unsigned int, unsigned int>, Tensor<1, 2>> defects_of_divergence(Body &body)
{
  std::map<std::pair<unsigned int, unsigned int>, Tensor<1, 2>> defect; // by unknown and component
  for (const auto &cell : body.dof_handler.active_cell_iterators())
    if (cell->is_locally_owned())
      if (const auto *cut = body.cracks.cut_cell(cell->active_cell_index()))
        for (unsigned int q = 0; q < cut->weights.size(); ++q)
          for (unsigned int c = 0; c < cut->n_columns(); ++c)
            defect[{cut->extra[c], cut->component[c]}] +=
              cut->weights[q] * cut->gradients[q * cut->n_columns() + c];
  for (unsigned int k = 0; k < body.cracks.paths().size(); ++k)
    for (unsigned int i = 0; i < body.cracks.paths()[k].pieces.size(); ++i)
    {
      const CrackPiece<2> &piece = body.cracks.paths()[k].pieces[i];
      const Tensor<1, 2> way = piece.ends[1] - piece.ends[0];
      const Tensor<1, 2> area({-way[1], way[0]}); // times the normal to the plus side
      for (const auto &[unknown, jump] : body.cracks.mean_jumps(k, i))
        for (unsigned int d = 0; d < 2; ++d)
          if (jump[d] != 0.)
            defect[{unknown, d}] += jump[d] * area;
    }
  return defect;
}
} // namespace

/// Not where nothing of a crack is left beside the other one, which is refused with a sentence.
bool may_be_cut(Body &body, const std::vector<std::vector<Point<2>>> &polylines)
{
  try
  {
    body.cut(polylines);
  }
  catch (const InputError &error)
  {
    MESSAGE(std::string(error.what()));
    return false;
  }
  return true;
}

TEST_CASE("every function of a junction jumps where its pieces say so and nowhere else")
{
  Body body(8);
  unsigned int n_refused = 0;
  // The second ends on the first from its left or right, the third from the other side.
  for (const double angle : {0., 27., 45., 60., 90., 153.})
    for (const double between : {90., 50., -90., -35.})
      for (const double shift : {0., 0.25 / 3., 0.1, 0.2})
        for (const bool both : {false, true})
        {
          CAPTURE(angle);
          CAPTURE(between);
          CAPTURE(shift);
          CAPTURE(both);
          const Line first{{shift, 0.7 * shift}, angle}, second{first.through, angle + between};
          std::vector<std::vector<Point<2>>> polylines{{first.at(-0.55), first.at(0.55)},
                                                       {second.at(0.6), second.at(0.)}};
          if (both)
            polylines.push_back({second.at(0.), second.at(-0.6)});
          if (!may_be_cut(body, polylines))
          {
            ++n_refused;
            continue;
          }
          CHECK(body.cracks.paths()[1].ends_on[1] == 0);
          if (both)
            CHECK(body.cracks.paths()[2].ends_on[0] == 0);
          double largest = 0.;
          for (const auto &[unknown, defect] : defects_of_divergence(body))
            largest = std::max(largest, defect.norm());
          CHECK(largest < 1e-13);
        }
  CHECK(n_refused <= 5);
}

TEST_CASE("the parts of rock between cracks move apart freely")
{
  unsigned int n_refused = 0;
  for (const double angle : {90., 63., 27.})
    for (const double between : {90., 50., -90.})
      for (const double shift : {0., 0.25 / 3., 0.1})
        for (const bool both : {false, true})
        {
          CAPTURE(angle);
          CAPTURE(between);
          CAPTURE(shift);
          CAPTURE(both);
          Body body(8);
          const Line first{{shift, 0.7 * shift}, angle}, second{first.through, angle + between};
          std::vector<std::vector<Point<2>>> polylines{{first.at(-1.6), first.at(1.6)},
                                                       {second.at(1.6), second.at(0.)}};
          if (both)
            polylines.push_back({second.at(0.), second.at(-1.6)});
          if (!may_be_cut(body, polylines))
          {
            ++n_refused;
            continue;
          }
          // A linear displacement of its own in each part; the second crack's plus side is its left
          // seen from its mouth, the third one's from the junction.
          const double side_of_second = between > 0. ? 1. : 0.; // of the first
          const Line backwards{second.through, second.angle + 180.};
          const auto part = [&](const dealii::CellId &cell, const Point<2> &centre,
                                const Point<2> &unit) -> unsigned int
          {
            const bool plus = on_plus_side(body.cracks, 0, first, cell, centre, unit);
            if (plus == (side_of_second == 1.))
              return on_plus_side(body.cracks, 1, backwards, cell, centre, unit);
            return both ? 2 + on_plus_side(body.cracks, 2, backwards, cell, centre, unit) : 2;
          };
          const Tensor<1, 3> field[4] = {
            Tensor<1, 3>({1., 0.3, -0.7}), Tensor<1, 3>({-2., 0.1, 0.4}),
            Tensor<1, 3>({0.5, -1.1, 0.2}), Tensor<1, 3>({3., 0.6, 0.9})};
          const auto exact = [&](const unsigned int part, const Point<2> &x)
          { return field[part][0] + field[part][1] * x[0] + field[part][2] * x[1]; };

          // The nearest to it, in the mean square at the points of quadrature: it is found itself.
          const unsigned int n_bulk = body.dof_handler.n_dofs(),
                             n = n_bulk + body.cracks.enrichment().unknowns().size();
          std::vector<std::vector<std::pair<unsigned int, double>>> rows;
          std::vector<double> values;
          const dealii::QGauss<2> gauss(2);
          std::vector<dealii::types::global_dof_index> dofs(body.fe.n_dofs_per_cell());
          for (const auto &cell : body.dof_handler.active_cell_iterators())
          {
            cell->get_dof_indices(dofs);
            const auto *cut = body.cracks.cut_cell(cell->active_cell_index());
            const auto &points = cut != nullptr ? cut->points : gauss.get_points();
            for (unsigned int q = 0; q < points.size(); ++q)
            {
              rows.emplace_back();
              for (unsigned int i = 0; i < dofs.size(); ++i)
                if (body.fe.system_to_component_index(i).first == 0)
                  rows.back().emplace_back(dofs[i], body.fe.shape_value(i, points[q]));
              if (cut != nullptr)
                for (unsigned int c = 0; c < cut->n_columns(); ++c)
                  if (cut->component[c] == 0)
                    rows.back().emplace_back(n_bulk + cut->extra[c],
                                             cut->values[q * cut->n_columns() + c]);
              values.push_back(exact(part(cell->id(), cell->center(), points[q]),
                                     body.mapping.transform_unit_to_real_cell(cell, points[q])));
            }
          }
          std::vector<int> place(n, -1);
          unsigned int n_used = 0;
          for (const auto &row : rows)
            for (const auto &[column, value] : row)
              if (place[column] < 0)
                place[column] = n_used++;
          dealii::FullMatrix<double> matrix(rows.size(), n_used);
          dealii::Vector<double> rhs(rows.size()), x(n_used), scale(n_used);
          for (unsigned int r = 0; r < rows.size(); ++r)
          {
            rhs[r] = values[r];
            for (const auto &[column, value] : rows[r])
              matrix(r, place[column]) += value;
          }
          for (unsigned int c = 0; c < n_used; ++c)
          {
            double largest = 0.;
            for (unsigned int r = 0; r < rows.size(); ++r)
              largest = std::max(largest, std::abs(matrix(r, c)));
            for (unsigned int r = 0; r < rows.size(); ++r)
              matrix(r, c) /= largest;
            scale[c] = largest;
          }
          dealii::Householder<double> householder;
          householder.initialize(matrix);
          CHECK(householder.least_squares(x, rhs) < 1e-9);

          // And the pieces part by what the parts differ by.
          double largest = 0.;
          for (unsigned int k = 0; k < polylines.size(); ++k)
            for (unsigned int i = 0; i < body.cracks.paths()[k].pieces.size(); ++i)
            {
              const CrackPiece<2> &piece = body.cracks.paths()[k].pieces[i];
              double jump = 0.;
              for (const auto &[unknown, unit] : body.cracks.mean_jumps(k, i))
                if (const int c = place[n_bulk + unknown]; c >= 0)
                  jump += unit[0] * x[c] / scale[c];
              double expected = 0.;
              const double lengths[2] = {piece.split, 1. - piece.split};
              for (unsigned int half = 0; half < 2; ++half)
              {
                const double middle = half == 0 ? 0.5 * piece.split : 0.5 * (1. + piece.split);
                const auto unit_way = piece.unit_ends[1] - piece.unit_ends[0];
                const auto beside = [&](const double sign)
                {
                  const auto normal = piece.unit_normal();
                  const Point<2> unit =
                    piece.unit_ends[0] + middle * unit_way + sign * 1e-7 * normal / normal.norm();
                  Point<2> centre;
                  for (const auto &corner : piece.corners)
                    centre += 0.25 * corner;
                  return exact(part(piece.cell, centre, unit),
                               piece.ends[0] + middle * (piece.ends[1] - piece.ends[0]));
                };
                expected += lengths[half] * (beside(1.) - beside(-1.));
              }
              largest = std::max(largest, std::abs(jump - expected));
            }
          CHECK(largest < 1e-6);
        }
  CHECK(n_refused <= 5);
}
} // namespace stockwork::junction_test
