#include "stockwork/base/parameters.h"

#include "base/parameter_tree.h"
#include "stockwork/base/error.h"
#include "stockwork/base/json.h"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <functional>
#include <map>
#include <regex>
#include <sstream>
#include <vector>

namespace stockwork
{
namespace
{
/// Text for a cell of a markdown table.
std::string cell(const std::string &text)
{
  std::istringstream words(text);
  std::string result;
  for (std::string word; words >> word;)
    result += (result.empty() ? "" : " ") + word;
  for (std::size_t i = 0; (i = result.find('|', i)) != std::string::npos; i += 2)
    result.insert(i, "\\");
  return result;
}

std::string code(const std::string &text)
{
  return text.empty() ? "(empty)" : "`" + cell(text) + "`";
}

std::string capitalised(std::string text)
{
  if (!text.empty())
    text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  return text;
}

struct Section
{
  std::string name;
  std::vector<DeclaredEntry> entries;
};

std::vector<Section> sections_of(const dealii::ParameterHandler &prm)
{
  std::vector<Section> sections;
  for (const DeclaredEntry &entry : declared_entries(prm))
    if (entry.alias_of.empty())
    {
      if (sections.empty() || sections.back().name != entry.section)
        sections.push_back({entry.section, {}});
      sections.back().entries.push_back(entry);
    }
  return sections;
}

/// 12 for "Wells/Well 12", 0 without a number.
unsigned int number_of(const std::string &section)
{
  const auto blank = section.rfind(' ');
  if (blank == std::string::npos || blank + 1 == section.size() ||
      section.find_first_not_of("0123456789", blank + 1) != std::string::npos)
    return 0;
  return std::stoul(section.substr(blank + 1));
}

/// The second section continues a numbered series and has the same entries.
bool is_next_alike(const Section &a, const Section &b)
{
  return number_of(a.name) > 0 && number_of(b.name) == number_of(a.name) + 1 &&
         a.name.substr(0, a.name.rfind(' ')) == b.name.substr(0, b.name.rfind(' ')) &&
         std::equal(a.entries.begin(), a.entries.end(), b.entries.begin(), b.entries.end(),
                    [](const DeclaredEntry &x, const DeclaredEntry &y)
                    {
                      return x.name == y.name && x.default_value == y.default_value &&
                             x.pattern == y.pattern && x.documentation == y.documentation;
                    });
}

void print_markdown(const dealii::ParameterHandler &prm, std::ostream &out)
{
  out << "# Parameters\n\n"
         "Printed by `stockwork --print-parameters markdown`. Entries of a section are set between "
         "`subsection NAME` and `end`. Physical values may carry any unit of their dimension; a "
         "bare number is in the SI unit given here.\n";
  const std::vector<Section> sections = sections_of(prm);
  for (std::size_t first = 0; first < sections.size();)
  {
    // Well 1, Well 2, ... are the same but for their number: one table for all.
    std::size_t last = first;
    while (last + 1 < sections.size() && is_next_alike(sections[last], sections[last + 1]))
      ++last;
    out << "\n## " << (sections[first].name.empty() ? "Top level" : sections[first].name);
    if (last > first)
      out << " to " << number_of(sections[last].name);
    out << "\n\n| entry | default | allowed | meaning |\n| --- | --- | --- | --- |\n";
    for (const DeclaredEntry &entry : sections[first].entries)
      out << "| " << cell(entry.name) << " | " << code(entry.default_value) << " | "
          << cell(allowed_text(entry.pattern)) << " | " << cell(capitalised(entry.documentation))
          << " |\n";
    first = last + 1;
  }
}
/// "type" and what limits the value, of a pattern's machine-style description.
void schema_of_pattern(JsonWriter &json, const std::string &pattern)
{
  std::smatch match;
  static const std::regex selection("\\[Selection (.*)\\]"),
    number("\\[(Double|Integer)(?: range)? ?(\\S*?)\\.\\.\\.(\\S*) .*\\]"),
    unit("\\[Quantity (.*) in ([(\\[])([^,]*), ([^)\\]]*)([)\\]])(?: (?!or \")(.+?))?(?: or "
         "\".*\")?\\]");
  if (pattern == "[Bool]")
    json.member("type", "boolean");
  else if (std::regex_match(pattern, match, selection))
  {
    json.member("type", "string");
    json.begin_array("enum");
    std::istringstream in(match[1]);
    for (std::string name; std::getline(in, name, '|');)
      json.element(name);
    json.end_array();
  }
  else if (std::regex_match(pattern, match, number))
  {
    json.member("type", match[1] == "Integer" ? "integer" : "number");
    for (const auto &[key, text] :
         {std::make_pair("minimum", match[2].str()), std::make_pair("maximum", match[3].str())})
      if (!text.empty() && text.find("MAX_") == std::string::npos && text.size() < 9)
        json.member(key, std::stod(text));
  }
  else
  {
    // A number with a unit is a text.
    json.begin_array("type");
    json.element("string");
    json.element("number");
    json.end_array();
    if (std::regex_match(pattern, match, unit))
    {
      json.member("x-quantity", match[1].str());
      json.member("x-unit", match[6].str());
      json.member("x-range",
                  match[2].str() + match[3].str() + ", " + match[4].str() + match[5].str());
    }
  }
}

void print_json_schema(const dealii::ParameterHandler &prm, std::ostream &out)
{
  std::map<std::string, std::vector<DeclaredEntry>> entries;       // by section
  std::map<std::string, std::vector<std::string>> sections_within; // by section
  for (const Section &section : sections_of(prm))
  {
    entries[section.name] = section.entries;
    for (std::string path = section.name; !path.empty();)
    {
      const auto slash = path.rfind('/');
      const std::string parent = slash == std::string::npos ? "" : path.substr(0, slash);
      auto &siblings = sections_within[parent];
      if (std::find(siblings.begin(), siblings.end(), path) == siblings.end())
        siblings.push_back(path);
      path = parent;
    }
  }
  JsonWriter json(out);
  const std::function<void(const std::string &)> print_section = [&](const std::string &path)
  {
    json.member("type", "object");
    json.member("additionalProperties", false);
    json.begin_object("properties");
    for (const DeclaredEntry &entry : entries[path])
    {
      json.begin_object(entry.name);
      json.member("description", capitalised(entry.documentation) +
                                   (entry.documentation.empty() ? "" : " ") +
                                   "Allowed: " + allowed_text(entry.pattern) + ".");
      json.member("default", entry.default_value);
      schema_of_pattern(json, entry.pattern);
      json.end_object();
    }
    for (const std::string &below : sections_within[path])
    {
      json.begin_object(below.substr(below.rfind('/') + 1));
      print_section(below);
      json.end_object();
    }
    json.end_object();
  };
  json.begin_object();
  json.member("$schema", "https://json-schema.org/draft/2020-12/schema");
  json.member("title", "Stockwork deck");
  print_section("");
  json.end_object();
  out << '\n';
}
} // namespace

void print_parameters(const dealii::ParameterHandler &prm,
                      const std::string &format,
                      std::ostream &out)
{
  using Handler = dealii::ParameterHandler;
  const auto style = [](const Handler::OutputStyle format)
  { return Handler::OutputStyle(format | Handler::KeepDeclarationOrder); };
  if (format == "prm")
    prm.print_parameters(out, style(Handler::PRM));
  else if (format == "json")
    prm.print_parameters(out, style(Handler::JSON));
  else if (format == "json-schema")
    print_json_schema(prm, out);
  else if (format == "markdown")
    print_markdown(prm, out);
  else
    throw InputError("'" + format +
                     "' is not a format of parameters; allowed is one of 'prm', "
                     "'json', 'json-schema' or 'markdown'");
}

void write_effective_deck(const dealii::ParameterHandler &prm, const std::string &file)
{
  std::ofstream out(file);
  print_parameters(prm, "prm", out);
  out.close();
  if (!out)
    throw OutputError("cannot write '" + file + "': " + std::strerror(errno));
}
} // namespace stockwork
