// Reading decks: syntax, includes, overrides, alternatives by resolution, and error messages.
#include "stockwork/base/deck.h"
#include "stockwork/base/error.h"
#include "stockwork/base/nearest.h"
#include "stockwork/base/quantity.h"

#include <deal.II/base/parameter_handler.h>

#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <functional>

#include <unistd.h>

namespace stockwork::deck_test
{
namespace
{
void declare(dealii::ParameterHandler &prm)
{
  Deck::declare_parameters(prm);
  prm.declare_entry("Model", "none", dealii::Patterns::Selection("none|cohesive_xfem"), "");
  prm.enter_subsection("Rock");
  prm.declare_entry("Young modulus", "20 GPa", Quantity(dimension::stress, Range::positive()), "");
  prm.declare_entry("Poisson ratio", "0.2", Quantity(dimension::number, Range::open(-1, 0.5)), "");
  prm.declare_alias("Young modulus", "E", true);
  prm.leave_subsection();
  prm.enter_subsection("Mesh");
  prm.enter_subsection("Box");
  prm.declare_entry("Cells", "4", dealii::Patterns::Integer(1), "");
  prm.leave_subsection();
  prm.leave_subsection();
}

std::string error_of(const std::function<void()> &action)
{
  try
  {
    action();
    return "";
  }
  catch (const InputError &error)
  {
    return error.what();
  }
}

std::string error_of_deck(const std::string &text, const std::vector<std::string> &overrides = {})
{
  return error_of(
    [&]()
    {
      dealii::ParameterHandler prm;
      declare(prm);
      Deck::read_text(text, "a.prm", overrides).parse_into(prm);
    });
}

bool has(const std::string &text, const std::string &part)
{
  return text.find(part) != std::string::npos;
}

/// A folder of its own that is removed at the end.
struct Folder
{
  Folder()
    : path(std::filesystem::temp_directory_path() /
           ("stockwork_deck_test_" + std::to_string(::getpid())))
  {
    std::filesystem::create_directories(path / "parts");
  }
  ~Folder()
  {
    std::filesystem::remove_all(path);
  }
  std::string write(const std::string &name, const std::string &text) const
  {
    std::ofstream(path / name) << text;
    return (path / name).string();
  }
  std::filesystem::path path;
};
} // namespace

TEST_CASE("entries, sections, comments, continued lines, origins")
{
  const Deck deck = Deck::read_text("# a comment\n"
                                    "set Model = cohesive_xfem # and another\n"
                                    "SUBSECTION  Rock\n"
                                    "  set Young   modulus = 15.96 \\\n"
                                    "      GPa\n"
                                    "end\n"
                                    "subsection Mesh\n"
                                    "  subsection Box\n"
                                    "    set Cells = 7\n"
                                    "    set Cells = 9\n"
                                    "  end\n"
                                    "end\n",
                                    "a.prm");
  dealii::ParameterHandler prm;
  declare(prm);
  deck.parse_into(prm);
  CHECK(prm.get("Model") == "cohesive_xfem");
  prm.enter_subsection("Rock");
  CHECK(get_quantity(prm, "Young modulus", dimension::stress) == 15.96e9);
  CHECK(prm.get("Poisson ratio") == "0.2");
  prm.leave_subsection();
  prm.enter_subsection("Mesh");
  prm.enter_subsection("Box");
  CHECK(prm.get_integer("Cells") == 9);
  CHECK(deck.origin("Rock/Young modulus").text() == "a.prm:4");
  CHECK(deck.origin("Mesh/Box/Cells").text() == "a.prm:10");
  CHECK(deck.origin("Rock/Poisson ratio").text() == "default value");
  CHECK(deck.peek("Mesh/Box/Cells").value() == "9");
  CHECK(deck.located(EntryError("Rock/Young modulus", "15.96 GPa", "less")) ==
        "a.prm:4: 'Rock/Young modulus' is '15.96 GPa'; allowed is less");
  CHECK_FALSE(deck.peek("Rock/Poisson ratio").has_value());
}

TEST_CASE("--set wins, and says so")
{
  const std::string text = "subsection Rock\n set Poisson ratio = 0.1\nend\n";
  const Deck deck = Deck::read_text(text, "a.prm", {"Rock/Poisson ratio = 1/4", "Model=none"});
  CHECK(deck.peek("Rock/Poisson ratio").value() == "1/4");
  CHECK(deck.origin("Rock/Poisson ratio").text() == "command line");
  CHECK(has(error_of_deck(text, {"Rock/Poison ratio=0.3"}),
            "command line: there is no entry 'Rock/Poison ratio'; did you mean 'Poisson ratio'?"));
  CHECK(has(error_of_deck(text, {"Rock/Poisson ratio"}), "'Section/Entry=value'"));
}

TEST_CASE("alternatives follow the resolution")
{
  const std::string text = "subsection Mesh\nsubsection Box\nset Cells = {10|20|40}\nend\nend\n";
  CHECK(Deck::read_text(text).peek("Mesh/Box/Cells").value() == "20");
  CHECK(Deck::read_text("set Resolution = fine\n" + text).peek("Mesh/Box/Cells").value() == "40");
  CHECK(Deck::read_text(text, "a", {"Resolution=coarse"}).peek("Mesh/Box/Cells").value() == "10");
  CHECK(Deck::read_text("set A = 1 + { a | b | c } m, {|x|y}").peek("A").value() == "1 + b m, x");
  CHECK(has(error_of_deck("set Model = {a|b}"), "has 2 alternatives"));
  CHECK(has(error_of_deck("set Model = {a|b|c"), "'}' is missing"));
  CHECK(has(error_of_deck("set Resolution = finest"), "one of 'coarse', 'medium' or 'fine'"));
}

TEST_CASE("includes are resolved against the including file")
{
  const Folder folder;
  folder.write("parts/rock.part.prm", "subsection Rock\n set Young modulus = 1 GPa\nend\n");
  folder.write("parts/all.part.prm", "include rock.part.prm\nset Model = cohesive_xfem\n");
  const std::string file = folder.write(
    "a.prm", "include parts/all.part.prm\nsubsection Rock\n set Young modulus = 2 GPa\nend\n");

  const Deck deck = Deck::read(file);
  CHECK(deck.peek("Model").value() == "cohesive_xfem");
  CHECK(deck.peek("Rock/Young modulus").value() == "2 GPa");
  CHECK(deck.origin("Model").text() == (folder.path / "parts/all.part.prm").string() + ":2");

  folder.write("parts/rock.part.prm", "# again\ninclude ../a.prm\n");
  const std::string cycle = error_of([&]() { Deck::read(file); });
  CHECK(has(cycle, "rock.part.prm:2: include of '../a.prm' is a cycle"));

  std::filesystem::remove(folder.path / "parts/rock.part.prm");
  const std::string missing = error_of([&]() { Deck::read(file); });
  CHECK(has(missing, "all.part.prm:1: the included file 'rock.part.prm' does not exist"));
  CHECK(has(error_of([&]() { Deck::read("no/such.prm"); }), "'no/such.prm' does not exist"));
  CHECK(has(error_of([&]() { Deck::read(folder.path.string()); }), "is a directory"));
}

TEST_CASE("unknown entries and sections come with the nearest names")
{
  CHECK(error_of_deck("subsection Rock\n set Youngs modulus = 1\nend") ==
        "a.prm:2: there is no entry 'Rock/Youngs modulus'; did you mean 'Young modulus'?");
  CHECK(error_of_deck("set Young modulus = 1") ==
        "a.prm:1: there is no entry 'Young modulus'; did you mean 'Rock/Young modulus'?");
  const std::string section = error_of_deck("subsection Rok\n set Young modulus = 1\nend");
  CHECK(section == "a.prm:1: there is no section 'Rok'; did you mean 'Rock'?");
  CHECK(error_of_deck("subsection Wellbore\nend") ==
        "a.prm:1: there is no section 'Wellbore'; there are 'Rock' and 'Mesh'");
}

TEST_CASE("values that are not allowed")
{
  CHECK(error_of_deck("subsection Rock\n set Young modulus = 3 m\nend") ==
        "a.prm:2: 'Rock/Young modulus': \"3 m\" is a length; a stress is expected, e.g. "
        "\"3 MPa\"");
  CHECK(has(error_of_deck("set Model = xfem_cohesive"), "one of 'none' or 'cohesive_xfem'"));
  CHECK(has(error_of_deck("set Model = cohesive_xfm"), "did you mean 'cohesive_xfem'?"));
  CHECK(has(error_of_deck("subsection Mesh\nsubsection Box\nset Cells = 0\nend\nend"),
            "allowed is an integer >= 1"));
}

TEST_CASE("all errors of a deck are reported together")
{
  const std::string errors = error_of_deck("set Modell = none\n"
                                           "subsection Rock\n"
                                           "  set Poisson ratio = 0.7\n"
                                           "  set Young modulus = -1\n"
                                           "end\n");
  CHECK(has(errors, "3 errors in 'a.prm'"));
  CHECK(errors.find("a.prm:1:") < errors.find("a.prm:3:"));
  CHECK(errors.find("a.prm:3:") < errors.find("a.prm:4:"));

  const std::string syntax = error_of_deck("sett A = b\nend\nsubsection Rock\nset X\n");
  CHECK(has(syntax, "a.prm:1: 'sett A = b' is not understood"));
  CHECK(has(syntax, "a.prm:2: 'end' without a subsection"));
  CHECK(has(syntax, "a.prm:4: 'set X' is not of the form"));
  CHECK(has(syntax, "an 'end' is missing"));
}

TEST_CASE("an old name is refused with the new one and the place")
{
  CHECK(has(error_of_deck("subsection Rock\nset E = 3 GPa\nend\n"),
            "a.prm:2: 'Rock/E' is now called 'Rock/Young modulus'"));
}

TEST_CASE("the fingerprint sees values, not their spelling")
{
  const auto of = [](const std::string &text, const std::vector<std::string> &excluded = {})
  {
    dealii::ParameterHandler prm;
    declare(prm);
    Deck::read_text(text).parse_into(prm);
    return fingerprint(prm, excluded);
  };
  CHECK(of("") == of("subsection Rock\nset Young modulus = 2e10\nend\n"));
  CHECK(of("") != of("subsection Rock\nset Young modulus = 2.1e10\nend\n"));
  CHECK(of("", {"Rock"}) == of("subsection Rock\nset Young modulus = 1 Pa\nend\n", {"Rock"}));
  CHECK(of("", {"Mesh"}) != of("subsection Rock\nset Young modulus = 1 Pa\nend\n", {"Mesh"}));
}

TEST_CASE("the name of a deck")
{
  CHECK(Deck::read_text("", "/somewhere/prm/kgd/cohesive_xfem.prm").name() == "kgd/cohesive_xfem");
  CHECK(Deck::read_text("", "/somewhere/mine.prm").name() == "mine");
}

TEST_CASE("near names")
{
  CHECK(edit_distance("abc", "abc") == 0);
  CHECK(edit_distance("Young modulus", "young modulus") == 0);
  CHECK(edit_distance("abcd", "acbd") == 1);
  CHECK(edit_distance("kitten", "sitting") == 3);
  CHECK(nearest_names("damge", {"none", "damage", "cohesive_xfem"}) ==
        std::vector<std::string>{"damage"});
  CHECK(nearest_names("zzz", {"none", "damage"}).empty());
}
} // namespace stockwork::deck_test
