#pragma once

#include <deal.II/base/parameter_handler.h>

#include <string>
#include <vector>

namespace stockwork
{
/// One declared entry of a ParameterHandler. The handler keeps its tree to itself, but saves it to
/// archives.
struct DeclaredEntry
{
  std::string section; ///< "Section/Sub", empty at the top level
  std::string name;
  std::string value, default_value, documentation;
  std::string pattern;     ///< machine style description of the allowed values
  std::string alias_of;    ///< the entry this one is another name for, or empty
  bool deprecated = false; ///< a deprecated alias

  std::string path() const
  {
    return section.empty() ? name : section + "/" + name;
  }
};

/// All declared entries in the order of their declaration, the entries of a section before its
/// subsections.
std::vector<DeclaredEntry> declared_entries(const dealii::ParameterHandler &prm);

/// The value of an entry in a subsection of the present one.
std::string value_of(dealii::ParameterHandler &prm,
                     const std::vector<std::string> &sections,
                     const std::string &name);

/// What an entry may be, in words, from the machine style description of its pattern.
std::string allowed_text(const std::string &pattern);

/// The error message about an entry whose value does not fit its pattern.
std::string
mismatch_text(const std::string &path, const std::string &value, const std::string &pattern);
} // namespace stockwork
