#pragma once

#include <string>
#include <vector>

namespace stockwork
{
/// A wish about the cells along one axis: cells of size @p size [m] from @p begin to @p end, with
/// mesh lines at both. Begin and end coincide for "a mesh line here, with cells of this size
/// beside it".
struct Concentration
{
  double begin;
  double end;
  double size;
};

/// Mesh lines from @p lower to @p upper [m] that honour all concentrations.
///
/// The cells grow away from a concentration in geometric progression, each @p growth times the one
/// before, until they reach @p largest or meet the cells of another concentration. No cell is
/// larger than asked for; the lines between two prescribed ones are moved together to fit, so
/// that neighbours differ by at most @p growth, unless a gap is only a few cells wide.
/// Mirrored wishes give mirrored lines.
/// @throws InputError if a concentration lies outside or two overlap
std::vector<double> graded_lines(double lower,
                                 double upper,
                                 std::vector<Concentration> concentrations,
                                 double growth,
                                 double largest);

/// The mesh lines of one axis from the deck's description of them:
///
///   16 cells                                    equal cells
///   0.5 m                                       equal cells of at most this size
///   lines 0, 1, 2.5, 10                         these lines
///   1 cm at 0 m, 5 cm at 3 m, growth 1.2        a line at 0, cells of 1 cm beside it, growing away
///   1 cm around 0 m, largest 20 m               0 is in the middle of a cell of 1 cm
///   8 cm around 0 m refined 3 times             … once the cell has been halved 3 times
///   1 cm from 0 m to 2 m, growth 1.1            a band of equal cells, growing away
///
/// Parts are separated by ',' or ';'; growth is 1.25 and largest unlimited unless given.
/// @throws InputError with what was given and what is allowed
std::vector<double> parse_lines(const std::string &text, double lower, double upper);

/// The number of equal cells that @p text asks for, or zero if it asks for something else.
unsigned int parse_equal_cells(const std::string &text, double lower, double upper);
} // namespace stockwork
