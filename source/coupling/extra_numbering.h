#pragma once

#include "stockwork/fracture/model.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

namespace stockwork
{
/// The extra unknowns in the order of their indices, and how values move when that order changes.
class ExtraNumbering
{
public:
  ExtraNumbering() = default;

  explicit ExtraNumbering(std::vector<ExtraUnknown> unknowns)
    : unknowns(std::move(unknowns))
  {
    for (unsigned int i = 0; i < this->unknowns.size(); ++i)
      index.emplace(this->unknowns[i].key, i);
    AssertThrow(index.size() == this->unknowns.size(),
                dealii::ExcMessage("Two extra unknowns have the same key."));
  }

  unsigned int size() const
  {
    return unknowns.size();
  }

  const ExtraUnknown &operator[](const unsigned int i) const
  {
    return unknowns[i];
  }

  /// Index of the unknown with this key.
  std::optional<unsigned int> find(const std::uint64_t key) const
  {
    const auto position = index.find(key);
    if (position == index.end())
      return {};
    return position->second;
  }

  bool same_keys(const ExtraNumbering &other) const
  {
    if (size() != other.size())
      return false;
    for (unsigned int i = 0; i < size(); ++i)
      if (unknowns[i].key != other.unknowns[i].key)
        return false;
    return true;
  }

  /// Whether the other knows all of these unknowns.
  bool is_within(const ExtraNumbering &other) const
  {
    return std::all_of(unknowns.begin(), unknowns.end(),
                       [&](const ExtraUnknown &unknown) { return other.index.count(unknown.key); });
  }

  /// Values in this numbering from values in another: by key, and the initial value of an unknown
  /// that the other does not know (`new_value` instead, where it is not NaN).
  std::vector<double>
  transfer(const ExtraNumbering &from,
           const std::vector<double> &values,
           const double new_value = std::numeric_limits<double>::quiet_NaN()) const
  {
    std::vector<double> result(size());
    for (unsigned int i = 0; i < size(); ++i)
    {
      const auto position = from.find(unknowns[i].key);
      result[i] = position                 ? values[*position]
                  : new_value == new_value ? new_value
                                           : unknowns[i].initial;
    }
    return result;
  }

  std::vector<std::uint64_t> keys() const
  {
    std::vector<std::uint64_t> result;
    for (const ExtraUnknown &unknown : unknowns)
      result.push_back(unknown.key);
    return result;
  }

private:
  std::vector<ExtraUnknown> unknowns;
  std::unordered_map<std::uint64_t, unsigned int> index;
};
} // namespace stockwork
