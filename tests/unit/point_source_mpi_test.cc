// A well's source in the rock, whatever the cells and ranks that share it.
#include <doctest/doctest.h>

#include "flow/point_source.h"

#include "stockwork/base/error.h"

#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/mapping_q1.h>
#include <deal.II/grid/grid_generator.h>

namespace stockwork::point_source_mpi_test
{
using doctest::Approx;

namespace
{
/// A square or cube of ten units, cut into ten cells along each edge, of rock that a deck
/// describes.
template <int dim>
struct Body
{
  Body()
    : triangulation(MPI_COMM_WORLD)
    , fe(dealii::FE_Q<dim>(1), dim, dealii::FE_Q<dim>(1), 1)
    , dofs(triangulation)
    , collectives(MPI_COMM_WORLD)
  {
    dealii::GridGenerator::subdivided_hyper_cube(triangulation, 10, 0., 10.);
    dofs.distribute_dofs(fe);
    constraints.close();
    Rock::declare_parameters(prm);
    prm.enter_subsection("Rock");
    prm.set("Young modulus", "1 GPa");
    prm.set("Poisson ratio", "0.2");
    prm.set("Permeability", "1e-14 m^2");
    prm.set("Biot modulus", "10 GPa");
    prm.leave_subsection();
    prm.enter_subsection("Fluid");
    prm.set("Viscosity", "1 mPa s");
    prm.leave_subsection();
    rock.parse_parameters(prm);
  }

  PointSource<dim> source(const dealii::Point<dim> &point, const double fraction = 1.)
  {
    PointSource<dim> result({point, fraction, 0.01, 0.});
    Scene<dim> scene{rock, {}, true, {}, [](const auto &x) { return 5. + 3. * x[0] - x[1]; }, 10.};
    result.setup({triangulation, dofs, mapping, constraints, true}, scene, collectives);
    return result;
  }

  /// Sum of the coefficients, and the mean of a coordinate.
  std::pair<double, double> moments(const PointSource<dim> &source, const unsigned int d)
  {
    std::map<dealii::types::global_dof_index, dealii::Point<dim>> places;
    dealii::DoFTools::map_dofs_to_support_points(mapping, dofs, places);
    std::vector<double> sums(2, 0.);
    const LinearFunctional &mean = source.mean_pressure();
    for (unsigned int i = 0; i < mean.bulk.size(); ++i)
    {
      sums[0] += mean.bulk_coefficients[i];
      sums[1] += mean.bulk_coefficients[i] * places.at(mean.bulk[i])[d];
    }
    collectives.sum(sums);
    return {sums[0], sums[1]};
  }

  dealii::parallel::distributed::Triangulation<dim> triangulation;
  dealii::FESystem<dim> fe;
  dealii::DoFHandler<dim> dofs;
  dealii::MappingQ1<dim> mapping;
  dealii::AffineConstraints<double> constraints;
  Collectives collectives;
  dealii::ParameterHandler prm;
  Rock rock;
};

template <int dim>
dealii::Point<dim> at(const double x, const double y)
{
  dealii::Point<dim> point;
  for (unsigned int d = 0; d < dim; ++d)
    point[d] = d == 0 ? x : y;
  return point;
}


template <int dim>
void check_places()
{
  Body<dim> body;
  // At a corner of cells, on a face, in the middle, off the middle by a third.
  for (const auto &[x, y] : {std::pair(5., 5.), std::pair(4.5, 5.), std::pair(4.5, 4.5),
                             std::pair(5.17, 4.83), std::pair(5. - 1e-14, 5.)})
  {
    const PointSource<dim> source = body.source(at<dim>(x, y));
    CHECK(source.source_radius() == Approx(2.));
    CHECK(body.moments(source, 0).first == Approx(1.).epsilon(1e-12));
    CHECK(body.moments(source, 0).second == Approx(x).epsilon(1e-3));
    CHECK(body.moments(source, 1).second == Approx(y).epsilon(1e-3));
    CHECK(source.in_situ_pressure() == Approx(5. + 3. * x - y).epsilon(1e-3));
    // Steady radial flow from r_w to R; what elements lack is a small part of it.
    const double mobility = 1e-11;
    const double closed = dim == 2
                            ? (std::log(200.) - 11. / 24.) / (2. * dealii::numbers::PI * mobility)
                            : (100. - 10. / 14.) / (4. * dealii::numbers::PI * mobility);
    CHECK(source.resistance() > closed);
    CHECK(source.resistance() == Approx(closed).epsilon(0.015));
    CHECK(source.reaches(at<dim>(x, y), 0.));
    CHECK(!source.reaches(at<dim>(x + 2.1, y), 0.1));
  }
  // On planes of symmetry.
  const PointSource<dim> cut = body.source(at<dim>(0., 5.), 0.5);
  CHECK(body.moments(cut, 0).first == Approx(1.).epsilon(1e-12));
  CHECK(cut.resistance() == Approx(2. * body.source(at<dim>(5., 5.)).resistance()).epsilon(1e-3));
  CHECK_THROWS_AS(body.source(at<dim>(0., 5.)), InputError);
  CHECK_THROWS_AS(body.source(at<dim>(5., 5.), 0.5), InputError);
  CHECK_THROWS_AS(body.source(at<dim>(1., 5.)), InputError);
  CHECK_THROWS_AS(body.source(at<dim>(-1., 5.)), InputError);
}
} // namespace

TEST_CASE("a source is the same wherever it is between cells and ranks")
{
  check_places<2>();
  check_places<3>();
}

TEST_CASE("a source keeps its radius when cells are split")
{
  Body<2> body;
  PointSource<2> source = body.source(at<2>(5.17, 4.83));
  const double resistance = source.resistance();
  body.triangulation.refine_global(1);
  body.dofs.distribute_dofs(body.fe);
  Scene<2> scene{body.rock, {}, true, {}, {}, 10.};
  source.setup({body.triangulation, body.dofs, body.mapping, body.constraints, true}, scene,
               body.collectives);
  CHECK(source.source_radius() == 2.);
  CHECK(body.moments(source, 1).second == Approx(4.83).epsilon(1e-3));
  CHECK(source.resistance() < resistance); // elements lack less
  CHECK(source.resistance() == Approx(resistance).epsilon(0.01));
}
} // namespace stockwork::point_source_mpi_test
