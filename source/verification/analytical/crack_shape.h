#pragma once

namespace stockwork::analytical
{
/// A crack in plane strain or a circular one.
enum class CrackShape
{
  line,
  penny
};
} // namespace stockwork::analytical
