#include "model_choice/charts.h"

#include "stockwork/base/error.h"

#include <algorithm>
#include <map>
#include <set>
#include <sstream>

namespace stockwork
{
namespace
{
/// More is not an error but another answer.
constexpr double greatest_error = 0.2;

/// Half lengths at the end are estimates.
constexpr double slack = 0.05;

/// Fields of a line; quotes keep a comma.
std::vector<std::string> fields_of(const std::string &line)
{
  std::vector<std::string> fields(1);
  bool quoted = false;
  for (const char c : line)
    if (c == '"')
      quoted = !quoted;
    else if (c == ',' && !quoted)
      fields.emplace_back();
    else if (c != '\r')
      fields.back() += c;
  return fields;
}

double number(const std::string &text, const std::string &line)
{
  try
  {
    return std::stod(text);
  }
  catch (const std::exception &)
  {
    throw InputError("The charts have '" + text + "' for a number in '" + line + "'.");
  }
}
} // namespace


Charts::Charts(std::istream &in)
{
  std::string line;
  std::getline(in, line);
  if (line != "kind,deck,model,resolution,cells,error,seconds,status")
    throw InputError("The charts begin with '" + line + "'.");
  while (std::getline(in, line))
  {
    const std::vector<std::string> fields = fields_of(line);
    if (fields.size() != 8)
      throw InputError("The charts have a line of " + std::to_string(fields.size()) + " fields: '" +
                       line + "'.");
    Row row{fields[0], fields[1], fields[2], fields[3]};
    row.cells = number(fields[4], line);
    row.seconds = number(fields[6], line);
    row.failed = fields[7] != "finished";
    if (!row.failed)
    {
      row.error = number(fields[5], line);
      row.failed = row.error > greatest_error;
    }
    rows.push_back(row);
  }
}


std::vector<std::string> Charts::models(const std::string &kind) const
{
  std::set<std::string> all, failed;
  for (const Row &row : rows)
    if (row.kind == kind)
    {
      all.insert(row.model);
      if (row.failed)
        failed.insert(row.model);
    }
  std::vector<std::string> sound;
  std::set_difference(all.begin(), all.end(), failed.begin(), failed.end(),
                      std::back_inserter(sound));
  return sound;
}


std::vector<std::string> Charts::failures(const std::string &kind) const
{
  std::set<std::string> found;
  for (const Row &row : rows)
    if (row.kind == kind && row.failed)
      found.insert(row.model + " (" + row.deck + ")");
  return {found.begin(), found.end()};
}


std::optional<Charts::Promise>
Charts::promise(const std::string &kind, const std::string &model, const double cells) const
{
  struct Runs
  {
    const Row *counts = nullptr, *worst = nullptr;
  };
  std::map<std::string, Runs> by_deck;
  for (const Row &row : rows)
    if (row.kind == kind && row.model == model)
    {
      const Row *&counts = by_deck[row.deck].counts;
      if (row.cells <= cells * (1. + slack) && (counts == nullptr || row.cells > counts->cells))
        counts = &row;
    }
  for (const Row &row : rows)
    if (row.kind == kind && row.model == model)
      if (Runs &runs = by_deck[row.deck]; runs.counts != nullptr && row.cells >= runs.counts->cells)
        if (runs.worst == nullptr || row.error > runs.worst->error)
          runs.worst = &row;
  if (by_deck.empty())
    return std::nullopt;
  Promise promise;
  promise.row.error = -1.;
  for (const auto &[deck, runs] : by_deck)
  {
    if (runs.counts == nullptr)
      return std::nullopt;
    if (runs.worst->error > promise.row.error)
      promise.row = *runs.worst;
    // In the plane, unknowns grow with the square of the cells along a line.
    const double finer = std::max(1., cells / runs.counts->cells);
    promise.seconds += runs.counts->seconds * finer * finer / by_deck.size();
  }
  return promise;
}
} // namespace stockwork
