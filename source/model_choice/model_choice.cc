#include "model_choice/model_choice.h"

#include "stockwork/base/error.h"
#include "stockwork/base/nearest.h"
#include "stockwork/base/quantity.h"

#include "base/catalogue.h"
#include "base/parameter_tree.h"
#include "case.h"
#include "model_choice/charts.h"
#include "model_choice/scene_kind.h"
#include "simulation.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <map>
#include <optional>
#include <set>
#include <sstream>

namespace stockwork
{
using namespace dealii;

namespace
{
const std::vector<std::string> resolution_names = {"coarse", "medium", "fine"};

bool model_is_open(const Deck &deck)
{
  return deck.peek("Fracture/Model").value_or("") == "auto";
}

bool resolution_is_open(const Deck &deck)
{
  return deck.peek("Resolution").value_or("") == "auto";
}

std::filesystem::path part_of(const std::string &model)
{
  return deck_directory() / "models" / (model + ".part.prm");
}

Charts read_charts()
{
  const std::filesystem::path file = deck_directory() / "charts.csv";
  std::ifstream in(file);
  if (!in)
    throw EntryError("Fracture/Model", "auto",
                     "a model's name: the charts to choose by are not at '" + file.string() + "'");
  return Charts(in);
}


/// Model and resolution that the charts promise the accuracy for.
struct Candidate
{
  std::string model, resolution;
  Charts::Promise promise;
  double cells;
  double error; ///< at most, in this scene
};

/// What is promised for a scene. The rock of a fracture that grows is not the chart's: with other
/// moduli, Poisson's ratios and lengths errors have been up to 1.5 times its own
/// (kgd/toughness); and its walls are not.
double error_in(const TriedDeck &tried, const Charts::Row &row)
{
  return tried.grows ? 1.5 * row.error + tried.effect_of_walls : row.error;
}

std::string in_words(const Candidate &candidate)
{
  std::ostringstream text;
  text << std::setprecision(2) << candidate.model << ", " << candidate.resolution << ": ";
  const bool grows = candidate.error > candidate.promise.row.error;
  if (grows)
    text << "at most " << 100. * candidate.error << " %: ";
  text << 100. * candidate.promise.row.error << " % at the end by " << candidate.promise.row.deck
       << ", which has " << std::setprecision(3) << candidate.promise.row.cells
       << " cells in its half length, and about " << std::setprecision(2)
       << candidate.promise.seconds << " s with its mesh; here are " << std::setprecision(3)
       << candidate.cells << " cells";
  if (grows)
    text << "; half as much again for another rock, and what the walls do";
  return text.str();
}


/// The worst that the groups say of a model with so many cells; nothing where one says nothing.
std::optional<Charts::Promise> promise_of(const Charts &charts,
                                          const SceneKind &scene,
                                          const std::string &model,
                                          const double cells)
{
  std::optional<Charts::Promise> worst;
  for (const Charts::Group &group : scene.groups)
  {
    const auto promise = charts.promise(group, model, cells);
    if (!promise)
      return std::nullopt;
    const double seconds = std::max(promise->seconds, worst ? worst->seconds : 0.);
    if (!worst || promise->row.error > worst->row.error)
      worst = promise;
    worst->seconds = seconds;
  }
  return worst;
}


/// Models that no chart of these groups shows failing, and those that one does.
std::vector<std::string>
sound_models(const Charts &charts, const SceneKind &scene, std::set<std::string> &failures)
{
  std::vector<std::string> sound = charts.models(scene.groups[0]);
  for (const Charts::Group &group : scene.groups)
  {
    std::vector<std::string> both;
    const std::vector<std::string> here = charts.models(group);
    std::set_intersection(sound.begin(), sound.end(), here.begin(), here.end(),
                          std::back_inserter(both));
    sound = both;
    for (const std::string &failure : charts.failures(group))
      failures.insert(failure);
  }
  return sound;
}


/// The choice for a deck whose dimension is known.
template <int dim>
class Chooser
{
public:
  Chooser(RunContext &run,
          const Deck &deck,
          const std::vector<std::string> &overrides,
          const PlugIns &plug_ins)
    : run(run)
    , deck(deck)
    , overrides(overrides)
    , plug_ins(plug_ins)
    , entry(model_is_open(deck) ? "Fracture/Model" : "Resolution")
    , charts(read_charts())
  {
  }

