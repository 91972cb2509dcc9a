#pragma once

#include <optional>
#include <string>
#include <vector>

namespace stockwork
{
/// What the user asked for on the command line.
struct CommandLine
{
  enum class Action
  {
    run,
    check, ///< read the deck, say whether it is all right, compute nothing
    print_parameters,
    list, ///< the cases and models that ship
    help,
    version
  };

  Action action = Action::run;
  std::string deck;                   ///< empty for help, version, print_parameters
  std::optional<std::string> output;  ///< --output DIR
  std::vector<std::string> overrides; ///< --set, "Section/Entry=value", in order
  bool restart = false;               ///< continue from the last checkpoint
  std::string parameter_format;       ///< prm, json, json-schema or markdown
};

/// @throws InputError with a message that names the option
CommandLine parse_command_line(int argc, const char *const *argv);

/// The text of --help.
std::string help_text();
} // namespace stockwork
