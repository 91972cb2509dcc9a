#pragma once

#include <cstdint>

namespace stockwork
{
/// Every bit of the number reaches every bit of the result, and no two have the same (the finaliser
/// of SplitMix64; Steele, Lea and Flood 2014).
inline std::uint64_t scrambled(std::uint64_t z)
{
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
  return z ^ (z >> 31);
}

/// What numbers are spread by before that.
constexpr std::uint64_t scrambling_step = 0x9e3779b97f4a7c15ull;
} // namespace stockwork
