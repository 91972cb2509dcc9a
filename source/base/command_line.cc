#include "stockwork/base/command_line.h"

#include "stockwork/base/error.h"
#include "stockwork/base/nearest.h"

#include <boost/program_options.hpp>

#include <sstream>

namespace stockwork
{
namespace
{
namespace po = boost::program_options;

const char *const see_help = " (stockwork --help lists the options)";

const std::vector<std::string> &parameter_formats()
{
  static const std::vector<std::string> formats = {"prm", "json", "json-schema", "markdown"};
  return formats;
}

po::options_description visible_options()
{
  po::options_description options("Options", 100);
  // clang-format off
  options.add_options()
    ("output,o", po::value<std::string>()->value_name("DIR"),
       "write results there instead of where the deck says; made if missing")
    ("set,s", po::value<std::vector<std::string>>()->value_name("'Section/Entry=value'"),
       "override an entry of the deck; may be given several times")
    ("check,c", "do all that does not solve: read the deck, make the mesh, set the model up, estimate "
       "memory and time, and report what is wrong; nothing is written")
    ("restart,r", "continue from the last checkpoint in the output directory")
    ("print-parameters", po::value<std::string>()->value_name("prm|json|json-schema|markdown"),
       "print all entries with default, allowed values and meaning; with a deck, its values")
    ("list,l", "print the fracture models and the cases that ship, a line each")
    ("help,h", "print this text")
    ("version,v", "print the versions of Stockwork and of the libraries it runs with");
  // clang-format on
  return options;
}

/// "--sett" -> "--set"
std::string nearest_option(const std::string &given)
{
  const po::options_description options = visible_options();
  std::vector<std::string> names;
  for (const auto &option : options.options())
    names.push_back("--" + option->long_name());
  return did_you_mean(given, names);
}
} // namespace

CommandLine parse_command_line(const int argc, const char *const *const argv)
{
  po::options_description all = visible_options();
  all.add_options()("deck", po::value<std::vector<std::string>>());
  po::positional_options_description positional;
  positional.add("deck", -1);

  po::variables_map given;
  try
  {
    // Guessing would take --out for --output today and refuse it when another option comes.
    const int style = po::command_line_style::unix_style & ~po::command_line_style::allow_guessing;
    po::store(
      po::command_line_parser(argc, argv).options(all).positional(positional).style(style).run(),
      given);
  }
  catch (const po::unknown_option &error)
  {
    const std::string hint = nearest_option(error.get_option_name());
    throw InputError("unknown option '" + error.get_option_name() + "'" +
                     (hint.empty() ? see_help : "; " + hint));
  }
  catch (const po::error &error)
  {
    throw InputError(std::string(error.what()) + see_help);
  }

  CommandLine result;
  if (given.count("help") > 0)
  {
    result.action = CommandLine::Action::help;
    return result;
  }
  if (given.count("version") > 0)
  {
    result.action = CommandLine::Action::version;
    return result;
  }

  if (given.count("list") > 0)
  {
    result.action = CommandLine::Action::list;
    return result;
  }

  if (given.count("deck") > 0)
  {
    const auto &decks = given["deck"].as<std::vector<std::string>>();
    if (decks.size() > 1)
      throw InputError("one deck at a time; given are " + quoted_list(decks) + see_help);
    result.deck = decks[0];
  }
  if (given.count("set") > 0)
    result.overrides = given["set"].as<std::vector<std::string>>();
  for (const std::string &text : result.overrides)
    if (text.find('=') == std::string::npos)
      throw InputError("--set '" + text + "' is not of the form 'Section/Entry=value'");
  if (given.count("output") > 0)
    result.output = given["output"].as<std::string>();
  result.restart = given.count("restart") > 0;

  if (given.count("print-parameters") > 0)
  {
    result.action = CommandLine::Action::print_parameters;
    result.parameter_format = given["print-parameters"].as<std::string>();
    for (const std::string &format : parameter_formats())
      if (format == result.parameter_format)
        return result;
    throw InputError("--print-parameters " + result.parameter_format + ": allowed is one of " +
                     quoted_list(parameter_formats(), "or"));
  }
  if (result.deck.empty())
    throw InputError(std::string("no deck is given: stockwork DECK") + see_help);
  if (given.count("check") > 0)
    result.action = CommandLine::Action::check;
  return result;
}

std::string help_text()
{
  std::ostringstream out;
  out
    << "Stockwork simulates fluid-driven fractures in porous rock.\n\n"
       "  stockwork DECK [options]\n"
       "  mpirun -np N stockwork DECK [options]\n\n"
    << visible_options()
    << "\n"
       "Examples\n"
       "  stockwork prm/kgd/toughness/cohesive_xfem.prm\n"
       "  stockwork prm/kgd/toughness/cohesive_xfem.prm --set Resolution=fine --output fine\n"
       "  stockwork my.prm --check --set 'Rock/Young modulus=20 GPa'\n"
       "  stockwork my.prm --restart --set 'Time/End time=2 h'\n"
       "  stockwork --print-parameters markdown > parameters.md\n\n"
       "A deck is a text of lines 'set Entry = value' in sections, and may include other decks.\n"
       "Values carry units (15.96 GPa, 1 md, 1 cP, 20 bbl/min); a bare number is SI.\n\n"
       "The output directory gets summary.json, statistics.csv (one row per step), the deck with\n"
       "all defaults spelt out, and .pvd/.vtu files for ParaView.\n\n"
       "Exit status\n"
       "  0  the run reached its end time (or the check found nothing wrong)\n"
       "  1  the deck or the command line cannot be used; nothing was computed\n"
       "  2  the run failed on its way; the last good checkpoint is kept\n\n"
       "Read on: README.md, doc/ (tutorial, deck, cases, theory, parameters) of the source tree.\n";
  return out.str();
}
} // namespace stockwork
