#pragma once

#include <deal.II/base/parameter_handler.h>

#include "stockwork/base/error.h"

#include <string>

namespace stockwork
{
/// Call @p interpret on an entry and turn what it throws into an error that names the entry.
template <class Interpret>
auto interpret_entry(const dealii::ParameterHandler &prm,
                     const std::string &section,
                     const std::string &entry,
                     const std::string &allowed,
                     const Interpret &interpret)
{
  const std::string text = prm.get(entry);
  try
  {
    return interpret(text);
  }
  catch (const InputError &error)
  {
    throw EntryError(section + "/" + entry, text, allowed + " (" + error.what() + ")");
  }
}
} // namespace stockwork
