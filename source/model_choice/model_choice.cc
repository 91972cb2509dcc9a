#include "model_choice/model_choice.h"

#include "stockwork/base/error.h"
#include "stockwork/base/nearest.h"
#include "stockwork/base/quantity.h"

#include "base/catalogue.h"
#include "base/parameter_tree.h"
#include "case.h"
#include "model_choice/charts.h"
#include "scene_estimates.h"
#include "simulation.h"

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iomanip>
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


/// Whose charts hold for a scene: all of these kinds have to promise. Empty: nobody's.
struct SceneKind
{
  std::vector<std::string> kinds;
  std::string why; ///< they do, or nobody's do
};

SceneKind nobodys(const std::string &why)
{
  return {{}, why};
}


/// Distance to the walls, in final half lengths, from which on they cost less than 1 %.
constexpr double far_walls = 10.;

/// What no chart has.
template <int dim>
std::string beyond_charts(const Case<dim> &the_case)
{
  const auto &cracks = the_case.scene.cracks;
  if (cracks.size() != 1)
    return cracks.empty() ? "there is no crack" : "there are several cracks";
  if (cracks[0].kind != InitialCrack<dim>::Kind::open)
    return "the crack is not an open one";
  if (dim == 2 && cracks[0].points.size() != 2)
    return "the crack is not straight";
  if (the_case.laws.all().size() > 1 || the_case.rock.is_random())
    return "the rock is not the same everywhere";
  if (!the_case.laws.are_linear() || the_case.rock.main().stiffness)
    return "the rock is not linear and isotropic";
  if (the_case.elements.has_pore_pressure)
    return "the rock has a pore pressure, and there is no reference for fractures in such rock";
  if (the_case.scheme.kind() == TimeScheme::Kind::newmark)
    return "inertia is on";
  if (the_case.network.n_wells() > 1)
    return "there are several wells";
  if (!(the_case.rock.main().energy_release_rate > 0.))
    return "the rock has no toughness";
  if (!the_case.walls_follow_reference)
  {
    // Charts are of cracks in a wide body that nothing but the stress in situ loads.
    if (!the_case.boundary_conditions.loads().empty() ||
        the_case.boundary_conditions.maximum_displacement(the_case.control.end_time) != 0.)
      return "there are loads on the boundary";
    const double reach = std::isnan(the_case.scene.crack_pressure) ? final_half_length(the_case)
                                                                   : half_length_at_end(the_case);
    if (!(distance_to_walls(the_case) >= far_walls * reach))
      return "the walls are nearer than ten times the length at the end";
  }
  return "";
}


/// A crack under a given pressure, which must not grow.
template <int dim>
SceneKind kind_of_static(const Case<dim> &the_case, const bool turned)
{
  const InitialCrack<dim> &crack = the_case.scene.cracks[0];
  const double net = the_case.scene.crack_pressure - closing_stress(the_case.scene, crack);
  const double half = half_length_at_end(the_case);
  const double intensity =
    dim == 2 ? net * std::sqrt(numbers::PI * half) : 2. * net * std::sqrt(half / numbers::PI);
  if (!(intensity < the_case.rock.main().toughness()))
    return nobodys("the given pressure lets the crack grow");
  if (dim == 3 && turned)
    return nobodys("the disc is turned out of the mesh's directions");
  return {{dim == 3 ? "static, disc"
           : turned ? "static, turned"
                    : "static"},
          "a crack under a given pressure that does not grow"};
}


