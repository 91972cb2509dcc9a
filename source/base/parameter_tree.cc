#include "base/parameter_tree.h"

#include "stockwork/base/error.h"
#include "stockwork/base/nearest.h"
#include "stockwork/base/quantity.h"

#include <boost/property_tree/ptree.hpp>

#include <regex>
#include <sstream>

namespace stockwork
{
namespace
{
using Tree = boost::property_tree::ptree;

/// The tree in what a ParameterHandler writes into an archive. It prints the tree as JSON as well;
/// to read that back five times took a fifth of a short run.
struct TreeOfArchive
{
  const Tree *tree = nullptr;

  template <typename Anything>
  void operator&(const Anything &)
  {
  }
  void operator&(const Tree &entries)
  {
    tree = &entries;
  }
};

/// A name as it was declared: the handler's tree has "_20" for a blank, and so on for all but
/// letters and digits.
std::string declared_name(const std::string &name)
{
  std::string text;
  for (std::size_t i = 0; i < name.size(); ++i)
    if (name[i] == '_' && i + 2 < name.size())
    {
      text += static_cast<char>(std::stoi(name.substr(i + 1, 2), nullptr, 16));
      i += 2;
    }
    else
      text += name[i];
  return text;
}

bool is_entry(const Tree &node)
{
  return node.count("value") > 0 && node.count("pattern") > 0 && node.get_child("value").empty() &&
         node.get_child("pattern").empty();
}

bool is_alias(const Tree &node)
{
  return node.count("alias") > 0 && node.get_child("alias").empty();
}

void collect(const Tree &node, const std::string &section, std::vector<DeclaredEntry> &entries)
{
  for (const auto &[name, child] : node)
    if (is_entry(child) || is_alias(child))
    {
      DeclaredEntry entry;
      entry.section = section;
      entry.name = declared_name(name);
      entry.value = child.get("value", "");
      entry.default_value = child.get("default_value", "");
      entry.documentation = child.get("documentation", "");
      entry.pattern = child.get("pattern_description", "");
      entry.alias_of = child.get("alias", "");
      entry.deprecated = child.get("deprecation_status", "") == "true";
      entries.push_back(entry);
    }
  for (const auto &[name, child] : node)
    if (!is_entry(child) && !is_alias(child))
      collect(child, (section.empty() ? "" : section + "/") + declared_name(name), entries);
}

/// "a number", with the ends of deal.II's "MIN...MAX (inclusive)" where they say something.
std::string number_text(const std::string &kind, const std::string &min, const std::string &max)
{
  const auto limited = [](const std::string &bound)
  {
    return !bound.empty() && bound.find("MAX_") == std::string::npos && bound != "-2147483648" &&
           bound != "2147483647";
  };
  if (limited(min) && limited(max))
    return kind + " from " + min + " to " + max;
  if (limited(min))
    return kind + " >= " + min;
  if (limited(max))
    return kind + " <= " + max;
  return kind;
}

std::vector<std::string> alternatives(const std::string &text)
{
  std::vector<std::string> names;
  std::istringstream in(text);
  for (std::string name; std::getline(in, name, '|');)
  {
    const auto first = name.find_first_not_of(' ');
    if (first != std::string::npos)
      names.push_back(name.substr(first, name.find_last_not_of(' ') - first + 1));
  }
  return names;
}
} // namespace

std::vector<DeclaredEntry> declared_entries(const dealii::ParameterHandler &prm)
{
  TreeOfArchive archive;
  prm.save(archive, 0);
  AssertThrow(archive.tree != nullptr, dealii::ExcInternalError());
  std::vector<DeclaredEntry> entries;
  collect(*archive.tree, "", entries);
  return entries;
}

std::string value_of(dealii::ParameterHandler &prm,
                     const std::vector<std::string> &sections,
                     const std::string &name)
{
  for (const std::string &section : sections)
    prm.enter_subsection(section);
  const std::string value = prm.get(name);
  for (std::size_t i = 0; i < sections.size(); ++i)
    prm.leave_subsection();
  return value;
}


std::string allowed_text(const std::string &pattern)
{
  if (const auto quantity = Quantity::create(pattern))
    return quantity->description(Quantity::Text);
  if (const auto quantities = Quantities::create(pattern))
    return quantities->description(Quantities::Text);

  std::smatch match;
  if (pattern == "[Bool]")
    return "true or false";
  if (pattern == "[Anything]")
    return "any text";
  if (pattern.find("[FileName") == 0 || pattern.find("[DirectoryName") == 0)
    return "a file name";
  static const std::regex selection("\\[Selection (.*)\\]"),
    multiple("\\[MultipleSelection (.*)\\]"),
    number("\\[(Double|Integer)(?: range)? ?(\\S*?)\\.\\.\\.(\\S*) .*\\]"),
    list("\\[List of <(.*)> of length (\\d+)\\.\\.\\.(\\d+) \\(inclusive\\)(?: separated by "
         "<(.*)>)?\\]");
  if (std::regex_match(pattern, match, selection))
    return "one of " + quoted_list(alternatives(match[1]), "or");
  if (std::regex_match(pattern, match, multiple))
    return "any of " + quoted_list(alternatives(match[1])) + ", separated by commas";
  if (std::regex_match(pattern, match, number))
    return number_text(match[1] == "Double" ? "a number" : "an integer", match[2], match[3]);
  if (std::regex_match(pattern, match, list))
  {
    const std::string separator = match[4].matched ? match[4].str() : ",";
    std::string text = "a list separated by '" + separator + "'";
    if (match[2] == match[3])
      text += " of " + match[2].str();
    else if (match[3] != "4294967295")
      text += " of " + match[2].str() + " to " + match[3].str();
    else if (match[2] != "0")
      text += " of " + match[2].str() + " or more";
    return text + ", each " + allowed_text(match[1]);
  }
  return pattern;
}

std::string
mismatch_text(const std::string &path, const std::string &value, const std::string &pattern)
{
  try
  {
    if (const auto quantity = Quantity::create(pattern))
      (void)quantity->parse(value);
    else if (const auto quantities = Quantities::create(pattern))
      (void)quantities->parse(value);
  }
  catch (const InputError &error)
  {
    return "'" + path + "': " + error.what();
  }
  std::smatch match;
  static const std::regex selection("\\[Selection (.*)\\]");
  std::string hint;
  if (std::regex_match(pattern, match, selection))
    hint = did_you_mean(value, alternatives(match[1]));
  return EntryError(path, value, allowed_text(pattern)).what() + (hint.empty() ? "" : "; " + hint);
}
} // namespace stockwork