  Deck choose(std::vector<ChosenValue> &chosen)
  {
    const SceneKind scene = classify();
    std::vector<std::string> models = sound_models(charts, scene, failures);
    if (!model_is_open(deck))
    {
      const std::string given = deck.peek("Fracture/Model").value_or("none");
      if (std::find(models.begin(), models.end(), given) == models.end())
        refuse("a model that charts of this kind of scene show doing well, which '" + given +
               "' is not: " + or_by_name());
      models = {given};
    }
    std::vector<Candidate> candidates;
    for (const std::string &model : models)
      if (const auto candidate = first_of(scene, model, open_resolutions()))
        candidates.push_back(*candidate);
    if (candidates.empty())
    {
      std::ostringstream allowed;
      allowed << "cells and an 'Accuracy' for which a chart promises something, which these and "
              << 100. * accuracy << " % are not";
      if (nearest)
        allowed << std::setprecision(2) << " (" << 100. * nearest->error
                << " % is: " << nearest->model << ", " << nearest->resolution << ")";
      allowed << ", or " << or_by_name() << remarks_by_model();
      refuse(allowed.str());
    }
    std::sort(candidates.begin(), candidates.end(),
              [](const Candidate &a, const Candidate &b)
              { return a.promise.seconds < b.promise.seconds; });
    if (candidates.size() == 1 && resolution_is_open(deck))
      if (const auto finer =
            first_of(scene, candidates[0].model, finer_than(candidates[0].resolution)))
        if (finer->cells > candidates[0].cells)
          candidates.push_back(*finer);
    tell(scene, candidates, chosen);
    return with(candidates[0].model, candidates[0].resolution);
  }

  /// What an earlier run has chosen, whose effective deck this is.
  Deck choose_again(const std::filesystem::path &effective, std::vector<ChosenValue> &chosen) const
  {
    const Deck before = Deck::read(effective.string());
    const std::string model = before.peek("Fracture/Model").value_or("none"),
                      resolution = before.peek("Resolution").value_or("medium");
    chosen.push_back({"Fracture/Model", model + ", Resolution = " + resolution,
                      "those of the run that is continued ('" + effective.string() +
                        "'); nothing is chosen anew"});
    return with(model, resolution);
  }

private:
  /// By the case without a fracture model.
  SceneKind classify() const
  {
    const Deck plain = Deck::read(deck.file(), overrides, {"", "none", "coarse"});
    ParameterHandler prm;
    declare_all_parameters(prm, plug_ins);
    plain.parse_into(prm);
    accuracy = get_quantity(prm, "Accuracy", dimension::number);
    const Case<dim> the_case(plain, prm, plug_ins);
    const SceneKind scene = kind_of(charts, the_case);
    if (scene.groups.empty())
      refuse("a scene that the charts cover, which this is not (" + scene.why + "), or " +
             or_by_name());
    return scene;
  }

  /// The rest of what is allowed instead of 'auto'.
  std::string or_by_name() const
  {
    return model_is_open(deck) ? "a model by name: " + quoted_list(all_models(), "or")
                               : std::string("'coarse', 'medium' or 'fine'");
  }

  static std::vector<std::string> finer_than(const std::string &resolution)
  {
    const auto at = std::find(resolution_names.begin(), resolution_names.end(), resolution);
    return at == resolution_names.end() ? std::vector<std::string>()
                                        : std::vector<std::string>(at + 1, resolution_names.end());
  }

  std::vector<std::string> open_resolutions() const
  {
    return resolution_is_open(deck)
             ? resolution_names
             : std::vector<std::string>{deck.peek("Resolution").value_or("medium")};
  }

  Deck with(const std::string &model, const std::string &resolution) const
  {
    Deck::Choice choice;
    if (model_is_open(deck))
    {
      choice.model = model;
      choice.part = part_of(model).string();
    }
    if (resolution_is_open(deck))
      choice.resolution = resolution;
    return Deck::read(deck.file(), overrides, choice);
  }

  /// The coarsest that is a candidate.
  std::optional<Candidate> first_of(const SceneKind &scene,
                                    const std::string &model,
                                    const std::vector<std::string> &resolutions)
  {
    for (const std::string &resolution : resolutions)
      if (const auto candidate = try_out(scene, model, resolution))
        return candidate;
    return std::nullopt;
  }

  std::optional<Candidate>
  try_out(const SceneKind &scene, const std::string &model, const std::string &resolution)
  {
    const auto remark = [&](const std::string &text) { remarks[model].push_back(text); };
    try
    {
      const Deck its = with(model, resolution);
      ParameterHandler prm;
      declare_all_parameters(prm, plug_ins);
      its.parse_into(prm);
      if (const std::string own = own_setting(prm, model); !own.empty())
      {
        remark(resolution + " has '" + own + "', which is in no chart");
        return std::nullopt;
      }
      std::ostringstream nobody_reads;
      RunContext quiet(run.communicator, nobody_reads);
      const TriedDeck tried = try_deck<dim>(quiet, its, prm, plug_ins);
      const auto promise = promise_of(charts, scene, model, tried.cells);
      std::ostringstream text;
      text << std::setprecision(2) << resolution;
      if (!promise)
        text << " has " << std::setprecision(3) << tried.cells
             << " cells in the half length, fewer than any chart";
      else if (const double error = error_in(tried, promise->row); !(error <= accuracy))
      {
        text << " promises " << 100. * error << " %";
        if (tried.warnings.empty() && !(nearest && nearest->error < error))
          nearest = Candidate{model, resolution, *promise, tried.cells, error};
      }
      else if (!tried.warnings.empty())
        text << " would be warned of: " << tried.warnings[0];
      else
        return Candidate{model, resolution, *promise, tried.cells, error};
      remark(text.str());
    }
    catch (const InputError &error)
    {
      remark(is_refused.insert(model).second
               ? resolution + " is refused" + without_entry(error.what())
               : resolution + " too");
    }
    return std::nullopt;
  }

