// Runs on one and on two ranks. What two ranks have written is read by one, and the other way
// round.
#include <doctest/doctest.h>

#include <deal.II/base/mpi.h>
#include <deal.II/dofs/dof_renumbering.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/numerics/vector_tools.h>

#include <csignal>
#include <filesystem>
#include <fstream>

#include <sys/resource.h>

#include "mesh/geometry.h"
#include "output/checkpoint.h"
#include "output/directory.h"
#include "output/signals.h"
#include "stockwork/base/error.h"

namespace stockwork::checkpoint_mpi_test
{
using namespace dealii;

namespace
{
/// A field that the elements do not contain, so that only the nodal values tell it.
template <int dim>
class Field : public Function<dim>
{
public:
  explicit Field(const double phase)
    : Function<dim>(dim + 1)
    , phase(phase)
  {
  }

  double value(const Point<dim> &p, const unsigned int component) const override
  {
    return std::sin(3. * p[0] + 7. * p[1] + phase) + component * std::exp(p[dim - 1]);
  }

private:
  double phase;
};

/// Q2-Q1 on a locally refined mesh.
template <int dim>
struct Bulk
{
  using Vector = Checkpoint::Vector;

  explicit Bulk(MPI_Comm communicator)
    : communicator(communicator)
    , fe(FE_Q<dim>(2), dim, FE_Q<dim>(1), 1)
    , triangulation(communicator)
    , dof_handler(triangulation)
  {
    ParameterHandler prm;
    Geometry<dim>::declare_parameters(prm);
    prm.parse_input_from_string("subsection Mesh\n set Region boxes = coal: (0, 0" +
                                std::string(dim == 3 ? ", 0" : "") + ") to (0.3, 1" +
                                std::string(dim == 3 ? ", 1" : "") + ")\n" + "subsection Box\n" +
                                "set Upper corner = 1, 1" + std::string(dim == 3 ? ", 1" : "") +
                                "\nset X spacing = 3 cells\nset Y spacing = 4 cells\nend\nend\n");
    geometry.parse_parameters(prm);
  }

  void setup()
  {
    dof_handler.distribute_dofs(fe);
    std::vector<unsigned int> block(dim + 1, 0);
    block[dim] = 1;
    DoFRenumbering::component_wise(dof_handler, block);
    const auto sizes = DoFTools::count_dofs_per_fe_block(dof_handler, block);
    owned = dof_handler.locally_owned_dofs().split_by_block(sizes);
    relevant = DoFTools::extract_locally_relevant_dofs(dof_handler).split_by_block(sizes);
  }

  void create()
  {
    geometry.create(triangulation);
    for (unsigned int i = 0; i < 2; ++i)
    {
      for (const auto &cell : triangulation.active_cell_iterators())
        if (cell->is_locally_owned() && cell->center().norm() < 0.5)
          cell->set_refine_flag();
      triangulation.execute_coarsening_and_refinement();
    }
    setup();
  }

  Vector field(const double phase) const
  {
    Vector values(owned, communicator);
    VectorTools::interpolate(dof_handler, Field<dim>(phase), values);
    return values;
  }

  Vector ghosted(const Vector &values) const
  {
    Vector result(owned, relevant, communicator);
    result = values;
    return result;
  }

