#pragma once

#include <cstddef>
#include <limits>
#include <vector>

namespace stockwork::peridynamics
{
/// At which version of the matrix the rows of each site were changed last.
class RowVersions
{
public:
  unsigned int current() const
  {
    return version;
  }

  /// All rows are others, of sites that may be others, too.
  void restart(const std::size_t n_sites)
  {
    first = ++version;
    changed_at.assign(n_sites, version);
  }

  /// The rows of these sites are others; none: nothing has happened.
  void change(const std::vector<unsigned int> &sites)
  {
    if (sites.empty())
      return;
    ++version;
    for (const unsigned int site : sites)
      changed_at[site] = version;
  }

  /// Whether it is known which rows have changed since then.
  bool reach_back_to(const unsigned int since) const
  {
    return since >= first;
  }

  bool has_changed(const unsigned int site, const unsigned int since) const
  {
    return changed_at[site] > since;
  }

private:
  unsigned int version = 0, first = std::numeric_limits<unsigned int>::max();
  std::vector<unsigned int> changed_at; ///< of all sites
};
} // namespace stockwork::peridynamics
