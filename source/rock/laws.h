#pragma once

#include <deal.II/base/parameter_handler.h>

#include "stockwork/rock/registry.h"

#include <map>
#include <memory>

namespace stockwork
{
/// The law of the rock in each region, as `Rock/Law` and `Rock/Region k/Law` choose.
class RockLaws
{
public:
  /// After Rock::declare_parameters().
  static void declare_parameters(dealii::ParameterHandler &prm, const RockLawRegistry &registry);

  /// Read which law each region has, and the rock's constants, which hang on that.
  /// @param regions that the mesh has, besides region 0
  /// @throws EntryError, also for entries of a law that no region has
  void parse_parameters(dealii::ParameterHandler &prm,
                        const RockLawRegistry &registry,
                        const std::vector<dealii::types::material_id> &regions,
                        Rock &rock);

  const RockLaw &operator()(const dealii::types::material_id region) const
  {
    return *laws.at(region);
  }

  /// Name of the law in a region.
  const std::string &name(const dealii::types::material_id region) const
  {
    return names.at(region);
  }

  /// Whether all rock is linear whatever happens.
  bool are_linear() const;

  /// Whether any rock has a history.
  bool may_yield() const;

  /// By region, 0 for the rock at large.
  const std::map<dealii::types::material_id, std::unique_ptr<RockLaw>> &all() const
  {
    return laws;
  }

private:
  /// What is said of a law that no rock has would be dropped.
  void refuse_unused(dealii::ParameterHandler &prm, const RockLawRegistry &registry) const;

  std::map<dealii::types::material_id, std::unique_ptr<RockLaw>> laws;
  std::map<dealii::types::material_id, std::string> names;
};
} // namespace stockwork