  MPI_Comm communicator;
  FESystem<dim> fe;
  Geometry<dim> geometry;
  parallel::distributed::Triangulation<dim> triangulation;
  DoFHandler<dim> dof_handler;
  std::vector<IndexSet> owned, relevant;
};

template <int dim>
void save(const std::string &directory,
          MPI_Comm communicator,
          const std::string &bytes,
          const unsigned int times = 1)
{
  Bulk<dim> bulk(communicator);
  bulk.create();
  Checkpoint checkpoint(directory, communicator);
  for (unsigned int i = 0; i < times; ++i)
  {
    const auto a = bulk.ghosted(bulk.field(i)), b = bulk.ghosted(bulk.field(i + 0.5));
    checkpoint.save(bulk.triangulation, bulk.dof_handler, {&a, &b}, bytes, 17);
  }
}

/// Difference between what is read and what save() has written.
template <int dim>
double load(const std::string &directory,
            MPI_Comm communicator,
            const std::string &bytes,
            const unsigned int times = 1)
{
  Bulk<dim> bulk(communicator);
  Checkpoint checkpoint(directory, communicator);
  CHECK(checkpoint.exists());
  CHECK(checkpoint.read(17) == bytes);
  bulk.geometry.create_coarse(bulk.triangulation);
  checkpoint.load_mesh(bulk.triangulation);
  bulk.setup();
  Checkpoint::Vector a(bulk.owned, communicator), b(bulk.owned, communicator);
  checkpoint.load_vectors(bulk.dof_handler, {&a, &b});

  Bulk<dim> original(communicator);
  original.create();
  CHECK(bulk.triangulation.n_global_active_cells() ==
        original.triangulation.n_global_active_cells());
  CHECK(bulk.dof_handler.n_dofs() == original.dof_handler.n_dofs());
  for (const auto &cell : bulk.triangulation.active_cell_iterators())
    if (cell->is_locally_owned())
      CHECK(cell->material_id() == (cell->center()[0] < 0.3 ? 1 : 0));

  a -= bulk.field(times - 1);
  b -= bulk.field(times - 1 + 0.5);
  return std::max(a.linfty_norm(), b.linfty_norm());
}

bool is_root()
{
  return Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
}

void remove(const std::string &directory)
{
  MPI_Barrier(MPI_COMM_WORLD);
  if (is_root())
    std::filesystem::remove_all(directory);
  MPI_Barrier(MPI_COMM_WORLD);
}

std::string name(const std::string &what)
{
  return "checkpoint_test_" + std::to_string(Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD)) +
         "/" + what;
}

/// Message of the error that reading must give on all ranks.
std::string error_of_reading(const std::string &directory, const std::uint64_t fingerprint)
{
  try
  {
    Checkpoint(directory, MPI_COMM_WORLD).read(fingerprint);
  }
  catch (const InputError &error)
  {
    return error.what();
  }
  return "no error";
}

bool contains(const std::string &text, const std::string &part)
{
  return text.find(part) != std::string::npos;
}

const std::string bytes("any\0bytes, \xff\n", 13);
} // namespace

TEST_CASE("what is saved comes back")
{
  save<2>(name("2d"), MPI_COMM_WORLD, bytes);
  CHECK(load<2>(name("2d"), MPI_COMM_WORLD, bytes) == 0.);
  save<3>(name("3d"), MPI_COMM_WORLD, bytes);
  CHECK(load<3>(name("3d"), MPI_COMM_WORLD, bytes) == 0.);
  remove(name("2d"));
  remove(name("3d"));
}

TEST_CASE("the last of several is read")
{
  save<2>(name("several"), MPI_COMM_WORLD, bytes, 4);
  CHECK(load<2>(name("several"), MPI_COMM_WORLD, bytes, 4) == 0.);
  remove(name("several"));
}

TEST_CASE("another number of ranks")
{
  save<2>(name("all"), MPI_COMM_WORLD, bytes);
  if (is_root())
  {
    CHECK(load<2>(name("all"), MPI_COMM_SELF, bytes) == 0.);
    save<2>(name("one"), MPI_COMM_SELF, bytes);
  }
  MPI_Barrier(MPI_COMM_WORLD);
  CHECK(load<2>(name("one"), MPI_COMM_WORLD, bytes) == 0.);
  remove(name("all"));
  remove(name("one"));
}

TEST_CASE("another deck, nothing there, damage")
{
  const std::string directory = name("damage");
  CHECK(contains(error_of_reading(directory, 17), "no checkpoint"));
  CHECK(!Checkpoint(directory, MPI_COMM_WORLD).exists());
  save<2>(directory, MPI_COMM_WORLD, bytes);
  CHECK(contains(error_of_reading(directory, 18), "another deck"));
  CHECK(error_of_reading(directory, 17) == "no error");

  std::vector<std::string> files;
  for (const auto &entry : std::filesystem::directory_iterator(directory))
    files.push_back(entry.path().string());
  std::sort(files.begin(), files.end());
  CHECK(files.size() >= 3);
  for (const std::string &file : files)
  {
    CAPTURE(file);
    MPI_Barrier(MPI_COMM_WORLD);
    const auto size = std::filesystem::file_size(file);
    const std::string copy = file + ".copy";
    const auto spoil = [&](const auto &how)
    {
      if (is_root())
      {
        std::filesystem::copy(file, copy);
        how();
      }
      MPI_Barrier(MPI_COMM_WORLD);
      CHECK(contains(error_of_reading(directory, 17), "damaged"));
      MPI_Barrier(MPI_COMM_WORLD);
      if (is_root())
        std::filesystem::rename(copy, file);
      MPI_Barrier(MPI_COMM_WORLD);
    };
    spoil([&]() { std::filesystem::resize_file(file, size - 1); });
    spoil(
      [&]()
      {
        std::fstream stream(file, std::ios::in | std::ios::out | std::ios::binary);
        stream.seekg(size / 2);
        const char c = stream.get();
        stream.seekp(size / 2);
        stream.put(c ^ 4);
      });
  }
  CHECK(error_of_reading(directory, 17) == "no error");
  remove(directory);
}

