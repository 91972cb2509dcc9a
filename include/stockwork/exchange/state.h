#pragma once

#include <deal.II/lac/trilinos_parallel_block_vector.h>

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace stockwork
{
/// Which step this is, and how the time scheme forms rates from the unknowns:
///
///   du/dt   = rate            (u - rate_reference u)
///   dp/dt   = pressure_rate   (p - rate_reference p)
///   d2u/dt2 = acceleration    (u - acceleration_reference u)
///
/// Backward Euler has rate = pressure_rate = 1/dt and the last accepted state as reference; BDF2
/// and Newmark differ in the numbers only, so nobody below the time scheme asks which one runs.
struct StepContext
{
  double time = 0.;           ///< time at the end of the step [s]
  double dt = 0.;             ///< length of the step [s]
  unsigned int step = 0;      ///< number of the step, from 1
  unsigned int attempt = 0;   ///< 0 for the first attempt at this step
  double rate = 0.;           ///< [1/s]
  double pressure_rate = 0.;  ///< [1/s]
  double acceleration = 0.;   ///< [1/s^2], zero when quasi-static
  double share_of_rates = 1.; ///< of the rates that are given, what wells inject or produce
  bool restarts = false;      ///< begins at the start of the run, and is one pass
  bool damaged_pores = false; ///< take up what is injected, see Segment::damaged_storage

  /// 1/rate [s]. Mass balances are integrated over this time, see Sink.
  double effective_dt() const
  {
    return 1. / rate;
  }

  /// Newmark's scheme: its rates of apertures do not add up to apertures. So that no fluid is lost
  /// where cells open, the fluid in fractures is balanced over the step by backward Euler then.
  bool balances_fractures_by_step() const
  {
    return acceleration > 0.;
  }

  /// As effective_dt(), for the fluid in fractures [s].
  double fracture_dt() const
  {
    return balances_fractures_by_step() ? dt : effective_dt();
  }

  /// pressure_rate over rate, for the fluid in fractures.
  double fracture_pressure_factor() const
  {
    return balances_fractures_by_step() ? 1. : pressure_rate / rate;
  }
};

/// One set of values of all unknowns.
/// `bulk` is ghosted: locally relevant dofs and what the fracture model asked for besides.
/// `extra` holds the fracture unknowns (the model's own first, then one fluid pressure per
/// segment) and is the same on every rank.
struct Unknowns
{
  dealii::TrilinosWrappers::MPI::BlockVector bulk;
  std::vector<double> extra;
};

/// What an assembly may depend on, besides the committed history of the model.
struct State
{
  const Unknowns &current;                ///< the iterate
  const Unknowns &committed;              ///< the last accepted step
  const Unknowns &rate_reference;         ///< see StepContext
  const Unknowns &acceleration_reference; ///< see StepContext; empty when quasi-static

  /// What the fluid in fractures changes from, see StepContext.
  const Unknowns &fracture_reference(const StepContext &context) const
  {
    return context.balances_fractures_by_step() ? committed : rate_reference;
  }

  /// Fluid pressure in the segment with this key [Pa], solved for or given, of the iterate; the
  /// same on every rank. Zero where there is no fluid; empty function: no fluid anywhere.
  std::function<double(std::uint64_t key)> segment_pressure;

  /// Index of that pressure among the extra unknowns, for derivatives; nothing where it is given.
  /// Empty function: no fluid anywhere.
  std::function<std::optional<unsigned int>(std::uint64_t key)> segment_unknown = {};

  /// Fluid pressure in a segment in any set of values [Pa]; zero where there is no fluid.
  double pressure_of(const std::uint64_t segment, const Unknowns &unknowns) const
  {
    if (segment_unknown)
      if (const auto index = segment_unknown(segment))
        return unknowns.extra[*index];
    return segment_pressure ? segment_pressure(segment) : 0.;
  }
};
} // namespace stockwork