SceneKind kind_of_growing(const Case<2> &the_case, const bool turned)
{
  const Pumping pumping = first_pumping(the_case);
  if (!(pumping.rate > 0.) || pumping.is_shut_in || the_case.network.maximum_pressure())
    return nobodys("no well pumps at a given rate until the end");
  const InitialCrack<2> &crack = the_case.scene.cracks[0];
  const Tensor<1, 2> along = (crack.points[1] - crack.points[0]) / crack.size();
  const Tensor<1, 2> across = Point<2>(-along[1], along[0]);
  const auto stress = the_case.scene.in_situ_stress(crack.points[0]);
  if (std::abs(along * (stress * across)) > 1e-6 * stress.norm())
    return nobodys("the stress in situ shears the crack, which will turn");
  if (across * (stress * across) < along * (stress * along) - 1e-6 * stress.norm())
    return nobodys("the stress in situ is greatest across the crack, which will turn");
  if (!std::isnan(the_case.rock.main().tensile_strength))
    return nobodys("the deck gives a tensile strength, and charts are of those that models take "
                   "for their cells");
  const double K_m = plane_fracture(the_case, pumping).dimensionless_toughness();
  std::ostringstream why;
  why << std::setprecision(2) << "K_m = " << K_m;
  const LeakOff leak_off = the_case.network.leak_off_law();
  if (leak_off != LeakOff::none && leak_off != LeakOff::carter)
    return nobodys("there is no chart for this law of leak-off");

  // Charts have K_m = 0.013, 2.0 to 2.2, and 7; what is between has to be promised by both
  // neighbours.
  std::vector<std::string> kinds;
  if (turned)
  {
    if (K_m < 6.9)
      return nobodys(why.str() + ", and at an angle to the mesh there are charts where toughness "
                                 "dominates alone, K_m >= 6.9");
    kinds = {"toughness, turned"};
  }
  else
  {
    if (K_m > 2.3)
      kinds.push_back("toughness");
    if (K_m > 0.013 && K_m < 6.9)
      kinds.push_back("transitional");
    if (K_m < 2.)
      kinds.push_back("viscosity");
  }
  if (leak_off == LeakOff::carter)
  {
    if (turned)
      return nobodys("there is no chart for leak-off at an angle to the mesh");
    kinds.push_back("carter");
  }
  return {kinds, why.str()};
}


template <int dim>
SceneKind kind_of(const Case<dim> &the_case)
{
  if (const std::string why = beyond_charts(the_case); !why.empty())
    return nobodys(why);
  const InitialCrack<dim> &crack = the_case.scene.cracks[0];
  Tensor<1, dim> direction;
  if (crack.disc)
    direction = crack.disc->normal;
  else
    direction = (crack.points.back() - crack.points.front()) / crack.size();
  double greatest = 0.;
  for (unsigned int d = 0; d < dim; ++d)
    greatest = std::max(greatest, std::abs(direction[d]));
  const bool turned = greatest < 1. - 1e-9;
  if (!std::isnan(the_case.scene.crack_pressure))
    return kind_of_static(the_case, turned);
  if constexpr (dim == 2)
    return kind_of_growing(the_case, turned);
  else
    return nobodys("fractures that grow in three dimensions have no charts");
}


/// Model and resolution that the charts promise the accuracy for.
struct Candidate
{
  std::string model, resolution;
  Charts::Promise promise;
  double cells;
};

std::string in_words(const Candidate &candidate)
{
  std::ostringstream text;
  text << std::setprecision(2) << candidate.model << ", " << candidate.resolution << ": "
       << 100. * candidate.promise.row.error << " % and about " << candidate.promise.seconds
       << " s by " << candidate.promise.row.deck << ", which has " << std::setprecision(3)
       << candidate.promise.row.cells << " cells in its half length; here are " << candidate.cells;
  return text.str();
}


/// The worst that the kinds say of a model with so many cells; nothing where one says nothing.
std::optional<Charts::Promise> promise_of(const Charts &charts,
                                          const SceneKind &scene,
                                          const std::string &model,
                                          const double cells)
{
  std::optional<Charts::Promise> worst;
  for (const std::string &kind : scene.kinds)
  {
    const auto promise = charts.promise(kind, model, cells);
    if (!promise)
      return std::nullopt;
    const double seconds = std::max(promise->seconds, worst ? worst->seconds : 0.);
    if (!worst || promise->row.error > worst->row.error)
      worst = promise;
    worst->seconds = seconds;
  }
  return worst;
}


