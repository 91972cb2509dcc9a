#include "stockwork/base/deck.h"

#include "base/deck_reader.h"
#include "base/parameter_tree.h"
#include "stockwork/base/error.h"
#include "stockwork/base/nearest.h"
#include "stockwork/base/quantity.h"

#include <algorithm>
#include <filesystem>
#include <sstream>

namespace stockwork
{
namespace
{
const std::string resolution_entry = "Resolution", model_entry = "Fracture/Model";

const std::vector<std::string> &resolutions()
{
  static const std::vector<std::string> names = {"coarse", "medium", "fine"};
  return names;
}

[[noreturn]] void throw_all(const std::string &file, const std::vector<std::string> &errors)
{
  std::string text =
    errors.size() == 1 ? errors[0] : std::to_string(errors.size()) + " errors in '" + file + "':";
  if (errors.size() > 1)
    for (const std::string &error : errors)
      text += "\n  " + error;
  throw InputError(text);
}

std::string section_of(const std::string &path)
{
  const auto slash = path.rfind('/');
  return slash == std::string::npos ? "" : path.substr(0, slash);
}

std::string name_of(const std::string &path)
{
  return path.substr(path.rfind('/') + 1);
}

/// Replace each {a|b|c} by its alternative.
std::string expand(const std::string &value, const unsigned int alternative)
{
  std::string result;
  std::size_t position = 0;
  for (auto open = value.find('{'); open != std::string::npos; open = value.find('{', position))
  {
    const auto close = value.find('}', open);
    if (close == std::string::npos)
      throw InputError("a '}' is missing in '" + value + "'");
    std::vector<std::string> parts(1);
    for (const char c : value.substr(open + 1, close - open - 1))
      if (c == '|')
        parts.emplace_back();
      else
        parts.back() += c;
    if (parts.size() != resolutions().size())
      throw InputError("'" + value.substr(open, close - open + 1) + "' has " +
                       std::to_string(parts.size()) +
                       " alternatives; three are expected: {coarse|medium|fine}");
    std::string part = parts[alternative];
    part.erase(0, part.find_first_not_of(' '));
    part.erase(part.find_last_not_of(' ') + 1);
    result += value.substr(position, open - position) + part;
    position = close + 1;
  }
  return result + value.substr(position);
}

/// "'a', 'b', ..." of a list that may be long.
std::string shortened_list(std::vector<std::string> names)
{
  const std::size_t most = 12;
  const bool many = names.size() > most;
  if (many)
    names.resize(most);
  return quoted_list(names) + (many ? " and others" : "");
}

/// What the deck's author may have meant by an entry that does not exist: the nearest names of
/// the same section, or the same or nearly the same name elsewhere.
std::string hint_for_entry(const std::string &path, const std::vector<DeclaredEntry> &declared)
{
  std::vector<std::string> here, elsewhere, paths;
  std::map<std::string, std::string> path_by_name;
  for (const DeclaredEntry &entry : declared)
  {
    if (entry.deprecated)
      continue;
    paths.push_back(entry.path());
    if (entry.section == section_of(path))
      here.push_back(entry.name);
    else if (edit_distance(entry.name, name_of(path)) <= 1)
      elsewhere.push_back(entry.path());
  }
  std::vector<std::string> hints = nearest_names(name_of(path), here);
  if (hints.empty())
    hints = elsewhere.empty() ? nearest_names(path, paths) : elsewhere;
  if (hints.size() > 3)
    hints.resize(3);
  if (!hints.empty())
    return "did you mean " + quoted_list(hints, "or") + "?";
  if (here.empty())
    return "";
  return "the section has " + shortened_list(here);
}

std::string hint_for_section(const std::string &path, const std::vector<std::string> &sections)
{
  const std::string hint = did_you_mean(path, sections);
  if (!hint.empty())
    return "; " + hint;
  std::vector<std::string> siblings;
  for (const std::string &section : sections)
    if (section_of(section) == section_of(path))
      siblings.push_back(name_of(section));
  return siblings.empty() ? "" : "; there are " + shortened_list(siblings);
}

/// Leaves the entered subsections also when an exception passes.
class EnteredSections
{
public:
  EnteredSections(dealii::ParameterHandler &prm, const std::string &path)
    : prm(prm)
  {
    std::istringstream in(path);
    for (std::string section; std::getline(in, section, '/'); ++depth)
      prm.enter_subsection(section);
  }
  ~EnteredSections()
  {
    for (; depth > 0; --depth)
      prm.leave_subsection();
  }

private:
  dealii::ParameterHandler &prm;
  unsigned int depth = 0;
};
} // namespace

std::string Origin::text() const
{
  if (command_line)
    return "command line";
  if (file.empty())
    return "default value";
  return file + ":" + std::to_string(line);
}

Deck Deck::read(const std::string &file, const std::vector<std::string> &overrides)
{
  return read(file, overrides, Choice());
}

Deck Deck::read(const std::string &file,
                const std::vector<std::string> &overrides,
                const Choice &choice)
{
  DeckReader reader;
  reader.read_file(file);
  if (!choice.part.empty())
    reader.read_file(choice.part);
  return from_reader(reader, file, overrides, choice);
}

Deck Deck::read_text(const std::string &text,
                     const std::string &name,
                     const std::vector<std::string> &overrides)
{
  DeckReader reader;
  std::istringstream in(text);
  reader.read_stream(in, name);
  return from_reader(reader, name, overrides, Choice());
}

Deck Deck::from_reader(const DeckReader &reader,
                       const std::string &file,
                       const std::vector<std::string> &overrides,
                       const Choice &choice)
{
  Deck deck;
  std::vector<std::string> errors = reader.errors;
  deck.file_name = file;
  for (const DeckLine &line : reader.lines)
    if (line.kind == DeckLine::Kind::section)
      deck.sections.emplace(line.path, line.origin);
    else
      deck.entries[line.path] = {line.value, line.origin};
  deck.read_overrides(overrides, errors);
  if (!choice.model.empty())
    deck.entries[model_entry].value = choice.model;
  if (!choice.resolution.empty())
    deck.entries[resolution_entry].value = choice.resolution;
  deck.expand_alternatives(errors);
  if (!errors.empty())
    throw_all(file, errors);
  return deck;
}

void Deck::read_overrides(const std::vector<std::string> &overrides,
                          std::vector<std::string> &errors)
{
  for (const std::string &text : overrides)
  {
    if (const std::string why = why_not_text(text); !why.empty() || text.size() > 10000)
    {
      errors.push_back("command line: --set '" + text.substr(0, 40) +
                       "': " + (why.empty() ? "the value is longer than 10000 characters" : why));
      continue;
    }
    const auto equal = text.find('=');
    const auto trim = [](std::string part)
    {
      part.erase(0, part.find_first_not_of(" \t"));
      part.erase(part.find_last_not_of(" \t") + 1);
      return part;
    };
    if (equal == std::string::npos || trim(text.substr(0, equal)).empty())
    {
      errors.push_back("command line: --set '" + text +
                       "' is not of the form 'Section/Entry=value'");
      continue;
    }
    std::string path;
    std::istringstream in(text.substr(0, equal));
    for (std::string part; std::getline(in, part, '/');)
      path += (path.empty() ? "" : "/") + trim(part);
    entries[path] = {trim(text.substr(equal + 1)), {"", 0, true}};
  }
}

void Deck::expand_alternatives(std::vector<std::string> &errors)
{
  std::string resolution = "medium";
  const auto given = entries.find(resolution_entry);
  if (given != entries.end())
    resolution = given->second.value;
  if (resolution == "auto") // to be chosen; until then
    resolution = "medium";
  const auto found = std::find(resolutions().begin(), resolutions().end(), resolution);
  if (found == resolutions().end())
  {
    errors.push_back(given->second.origin.text() + ": '" + resolution_entry + "' is '" +
                     resolution + "'; allowed is one of " + quoted_list(resolutions(), "or") +
                     ", or 'auto'");
    return;
  }
  for (auto &[path, entry] : entries)
    try
    {
      entry.value = expand(entry.value, found - resolutions().begin());
    }
    catch (const InputError &error)
    {
      errors.push_back(entry.origin.text() + ": '" + path + "': " + error.what());
    }
}

void Deck::declare_parameters(dealii::ParameterHandler &prm)
{
  prm.declare_entry(resolution_entry, "medium",
                    dealii::Patterns::Selection("auto|coarse|medium|fine"),
                    "Which of the three alternatives of every value written as {a|b|c} is taken: "
                    "the first for coarse, the second for medium, the third for fine. auto: the "
                    "cheapest for which the charts that ship promise Accuracy.");
}

std::optional<std::string> Deck::peek(const std::string &path) const
{
  const auto entry = entries.find(path);
  if (entry == entries.end())
    return std::nullopt;
  return entry->second.value;
}

void Deck::parse_into(dealii::ParameterHandler &prm) const
{
  const std::vector<DeclaredEntry> declared = declared_entries(prm);
  std::map<std::string, const DeclaredEntry *> by_path;
  std::vector<std::string> section_names;
  for (const DeclaredEntry &entry : declared)
  {
    by_path[entry.path()] = &entry;
    for (std::string s = entry.section; !s.empty(); s = section_of(s))
      if (std::find(section_names.begin(), section_names.end(), s) == section_names.end())
        section_names.push_back(s);
  }
  const auto is_section = [&](const std::string &path)
  {
    return path.empty() ||
           std::find(section_names.begin(), section_names.end(), path) != section_names.end();
  };

  std::vector<std::pair<Origin, std::string>> errors;
  for (const auto &[path, origin] : sections)
    if (!is_section(path) && is_section(section_of(path)))
      errors.emplace_back(origin, "there is no section '" + path + "'" +
                                    hint_for_section(path, section_names));

  for (const auto &[path, given] : entries)
  {
    const auto found = by_path.find(path);
    if (found == by_path.end())
    {
      // The unknown section has been reported once for all its entries.
      if (!is_section(section_of(path)) && !given.origin.command_line)
        continue;
      const std::string hint = hint_for_entry(path, declared);
      errors.emplace_back(given.origin,
                          "there is no entry '" + path + "'" + (hint.empty() ? "" : "; " + hint));
      continue;
    }
    const DeclaredEntry &entry = *found->second;
    const DeclaredEntry *target =
      entry.alias_of.empty()
        ? &entry
        : by_path.at(entry.section.empty() ? entry.alias_of : entry.section + "/" + entry.alias_of);
    if (entry.deprecated)
    {
      errors.emplace_back(given.origin, "'" + path + "' is now called '" + target->path() + "'");
      continue;
    }
    try
    {
      const EnteredSections entered(prm, target->section);
      prm.set(target->name, given.value);
    }
    catch (const dealii::ParameterHandler::ExcValueDoesNotMatchPattern &)
    {
      errors.emplace_back(given.origin, mismatch_text(path, given.value, target->pattern));
    }
  }

  if (!errors.empty())
  {
    std::stable_sort(
      errors.begin(), errors.end(),
      [](const auto &a, const auto &b)
      { return std::tie(a.first.file, a.first.line) < std::tie(b.first.file, b.first.line); });
    std::vector<std::string> texts;
    for (const auto &[origin, text] : errors)
      texts.push_back(origin.text() + ": " + text);
    throw_all(file_name, texts);
  }
}

Origin Deck::origin(const std::string &path) const
{
  const auto entry = entries.find(path);
  return entry == entries.end() ? Origin() : entry->second.origin;
}

std::string Deck::located(const EntryError &error) const
{
  // An entry that is missing: where its section begins, or the deck.
  Origin place = origin(error.path());
  for (std::string path = section_of(error.path());
       place.file.empty() && !place.command_line && !path.empty(); path = section_of(path))
    if (const auto section = sections.find(path); section != sections.end())
      place = section->second;
  if (place.file.empty() && !place.command_line)
    place = {file_name, 1, false};
  return place.text() + ": " + error.what();
}

std::string Deck::name() const
{
  namespace fs = std::filesystem;
  const fs::path path = fs::absolute(file_name).lexically_normal().replace_extension();
  // From the last folder "prm" on, or else the file and its folder.
  fs::path name;
  bool found = false;
  for (const fs::path &part : path)
    if (part == "prm")
    {
      name.clear();
      found = true;
    }
    else
      name /= part;
  return found ? name.string() : path.filename().string();
}

std::string comparable_text(const dealii::ParameterHandler &prm,
                            const std::vector<std::string> &excluded)
{
  std::vector<std::string> lines;
  for (const DeclaredEntry &entry : declared_entries(prm))
  {
    const std::string path = entry.path();
    if (!entry.alias_of.empty() || std::any_of(excluded.begin(), excluded.end(),
                                               [&](const std::string &exclusion) {
                                                 return path == exclusion ||
                                                        path.compare(0, exclusion.size() + 1,
                                                                     exclusion + "/") == 0;
                                               }))
      continue;
    std::ostringstream value;
    value.precision(17);
    const auto quantity = Quantity::create(entry.pattern);
    if (quantity && !quantity->is_word(entry.value))
      value << quantity->parse(entry.value);
    else
      value << entry.value;
    lines.push_back(path + "=" + value.str());
  }
  std::sort(lines.begin(), lines.end());
  std::string text;
  for (const std::string &line : lines)
    text += line + '\n';
  return text;
}

std::uint64_t fingerprint(const dealii::ParameterHandler &prm,
                          const std::vector<std::string> &excluded)
{
  std::uint64_t hash = 14695981039346656037ull; // FNV-1a, 64 bit
  for (const unsigned char c : comparable_text(prm, excluded))
    hash = (hash ^ c) * 1099511628211ull;
  return hash;
}

std::string difference(const std::string &before, const std::string &now)
{
  const auto entries = [](const std::string &text)
  {
    std::map<std::string, std::string> values;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);)
      values[line.substr(0, line.find('='))] = line.substr(line.find('=') + 1);
    return values;
  };
  const auto shown = [](const std::map<std::string, std::string> &values, const std::string &path)
  {
    const auto value = values.find(path);
    return value == values.end()   ? std::string("not there")
           : value->second.empty() ? std::string("empty")
                                   : "'" + value->second.substr(0, 60) + "'";
  };
  const auto old = entries(before), young = entries(now);
  std::map<std::string, std::string> all = old;
  all.insert(young.begin(), young.end());
  std::string text;
  unsigned int n = 0;
  for (const auto &[path, value] : all)
    if (shown(old, path) != shown(young, path) && ++n <= 5)
      text += (n > 1 ? "; '" : "'") + path + "' was " + shown(old, path) + " and is now " +
              shown(young, path);
  return n > 5 ? text + "; and " + std::to_string(n - 5) + " more" : text;
}
} // namespace stockwork
