// Runs on one and on two ranks.
#include <doctest/doctest.h>

#include <deal.II/base/function_lib.h>
#include <deal.II/base/mpi.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/numerics/data_out.h>
#include <deal.II/numerics/vector_tools.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include <sys/resource.h>

#include "mesh/geometry.h"
#include "output/bulk_fields.h"
#include "output/field_output.h"
#include "output/signals.h"
#include "stockwork/base/error.h"

namespace stockwork::output_mpi_test
{
using namespace dealii;

namespace
{
/// u = (1e-3 x, -2e-3 y + 1e-3 x), p - p_0 = 5e5 x.
class Linear : public Function<2>
{
public:
  Linear()
    : Function<2>(3)
  {
  }

  double value(const Point<2> &p, const unsigned int component) const override
  {
    return component == 0 ? 1e-3 * p[0] : component == 1 ? -2e-3 * p[1] + 1e-3 * p[0] : 5e5 * p[0];
  }
};

/// A model with something to show.
class Model : public FractureModel<2>
{
public:
  void write_fields(const State &, FieldSink<2> &sink) const override
  {
    if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
    {
      sink.add_fracture_piece({Point<2>(0., 0.), Point<2>(0.5, 0.)}, {{"aperture", aperture}});
      sink.add_fracture_piece({Point<2>(0.5, 0.), Point<2>(1., 0.5)}, {{"aperture", 1.}});
    }
    if (!damage.empty())
      sink.add_cell_field("damage", damage);
  }

  double aperture = 2.;
  std::vector<double> damage;
};

/// Everything that output needs.
struct Setting
{
  Setting()
    : triangulation(MPI_COMM_WORLD)
    , dof_handler(triangulation)
  {
    ParameterHandler prm;
    Geometry<2>::declare_parameters(prm);
    Rock::declare_parameters(prm);
    FieldOutput<2>::declare_parameters(prm);
    prm.parse_input_from_string("subsection Mesh\nsubsection Box\nset Upper corner = 1, 1\n"
                                "end\nend\nsubsection Rock\n"
                                "set Young modulus = 10 GPa\nset Poisson ratio = 0.25\n"
                                "set Biot coefficient = 0.8\nset Permeability = 1e-15 m^2\nend\n"
                                "subsection Fluid\nset Viscosity = 1 cP\nend\n"
                                "subsection Output\nset Steps between fields = 2\n"
                                "set Times of fields = 1 s, 10 s\nend\n");
    geometry.parse_parameters(prm);
    rock.parse_parameters(prm);
    output.parse_parameters(prm);
    geometry.create(triangulation);
    mapping = geometry.mapping();
    const FESystem<2> fe(FE_Q<2>(2), 2, FE_Q<2>(1), 1);
    dof_handler.distribute_dofs(fe);
    const auto owned = dof_handler.locally_owned_dofs();
    const auto relevant = DoFTools::extract_locally_relevant_dofs(dof_handler);
    unknowns.bulk.reinit({owned}, {relevant}, MPI_COMM_WORLD);
    TrilinosWrappers::MPI::BlockVector values;
    values.reinit({owned}, MPI_COMM_WORLD);
    VectorTools::interpolate(*mapping, dof_handler, Linear(), values);
    values.compress(VectorOperation::insert);
    unknowns.bulk = values;
  }

  MeshView<2> mesh_view() const
  {
    return {triangulation, dof_handler, *mapping, constraints, true};
  }

  Scene<2> scene() const
  {
    return {rock,
            {},
            true,
            [](const Point<2> &x)
            {
              SymmetricTensor<2, 2> s;
              s[0][0] = -1e7;
              s[1][1] = -2e7 + 1e6 * x[1];
              return s;
            },
            [](const Point<2> &x) { return 3e6 - 1e5 * x[1]; },
            1.};
  }

  void write(const double time)
  {
    const State state{unknowns, unknowns, unknowns, unknowns, {}};
    output.write(time, mesh_view(), scene(), model, state);
  }