TEST_CASE("no room: an error, and the previous checkpoint survives")
{
  catch_stop_signals();
  const std::string directory = name("full");
  save<2>(directory, MPI_COMM_WORLD, "first");

  // No file may be larger than 20 kB: a disk that fills up, for whoever writes.
  rlimit old;
  getrlimit(RLIMIT_FSIZE, &old);
  rlimit small = old;
  small.rlim_cur = 20000;
  setrlimit(RLIMIT_FSIZE, &small);
  CHECK_THROWS_AS(save<2>(directory, MPI_COMM_WORLD, "second"), OutputError);
  setrlimit(RLIMIT_FSIZE, &old);

  CHECK(load<2>(directory, MPI_COMM_WORLD, "first") == 0.);
  save<2>(directory, MPI_COMM_WORLD, "third");
  CHECK(load<2>(directory, MPI_COMM_WORLD, "third") == 0.);
  remove(directory);
}

TEST_CASE("killed while writing: the previous checkpoint survives")
{
  const std::string directory = name("killed");
  save<2>(directory, MPI_COMM_WORLD, "first");
  // A kill leaves any part of the other set behind, and perhaps a part of the next state.
  if (is_root())
  {
    std::ofstream(directory + "/mesh_b") << "half a mesh";
    std::ofstream(directory + "/state.new") << "half a state";
  }
  MPI_Barrier(MPI_COMM_WORLD);
  CHECK(load<2>(directory, MPI_COMM_WORLD, "first") == 0.);
  save<2>(directory, MPI_COMM_WORLD, "second");
  CHECK(load<2>(directory, MPI_COMM_WORLD, "second") == 0.);
  remove(directory);
}

TEST_CASE("when a checkpoint is due")
{
  ParameterHandler prm;
  CheckpointSchedule::declare_parameters(prm);
  prm.parse_input_from_string("subsection Checkpoint\nset Steps between = 3\n"
                              "set Time between = 0\nend\n");
  CheckpointSchedule schedule;
  schedule.parse_parameters(prm);
  std::vector<unsigned int> due;
  for (unsigned int step = 1; step < 10; ++step)
    if (schedule.due(step, MPI_COMM_WORLD))
      due.push_back(step);
  CHECK(due == std::vector<unsigned int>{3, 6, 9});
}

TEST_CASE("an output directory that cannot be used is an input error")
{
  if (is_root())
  {
    std::filesystem::create_directories(name(""));
    std::ofstream(name("file")) << "not a directory";
  }
  MPI_Barrier(MPI_COMM_WORLD);
  CHECK_THROWS_AS(prepare_output_directory(name("file"), MPI_COMM_WORLD), InputError);
  CHECK_THROWS_AS(prepare_output_directory(name("file/below"), MPI_COMM_WORLD), InputError);
  CHECK_THROWS_AS(prepare_output_directory("/proc/nowhere", MPI_COMM_WORLD), InputError);
  CHECK_NOTHROW(prepare_output_directory(name("a/b/c"), MPI_COMM_WORLD));
  remove(name("a"));
}

TEST_CASE("a stop signal to one rank is known to all")
{
  catch_stop_signals();
  CHECK(!stop_requested(MPI_COMM_WORLD));
  if (is_root())
    std::raise(SIGTERM);
  CHECK(stop_requested(MPI_COMM_WORLD));
}
} // namespace stockwork::checkpoint_mpi_test
