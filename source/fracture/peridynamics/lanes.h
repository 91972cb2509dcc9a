#pragma once

#include <cstring>

namespace stockwork::peridynamics
{
/// Neighbouring sites of a row in one register. (deal.II's VectorizedArray has the width that the
/// library was built for: of a distribution's, one.)
#ifdef __AVX__
using Lanes = double __attribute__((vector_size(32)));
#else
using Lanes = double __attribute__((vector_size(16)));
#endif
constexpr int n_lanes = sizeof(Lanes) / sizeof(double);

/// A value from and to an address that need not be aligned.
template <typename Value>
inline void load(Value &value, const double *const from)
{
  std::memcpy(&value, from, sizeof(Value));
}

template <typename Value>
inline void store(const Value &value, double *const to)
{
  std::memcpy(to, &value, sizeof(Value));
}
} // namespace stockwork::peridynamics
