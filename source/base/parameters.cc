#include "stockwork/base/parameters.h"

#include "base/parameter_tree.h"
#include "stockwork/base/error.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>

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

void print_markdown(const dealii::ParameterHandler &prm, std::ostream &out)
{
  out << "# Parameters\n\n"
         "Printed by `stockwork --print-parameters markdown`. Entries of a section are set between "
         "`subsection NAME` and `end`. Physical values may carry any unit of their dimension; a "
         "bare number is in the SI unit given here.\n";
  std::string section = "none yet";
  for (const DeclaredEntry &entry : declared_entries(prm))
  {
    if (!entry.alias_of.empty())
      continue;
    if (entry.section != section)
    {
      section = entry.section;
      out << "\n## " << (section.empty() ? "Top level" : section)
          << "\n\n| entry | default | allowed | meaning |\n| --- | --- | --- | --- |\n";
    }
    out << "| " << cell(entry.name) << " | " << code(entry.default_value) << " | "
        << cell(allowed_text(entry.pattern)) << " | " << cell(capitalised(entry.documentation))
        << " |\n";
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
