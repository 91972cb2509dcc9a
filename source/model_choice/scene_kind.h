#pragma once

#include "case.h"
#include "model_choice/charts.h"

#include <string>
#include <vector>

namespace stockwork
{
/// Whose charts hold for a scene: all of these groups have to promise. Empty: nobody's.
struct SceneKind
{
  std::vector<Charts::Group> groups;
  std::string why; ///< they do, or nobody's do
};

template <int dim>
SceneKind kind_of(const Charts &charts, const Case<dim> &the_case);
} // namespace stockwork
