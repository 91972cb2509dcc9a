#pragma once

#include <boost/serialization/set.hpp>
#include <boost/serialization/string.hpp>
#include <boost/serialization/utility.hpp>
#include <boost/serialization/vector.hpp>

#include <set>
#include <string>
#include <utility>
#include <vector>

namespace stockwork::cohesive_xfem
{
/// What keeps cracks from growing. The same on all ranks.
struct GrowthLimits
{
  using Tip = std::pair<unsigned int, unsigned int>; ///< crack, end

  std::vector<bool> has_grown;  ///< by crack
  std::vector<double> volume;   ///< by crack, at the last accepted step [m^2]
  std::string blocked_by;       ///< what stopped a tip last, as told to the user
  std::set<Tip> wait_for_mesh;  ///< tips that need the mesh changed ahead of them
  std::set<Tip> told_of_arrest; ///< tips about which the user has been told that they are arrested

  template <class Archive>
  void serialize(Archive &ar, const unsigned int)
  {
    ar &has_grown &volume &blocked_by &wait_for_mesh &told_of_arrest;
  }
};
} // namespace stockwork::cohesive_xfem
