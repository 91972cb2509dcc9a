#pragma once

#include <ostream>
#include <string>

namespace dealii
{
class ParameterHandler;
}

namespace stockwork
{
/// Print all declared entries with their present values.
///
/// @param format "prm": a deck that can be run; "json": for programs; "json-schema": what such a
/// file may hold, for editors (draft 2020-12; nested sections, and of each entry its type, unit,
/// range, default and meaning); "markdown": the reference
/// manual, a table of entries, defaults, allowed values and meaning for each section
/// @throws InputError for another format
void print_parameters(const dealii::ParameterHandler &prm,
                      const std::string &format,
                      std::ostream &out);

/// Write the deck with every default spelt out; rank 0 only. @throws OutputError
void write_effective_deck(const dealii::ParameterHandler &prm, const std::string &file);
} // namespace stockwork
