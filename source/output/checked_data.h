#pragma once

#include <cmath>
#include <string>

namespace stockwork
{
/// A deal.II class that makes output, and a look at what it is about to write.
template <class DataOut>
class CheckedData : public DataOut
{
public:
  using DataOut::DataOut;

  /// Name of a field with a value that is not finite; empty if there is none.
  std::string first_not_finite() const
  {
    const auto names = this->get_dataset_names();
    for (const auto &patch : this->get_patches())
      for (unsigned int row = 0; row < names.size(); ++row)
        for (unsigned int i = 0; i < patch.data.n_cols(); ++i)
          if (!std::isfinite(patch.data(row, i)))
            return names[row];
    return "";
  }
};
} // namespace stockwork
