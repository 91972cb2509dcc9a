#pragma once

namespace stockwork::peridynamics
{
/// A local system is square. Rows of one or two unknowns that have hundreds of columns are entered
/// so many columns at a time.
constexpr unsigned int most_columns = 24;
} // namespace stockwork::peridynamics