  Geometry<2> geometry;
  Rock rock;
  parallel::distributed::Triangulation<2> triangulation;
  DoFHandler<2> dof_handler;
  std::unique_ptr<Mapping<2>> mapping;
  AffineConstraints<double> constraints;
  Unknowns unknowns;
  Model model;
  FieldOutput<2> output;
};

std::string text_of(const std::string &file)
{
  std::ifstream stream(file);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

unsigned int count(const std::string &text, const std::string &part)
{
  unsigned int n = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
    ++n;
  return n;
}

unsigned int n_ranks()
{
  return Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
}

/// An empty directory.
std::string directory(const std::string &what)
{
  const std::string name = "output_test_" + std::to_string(n_ranks()) + "/" + what;
  MPI_Barrier(MPI_COMM_WORLD);
  if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
    std::filesystem::remove_all(name);
  MPI_Barrier(MPI_COMM_WORLD);
  return name;
}

struct Peek : public DataOut<2>
{
  using DataOut<2>::get_dataset_names;
  using DataOut<2>::get_patches;
};
} // namespace

TEST_CASE("values of the fields")
{
  const Setting setting;
  const Scene<2> scene = setting.scene();
  const State state{setting.unknowns, setting.unknowns, setting.unknowns, setting.unknowns, {}};
  const BulkFields<2> fields(setting.mesh_view(), scene, setting.model, state);
  Peek output;
  output.attach_dof_handler(setting.dof_handler);
  output.add_data_vector(setting.unknowns.bulk, fields);
  output.build_patches(*setting.mapping, 2);
  const auto names = output.get_dataset_names();
  REQUIRE(names.size() == 2 + 4 + 1 + 4 + 2);

  // By hand: lambda = mu = 4 GPa; strain (1e-3, -2e-3), engineering shear 1e-3.
  for (const auto &patch : output.get_patches())
    for (unsigned int v = 0; v < 4; ++v)
    {
      const Point<2> x = patch.vertices[v];
      const unsigned int i = (v % 2) * 2 + (v / 2) * 6; // of 3 x 3 points
      const double excess = 5e5 * x[0], pressure = 3e6 - 1e5 * x[1] + excess;
      const double xx = -1e7 + 4e9 * -1e-3 + 8e9 * 1e-3 - 0.8 * excess;
      const double yy = -2e7 + 1e6 * x[1] + 4e9 * -1e-3 - 8e9 * 2e-3 - 0.8 * excess;
      const double xy = 8e9 * 0.5e-3;
      const std::vector<double> expected{1e-3 * x[0],
                                         -2e-3 * x[1] + 1e-3 * x[0],
                                         xx,
                                         xy,
                                         xy,
                                         yy,
                                         pressure,
                                         xx + 0.8 * pressure,
                                         xy,
                                         xy,
                                         yy + 0.8 * pressure,
                                         -1e-15 / 1e-3 * 5e5,
                                         0.};
      for (unsigned int n = 0; n < names.size(); ++n)
      {
        CAPTURE(names[n]);
        CHECK(std::abs(patch.data(n, i) - expected[n]) < 1e-6 * std::abs(expected[n]) + 1e-12);
      }
    }
}

TEST_CASE("files and series")
{
  const std::string place = directory("series");
  Setting setting;
  setting.model.damage.assign(setting.triangulation.n_active_cells(), 0.5);
  setting.output.open(place, MPI_COMM_WORLD);
  setting.write(0.);
  setting.write(2.);

  const std::string bulk = text_of(place + "/fields.pvd"),
                    fracture = text_of(place + "/fracture.pvd");
  CHECK(count(bulk, "<DataSet") == 2);
  CHECK(count(bulk, n_ranks() == 1 ? "vtu/fields_0001.vtu" : "vtu/fields_0001.pvtu") == 1);
  CHECK(count(fracture, "vtu/fracture_0001.vtu") == 1);
  const std::string vtu =
    text_of(place + (n_ranks() == 1 ? "/vtu/fields_0001.vtu" : "/vtu/fields_0001.pvtu"));
  for (const std::string name :
       {"displacement", "pore_pressure", "total_stress", "effective_stress", "flux", "damage"})
    CHECK(count(vtu, "Name=\"" + name + "\"") == 1);
  const std::string lines = text_of(place + "/vtu/fracture_0001.vtu");
  CHECK(count(lines, "NumberOfCells=\"2\"") == 1);
  CHECK(count(lines, "aperture") >= 1);

  // A restarted run continues the series.
  std::stringstream memory;
  {
    boost::archive::binary_oarchive archive(memory);
    archive << setting.output;
  }
  setting.write(3.);
  Setting again;
  again.output.open(place, MPI_COMM_WORLD);
  {
    boost::archive::binary_iarchive archive(memory);
    archive >> again.output;
  }
  again.write(4.);
  CHECK(count(text_of(place + "/fields.pvd"), "<DataSet") == 3);
  CHECK(count(text_of(place + "/fields.pvd"), "timestep=\"3\"") == 0);
}

TEST_CASE("when fields are due")
{
  Setting setting;
  setting.output.open(directory("due"), MPI_COMM_WORLD);
  CHECK(setting.output.next_time(0.) == 1.);
  CHECK(setting.output.next_time(1.) == 10.);
  CHECK(setting.output.next_time(10.) > 1e300);
  CHECK(!setting.output.due(1, 0.5, false));
  CHECK(setting.output.due(1, 0.5, true));
  CHECK(setting.output.due(2, 0.5, false));
  CHECK(setting.output.due(3, 1., false));
  setting.write(1.);
  CHECK(!setting.output.due(3, 1.5, false));
  CHECK(setting.output.due(7, 12., false));
}

TEST_CASE("what is not a number is never written")
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::string place = directory("nan");
  Setting setting;
  setting.output.open(place, MPI_COMM_WORLD);

