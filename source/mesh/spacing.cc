#include "mesh/spacing.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <regex>

#include "stockwork/base/error.h"
#include "stockwork/base/quantity.h"

namespace stockwork
{
namespace
{
/// Largest number of cells along one axis: beyond it a size is a slip of the pen.
constexpr double max_cells = 1e6;

double length(const std::string &text)
{
  return parse_finite_quantity(text, dimension::length);
}

std::string metres(const double x)
{
  return to_string(x, dimension::length);
}

[[noreturn]] void refuse(const std::string &text, const std::string &why)
{
  throw InputError("\"" + text + "\": " + why);
}

/// The wanted cell size as a function of position: the least of the distances to the
/// concentrations, each scaled so that the cells form a geometric progression.
class SizeFunction
{
public:
  SizeFunction(const std::vector<Concentration> &concentrations,
               const double growth,
               const double largest)
    : concentrations(concentrations)
    , slope(std::log(growth))
    // With h = a (1 + slope d / a), a cell that starts at the concentration ends at d = size.
    , start_factor(growth > 1. ? slope / (growth - 1.) : 1.)
    , largest(largest)
  {
  }

  double operator()(const double x) const
  {
    double h = largest;
    for (const Concentration &c : concentrations)
      if (x >= c.begin && x <= c.end && c.begin < c.end)
        h = std::min(h, c.size);
      else
        h = std::min(h, start_factor * c.size + slope * distance(c, x));
    return h;
  }

