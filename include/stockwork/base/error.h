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

/// A solve failed and no smaller step rescued it. The message says what to try; the last good
/// checkpoint is kept; the program ends with status 2.
class SolveError : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};
} // namespace stockwork
