#include "output/checkpoint.h"

#include <deal.II/distributed/solution_transfer.h>

#include <boost/archive/binary_iarchive.hpp>
#include <boost/archive/binary_oarchive.hpp>
#include <boost/crc.hpp>
#include <boost/serialization/string.hpp>
#include <boost/serialization/vector.hpp>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>

#include <fcntl.h>
#include <sc.h>
#include <unistd.h>

#include "output/directory.h"
#include "stockwork/base/deck.h"
#include "stockwork/base/error.h"
#include "stockwork/base/quantity.h"

namespace stockwork
{
using namespace dealii;

namespace
{
/// First line of the file "state"; changes with the format.
const std::string magic = "Stockwork checkpoint, format 8\n";

/// Checksum as four bytes, the same on every machine.
std::string seal(const std::string &bytes)
{
  boost::crc_32_type crc;
  crc.process_bytes(bytes.data(), bytes.size());
  std::string result;
  for (unsigned int i = 0; i < 4; ++i)
    result.push_back(static_cast<char>((crc.checksum() >> (8 * i)) & 0xff));
  return result;
}

/// While it lives, p4est ends the program with a sentence where it cannot write, and not with a
/// list of functions: its way of giving up must not return.
class SentenceWhenP4estGivesUp
{
public:
  explicit SentenceWhenP4estGivesUp(const std::string &directory)
  {
    message = "stockwork: cannot write a checkpoint in " + directory +
              ". The previous one, if any, is intact; continue from it with --restart once the "
              "directory can be written to.\n";
    sc_set_abort_handler(
      []()
      {
        std::cerr << message << std::flush;
        MPI_Abort(MPI_COMM_WORLD, 2);
      });
  }

