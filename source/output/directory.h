#pragma once

#include <mpi.h>

#include <functional>
#include <string>

namespace stockwork
{
/// Make the output directory, with its parents, and see whether files can be written there.
/// Collective. @throws InputError on every rank, so that a run does not compute in vain
void prepare_output_directory(const std::string &directory, MPI_Comm communicator);

/// Holds an output directory for one run at a time, as long as it lives; the system lets go of it
/// also when the run crashes. File systems without locks are taken on trust.
class DirectoryLock
{
public:
  /// Collective. @throws EntryError on every rank if another run holds it
  DirectoryLock(const std::string &directory, MPI_Comm communicator);
  ~DirectoryLock();
  DirectoryLock(const DirectoryLock &) = delete;
  DirectoryLock &operator=(const DirectoryLock &) = delete;

private:
  int descriptor = -1; ///< on rank 0
};

/// Run @p action on rank 0; if it throws there, throw an OutputError with its message on every
/// rank. Collective.
void on_root(MPI_Comm communicator, const std::function<void()> &action);

/// Run @p action on every rank; if it throws somewhere, throw an OutputError with the message of
/// the first such rank on all. Collective; @p action must not communicate.
void on_all(MPI_Comm communicator, const std::function<void()> &action);

/// Whether to wait until the disk has a file: for what a restart needs. Else the room for it is
/// taken at once, so that a full disk is noticed all the same.
enum class OnDisk
{
  now,
  soon
};

/// Write a whole file; what could be written before an error is removed. @throws OutputError
void write_file(const std::string &file, const std::string &contents, OnDisk on_disk = OnDisk::now);

/// Write a whole file so that there is either the old one or the new one, never half of one: a
/// killed run or a full disk leaves the old. @throws OutputError
void replace_file(const std::string &file,
                  const std::string &contents,
                  OnDisk on_disk = OnDisk::now);
} // namespace stockwork
