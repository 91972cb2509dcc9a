#pragma once

#include <deal.II/base/parameter_handler.h>

#include "stockwork/rock/law.h"
#include "stockwork/rock/rock.h"

#include <functional>
#include <map>
#include <memory>
#include <string>

namespace stockwork
{
/// How a law of the rock is made.
struct RockLawEntry
{
  std::string description;

  /// Declare the entries of subsection Rock/<name>; called inside it. An entry that a law cannot
  /// do without has an empty default.
  std::function<void(dealii::ParameterHandler &)> declare_parameters = [](auto &) {};

  /// Of linear rock that is not isotropic: its stiffness in the axes of the run [Pa], from the same
  /// entries and from the normal of the layers and the plane state among the properties; the rest
  /// of them is not known yet. Such a law has nothing else to do. Empty: isotropic in its linear
  /// range, with Rock/Young modulus and Rock/Poisson ratio.
  std::function<dealii::SymmetricTensor<4, 3>(
    const dealii::ParameterHandler &prm, const std::string &path, const RockProperties &)>
    stiffness;

  /// Make the law of one region from those entries, the region's own where it has some.
  /// @param path of the subsection, for messages
  /// @throws EntryError
  std::function<std::unique_ptr<RockLaw>(
    const dealii::ParameterHandler &prm, const std::string &path, const RockProperties &)>
    create;
};

/// All known laws of the rock, by name. Each folder of source/rock/ has a function
/// `register_law(RockLawRegistry &)` in the namespace named after the folder; the build writes the
/// list. A shared library loaded at run time exports the C function
/// `stockwork_register_rock_laws(stockwork::RockLawRegistry &)`.
class RockLawRegistry
{
public:
  /// Throws InputError when the name is taken.
  void add(const std::string &name, RockLawEntry entry);

  const std::map<std::string, RockLawEntry> &all() const
  {
    return entries;
  }

private:
  std::map<std::string, RockLawEntry> entries;
};
} // namespace stockwork
