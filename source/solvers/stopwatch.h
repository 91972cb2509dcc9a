#pragma once

#include <chrono>

namespace stockwork
{
/// Wall time since construction.
class Stopwatch
{
public:
  double seconds() const
  {
    return std::chrono::duration<double>(Clock::now() - start).count();
  }

private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start = Clock::now();
};
} // namespace stockwork
