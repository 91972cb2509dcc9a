#pragma once

#include <cstdint>

namespace stockwork
{
/// An unknown beyond those of the bulk: an enrichment, a fluid pressure. Unknowns are recognised
/// by their key when the mesh or the crack has changed, so a key must not depend on numbering,
/// rank or refinement elsewhere.
struct ExtraUnknown
{
  std::uint64_t key;
  double initial = 0.; ///< value, and rate reference, when it appears for the first time
};
} // namespace stockwork