  /// What the deck changes of that with which the charts were made: an entry of the model, but for
  /// the cells, which are counted; or the elements, which are those of the model's part.
  static std::string own_setting(const ParameterHandler &prm, const std::string &model)
  {
    const std::string elements = "Discretisation/Elements";
    const auto charted = Deck::read(part_of(model).string()).peek(elements);
    for (const DeclaredEntry &entry : declared_entries(prm))
    {
      const bool is_models = entry.section == "Fracture/" + model && entry.name != "Cell size";
      if ((is_models && entry.value != entry.default_value) ||
          (entry.path() == elements && entry.value != charted.value_or(entry.default_value)))
        return entry.path() + " = " + entry.value;
    }
    return "";
  }

  /// A message from "; allowed is ..." on, for entry and value are known here.
  static std::string without_entry(const std::string &message)
  {
    const auto at = message.find("; allowed is ");
    return at == std::string::npos ? ": " + message : message.substr(at);
  }

  /// What is not a candidate, a line for each model.
  std::string remarks_by_model() const
  {
    std::string lines;
    for (const auto &[model, texts] : remarks)
      for (const std::string &text : texts)
        lines += (&text == &texts.front() ? "\n    not " + model + ": " : "; ") + text;
    if (!failures.empty())
      lines += "\n    shown failing: " +
               quoted_list(std::vector<std::string>(failures.begin(), failures.end()));
    return lines;
  }

  [[noreturn]] void refuse(const std::string &allowed) const
  {
    throw EntryError(entry, "auto", allowed);
  }

  std::vector<std::string> all_models() const
  {
    std::vector<std::string> names;
    for (const auto &[name, entry] : plug_ins.fracture_models.all())
      names.push_back(name);
    return names;
  }

  void tell(const SceneKind &scene,
            const std::vector<Candidate> &candidates,
            std::vector<ChosenValue> &chosen) const
  {
    std::string groups;
    for (const Charts::Group &group : scene.groups)
      groups += (groups.empty() ? "" : " and ") + group.in_words();
    std::ostringstream why;
    why << "the cheapest that the charts of " << groups << " (here " << scene.why << ") promise "
        << 100. * accuracy << " % for, " << in_words(candidates[0])
        << (candidates.size() > 1 ? "; second choice " + in_words(candidates[1])
                                  : std::string("; there is no second choice"));
    if (model_is_open(deck))
      why << "; with the settings of models/" << candidates[0].model << ".part.prm";
    why << remarks_by_model() << ". Seconds are of the charts' runs; what this one takes is below";
    chosen.push_back({"Fracture/Model",
                      candidates[0].model + ", Resolution = " + candidates[0].resolution,
                      why.str()});
  }

  RunContext &run;
  const Deck &deck;
  const std::vector<std::string> &overrides;
  const PlugIns &plug_ins;
  const std::string entry; ///< that is left to the program
  const Charts charts;
  mutable double accuracy = 0.;
  std::map<std::string, std::vector<std::string>> remarks; ///< by model: why it is no candidate
  std::optional<Candidate> nearest; ///< of those that promise less than is wanted
  std::set<std::string> is_refused; ///< models that --check would refuse
  std::set<std::string> failures;   ///< models that charts show failing
};
} // namespace


bool leaves_model_to_program(const Deck &deck)
{
  return model_is_open(deck) || resolution_is_open(deck);
}


Deck choose_model(RunContext &run,
                  const Deck &deck,
                  const std::vector<std::string> &overrides,
                  const PlugIns &plug_ins,
                  const std::string &continued,
                  std::vector<ChosenValue> &chosen)
{
  const auto by = [&](auto chooser)
  {
    const std::filesystem::path before = std::filesystem::path(continued) / "effective.prm";
    if (!continued.empty() && std::filesystem::exists(before))
      return chooser.choose_again(before, chosen);
    return chooser.choose(chosen);
  };
  if (deck.peek("Dimension").value_or("2") == "3")
    return by(Chooser<3>(run, deck, overrides, plug_ins));
  return by(Chooser<2>(run, deck, overrides, plug_ins));
}
} // namespace stockwork
