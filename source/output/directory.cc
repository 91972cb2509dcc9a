#include "output/directory.h"

#include <deal.II/base/mpi.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include "stockwork/base/error.h"

namespace stockwork
{
namespace
{
std::string reason()
{
  return errno == ENOSPC   ? "the disk is full"
         : errno == EDQUOT ? "the disk quota is used up"
         : errno == EFBIG  ? "the file would be larger than allowed (ulimit -f)"
                           : std::strerror(errno);
}

std::string problem_of(const std::function<void()> &action)
{
  try
  {
    action();
  }
  catch (const std::exception &error)
  {
    return *error.what() == 0 ? "unknown error" : error.what();
  }
  return "";
}

/// Throw the message of the lowest rank that has one, on all.
void agree(MPI_Comm communicator, const std::string &problem)
{
  if (dealii::Utilities::MPI::max(problem.empty() ? 0 : 1, communicator) == 0)
    return;
  for (const std::string &message : dealii::Utilities::MPI::all_gather(communicator, problem))
    if (!message.empty())
      throw OutputError(message);
}
} // namespace

void write_file(const std::string &file, const std::string &contents, const OnDisk on_disk)
{
  const int descriptor = open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
  if (descriptor < 0)
    throw OutputError("cannot write " + file + ": " + reason());
  std::string why;
  if (on_disk == OnDisk::soon && !contents.empty())
  {
    errno = posix_fallocate(descriptor, 0, static_cast<off_t>(contents.size()));
    if (errno == ENOSPC || errno == EDQUOT || errno == EFBIG)
      why = reason();
  }
  for (std::size_t done = 0; done < contents.size() && why.empty();)
  {
    const ssize_t n = write(descriptor, contents.data() + done, contents.size() - done);
    if (n >= 0)
      done += n;
    else if (errno != EINTR)
      why = reason();
  }
  // Only when forced to the disk do some file systems say what does not fit.
  if (on_disk == OnDisk::now && why.empty() && fsync(descriptor) != 0 && errno != EINVAL)
    why = reason();
  if (close(descriptor) != 0 && why.empty())
    why = reason();
  if (!why.empty())
  {
    std::remove(file.c_str());
    throw OutputError("cannot write " + file + ": " + why);
  }
}

void replace_file(const std::string &file, const std::string &contents, const OnDisk on_disk)
{
  write_file(file + ".new", contents, on_disk);
  if (std::rename((file + ".new").c_str(), file.c_str()) != 0)
    throw OutputError("cannot write " + file + ": " + reason());
}

void on_all(MPI_Comm communicator, const std::function<void()> &action)
{
  agree(communicator, problem_of(action));
}

void on_root(MPI_Comm communicator, const std::function<void()> &action)
{
  const bool root = dealii::Utilities::MPI::this_mpi_process(communicator) == 0;
  agree(communicator, root ? problem_of(action) : "");
}

void prepare_output_directory(const std::string &directory, MPI_Comm communicator)
{
  try
  {
    on_root(communicator,
            [&directory]()
            {
              std::filesystem::create_directories(directory);
              const std::string probe = directory + "/.stockwork_can_write_here";
              write_file(probe, "yes");
              std::remove(probe.c_str());
            });
  }
  catch (const OutputError &error)
  {
    throw EntryError("Output directory", directory,
                     std::string("a directory that can be written to, there or with --output (") +
                       error.what() + ")");
  }
}

DirectoryLock::DirectoryLock(const std::string &directory, MPI_Comm communicator)
{
  int held = 0;
  if (dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
  {
    descriptor = open((directory + "/.lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    held = descriptor >= 0 && flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  }
  if (dealii::Utilities::MPI::max(held, communicator) == 1)
  {
    if (descriptor >= 0)
      close(descriptor);
    throw EntryError(
      "Output directory", directory,
      "a directory that no other run writes to at this time, there or with --output");
  }
}

DirectoryLock::~DirectoryLock()
{
  if (descriptor >= 0)
    close(descriptor);
}
} // namespace stockwork
