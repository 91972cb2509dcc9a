#include "base/deck_reader.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace stockwork
{
namespace
{
std::string trim(const std::string &text)
{
  const auto first = text.find_first_not_of(" \t\r\n");
  return first == std::string::npos
           ? ""
           : text.substr(first, text.find_last_not_of(" \t\r\n") - first + 1);
}

/// Runs of blanks become one, as in ParameterHandler.
std::string single_blanks(const std::string &text)
{
  std::istringstream words(text);
  std::string result;
  for (std::string word; words >> word;)
    result += (result.empty() ? "" : " ") + word;
  return result;
}

/// If the line begins with the keyword (in any case), what follows it.
bool accept_keyword(const std::string &line, const std::string &keyword, std::string &rest)
{
  if (line.size() < keyword.size() ||
      !std::equal(keyword.begin(), keyword.end(), line.begin(),
                  [](char k, char c) { return k == std::tolower(static_cast<unsigned char>(c)); }))
    return false;
  if (line.size() > keyword.size() && line[keyword.size()] != ' ' && line[keyword.size()] != '\t')
    return false;
  rest = trim(line.substr(keyword.size()));
  return true;
}

std::string joined(const std::vector<std::string> &sections)
{
  std::string path;
  for (const std::string &section : sections)
    path += (path.empty() ? "" : "/") + section;
  return path;
}
} // namespace

void DeckReader::error(const Origin &origin, const std::string &message)
{
  errors.push_back(origin.text() + ": " + message);
}

void DeckReader::read_file(const std::string &name)
{
  const std::filesystem::path path(name);
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored))
    errors.push_back("the deck '" + name + "' does not exist");
  else if (std::filesystem::is_directory(path, ignored))
    errors.push_back("the deck '" + name + "' is a directory; a .prm file is expected");
  else if (std::ifstream in(name); !in)
    errors.push_back("the deck '" + name + "' cannot be read");
  else
  {
    open_files.push_back(std::filesystem::weakly_canonical(path).string());
    read_stream(in, name);
    open_files.pop_back();
  }
}

void DeckReader::read_stream(std::istream &in, const std::string &name)
{
  const std::size_t outer_depth = sections.size();
  unsigned int number = 0;
  std::string line, pending;
  unsigned int pending_line = 0;
  while (std::getline(in, line))
  {
    ++number;
    // A comment ends the line, but not the continuation that the line is part of.
    const auto comment = line.find('#');
    const bool has_comment = comment != std::string::npos;
    line = trim(line.substr(0, comment));
    if (pending.empty())
      pending_line = number;
    else if (line.empty() && has_comment)
      continue;
    const bool continued = !line.empty() && line.back() == '\\';
    if (continued)
      line.pop_back();
    pending += line;
    if (continued)
    {
      if (pending.empty())
        pending = " ";
      continue;
    }
    read_line(trim(pending), {name, pending_line, false});
    pending.clear();
  }
  if (!trim(pending).empty())
    error({name, pending_line, false}, "the last line is continued by a '\\', but the file ends");
  if (sections.size() > outer_depth)
    error({name, number, false},
          "the file ends inside subsection '" + joined(sections) + "'; an 'end' is missing");
  sections.resize(std::min(sections.size(), outer_depth));
}

void DeckReader::read_line(const std::string &line, const Origin &origin)
{
  std::string rest;
  if (line.empty())
    return;
  if (accept_keyword(line, "subsection", rest))
  {
    if (rest.empty())
      error(origin, "a subsection needs a name");
    sections.push_back(single_blanks(rest));
    lines.push_back({DeckLine::Kind::section, joined(sections), "", origin});
  }
  else if (accept_keyword(line, "end", rest))
  {
    if (!rest.empty())
      error(origin, "'end' stands alone on its line, here it is followed by '" + rest + "'");
    if (sections.empty())
      error(origin, "'end' without a subsection");
    else
      sections.pop_back();
  }
  else if (accept_keyword(line, "include", rest))
    include(rest, origin);
  else if (accept_keyword(line, "set", rest))
  {
    const auto equal = rest.find('=');
    const std::string name = single_blanks(rest.substr(0, equal));
    if (equal == std::string::npos || name.empty())
    {
      error(origin, "'" + line + "' is not of the form 'set Entry = value'");
      return;
    }
    const std::string section = joined(sections);
    lines.push_back({DeckLine::Kind::entry, section.empty() ? name : section + "/" + name,
                     single_blanks(rest.substr(equal + 1)), origin});
  }
  else
    error(origin, "'" + line +
                    "' is not understood; a line begins with set, subsection, end, include or #");
}

void DeckReader::include(const std::string &name, const Origin &origin)
{
  namespace fs = std::filesystem;
  if (name.empty())
    return error(origin, "'include' needs a file name");

  const fs::path file = fs::path(name).is_absolute()
                          ? fs::path(name)
                          : fs::path(origin.file).parent_path() / fs::path(name);
  const std::string shown = file.lexically_normal().string();
  const std::string canonical = fs::weakly_canonical(file).string();
  if (std::find(open_files.begin(), open_files.end(), canonical) != open_files.end())
    return error(origin, "include of '" + name + "' is a cycle: that file is being read already");
  std::ifstream in(file);
  if (!in || fs::is_directory(file))
    return error(origin, "the included file '" + name + "' " +
                           (fs::exists(file) ? "cannot be read" : "does not exist") +
                           " (looked for '" + shown +
                           "'; an include is relative to the file it stands in)");
  open_files.push_back(canonical);
  read_stream(in, shown);
  open_files.pop_back();
}
} // namespace stockwork
