#pragma once

#include <deal.II/base/parameter_handler.h>
#include <deal.II/distributed/tria.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/lac/trilinos_parallel_block_vector.h>

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

namespace stockwork
{
/// The state of a run on disk: mesh, bulk vectors, and everything else as one string of bytes.
/// A checkpoint may be read by another number of ranks than wrote it.
///
/// A write never touches the checkpoint before it: the mesh and the vectors go to whichever of two
/// sets of files (a, b) is not in use, and replacing the small file "state", which names the set
/// and holds checksums of it, is the one step that makes the new checkpoint the valid one. The file
/// before it is kept as "state.previous": where the newest is damaged, reading falls back to it.
///
/// Reading has three phases, because unknowns need a mesh and a mesh its coarse cells:
///
///   const std::string bytes = checkpoint.read(fingerprint);
///   geometry.create_coarse(triangulation);
///   checkpoint.load_mesh(triangulation);
///   dof_handler.distribute_dofs(fe);
///   checkpoint.load_vectors(dof_handler, vectors);
///
/// All functions are collective, and all ranks must see the same directory.
class Checkpoint
{
public:
  using Vector = dealii::TrilinosWrappers::MPI::BlockVector;

  /// @param directory where the files go; made when first needed
  Checkpoint(const std::string &directory, MPI_Comm communicator);

  /// @param vectors with ghosts, the locally relevant ones at least
  /// @param bytes the rest, the same on all ranks (rank 0's is written)
  /// @param fingerprint of the deck
  /// @param deck its comparable_text(), to say later what has changed
  /// @param attached_bytes of this rank, that somebody else has attached to the mesh
  /// @throws OutputError if it cannot be written; the previous checkpoint is left as it was
  template <int dim>
  void save(const dealii::parallel::distributed::Triangulation<dim> &triangulation,
            const dealii::DoFHandler<dim> &dof_handler,
            const std::vector<const Vector *> &vectors,
            const std::string &bytes,
            std::uint64_t fingerprint,
            const std::string &deck = "",
            std::uint64_t attached_bytes = 0);

  bool exists() const;

  /// Forget what an earlier run has left in this directory. Collective.
  void remove() const;

  /// The bytes given to save(). @throws InputError if there is no checkpoint, if it is damaged or
  /// of another version, or if the deck has changed since
  std::string read(std::uint64_t fingerprint, const std::string &deck = "");

  /// Why read() took the checkpoint before the newest; empty: it took the newest.
  const std::string &why_not_newest() const
  {
    return problem_of_newest;
  }

  /// @param triangulation the coarse cells of the mesh
  template <int dim>
  void load_mesh(dealii::parallel::distributed::Triangulation<dim> &triangulation) const;

  /// @param vectors owned entries only, of the right size, as many as were saved and in that order
  template <int dim>
  void load_vectors(const dealii::DoFHandler<dim> &dof_handler,
                    const std::vector<Vector *> &vectors) const;

private:
  /// What the file "state" holds.
  struct State
  {
    struct File
    {
      std::string name;
      std::uint64_t size = 0;
      std::uint32_t checksum = 0;

      template <class Archive>
      void serialize(Archive &archive, const unsigned int)
      {
        archive &name &size &checksum;
      }
    };

    std::uint64_t fingerprint = 0;
    unsigned int dimension = 0;
    unsigned int n_vectors = 0;
    std::uint64_t n_dofs = 0;
    std::string set; ///< "a" or "b"; empty: there is no checkpoint
    std::vector<File> files;
    std::string bytes;
    std::string deck;

    template <class Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &fingerprint &dimension &n_vectors &n_dofs &set &files &bytes &deck;
    }
  };

  std::string path(const std::string &name) const;
  void reserve_space(std::uint64_t bytes) const;
  State::File describe(const std::string &name) const;
  State read_state(const std::string &name = "state") const;
  void write_state(const State &next) const;

  std::string directory;
  MPI_Comm communicator;
  std::string problem_of_newest;
  State state; ///< of the valid checkpoint, without its bytes
};

/// When to write a checkpoint: after so many steps, after so much time, or both.
class CheckpointSchedule
{
public:
  static void declare_parameters(dealii::ParameterHandler &prm);
  void parse_parameters(dealii::ParameterHandler &prm);

  /// Whether it is time again; starts the clock anew if so. To be called once after each accepted
  /// step. Collective.
  bool due(unsigned int step, MPI_Comm communicator);

private:
  unsigned int steps_between = 0;
  double seconds_between = 0.;
  unsigned int last_step = 0;
  std::chrono::steady_clock::time_point last_time = std::chrono::steady_clock::now();
};
} // namespace stockwork
