#pragma once

#include "stockwork/base/deck.h"

#include <istream>
#include <string>
#include <vector>

namespace stockwork
{
/// One `set` of a deck, in the order of reading.
struct DeckLine
{
  enum class Kind
  {
    section,
    entry
  };
  Kind kind;
  std::string path; ///< "Section/Sub" or "Section/Sub/Entry"
  std::string value;
  Origin origin;
};

/// What is wrong with a line that is not text in UTF-8; empty: nothing.
std::string why_not_text(const std::string &text);

/// Reads the lines of a deck and of its includes: subsection/end, set, include, # comments and a
/// backslash that continues a line. Errors are collected, so that one run shows them all.
class DeckReader
{
public:
  /// Read the file @p name. Problems of opening it are errors too.
  void read_file(const std::string &name);

  void read_stream(std::istream &in, const std::string &name);

  std::vector<DeckLine> lines;
  std::vector<std::string> errors;

private:
  void read_line(const std::string &line, const Origin &origin);
  void include(const std::string &name, const Origin &origin);
  void error(const Origin &origin, const std::string &message);

  /// Whether a deck can be read from there; if not, an error says why.
  bool is_file(const std::string &name, const std::string &shown, const std::string &prefix);

  std::vector<std::string> sections; ///< the subsections entered
  unsigned int n_files = 0, n_lines = 0;
  std::vector<std::string> open_files; ///< the chain of includes, canonical paths
};
} // namespace stockwork