  /// Points between @p a and @p b at which another piece of the function may take over, with both
  /// ends: in between, the function is linear.
  std::vector<double> kinks(const double a, const double b) const
  {
    // Every piece is a line h = value(a) + s (x - a).
    std::vector<std::pair<double, double>> lines;
    for (const Concentration &c : concentrations)
      if (c.begin <= a && c.end >= b)
        lines.emplace_back(c.size, 0.);
      else if (c.end <= a)
        lines.emplace_back(start_factor * c.size + slope * (a - c.end), slope);
      else
        lines.emplace_back(start_factor * c.size + slope * (c.begin - a), -slope);
    if (std::isfinite(largest))
      lines.emplace_back(largest, 0.);

    std::vector<double> result{a, b};
    for (std::size_t i = 0; i < lines.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        if (lines[i].second != lines[j].second)
        {
          const double x =
            a + (lines[j].first - lines[i].first) / (lines[i].second - lines[j].second);
          if (x > a && x < b)
            result.push_back(x);
        }
    std::sort(result.begin(), result.end());
    return result;
  }

private:
  static double distance(const Concentration &c, const double x)
  {
    return std::max({c.begin - x, x - c.end, 0.});
  }

  const std::vector<Concentration> &concentrations;
  double slope;
  double start_factor;
  double largest;
};

/// Append the lines in (a, b], where the size function says how close.
void fill(std::vector<double> &lines, const double a, const double b, const SizeFunction &size)
{
  // Number of cells up to each kink, the integral of 1/h. The values at the middle tell the linear
  // piece; at the ends of a band the function jumps.
  struct Piece
  {
    double begin, middle_size, slope, length, cells_before, cells;
  };
  std::vector<Piece> pieces;
  const std::vector<double> kinks = size.kinks(a, b);
  double n = 0.;
  for (std::size_t i = 0; i + 1 < kinks.size(); ++i)
  {
    const double l = kinks[i + 1] - kinks[i];
    if (l <= 1e-14 * (b - a))
      continue;
    const double quarter = size(kinks[i] + 0.25 * l), three = size(kinks[i] + 0.75 * l);
    Piece piece{kinks[i], 0.5 * (quarter + three), (three - quarter) / (0.5 * l), l, n, 0.};
    const double half_change = piece.slope * 0.5 * l / piece.middle_size;
    piece.cells = std::abs(half_change) < 1e-9
                    ? l / piece.middle_size
                    : std::log((1. + half_change) / (1. - half_change)) / piece.slope;
    n += piece.cells;
    pieces.push_back(piece);
  }
  if (!(n < max_cells))
    throw InputError("the cell sizes ask for " + std::to_string(n) + " cells between " + metres(a) +
                     " and " + metres(b) + "; at most a million are allowed.");

  const unsigned int n_cells = std::max(1., std::ceil(n - 1e-6));
  auto piece = pieces.begin();
  for (unsigned int i = 1; i < n_cells; ++i)
  {
    const double target = n * i / n_cells;
    while (piece + 1 != pieces.end() && target > piece->cells_before + piece->cells)
      ++piece;
    const double begin_size = piece->middle_size - piece->slope * 0.5 * piece->length;
    const double m = target - piece->cells_before;
    const double exponent = m * piece->slope;
    lines.push_back(piece->begin + (std::abs(exponent) < 1e-12
                                      ? m * begin_size
                                      : begin_size * std::expm1(exponent) / piece->slope));
  }
  lines.push_back(b);
}
} // namespace

std::vector<double> graded_lines(const double lower,
                                 const double upper,
                                 std::vector<Concentration> concentrations,
                                 const double growth,
                                 const double largest)
{
  const double tolerance = 1e-10 * (upper - lower);
  std::sort(concentrations.begin(), concentrations.end(),
            [](const Concentration &a, const Concentration &b) { return a.begin < b.begin; });

  std::vector<double> fixed{lower};
  const auto fix = [&](const double x)
  {
    if (x > fixed.back() + tolerance)
      fixed.push_back(x);
  };
  for (Concentration &c : concentrations)
  {
    if (c.begin < lower - tolerance || c.end > upper + tolerance)
      throw InputError("the cells from " + metres(c.begin) + " to " + metres(c.end) +
                       " are outside the domain, " + metres(lower) + " to " + metres(upper) + ".");
    if (c.begin < fixed.back() - tolerance)
      throw InputError("the cells from " + metres(c.begin) + " to " + metres(c.end) +
                       " overlap with others before " + metres(fixed.back()) + ".");
    // Snap to the line that is there already, so that no sliver arises.
    c.begin = std::abs(c.begin - fixed.back()) < tolerance ? fixed.back() : c.begin;
    c.begin = std::abs(c.begin - upper) < tolerance ? upper : c.begin;
    c.end = std::abs(c.end - upper) < tolerance ? upper : std::max(c.end, c.begin);
    fix(c.begin);
    fix(c.end);
  }
  fix(upper);

  const SizeFunction size(concentrations, growth, largest);
  std::vector<double> lines{lower};
  for (std::size_t i = 0; i + 1 < fixed.size(); ++i)
    fill(lines, fixed[i], fixed[i + 1], size);
  return lines;
}

unsigned int parse_equal_cells(const std::string &text, const double lower, const double upper)
{
  static const std::regex count(R"(\s*(\d+)\s+cells?\s*)");
  std::smatch match;
  if (std::regex_match(text, match, count))
  {
    const double n = std::stod(match[1]);
    if (n < 1. || n > max_cells)
      refuse(text, "the number of cells must be between 1 and a million");
    return static_cast<unsigned int>(n);
  }

  static const std::regex keyword(R"(\b(lines|at|around|from|growth|largest|cells?)\b|[,;])");
  if (std::regex_search(text, keyword))
    return 0;
  const double size = length(text);
  if (!(size > 0.))
    refuse(text, "the cell size must be positive");
  const double n = std::ceil((upper - lower) / size * (1. - 1e-9));
  if (!(n <= max_cells))
    refuse(text, "this makes more than a million cells between " + metres(lower) + " and " +
                   metres(upper));
  return std::max(1., n);
}

std::vector<double> parse_lines(const std::string &text, const double lower, const double upper)
{
  if (const unsigned int n = parse_equal_cells(text, lower, upper))
  {
    std::vector<double> lines(n + 1);
    for (unsigned int i = 0; i <= n; ++i)
      lines[i] = lower + (upper - lower) * i / n;
    lines.back() = upper;
    return lines;
  }

  static const std::regex list(R"(\s*lines\b\s*(.*))");
  std::smatch match;
  if (std::regex_match(text, match, list))
  {
    std::vector<double> lines;
    for (const std::string &item : split_list(match[1]))
      lines.push_back(length(item));
    for (std::size_t i = 1; i < lines.size(); ++i)
      if (!(lines[i] > lines[i - 1]))
        refuse(text, "the lines must ascend");
    const double tolerance = 1e-10 * (upper - lower);
    if (lines.size() < 2 || std::abs(lines.front() - lower) > tolerance ||
        std::abs(lines.back() - upper) > tolerance)
      refuse(text, "the lines must begin at " + metres(lower) + " and end at " + metres(upper));
    lines.front() = lower;
    lines.back() = upper;
    return lines;
  }

  static const std::regex at(R"((.+)\bat\b(.+))"),
    around(R"((.+)\baround\b(.+?)(?:\brefined\s+(\d+)\s+times?\s*)?)"),
    from(R"((.+)\bfrom\b(.+)\bto\b(.+))"), growth_entry(R"(\s*growth\b(.+))"),
    largest_entry(R"(\s*largest\b(.+))");
  std::vector<Concentration> concentrations;
  double growth = 1.25;
  double largest = std::numeric_limits<double>::infinity();
  for (const std::string &part : split_list(text))
    if (std::regex_match(part, match, growth_entry))
      growth = parse_finite_quantity(match[1], dimension::number);
    else if (std::regex_match(part, match, largest_entry))
      largest = length(match[1]);
    else if (std::regex_match(part, match, from))
      concentrations.push_back({length(match[2]), length(match[3]), length(match[1])});
    else if (std::regex_match(part, match, around))
    {
      const double size = length(match[1]), x = length(match[2]);
      // Halving r times leaves 2^r cells; the middle of the lowest one comes to lie at x.
      const unsigned int halvings = match[3].matched ? std::stoul(match[3]) : 0;
      const double begin = x - 0.5 * std::ldexp(size, -static_cast<int>(halvings));
      concentrations.push_back({begin, begin + size, size});
    }
    else if (std::regex_match(part, match, at))
      concentrations.push_back({length(match[2]), length(match[2]), length(match[1])});
    else
      refuse(text, "\"" + part + "\" is not understood");

  if (concentrations.empty() && !std::isfinite(largest))
    refuse(text, "no cell size is given");
  if (!(growth >= 1. && growth <= 10.))
    refuse(text, "growth must be between 1 and 10");
  if (!(largest > 0.))
    refuse(text, "the largest size must be positive");
  for (const Concentration &c : concentrations)
  {
    if (!(c.size > 0.))
      refuse(text, "the cell sizes must be positive");
    if (c.end < c.begin)
      refuse(text, "\"from\" must lie below \"to\"");
  }
  return graded_lines(lower, upper, std::move(concentrations), growth, largest);
}
} // namespace stockwork
