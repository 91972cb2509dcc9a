#pragma once

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace stockwork::test
{
/// A table of reference values, tests/data/reference/<name>.csv. Its `#` lines say where the
/// numbers come from and hold the parameters as `name=value`; the next line names the columns.
class ReferenceTable
{
public:
  explicit ReferenceTable(const std::string &name)
  {
    std::ifstream file(STOCKWORK_TEST_DATA "/reference/" + name + ".csv");
    if (!file)
      throw std::runtime_error("no reference table " + name);
    std::string line;
    while (std::getline(file, line))
      if (line.rfind("#", 0) == 0)
        header += line + ' ';
      else if (columns.empty())
        columns = split(line);
      else
        cells.push_back(split(line));
  }

  /// The number after `key=` in the header; `inf` is one.
  double parameter(const std::string &key) const
  {
    const auto found = header.find(' ' + key + '=');
    if (found != std::string::npos)
      return std::strtod(header.c_str() + found + key.size() + 2, nullptr);
    throw std::runtime_error("the reference table has no parameter " + key);
  }

  std::size_t rows() const
  {
    return cells.size();
  }

  const std::string &text(const std::size_t row, const std::string &column) const
  {
    const auto found = std::find(columns.begin(), columns.end(), column);
    if (found == columns.end())
      throw std::runtime_error("the reference table has no column " + column);
    return cells[row].at(found - columns.begin());
  }

  double operator()(const std::size_t row, const std::string &column) const
  {
    return std::strtod(text(row, column).c_str(), nullptr);
  }

private:
  static std::vector<std::string> split(const std::string &line)
  {
    std::vector<std::string> parts;
    std::istringstream stream(line);
    for (std::string part; std::getline(stream, part, ',');)
      parts.push_back(part);
    return parts;
  }

  std::string header;
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> cells;
};


/// What a difference is measured against: each value, or the largest value of the column (for
/// profiles that pass through zero).
enum class RelativeTo
{
  each,
  largest
};


/// Largest relative difference between f(row) and a column of the table. The reference is
/// multiplied by `factor` first: with 1 + 2 tolerance in place of 1 the difference must exceed
/// the tolerance, or the comparison could not have failed.
template <typename Function>
double largest_difference(const ReferenceTable &table,
                          const std::string &column,
                          const Function &f,
                          const RelativeTo measure = RelativeTo::each,
                          const double factor = 1.)
{
  double largest = 0.;
  for (std::size_t i = 0; i < table.rows(); ++i)
    largest = std::max(largest, std::abs(table(i, column)));

  double difference = 0.;
  for (std::size_t i = 0; i < table.rows(); ++i)
  {
    const double reference = factor * table(i, column);
    const double scale = measure == RelativeTo::each ? std::abs(reference) : largest;
    const double error = std::abs(f(i) - reference) / std::max(scale, 1e-12 * largest);
    difference = std::isnan(error) ? error : std::max(difference, error);
    if (std::isnan(error))
      return error;
  }
  return difference;
}
} // namespace stockwork::test


/// The column agrees with f to the tolerance, and the same comparison detects a reference that
/// is off by twice the tolerance.
#define CHECK_COLUMN(table, column, tolerance, measure, ...)                                       \
  do                                                                                               \
  {                                                                                                \
    INFO("column ", column);                                                                       \
    CHECK(stockwork::test::largest_difference(table, column, __VA_ARGS__, measure) < (tolerance)); \
    CHECK(stockwork::test::largest_difference(table, column, __VA_ARGS__, measure,                 \
                                              1. + 2. * (tolerance)) > (tolerance));               \
  } while (false)
