#pragma once

#include <filesystem>
#include <ostream>

namespace stockwork
{
/// Where the decks that ship are: beside the installed program, or else in the source tree.
std::filesystem::path deck_directory();

/// Print the cases that ship, a line each: the folder below prm/, what it is, and the fracture
/// models that it has decks for.
void print_cases(std::ostream &out);
} // namespace stockwork
