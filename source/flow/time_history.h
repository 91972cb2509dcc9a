#pragma once

#include <deal.II/base/function_parser.h>

#include <memory>
#include <string>
#include <vector>

#include "stockwork/base/quantity.h"

namespace stockwork
{
/// A quantity that the deck gives for all times, in one of three forms:
///
///   1e-4 m^2/s                        a constant
///   0 s: 1e-4 m^2/s; 50 s: 0          pieces, each from its time on; zero before the first
///   f(t) = 1e-4*min(t/10, 1)          an expression (muParser) in SI units, t in seconds
class TimeHistory
{
public:
  TimeHistory() = default;

  /// @param path of the entry, for messages
  /// @throws EntryError
  TimeHistory(const std::string &text, const Dimension &dimension, const std::string &path);

  /// What applies to a step from `begin` to `end`: the mean of pieces; the value at the end of an
  /// expression. @throws SolveError where an expression is not finite
  double operator()(double begin, double end) const;

  /// The mean over a step of a quantity that adds up, a rate, so that no volume is lost where a
  /// step runs across a change. @throws SolveError where an expression is not finite
  double mean(double begin, double end) const;

  /// Whether an expression is finite at many times of a run.
  /// @throws EntryError where it is not
  void check(double begin, double end) const;

  /// A pressure says nothing of the time before its first piece.
  /// @throws EntryError where that begins later than @p begin [s]
  void check_starts_by(double begin) const;

  /// The greatest magnitude; of an expression, the greatest found at powers of ten of time.
  double magnitude() const;

  /// Whether it is constant between its jumps: an expression is not taken to be.
  bool is_in_pieces() const;

  /// The least value; of an expression, unknown: minus infinity.
  double minimum() const;

  /// The greatest value; of an expression, unknown: infinity.
  double maximum() const;

  /// @throws EntryError with what is allowed instead
  [[noreturn]] void refuse(const std::string &allowed) const;

  /// The next time after t at which the value jumps [s]; infinity if there is none. Steps should
  /// end there.
  double next_jump(double t) const;

  /// Whether the value jumps from zero to above it at this time.
  bool rises_from_zero(double t) const;

private:
  double expressed(double t) const;

  std::string path, text; ///< of the entry
  std::vector<double> times, values;
  std::shared_ptr<dealii::FunctionParser<1>> expression;
};
} // namespace stockwork
