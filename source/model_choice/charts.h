#pragma once

#include <istream>
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
    std::string kind; ///< of scene: "toughness"
    std::string deck; ///< its folder: "kgd/toughness"
    std::string model, resolution;
    double cells = 0.;   ///< in half of the fracture's length at the end
    double error = 0.;   ///< relative, the worst of what was compared at the end
    double seconds = 0.; ///< of the processor
    bool failed = false; ///< the run did not reach its end, or something else came out
  };

  /// A table with a head. @throws InputError for what is none
  explicit Charts(std::istream &in);

  /// Models with runs of this kind of scene, none of which has failed.
  std::vector<std::string> models(const std::string &kind) const;

  /// Those that have failed, as "peridynamics (kgd/viscosity)".
  std::vector<std::string> failures(const std::string &kind) const;

  struct Promise
  {
    Row row;             ///< the worst of those that it comes from
    double seconds = 0.; ///< of such a scene with so many cells, on the average
  };

  /// What a model promises with so many cells: of each deck the finest run with no more cells
  /// counts, or a finer one that errs by more, for then the former was lucky; and of these the
  /// worst. Nothing where a deck has no such run.
  std::optional<Promise>
  promise(const std::string &kind, const std::string &model, double cells) const;

private:
  std::vector<Row> rows;
};
} // namespace stockwork
