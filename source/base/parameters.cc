#include "stockwork/base/parameters.h"

#include "base/parameter_tree.h"
#include "stockwork/base/error.h"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <fstream>
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
  else if (format == "markdown")
    print_markdown(prm, out);
  else
    throw InputError("'" + format +
                     "' is not a format of parameters; allowed is one of 'prm', "
                     "'json' or 'markdown'");
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
