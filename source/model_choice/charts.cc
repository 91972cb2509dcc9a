#include "model_choice/charts.h"

#include "stockwork/base/error.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
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

/// Dimensionless toughness that differs by less is the same.
constexpr double same_toughness = 0.2;

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
  if (line != "kind,deck,model,resolution,K_m,leaked,cells,error,seconds,status")
    throw InputError("The charts begin with '" + line + "'.");
  while (std::getline(in, line))
  {
    const std::vector<std::string> fields = fields_of(line);
    if (fields.size() != 10)
      throw InputError("The charts have a line of " + std::to_string(fields.size()) + " fields: '" +
                       line + "'.");
    Row row{fields[0], fields[1], fields[2], fields[3]};
    if (!fields[4].empty())
      row.toughness = number(fields[4], line);
    if (!fields[5].empty())
      row.leaked = number(fields[5], line);
    row.cells = number(fields[6], line);
    row.seconds = number(fields[8], line);
    row.failed = fields[9] != "finished";
    if (!row.failed)
    {
      row.error = number(fields[7], line);
      row.failed = row.error > greatest_error;
    }
    rows.push_back(row);
  }
}


std::string Charts::Group::in_words() const
{
  std::ostringstream text;
  text << std::setprecision(2) << '\'' << kind << '\'';
  if (!std::isnan(least))
    text << " with K_m = " << least;
  if (most > least * (1. + 1e-9))
    text << " to " << most;
  return text.str();
}


std::vector<Charts::Group> Charts::groups(const std::string &kind) const
{
  std::vector<Row> sorted;
  for (const Row &row : rows)
    if (row.kind == kind)
      sorted.push_back(row);
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const Row &a, const Row &b) { return a.toughness < b.toughness; });
  std::vector<Group> found;
  for (const Row &row : sorted)
  {
    if (found.empty() || row.toughness > (1. + same_toughness) * found.back().most)
    {
      found.emplace_back();
      found.back().kind = kind;
      found.back().least = row.toughness;
    }
    Group &group = found.back();
    group.most = row.toughness;
    group.leaked = std::max(group.leaked, row.leaked);
    if (std::find(group.decks.begin(), group.decks.end(), row.deck) == group.decks.end())
      group.decks.push_back(row.deck);
  }
  return found;
}


std::vector<Charts::Row> Charts::rows_of(const Group &group) const
{
  std::vector<Row> found;
  for (const Row &row : rows)
    if (row.kind == group.kind &&
        std::find(group.decks.begin(), group.decks.end(), row.deck) != group.decks.end())
      found.push_back(row);
  return found;
}


std::vector<std::string> Charts::models(const Group &group) const
{
  std::set<std::string> all, failed;
  for (const Row &row : rows_of(group))
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


std::vector<std::string> Charts::failures(const Group &group) const
{
  std::set<std::string> found;
  for (const Row &row : rows_of(group))
    if (row.failed)
      found.insert(row.model + " (" + row.deck + ")");
  return {found.begin(), found.end()};
}


std::optional<Charts::Promise>
Charts::promise(const Group &group, const std::string &model, const double cells) const
{
  struct Runs
  {
    const Row *counts = nullptr, *worst = nullptr;
  };
  std::map<std::string, Runs> by_deck;
  const std::vector<Row> charted = rows_of(group);
  for (const Row &row : charted)
    if (row.model == model)
    {
      const Row *&counts = by_deck[row.deck].counts;
      if (row.cells <= cells * (1. + slack) && (counts == nullptr || row.cells > counts->cells))
        counts = &row;
    }
  for (const Row &row : charted)
    if (row.model == model)
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
    // Unknowns grow with the square of the cells along a line, in space with their cube.
    const double finer = std::max(1., cells / runs.counts->cells);
    const int dim = group.kind.find("disc") == std::string::npos ? 2 : 3;
    promise.seconds += runs.counts->seconds * std::pow(finer, dim) / by_deck.size();
  }
  return promise;
}
} // namespace stockwork
