#pragma once

#include <istream>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace stockwork
{
/// What runs of the decks that ship have reached: prm/charts.csv, which contrib/make_charts.py
/// writes.
class Charts
{
public:
  struct Row
  {
    std::string kind; ///< of scene: "growing"
    std::string deck; ///< its folder: "kgd/toughness"
    std::string model, resolution;
    /// Of a fracture that grows, by the audit: the dimensionless toughness and the share of the
    /// fluid that has leaked off, both at the end.
    double toughness = std::numeric_limits<double>::quiet_NaN();
    double leaked = 0.;
    double cells = 0.;   ///< in half of the fracture's length at the end
    double error = 0.;   ///< relative, the worst of what was compared at the end
    double seconds = 0.; ///< of the processor
    bool failed = false; ///< the run did not reach its end, or something else came out
  };

  /// Decks of a kind that show the same physics: a model that does well in them all promises it.
  struct Group
  {
    std::string kind;
    double least = std::numeric_limits<double>::quiet_NaN(), most = least; ///< toughness
    double leaked = 0.;                                                    ///< the most
    std::vector<std::string> decks;

    /// "'growing' with K_m = 2 to 2.2"
    std::string in_words() const;
  };

  /// A table with a head. @throws InputError for what is none
  explicit Charts(std::istream &in);

  /// All decks of a kind in groups of nearly the same toughness, the smallest first; static ones
  /// are one group. Empty: no such kind.
  std::vector<Group> groups(const std::string &kind) const;

  /// Models with runs in a group, none of which has failed.
  std::vector<std::string> models(const Group &group) const;

  /// Those that have failed, as "damage (kgd/rotated/45)".
  std::vector<std::string> failures(const Group &group) const;

  struct Promise
  {
    Row row;             ///< the worst of those that it comes from
    double seconds = 0.; ///< of such a scene with so many cells, on the average
  };

  /// What a model promises with so many cells: of each deck the finest run with no more cells
  /// counts, or a finer one that errs by more, for then the former was lucky; and of these the
  /// worst. Nothing where a deck has no such run.
  std::optional<Promise> promise(const Group &group, const std::string &model, double cells) const;

private:
  std::vector<Row> rows_of(const Group &group) const;

  std::vector<Row> rows;
};
} // namespace stockwork