/// Models that no chart of these kinds shows failing, and those that one does.
std::vector<std::string>
sound_models(const Charts &charts, const SceneKind &scene, std::set<std::string> &failures)
{
  std::vector<std::string> sound = charts.models(scene.kinds[0]);
  for (const std::string &kind : scene.kinds)
  {
    std::vector<std::string> both;
    const std::vector<std::string> here = charts.models(kind);
    std::set_intersection(sound.begin(), sound.end(), here.begin(), here.end(),
                          std::back_inserter(both));
    sound = both;
    for (const std::string &failure : charts.failures(kind))
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
    const std::vector<std::string> sound = sound_models(charts, scene, failures);
    std::vector<std::string> models = sound;
    if (!model_is_open(deck))
    {
      models = {deck.peek("Fracture/Model").value_or("none")};
      if (std::find(sound.begin(), sound.end(), models[0]) == sound.end())
        refuse("coarse, medium or fine: no chart of this kind of scene shows '" + models[0] +
               "' doing well");
    }
    std::vector<Candidate> candidates;
    for (const std::string &model : models)
      for (const std::string &resolution : open_resolutions())
        if (const auto candidate = try_out(scene, model, resolution))
        {
          candidates.push_back(*candidate);
          if (!model_is_open(deck))
            continue; // the next finer one may be the second choice
          break;
        }
    if (candidates.empty())
      refuse("one of " + quoted_list(all_models(), "or") + (remarks.empty() ? "" : ": " + remarks));
    std::sort(candidates.begin(), candidates.end(),
              [](const Candidate &a, const Candidate &b)
              { return a.promise.seconds < b.promise.seconds; });
    tell(scene, candidates, chosen);
    return with(candidates[0].model, candidates[0].resolution);
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
    const SceneKind scene = kind_of(the_case);
    if (scene.kinds.empty())
      refuse((model_is_open(deck) ? "one of " + quoted_list(all_models(), "or")
                                  : std::string("coarse, medium or fine")) +
             ": no chart covers this scene, for " + scene.why);
    return scene;
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

  std::optional<Candidate>
  try_out(const SceneKind &scene, const std::string &model, const std::string &resolution)
  {
    const std::string name = model + ", " + resolution;
    try
    {
      const Deck its = with(model, resolution);
      ParameterHandler prm;
      declare_all_parameters(prm, plug_ins);
      its.parse_into(prm);
      if (const std::string own = own_setting(prm, model); !own.empty())
      {
        remark(name + " has '" + own + "', which is in no chart");
        return std::nullopt;
      }
      std::ostringstream nobody_reads;
      RunContext quiet(run.communicator, nobody_reads);
      const double cells = cells_in_half_length<dim>(quiet, its, prm, plug_ins);
      const auto promise = promise_of(charts, scene, model, cells);
      if (promise && promise->row.error <= accuracy)
        return Candidate{model, resolution, *promise, cells};
      std::ostringstream text;
      text << std::setprecision(2);
      if (promise)
        text << name << " promises " << 100. * promise->row.error << " %";
      else
        text << name << " has " << std::setprecision(3) << cells
             << " cells in the half length, fewer than any chart";
      remark(text.str());
    }
    catch (const InputError &error)
    {
      remark(name + " is refused: " + error.what());
    }
    return std::nullopt;
  }

  /// An entry of a model that the deck changes, but for the cells, which are counted.
  static std::string own_setting(const ParameterHandler &prm, const std::string &model)
  {
    for (const DeclaredEntry &entry : declared_entries(prm))
      if (entry.section == "Fracture/" + model && entry.name != "Cell size" &&
          entry.value != entry.default_value)
        return entry.path() + " = " + entry.value;
    return "";
  }

  void remark(const std::string &text)
  {
    remarks += (remarks.empty() ? "" : "; ") + text;
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
    std::string kinds;
    for (const std::string &kind : scene.kinds)
      kinds += (kinds.empty() ? "'" : " and '") + kind + "'";
    std::ostringstream why;
    why << "the cheapest that the charts of " << kinds << " (" << scene.why << ") promise "
        << 100. * accuracy << " % for, " << in_words(candidates[0])
        << (candidates.size() > 1 ? "; second choice " + in_words(candidates[1])
                                  : std::string("; there is no second choice"));
    if (model_is_open(deck))
      why << "; with the settings of models/" << candidates[0].model << ".part.prm";
    if (!remarks.empty())
      why << "; not: " << remarks;
    if (!failures.empty())
      why << "; shown failing: "
          << quoted_list(std::vector<std::string>(failures.begin(), failures.end()));
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
  std::string remarks;            ///< on what is not a candidate
  std::set<std::string> failures; ///< models that charts show failing
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
                  std::vector<ChosenValue> &chosen)
{
  if (deck.peek("Dimension").value_or("2") == "3")
    return Chooser<3>(run, deck, overrides, plug_ins).choose(chosen);
  return Chooser<2>(run, deck, overrides, plug_ins).choose(chosen);
}
} // namespace stockwork
