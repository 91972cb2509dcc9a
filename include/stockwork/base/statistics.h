#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace stockwork
{
/// Unit of a column of statistics.csv, by its name: of fractures that are lines in 2-D, and areas
/// in 3-D, and of what in 2-D is per metre of thickness. "" for a number.
std::string unit_of_column(const std::string &name, unsigned int dim);

/// statistics.csv: one row per accepted step, the same columns for every fracture model.
///
/// A column is registered on first use and keeps its place. The first line is a comment with the
/// units. Each row is flushed, so that a running job can be watched and a killed one loses
/// nothing. Only the rank that opens a file writes; on the others the table only collects.
class StatisticsTable
{
public:
  /// A table in memory.
  StatisticsTable() = default;

  /// Write to @p file, which is overwritten. @throws OutputError
  void open(const std::string &file);

  /// Continue @p file after a restart: keep its rows up to @p time (the column "time") and drop
  /// the later ones, which will be computed again. A missing file starts a new one.
  void continue_from(const std::string &file, double time);

  /// Set a value of the current row. @p unit is taken on first use, "" for a number.
  void set(const std::string &column, double value, const std::string &unit = "");

  /// End the current row. Columns that were not set stay empty. @throws OutputError
  void end_row();

  /// The values of the last ended row, in no row: those set so far. This is "final" in
  /// summary.json. Columns never set are missing.
  const std::map<std::string, double> &final_values() const
  {
    return last_row;
  }

  const std::vector<std::string> &columns() const
  {
    return names;
  }

  unsigned int n_rows() const
  {
    return rows.size();
  }

private:
  std::size_t column_index(const std::string &name, const std::string &unit);
  std::string header() const;
  void rewrite();
  void write(const std::string &text, bool append);

  std::string file_name;
  std::vector<std::string> names, units;
  std::vector<std::string> rows; ///< formatted, without the columns added later
  std::map<std::size_t, double> current;
  std::map<std::string, double> last_row;
  bool header_is_current = false;
};
} // namespace stockwork
