#pragma once

#include <stdexcept>
#include <string>

namespace stockwork
{
/// The user's input cannot be used. The message names the entry, the value, what is allowed and
/// where it was read. Thrown before anything is computed; the program ends with status 1.
class InputError : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/// One entry of the deck has a value that cannot be used. Whoever interprets the entry knows its
/// name but not where it was written; the program adds file and line from Deck::origin().
class EntryError : public InputError
{
public:
  /// @param path the entry with its sections, "Rock/Poisson ratio"
  /// @param value what the deck says
  /// @param allowed what it may say, as the end of the sentence "allowed is ..."
  EntryError(const std::string &path, const std::string &value, const std::string &allowed)
    : InputError("'" + path + "' is " + (value.empty() ? "empty" : "'" + value + "'") +
                 "; allowed is " + allowed)
    , entry_path(path)
  {
  }

  const std::string &path() const
  {
    return entry_path;
  }

private:
  std::string entry_path;
};

/// A solve failed and no smaller step rescued it. The message says what to try; the last good
/// checkpoint is kept; the program ends with status 2.
class SolveError : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/// A matrix does not fit into memory, as all ranks know: no shorter step needs less. The run ends,
/// as with a SolveError.
class MemoryError : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/// A result could not be written during the run (disk full, directory gone). The last good
/// checkpoint is kept; the program ends with status 2.
class OutputError : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};
} // namespace stockwork