  ~SentenceWhenP4estGivesUp()
  {
    sc_set_abort_handler(nullptr);
  }

private:
  static inline std::string message; // the handler has no arguments
};
} // namespace

Checkpoint::Checkpoint(const std::string &directory, MPI_Comm communicator)
  : directory(directory)
  , communicator(communicator)
{
}

std::string Checkpoint::path(const std::string &name) const
{
  return directory + "/" + name;
}

bool Checkpoint::exists() const
{
  const bool mine =
    Utilities::MPI::this_mpi_process(communicator) == 0 &&
    (std::filesystem::exists(path("state")) || std::filesystem::exists(path("state.previous")));
  return Utilities::MPI::max(mine ? 1 : 0, communicator) == 1;
}

void Checkpoint::remove() const
{
  on_root(communicator,
          [&]()
          {
            std::filesystem::remove(path("state"));
            std::filesystem::remove(path("state.previous"));
          });
}

template <int dim>
void Checkpoint::save(const parallel::distributed::Triangulation<dim> &triangulation,
                      const DoFHandler<dim> &dof_handler,
                      const std::vector<const Vector *> &vectors,
                      const std::string &bytes,
                      const std::uint64_t fingerprint,
                      const std::string &deck,
                      std::uint64_t attached_bytes)
{
  std::string set;
  attached_bytes = Utilities::MPI::sum(attached_bytes, communicator);
  on_root(communicator,
          [&]()
          {
            std::filesystem::create_directories(directory);
            // A run that starts afresh where an earlier one was replaces its checkpoint, but not
            // before the new one is complete. A damaged one is nothing to keep.
            if (state.set.empty() && std::filesystem::exists(path("state")))
              try
              {
                state = read_state();
              }
              catch (const InputError &)
              {
              }
            set = state.set == "a" ? "b" : "a";
            std::filesystem::remove(path("state.previous")); // its files are about to be replaced
            // Per cell: the values of its unknowns, its status and its place in the tree; besides,
            // a margin for headers.
            const double cell_bytes =
              vectors.size() * dof_handler.get_fe().n_dofs_per_cell() * sizeof(double) + 64.;
            reserve_space(
              static_cast<std::uint64_t>(triangulation.n_global_active_cells() * cell_bytes) +
              bytes.size() + attached_bytes + 65536);
          });
  set = Utilities::MPI::broadcast(communicator, set, 0);

  parallel::distributed::SolutionTransfer<dim, Vector> transfer(dof_handler);
  transfer.prepare_for_serialization(vectors);
  {
    const SentenceWhenP4estGivesUp sentence(directory);
    triangulation.save(path("mesh_" + set));
  }

  on_root(communicator,
          [&]()
          {
            State next;
            next.fingerprint = fingerprint;
            next.dimension = dim;
            next.n_vectors = vectors.size();
            next.n_dofs = dof_handler.n_dofs();
            next.set = set;
            next.bytes = bytes;
            next.deck = deck;
            for (const auto &entry : std::filesystem::directory_iterator(directory))
            {
              const std::string name = entry.path().filename().string();
              if (name.rfind("mesh_" + set, 0) == 0)
                next.files.push_back(describe(name));
            }
            write_state(next);
            next.bytes.clear();
            next.deck.clear();
            state = next;
          });
}

void Checkpoint::reserve_space(const std::uint64_t bytes) const
{
  // p4est aborts the program when a write fails. So make sure beforehand that there is room.
  const std::string file = path("room");
  const int descriptor = open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
  int error = descriptor < 0 ? errno : posix_fallocate(descriptor, 0, bytes);
  if (descriptor >= 0)
    close(descriptor);
  std::remove(file.c_str());
  // File systems that cannot reserve are asked how much is free.
  if (error == EOPNOTSUPP || error == EINVAL)
    error = std::filesystem::space(directory).available < bytes ? ENOSPC : 0;
  if (error != 0)
    throw OutputError("There is no room for a checkpoint of " +
                      std::to_string(bytes / 1000000 + 1) + " MB in " + directory + " (" +
                      (error == EFBIG ? "file size limit, ulimit -f" : std::strerror(error)) +
                      "). The previous checkpoint, if any, is intact; continue from it with "
                      "--restart once there is room.");
}

Checkpoint::State::File Checkpoint::describe(const std::string &name) const
{
  std::ifstream file(path(name), std::ios::binary);
  if (!file)
    throw InputError("cannot read " + path(name));
  boost::crc_32_type crc;
  State::File result{name};
  std::vector<char> buffer(1 << 20);
  while (file)
  {
    file.read(buffer.data(), buffer.size());
    crc.process_bytes(buffer.data(), file.gcount());
    result.size += file.gcount();
  }
  result.checksum = crc.checksum();
  return result;
}

void Checkpoint::write_state(const State &next) const
{
  std::ostringstream stream;
  {
    boost::archive::binary_oarchive archive(stream);
    archive << next;
  }
  const std::string body = stream.str();
  write_file(path("state.new"), magic + seal(body) + body);
  if (std::filesystem::exists(path("state")))
    std::filesystem::rename(path("state"), path("state.previous"));
  std::filesystem::rename(path("state.new"), path("state"));
}

Checkpoint::State Checkpoint::read_state(const std::string &name) const
{
  std::ifstream file(path(name), std::ios::binary);
  if (!file)
    throw InputError("There is no checkpoint in " + directory +
                     " to restart from. Was the earlier run given the same output directory, and "
                     "did it get as far as its first checkpoint?");
  std::ostringstream stream;
  stream << file.rdbuf();
  const std::string contents = stream.str();

  const std::string damaged =
    "The checkpoint in " + directory +
    " is damaged. Start the run afresh, or put back a copy of the directory.";
  if (contents.compare(0, magic.size(), magic) != 0)
    throw InputError(contents.rfind("Stockwork checkpoint", 0) == 0
                       ? "The checkpoint in " + directory +
                           " was written by another version of the program."
                       : damaged);
  if (contents.size() < magic.size() + 4)
    throw InputError(damaged);
  const std::string body = contents.substr(magic.size() + 4);
  if (contents.compare(magic.size(), 4, seal(body)) != 0)
    throw InputError(damaged);

  State result;
  try
  {
    std::istringstream input(body);
    boost::archive::binary_iarchive archive(input);
    archive >> result;
  }
  catch (const std::exception &)
  {
    throw InputError(damaged);
  }
  for (const State::File &expected : result.files)
  {
    const bool there = std::filesystem::exists(path(expected.name));
    const State::File found = there ? describe(expected.name) : State::File();
    if (!there || found.size != expected.size || found.checksum != expected.checksum)
      throw InputError(damaged);
  }
  return result;
}

std::string Checkpoint::read(const std::uint64_t fingerprint, const std::string &deck)
{
  problem_of_newest.clear();
  try
  {
    on_root(communicator,
            [&]()
            {
              State found;
              try
              {
                found = read_state();
              }
              catch (const InputError &error)
              {
                if (!std::filesystem::exists(path("state.previous")))
                  throw;
                try
                {
                  found = read_state("state.previous");
                  problem_of_newest = error.what();
                }
                catch (const InputError &)
                {
                  throw error;
                }
              }
              if (found.fingerprint != fingerprint)
              {
                const std::string changed =
                  found.deck.empty() || deck.empty() ? "" : difference(found.deck, deck);
                throw InputError("The checkpoint in " + directory +
                                 " was written by a run of another deck, or this deck has been "
                                 "changed since" +
                                 (changed.empty() ? "" : ": " + changed) +
                                 ". Restart with the deck as it was, or start afresh.");
              }
              found.deck.clear();
              state = std::move(found);
            });
  }
  catch (const OutputError &error)
  {
    throw InputError(error.what());
  }
  state = Utilities::MPI::broadcast(communicator, state, 0);
  problem_of_newest = Utilities::MPI::broadcast(communicator, problem_of_newest, 0);
  std::string bytes;
  std::swap(bytes, state.bytes);
  return bytes;
}

template <int dim>
void Checkpoint::load_mesh(parallel::distributed::Triangulation<dim> &triangulation) const
{
  AssertThrow(!state.set.empty(), ExcMessage("read() comes first"));
  AssertThrow(state.dimension == dim, ExcDimensionMismatch(state.dimension, dim));
  triangulation.load(path("mesh_" + state.set));
}

template <int dim>
void Checkpoint::load_vectors(const DoFHandler<dim> &dof_handler,
                              const std::vector<Vector *> &vectors) const
{
  AssertThrow(state.n_vectors == vectors.size(),
              ExcDimensionMismatch(state.n_vectors, vectors.size()));
  AssertThrow(state.n_dofs == dof_handler.n_dofs(),
              ExcDimensionMismatch(state.n_dofs, dof_handler.n_dofs()));
  parallel::distributed::SolutionTransfer<dim, Vector> transfer(dof_handler);
  std::vector<Vector *> targets = vectors;
  transfer.deserialize(targets);
  for (Vector *vector : targets)
    vector->compress(VectorOperation::insert);
}

void CheckpointSchedule::declare_parameters(ParameterHandler &prm)
{
  prm.enter_subsection("Checkpoint");
  prm.declare_entry("Steps between", "0", Patterns::Integer(0),
                    "Write a checkpoint after so many steps; 0: do not count steps.");
  prm.declare_entry("Time between", "15 min", Quantity(dimension::time, Range::non_negative()),
                    "Write a checkpoint after so much computing time; 0: do not look at the "
                    "clock.");
  prm.leave_subsection();
}

void CheckpointSchedule::parse_parameters(ParameterHandler &prm)
{
  prm.enter_subsection("Checkpoint");
  steps_between = prm.get_integer("Steps between");
  seconds_between = get_quantity(prm, "Time between", dimension::time);
  prm.leave_subsection();
}

bool CheckpointSchedule::due(const unsigned int step, MPI_Comm communicator)
{
  const auto now = std::chrono::steady_clock::now();
  const double waited = std::chrono::duration<double>(now - last_time).count();
  const bool mine = (steps_between > 0 && step >= last_step + steps_between) ||
                    (seconds_between > 0. && waited >= seconds_between);
  if (Utilities::MPI::max(mine ? 1 : 0, communicator) == 0)
    return false;
  last_step = step;
  last_time = now;
  return true;
}

template void Checkpoint::save<2>(const parallel::distributed::Triangulation<2> &,
                                  const DoFHandler<2> &,
                                  const std::vector<const Vector *> &,
                                  const std::string &,
                                  std::uint64_t,
                                  const std::string &,
                                  std::uint64_t);
template void Checkpoint::save<3>(const parallel::distributed::Triangulation<3> &,
                                  const DoFHandler<3> &,
                                  const std::vector<const Vector *> &,
                                  const std::string &,
                                  std::uint64_t,
                                  const std::string &,
                                  std::uint64_t);
template void Checkpoint::load_mesh<2>(parallel::distributed::Triangulation<2> &) const;
template void Checkpoint::load_mesh<3>(parallel::distributed::Triangulation<3> &) const;
template void Checkpoint::load_vectors<2>(const DoFHandler<2> &,
                                          const std::vector<Vector *> &) const;
template void Checkpoint::load_vectors<3>(const DoFHandler<3> &,
                                          const std::vector<Vector *> &) const;
} // namespace stockwork
