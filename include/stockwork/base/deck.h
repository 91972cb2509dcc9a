#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace dealii
{
class ParameterHandler;
}

namespace stockwork
{
class DeckReader;
class EntryError;

/// Where an entry's value comes from.
struct Origin
{
  std::string file; ///< empty: not from a file
  unsigned int line = 0;
  bool command_line = false;

  /// "rock.part.prm:12", "command line" or "default value"
  std::string text() const;
};

/// An input deck: the entries of a file and the files it includes, in ParameterHandler syntax,
/// each with the place where it was written.
///
/// An include is resolved against the including file. A part `{a|b|c}` of a value stands for its
/// first, second or third alternative according to `set Resolution = coarse|medium|fine`. Of two
/// values for one entry the later wins; --set wins over all.
class Deck
{
public:
  /// What the program has chosen where the deck says 'auto'.
  struct Choice
  {
    std::string part;       ///< file with the settings of the model, read after the deck
    std::string model;      ///< of 'Fracture/Model'; empty: as the deck says
    std::string resolution; ///< empty: as the deck says
  };

  /// @param overrides "Section/Sub/Entry=value", as given with --set
  /// @throws InputError with all syntax errors, missing files and include cycles
  static Deck read(const std::string &file, const std::vector<std::string> &overrides = {});

  /// The same with a choice in place of 'auto'.
  static Deck
  read(const std::string &file, const std::vector<std::string> &overrides, const Choice &choice);

  /// The same from text; @p name stands for the file in messages, and includes are resolved
  /// against its directory.
  static Deck read_text(const std::string &text,
                        const std::string &name = "deck",
                        const std::vector<std::string> &overrides = {});

  /// Declare the entries the deck itself knows: Resolution.
  static void declare_parameters(dealii::ParameterHandler &prm);

  /// The value of an entry before anything is declared, e.g. "Additional shared libraries" or
  /// "Fracture/Model"; nothing if the deck does not set it.
  std::optional<std::string> peek(const std::string &path) const;

  /// Set every entry of the deck in @p prm.
  /// @throws InputError naming all unknown sections and entries, entries that have another name now
  /// (deprecated aliases) and all values that are not allowed, with file, line and the nearest
  /// valid names
  void parse_into(dealii::ParameterHandler &prm) const;

  /// Where the effective value of "Section/Sub/Entry" was written.
  Origin origin(const std::string &path) const;

  /// The message of an error with the place where the entry was written before it.
  std::string located(const EntryError &error) const;

  /// The deck's file as given, for messages.
  const std::string &file() const
  {
    return file_name;
  }

  /// The deck's name for summary.json: the path without extension and without everything up to
  /// the last folder "prm", e.g. "kgd/cohesive_xfem".
  std::string name() const;

private:
  struct Entry
  {
    std::string value;
    Origin origin;
  };

  static Deck from_reader(const DeckReader &reader,
                          const std::string &file,
                          const std::vector<std::string> &overrides,
                          const Choice &choice);
  void read_overrides(const std::vector<std::string> &overrides, std::vector<std::string> &errors);
  void expand_alternatives(std::vector<std::string> &errors);

  std::string file_name;
  std::map<std::string, Entry> entries;   ///< by "Section/Sub/Entry"
  std::map<std::string, Origin> sections; ///< every section seen, by "Section/Sub"
};

/// A number that two runs share exactly when all their effective values agree (quantities are
/// compared by value: "3 MPa" is "3e6"), apart from entries whose path is listed in @p excluded
/// or starts with a section listed there ("Output", "Time/End time").
std::uint64_t fingerprint(const dealii::ParameterHandler &prm,
                          const std::vector<std::string> &excluded = {});

/// What the fingerprint is of: a line "Section/Entry=value" for each, sorted.
std::string comparable_text(const dealii::ParameterHandler &prm,
                            const std::vector<std::string> &excluded = {});

/// The entries in which two such texts differ, for people: "'Rock/Young modulus' was 3e10 and is
/// now 3.1e10"; of many, the first few.
std::string difference(const std::string &before, const std::string &now);
} // namespace stockwork
