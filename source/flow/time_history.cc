#include "flow/time_history.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "stockwork/base/error.h"

namespace stockwork
{
namespace
{
std::string trim(const std::string &text)
{
  const auto begin = text.find_first_not_of(" \t");
  return begin == std::string::npos ? ""
                                    : text.substr(begin, text.find_last_not_of(" \t") - begin + 1);
}
} // namespace

TimeHistory::TimeHistory(const std::string &text,
                         const Dimension &dimension,
                         const std::string &path)
  : path(path)
  , text(text)
{
  const std::string allowed = "a value, '" + std::string(dimension.example) +
                              "'; pieces, each from its time on, '0 s: " + dimension.example +
                              "; 50 s: 0'; or an expression in SI units, 'f(t) = t/10'";
  try
  {
    if (text.compare(0, 4, "f(t)") == 0 && text.find('=') != std::string::npos)
    {
      expression = std::make_shared<dealii::FunctionParser<1>>();
      expression->initialize("t", text.substr(text.find('=') + 1), {});
      // muParser finds faults only now
      if (!std::isfinite(expression->value(dealii::Point<1>(0.))))
        throw InputError("it is not finite at the start");
    }
    else if (text.find(':') == std::string::npos)
    {
      times = {-std::numeric_limits<double>::infinity()};
      values = {parse_finite_quantity(trim(text), dimension)};
    }
    else
      for (const std::string &piece : split_list(text))
      {
        const auto colon = piece.find(':');
        if (colon == std::string::npos)
          throw InputError("no time");
        times.push_back(parse_finite_quantity(trim(piece.substr(0, colon)), dimension::time));
        values.push_back(parse_finite_quantity(trim(piece.substr(colon + 1)), dimension));
        if (times.size() > 1 && !(times.back() > times[times.size() - 2]))
          throw InputError("its times do not grow");
      }
  }
  catch (const InputError &error)
  {
    throw EntryError(path, text, allowed + " (" + error.what() + ")");
  }
  catch (const std::exception &)
  {
    throw EntryError(path, text, allowed);
  }
}

double TimeHistory::expressed(const double t) const
{
  const double value = expression->value(dealii::Point<1>(t));
  if (!std::isfinite(value))
  {
    std::ostringstream text;
    text << "'" << path << "' is not finite at t = " << t << " s.";
    throw SolveError(text.str());
  }
  return value;
}

double TimeHistory::mean(const double begin, const double end) const
{
  if (!expression || !(end > begin))
    return (*this)(begin, end);
  // An expression may jump: many points, of equal weight.
  constexpr unsigned int n = 64;
  double sum = 0.;
  for (unsigned int k = 0; k < n; ++k)
    sum += expressed(begin + (end - begin) * (k + 0.5) / n);
  return sum / n;
}

double TimeHistory::operator()(const double begin, const double end) const
{
  if (expression)
    return expressed(end);

  double integral = 0.;
  for (unsigned int k = 0; k < times.size(); ++k)
  {
    const double from = std::max(begin, times[k]);
    const double to = k + 1 < times.size() ? std::min(end, times[k + 1]) : end;
    if (from <= begin && to >= end)
      return values[k];
    if (to > from)
      integral += values[k] * (to - from);
  }
  return end > begin ? integral / (end - begin) : 0.;
}

void TimeHistory::check(const double begin, const double end) const
{
  if (!expression)
    return;
  constexpr unsigned int n = 4096;
  for (unsigned int k = 0; k <= n; ++k)
  {
    const double t = begin + (end - begin) * k / n;
    if (!std::isfinite(expression->value(dealii::Point<1>(t))))
    {
      std::ostringstream allowed;
      allowed << "an expression that is finite from " << begin << " s to " << end
              << " s; at t = " << t << " s it is not";
      refuse(allowed.str());
    }
  }
}

void TimeHistory::check_starts_by(const double begin) const
{
  if (times.empty() || times.front() <= begin)
    return;
  std::ostringstream allowed;
  allowed << "pieces of which the first begins at " << begin
          << " s, the start of the run: of the time before nothing is said";
  refuse(allowed.str());
}

double TimeHistory::magnitude() const
{
  double largest = 0.;
  for (const double value : values)
    largest = std::max(largest, std::abs(value));
  if (expression)
    for (int exponent = -6; exponent <= 9; ++exponent)
    {
      const double value = expression->value(dealii::Point<1>(std::pow(10., exponent)));
      if (std::isfinite(value))
        largest = std::max(largest, std::abs(value));
    }
  return largest;
}

double TimeHistory::minimum() const
{
  return expression ? -std::numeric_limits<double>::infinity()
                    : *std::min_element(values.begin(), values.end());
}

bool TimeHistory::is_in_pieces() const
{
  return !expression;
}

double TimeHistory::maximum() const
{
  return expression ? std::numeric_limits<double>::infinity()
                    : *std::max_element(values.begin(), values.end());
}

void TimeHistory::refuse(const std::string &allowed) const
{
  throw EntryError(path, text, allowed);
}

double TimeHistory::next_jump(const double t) const
{
  // Times of steps are sums with rounding errors.
  const auto next = std::upper_bound(times.begin(), times.end(), t + 1e-10 * std::abs(t));
  return next == times.end() ? std::numeric_limits<double>::infinity() : *next;
}

bool TimeHistory::rises_from_zero(const double t) const
{
  for (unsigned int k = 0; k < times.size(); ++k)
    if (std::abs(times[k] - t) <= 1e-10 * std::abs(t))
      return (k == 0 || values[k - 1] == 0.) && values[k] > 0.; // before the first piece: nothing
  return false;
}
} // namespace stockwork
