#include "stockwork/base/statistics.h"

#include "stockwork/base/error.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace stockwork
{
namespace
{
const std::string time_column = "time";

std::vector<std::string> split(const std::string &line, const char separator)
{
  std::vector<std::string> parts;
  std::istringstream in(line);
  for (std::string part; std::getline(in, part, separator);)
    parts.push_back(part);
  return parts;
}

/// The shortest text that is read back as the same number: a restarted run writes the same file.
std::string exact_text(const double value)
{
  char text[32];
  for (int digits = 15; digits <= 17; ++digits)
  {
    std::snprintf(text, sizeof(text), "%.*g", digits, value);
    if (std::strtod(text, nullptr) == value)
      break;
  }
  return text;
}
} // namespace

std::string unit_of_column(const std::string &name, const unsigned int dim)
{
  static const struct
  {
    const char *word, *in_2d, *in_3d;
  } units[] = {{"error", "", ""},
               {"length", "m", "m^2"},
               {"extent", "m", "m"},
               {"radius", "m", "m"},
               {"displacement", "m", "m"},
               {"aperture", "m", "m"},
               {"pressure", "Pa", "Pa"},
               {"volume", "m^2", "m^3"},
               {"rate", "m^2/s", "m^3/s"},
               {"energy", "J/m", "J"},
               {"work", "J/m", "J"},
               {"load", "N/m", "N"},
               {"stress_intensity", "Pa m^(1/2)", "Pa m^(1/2)"},
               {"angle", "rad", "rad"},
               {"time", "s", "s"}};
  for (const auto &unit : units)
    if (name.find(unit.word) != std::string::npos)
      return dim == 2 ? unit.in_2d : unit.in_3d;
  return "";
}


void StatisticsTable::open(const std::string &file)
{
  file_name = file;
  rewrite();
}

void StatisticsTable::continue_from(const std::string &file, const double time)
{
  file_name = file;
  std::ifstream in(file);
  // "# time [s], fracture_length [m]", then the names alone, then the rows.
  std::string comment, header_line;
  if (in && std::getline(in, comment) && std::getline(in, header_line))
  {
    const auto kept_names = split(header_line, ',');
    const auto described = split(comment.substr(comment.find_first_not_of("# ")), ',');
    for (std::size_t i = 0; i < kept_names.size(); ++i)
    {
      const auto open = i < described.size() ? described[i].find('[') : std::string::npos;
      column_index(kept_names[i],
                   open == std::string::npos
                     ? ""
                     : described[i].substr(open + 1, described[i].rfind(']') - open - 1));
    }
    const std::size_t time_index = column_index(time_column, "s");
    for (std::string row; std::getline(in, row);)
    {
      const auto cells = split(row, ',');
      // A row without its time was cut off by the crash.
      if (time_index >= cells.size() || cells[time_index].empty() ||
          std::stod(cells[time_index]) > time * (1 + 1e-12))
        continue;
      rows.push_back(row);
      last_row.clear();
      for (std::size_t i = 0; i < cells.size() && i < names.size(); ++i)
        if (!cells[i].empty())
          last_row[names[i]] = std::stod(cells[i]);
    }
    in.close();
  }
  rewrite();
}

std::size_t StatisticsTable::column_index(const std::string &name, const std::string &unit)
{
  for (std::size_t i = 0; i < names.size(); ++i)
    if (names[i] == name)
      return i;
  names.push_back(name);
  units.push_back(unit);
  header_is_current = false;
  return names.size() - 1;
}

void StatisticsTable::set(const std::string &column, const double value, const std::string &unit)
{
  current[column_index(column, unit)] = value;
}

void StatisticsTable::end_row()
{
  std::string row;
  for (std::size_t i = 0; i < names.size(); ++i)
  {
    const auto cell = current.find(i);
    row += (i > 0 ? "," : "");
    if (cell != current.end() && std::isfinite(cell->second))
      row += exact_text(cell->second);
  }
  last_row.clear();
  for (const auto &[index, value] : current)
    last_row[names[index]] = value;
  current.clear();
  rows.push_back(row);

  if (file_name.empty())
    return;
  if (!header_is_current)
    rewrite();
  else
    write(row + "\n", true);
}

std::string StatisticsTable::header() const
{
  std::string comment = "#", line;
  for (std::size_t i = 0; i < names.size(); ++i)
  {
    comment += (i > 0 ? ", " : " ") + names[i] + (units[i].empty() ? "" : " [" + units[i] + "]");
    line += (i > 0 ? "," : "") + names[i];
  }
  return comment + "\n" + line + "\n";
}

void StatisticsTable::rewrite()
{
  std::string text = names.empty() ? "" : header();
  for (const std::string &row : rows)
  {
    // Columns that came later are empty in the rows before.
    const auto separators = std::count(row.begin(), row.end(), ',');
    text += row + std::string(names.size() - 1 - separators, ',') + "\n";
  }
  write(text, false);
  header_is_current = true;
}

void StatisticsTable::write(const std::string &text, const bool append)
{
  // A rewritten file replaces the old one in one go: a full disk must not cost the rows there are.
  const std::string target = append ? file_name : file_name + ".new";
  std::ofstream out(target, append ? std::ios::app : std::ios::trunc);
  out << text << std::flush;
  out.close();
  if (!out)
    throw OutputError("cannot write '" + target + "': " + std::strerror(errno));
  if (!append)
  {
    std::error_code error;
    std::filesystem::rename(target, file_name, error);
    if (error)
      throw OutputError("cannot write '" + file_name + "': " + error.message());
  }
}
} // namespace stockwork
