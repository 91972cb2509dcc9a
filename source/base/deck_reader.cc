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

/// Beyond these, a deck is a slip of the pen or worse.
constexpr unsigned int max_files = 1000, max_lines = 200000, max_depth = 20, max_errors = 50;
constexpr std::size_t max_value = 10000, max_line = 100000;

/// First byte that cannot belong to a text in UTF-8, if any (RFC 3629).
std::string::size_type find_not_utf8(const std::string &text)
{
  for (std::size_t i = 0; i < text.size();)
  {
    const unsigned char c = text[i];
    const unsigned int length = c < 0x80                ? 1
                                : c >= 0xc2 && c < 0xe0 ? 2
                                : c >= 0xe0 && c < 0xf0 ? 3
                                : c >= 0xf0 && c < 0xf5 ? 4
                                                        : 0;
    if (length == 0 || i + length > text.size() || (c < 0x20 && c != '\t' && c != '\r'))
      return i;
    for (unsigned int k = 1; k < length; ++k)
      if ((static_cast<unsigned char>(text[i + k]) & 0xc0) != 0x80)
        return i;
    const unsigned char next = length > 1 ? text[i + 1] : 0;
    if ((c == 0xe0 && next < 0xa0) || (c == 0xed && next > 0x9f) || (c == 0xf0 && next < 0x90) ||
        (c == 0xf4 && next > 0x8f))
      return i;
    i += length;
  }
  return std::string::npos;
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
  if (errors.size() < max_errors)
    errors.push_back(origin.text() + ": " + message);
  else if (errors.size() == max_errors)
    errors.push_back(origin.text() + ": and so on; mend these first");
}

std::string why_not_text(const std::string &text)
{
  const auto bad = find_not_utf8(text);
  if (bad == std::string::npos)
    return "";
  std::ostringstream why;
  why << "character " << bad + 1 << " is the byte 0x" << std::hex
      << static_cast<unsigned int>(static_cast<unsigned char>(text[bad]))
      << ", which is not text in UTF-8; save the deck as UTF-8 (or plain ASCII)";
  return why.str();
}

bool DeckReader::is_file(const std::string &name,
                         const std::string &shown,
                         const std::string &prefix)
{
  // A device or pipe would be waited for, or never end.
  namespace fs = std::filesystem;
  std::error_code code;
  const auto status = fs::status(name, code);
  const std::string what = !fs::exists(status)        ? "does not exist"
                           : fs::is_directory(status) ? "is a directory; a .prm file is expected"
                           : !fs::is_regular_file(status)
                             ? "is a device or pipe; a .prm file is expected"
                           : !std::ifstream(name) ? "cannot be read"
                                                  : "";
  if (!what.empty())
    errors.push_back(prefix + "'" + shown + "' " + what);
  return what.empty();
}

void DeckReader::read_file(const std::string &name)
{
  if (!is_file(name, name, "the deck "))
    return;
  std::ifstream in(name);
  open_files.push_back(std::filesystem::weakly_canonical(name).string());
  read_stream(in, name);
  open_files.pop_back();
  if (errors.empty() &&
      std::none_of(lines.begin(), lines.end(),
                   [](const DeckLine &line) { return line.kind == DeckLine::Kind::entry; }))
    errors.push_back(name + ":1: the deck is empty: no line says 'set Entry = value'");
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
    if (++n_lines > max_lines)
    {
      if (n_lines == max_lines + 1)
        error({name, number, false}, "the deck has more than " + std::to_string(max_lines) +
                                       " lines, those of its includes counted");
      break;
    }
    if (number == 1 && line.compare(0, 3, "\xef\xbb\xbf") == 0)
      line.erase(0, 3); // the mark that some editors write
    if (const std::string why = why_not_text(line); !why.empty())
    {
      error({name, number, false}, why);
      continue;
    }
    if (line.size() + pending.size() > max_line)
    {
      error({name, number, false},
            "the line is longer than " + std::to_string(max_line) + " characters");
      pending.clear();
      continue;
    }
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
    if (sections.size() > max_depth)
    {
      if (sections.size() == max_depth + 1)
        error(origin, "subsections are nested more than " + std::to_string(max_depth) + " deep");
      return;
    }
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
    if (rest.size() - equal > max_value)
    {
      error(origin, "the value of '" + name.substr(0, 100) + "' is longer than " +
                      std::to_string(max_value) + " characters");
      return;
    }
    const std::string section = joined(sections);
    lines.push_back({DeckLine::Kind::entry, section.empty() ? name : section + "/" + name,
                     single_blanks(rest.substr(equal + 1)), origin});
  }
  else
    error(origin, "'" + (line.size() > 200 ? line.substr(0, 200) + "..." : line) +
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
  std::error_code no_such_path;
  const std::string canonical = fs::weakly_canonical(file, no_such_path).string();
  if (std::find(open_files.begin(), open_files.end(), canonical) != open_files.end())
    return error(origin, "include of '" + name + "' is a cycle: that file is being read already");
  std::error_code code;
  if (!fs::is_regular_file(fs::status(file, code)) || !std::ifstream(file))
    return error(
      origin,
      "the included file '" + name + "' " +
        (!fs::exists(fs::status(file, code)) ? "does not exist"
         : fs::is_regular_file(fs::status(file, code)) || fs::is_directory(fs::status(file, code))
           ? "cannot be read"
           : "is a device or pipe") +
        " (looked for '" + shown + "'; an include is relative to the file it stands in)");
  if (++n_files > max_files)
  {
    if (n_files == max_files + 1)
      error(origin, "the deck includes more than " + std::to_string(max_files) + " files");
    return;
  }
  std::ifstream in(file);
  open_files.push_back(canonical);
  read_stream(in, shown);
  open_files.pop_back();
}
} // namespace stockwork
