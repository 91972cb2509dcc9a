#pragma once

#include <mpi.h>

#include <chrono>
#include <map>
#include <ostream>
#include <string>
#include <vector>

namespace stockwork
{
/// Wall time by phase of the computation.
///
/// A scope inside another pauses it, so that every second is counted once and the phases add up
/// to the total. The phases of summary.json are assembly, preconditioner, solve, fracture and
/// output; any other name may be used too.
class PhaseTimers
{
public:
  PhaseTimers();

  /// Measures until it is destroyed. Scopes end in the reverse order of their begin.
  class Scope
  {
  public:
    Scope(const Scope &) = delete;
    Scope &operator=(const Scope &) = delete;
    ~Scope();

  private:
    friend class PhaseTimers;
    Scope(PhaseTimers &timers, const std::string &phase);
    PhaseTimers &timers;
  };

  [[nodiscard]] Scope scope(const std::string &phase);

  /// Charge seconds that one phase has taken to another, of which they were a part.
  void move(const std::string &from, const std::string &to, double seconds);

  /// Seconds since construction on this rank.
  double total() const;

  /// Seconds by phase, with "total"; the maximum over the ranks of the communicator (collective).
  std::map<std::string, double> seconds(MPI_Comm communicator) const;

  /// A table of phases, seconds, shares and calls, and seconds per step if there are steps;
  /// collective, printed by rank 0.
  void print(std::ostream &out, MPI_Comm communicator, unsigned int n_steps) const;

private:
  using Clock = std::chrono::steady_clock;

  struct Phase
  {
    double seconds = 0;
    unsigned long calls = 0;
  };

  /// Charge the time since the last event to the innermost phase.
  void charge();

  Clock::time_point start, last;
  std::map<std::string, Phase> phases;
  std::vector<Phase *> running;
};
} // namespace stockwork
