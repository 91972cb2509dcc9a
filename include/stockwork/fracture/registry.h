#pragma once

#include "stockwork/fracture/model.h"

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>

namespace stockwork
{
/// Whether a model that has a history, for it overrides commit(), can also take a step back, be
/// saved and loaded, and sum up what has become of the fracture.
template <int dim, class Model>
constexpr bool keeps_what_it_commits()
{
  using Base = FractureModel<dim>;
  // A function that is not overridden is the base's, by its type as well.
  constexpr bool commits = !std::is_same_v<decltype(&Model::commit), decltype(&Base::commit)>;
  return !commits || (!std::is_same_v<decltype(&Model::rollback), decltype(&Base::rollback)> &&
                      !std::is_same_v<decltype(&Model::save), decltype(&Base::save)> &&
                      !std::is_same_v<decltype(&Model::load), decltype(&Base::load)> &&
                      !std::is_same_v<decltype(&Model::summary), decltype(&Base::summary)>);
}

/// A fracture model that has just been made: a pointer to it, and the one place where its own type
/// is known, so that one which would forget its history in silence does not compile.
template <int dim>
class MadeModel
{
public:
  template <class Model>
  MadeModel(std::unique_ptr<Model> model)
    : model(std::move(model))
  {
    static_assert(!std::is_same_v<Model, FractureModel<dim>>,
                  "Let the function that makes a model return its own type, not the interface's.");
    static_assert(keeps_what_it_commits<dim, Model>(),
                  "A fracture model with commit() needs rollback(), save(), load() and summary().");
  }

  operator std::unique_ptr<FractureModel<dim>>() &&
  {
    return std::move(model);
  }

private:
  std::unique_ptr<FractureModel<dim>> model;
};

/// How a fracture model is made. `create_2d` or `create_3d` may be empty where the model does not
/// exist in that dimension.
struct FractureModelEntry
{
  std::string description;
  /// Declare the entries of subsection Fracture/<name>; called inside it.
  std::function<void(dealii::ParameterHandler &)> declare_parameters = [](auto &) {};
  /// Make a model from the entries of that subsection; called inside it.
  std::function<MadeModel<2>(dealii::ParameterHandler &, const Scene<2> &)> create_2d;
  std::function<MadeModel<3>(dealii::ParameterHandler &, const Scene<3> &)> create_3d;
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
