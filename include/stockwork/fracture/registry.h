#pragma once

#include "stockwork/fracture/model.h"

#include <functional>
#include <map>
#include <memory>
#include <string>

namespace stockwork
{
/// How a fracture model is made. `create_2d` or `create_3d` may be empty where the model does not
/// exist in that dimension.
struct FractureModelEntry
{
  std::string description;
  /// Declare the entries of subsection Fracture/<name>; called inside it.
  std::function<void(dealii::ParameterHandler &)> declare_parameters = [](auto &) {};
  /// Make a model from the entries of that subsection; called inside it.
  std::function<std::unique_ptr<FractureModel<2>>(dealii::ParameterHandler &, const Scene<2> &)>
    create_2d;
  std::function<std::unique_ptr<FractureModel<3>>(dealii::ParameterHandler &, const Scene<3> &)>
    create_3d;
};

/// All known fracture models, by name. Each folder of source/fracture/ has a function
/// `register_model(FractureModelRegistry &)` in the namespace named after the folder; the build
/// writes the list. A shared library loaded at run time exports the C function
/// `stockwork_register(stockwork::FractureModelRegistry &)`.
class FractureModelRegistry
{
public:
  /// Throws InputError when the name is taken.
  void add(const std::string &name, FractureModelEntry entry);

  /// Throws InputError naming the known models.
  const FractureModelEntry &find(const std::string &name) const;

  const std::map<std::string, FractureModelEntry> &all() const
  {
    return entries;
  }

private:
  std::map<std::string, FractureModelEntry> entries;
};
} // namespace stockwork