  const auto message = [&setting]() -> std::string
  {
    try
    {
      setting.write(1.);
    }
    catch (const SolveError &error)
    {
      return error.what();
    }
    return "";
  };
  setting.model.aperture = nan;
  CHECK(message().find("aperture") != std::string::npos);
  setting.model.aperture = 1.;
  setting.model.damage.assign(setting.triangulation.n_active_cells(), nan);
  CHECK(message().find("damage") != std::string::npos);
  setting.model.damage.clear();
  CHECK(message() == "");

  // On one rank only.
  TrilinosWrappers::MPI::BlockVector values;
  values.reinit({setting.dof_handler.locally_owned_dofs()}, MPI_COMM_WORLD);
  if (values.block(0).in_local_range(0))
    values.block(0)(0) = nan;
  values.compress(VectorOperation::insert);
  setting.unknowns.bulk = values;
  CHECK(message() != "");
  CHECK(count(text_of(place + "/fields.pvd"), "<DataSet") == 1);
}

TEST_CASE("a disk that fills up: an error, and what was written before is complete")
{
  catch_stop_signals();
  const std::string place = directory("full");
  Setting setting;
  setting.output.open(place, MPI_COMM_WORLD);
  setting.write(1.);
  const std::string before = text_of(place + "/fields.pvd");

  rlimit old;
  getrlimit(RLIMIT_FSIZE, &old);
  rlimit small = old;
  small.rlim_cur = 2000;
  setrlimit(RLIMIT_FSIZE, &small);
  CHECK_THROWS_AS(setting.write(2.), OutputError);
  setrlimit(RLIMIT_FSIZE, &old);

  CHECK(text_of(place + "/fields.pvd") == before);
  setting.write(2.);
  CHECK(count(text_of(place + "/fields.pvd"), "<DataSet") == 2);
}
} // namespace stockwork::output_mpi_test
