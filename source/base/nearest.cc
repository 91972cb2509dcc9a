#include "stockwork/base/nearest.h"

#include <algorithm>
#include <cctype>
#include <utility>

namespace stockwork
{
namespace
{
char lower(const char c)
{
  return static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
}

bool contains_ignoring_case(const std::string &text, const std::string &part)
{
  return std::search(text.begin(), text.end(), part.begin(), part.end(),
                     [](char a, char b) { return lower(a) == lower(b); }) != text.end();
}
} // namespace

unsigned int edit_distance(const std::string &a, const std::string &b)
{
  // Damerau's distance needs the two rows before the current one.
  std::vector<unsigned int> before(b.size() + 1), above(b.size() + 1), row(b.size() + 1);
  for (unsigned int j = 0; j <= b.size(); ++j)
    row[j] = j;
  for (unsigned int i = 1; i <= a.size(); ++i)
  {
    std::swap(before, above);
    std::swap(above, row);
    row[0] = i;
    for (unsigned int j = 1; j <= b.size(); ++j)
    {
      const bool same = lower(a[i - 1]) == lower(b[j - 1]);
      row[j] = std::min({above[j] + 1, row[j - 1] + 1, above[j - 1] + (same ? 0 : 1)});
      if (i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) &&
          lower(a[i - 2]) == lower(b[j - 1]))
        row[j] = std::min(row[j], before[j - 2] + 1);
    }
  }
  return row[b.size()];
}

std::vector<std::string> nearest_names(const std::string &name,
                                       const std::vector<std::string> &candidates,
                                       const unsigned int max_results)
{
  const unsigned int tolerated = std::max<unsigned int>(1, (name.size() + 1) / 3);

  std::vector<std::pair<unsigned int, std::string>> near;
  for (const std::string &candidate : candidates)
  {
    const unsigned int distance = edit_distance(name, candidate);
    if (distance <= tolerated)
      near.emplace_back(distance, candidate);
    // An abbreviation or an added word: "Young" for "Young modulus".
    else if (std::min(name.size(), candidate.size()) >= 3 &&
             (contains_ignoring_case(candidate, name) || contains_ignoring_case(name, candidate)))
      near.emplace_back(tolerated + 1, candidate);
  }
  std::stable_sort(near.begin(), near.end(),
                   [](const auto &a, const auto &b) { return a.first < b.first; });

  std::vector<std::string> result;
  for (const auto &[distance, candidate] : near)
    if (result.size() < max_results &&
        std::find(result.begin(), result.end(), candidate) == result.end())
      result.push_back(candidate);
  return result;
}

std::string quoted_list(const std::vector<std::string> &names, const std::string &conjunction)
{
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i)
  {
    if (i > 0)
      text += i + 1 == names.size() ? " " + conjunction + " " : ", ";
    text += "'" + names[i] + "'";
  }
  return text;
}

std::string did_you_mean(const std::string &name, const std::vector<std::string> &candidates)
{
  const auto near = nearest_names(name, candidates);
  return near.empty() ? "" : "did you mean " + quoted_list(near, "or") + "?";
}
} // namespace stockwork
