#pragma once

#include <ostream>

namespace stockwork
{
/// Print the cases that ship, a line each: the folder below prm/, what it is, and the fracture
/// models that it has decks for. They are looked for beside the installed program, then in the
/// source tree.
void print_cases(std::ostream &out);
} // namespace stockwork
