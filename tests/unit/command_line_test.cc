// The command line and the texts the program prints about itself.
#include "stockwork/base/command_line.h"
#include "stockwork/base/error.h"
#include "stockwork/base/version.h"

#include <doctest/doctest.h>

namespace stockwork::command_line_test
{
using Action = CommandLine::Action;

namespace
{
CommandLine parse(std::vector<const char *> arguments)
{
  arguments.insert(arguments.begin(), "stockwork");
  return parse_command_line(arguments.size(), arguments.data());
}

std::string error_of(const std::vector<const char *> &arguments)
{
  try
  {
    parse(arguments);
    return "";
  }
  catch (const InputError &error)
  {
    return error.what();
  }
}

bool has(const std::string &text, const std::string &part)
{
  return text.find(part) != std::string::npos;
}
} // namespace

TEST_CASE("a run")
{
  const CommandLine line = parse({"a.prm", "--set", "Rock/Young modulus=2 GPa", "--output", "there",
                                  "--set=Mesh/Cells={1|2|3}", "--restart"});
  CHECK(line.action == Action::run);
  CHECK(line.deck == "a.prm");
  CHECK(line.output.value() == "there");
  CHECK(line.restart);
  CHECK(line.overrides ==
        std::vector<std::string>{"Rock/Young modulus=2 GPa", "Mesh/Cells={1|2|3}"});

  CHECK(parse({"--set", "A=-1", "a.prm"}).deck == "a.prm");
  CHECK_FALSE(parse({"a.prm"}).output.has_value());
}

TEST_CASE("other actions")
{
  CHECK(parse({"a.prm", "--check"}).action == Action::check);
  CHECK(parse({"--help"}).action == Action::help);
  CHECK(parse({"--version"}).action == Action::version);
  CHECK(parse({"--print-parameters", "json"}).parameter_format == "json");
  CHECK(parse({"a.prm", "--print-parameters", "prm"}).deck == "a.prm");
}

TEST_CASE("what cannot be understood is named")
{
  CHECK(has(error_of({}), "no deck is given"));
  CHECK(has(error_of({"a.prm", "--chek"}), "unknown option '--chek'; did you mean '--check'?"));
  CHECK(has(error_of({"a.prm", "--out", "x"}), "unknown option '--out'"));
  CHECK(has(error_of({"a.prm", "b.prm"}), "'a.prm' and 'b.prm'"));
  CHECK(has(error_of({"a.prm", "--set", "Rock"}), "'Section/Entry=value'"));
  CHECK(has(error_of({"a.prm", "--set"}), "--set"));
  CHECK(has(error_of({"--print-parameters", "xml"}), "'prm', 'json', 'json-schema' or 'markdown'"));
}

TEST_CASE("help and versions")
{
  for (const char *part : {"--set", "--restart", "Exit status", "mpirun", "Examples"})
    CHECK(has(help_text(), part));
  for (const char *part : {"Stockwork ", "deal.II", "Trilinos", "MPI", "BLAS"})
    CHECK(has(version_report(), part));
  MESSAGE(version_report());
}
} // namespace stockwork::command_line_test
