#include "stockwork/base/timers.h"

#include <deal.II/base/mpi.h>

#include <boost/serialization/map.hpp>

#include <algorithm>
#include <iomanip>
#include <utility>

namespace stockwork
{
namespace
{
/// Phases in the order of a run first, others after them by name.
std::vector<std::string> in_order_of_a_run(const std::map<std::string, double> &seconds)
{
  std::vector<std::string> order;
  for (const char *phase :
       {"assembly", "preconditioner", "solve", "fracture", "growth", "adaptation", "output"})
    if (seconds.count(phase) > 0)
      order.emplace_back(phase);
  for (const auto &[phase, value] : seconds)
    if (phase != "total" && std::find(order.begin(), order.end(), phase) == order.end())
      order.push_back(phase);
  return order;
}
} // namespace

PhaseTimers::Scope::Scope(PhaseTimers &timers, const std::string &phase)
  : timers(timers)
{
  timers.charge();
  Phase &entered = timers.phases[phase];
  ++entered.calls;
  timers.running.push_back(&entered);
}

PhaseTimers::Scope::~Scope()
{
  timers.charge();
  timers.running.pop_back();
}

PhaseTimers::PhaseTimers()
  : start(Clock::now())
  , last(start)
{
  for (const char *phase : {"assembly", "preconditioner", "solve", "fracture", "output"})
    phases[phase];
}

PhaseTimers::Scope PhaseTimers::scope(const std::string &phase)
{
  return Scope(*this, phase);
}

void PhaseTimers::charge()
{
  const auto now = Clock::now();
  if (!running.empty())
    running.back()->seconds += std::chrono::duration<double>(now - last).count();
  last = now;
}

void PhaseTimers::move(const std::string &from, const std::string &to, const double seconds)
{
  phases[from].seconds -= seconds;
  phases[to].seconds += seconds;
  ++phases[to].calls;
}

double PhaseTimers::total() const
{
  return std::chrono::duration<double>(Clock::now() - start).count();
}

std::map<std::string, double> PhaseTimers::seconds(const MPI_Comm communicator) const
{
  std::map<std::string, double> mine;
  for (const auto &[name, phase] : phases)
    mine[name] = phase.seconds;
  mine["total"] = total();

  // A phase may have been entered on some ranks only, so the names are exchanged, too.
  std::map<std::string, double> greatest;
  for (const auto &others : dealii::Utilities::MPI::all_gather(communicator, mine))
    for (const auto &[name, value] : others)
      greatest[name] = std::max(greatest[name], value);
  return greatest;
}

void PhaseTimers::print(std::ostream &out,
                        const MPI_Comm communicator,
                        const unsigned int n_steps) const
{
  const auto values = seconds(communicator);
  if (dealii::Utilities::MPI::this_mpi_process(communicator) != 0)
    return;

  const double total = values.at("total");
  double others = total;
  const auto line = [&](const std::string &name, const double value, const std::string &calls)
  {
    out << "  " << std::left << std::setw(20) << name << std::right << std::setw(10) << value
        << std::setw(8) << 100 * value / std::max(total, 1e-30) << " %" << std::setw(10) << calls;
    if (n_steps > 0)
      out << std::setw(12) << value / n_steps;
    out << '\n';
  };
  const auto flags = out.flags();
  const auto precision = out.precision();
  out << std::fixed << std::setprecision(2)
      << "\n  phase                  seconds     share     calls"
      << (n_steps > 0 ? "  s per step" : "") << '\n';
  for (const std::string &name : in_order_of_a_run(values))
  {
    others -= values.at(name);
    const auto phase = phases.find(name);
    line(name, values.at(name), phase == phases.end() ? "" : std::to_string(phase->second.calls));
  }
  line("everything else", std::max(others, 0.), "");
  line("total", total, "");
  out << std::flush;
  out.flags(flags);
  out.precision(precision);
}
} // namespace stockwork
