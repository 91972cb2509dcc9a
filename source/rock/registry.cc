#include "stockwork/rock/registry.h"

#include "stockwork/base/error.h"

namespace stockwork
{
void RockLawRegistry::add(const std::string &name, RockLawEntry entry)
{
  if (!entries.emplace(name, std::move(entry)).second)
    throw InputError("Two laws of the rock are called '" + name +
                     "'. Is the same shared library loaded twice?");
}
} // namespace stockwork
