#pragma once

#include <deal.II/base/index_set.h>

#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace stockwork
{
/// Which rows of a matrix have got other values, in terms of stamps of these values.
class RowChanges
{
public:
  /// With this stamp any row may be another.
  void anywhere(const unsigned int stamp)
  {
    known_since = stamp;
    changes.clear();
  }

  /// With this stamp only these rows are others; of all ranks.
  void in(dealii::IndexSet rows, const unsigned int stamp)
  {
    changes.emplace_back(stamp, std::move(rows));
  }

  /// The rows that are not what they were with an earlier stamp; nothing: that is not known.
  std::optional<dealii::IndexSet> since(const unsigned int stamp) const
  {
    if (stamp < known_since)
      return {};
    dealii::IndexSet rows;
    for (const auto &[at, changed] : changes)
      if (at > stamp)
      {
        if (rows.size() == 0)
          rows.set_size(changed.size());
        rows.add_indices(changed);
      }
    rows.compress();
    return rows;
  }

private:
  unsigned int known_since = std::numeric_limits<unsigned int>::max();
  std::vector<std::pair<unsigned int, dealii::IndexSet>> changes;
};
} // namespace stockwork
