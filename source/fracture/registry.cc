#include "stockwork/fracture/registry.h"

#include "stockwork/base/error.h"
#include "stockwork/base/nearest.h"

namespace stockwork
{
void FractureModelRegistry::add(const std::string &name, FractureModelEntry entry)
{
  if (!entries.emplace(name, std::move(entry)).second)
    throw InputError("Two fracture models are called '" + name +
                     "'. Is the same shared library loaded twice?");
}


const FractureModelEntry &FractureModelRegistry::find(const std::string &name) const
{
  const auto position = entries.find(name);
  if (position == entries.end())
  {
    std::string known;
    for (const auto &entry : entries)
      known += (known.empty() ? "" : ", ") + entry.first;
    throw EntryError("Fracture/Model", name, "one of " + known);
  }
  return position->second;
}
} // namespace stockwork
