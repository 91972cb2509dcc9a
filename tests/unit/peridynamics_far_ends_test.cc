// Where bonds lead to, kept once for all sites that see the lattice alike.
#include <doctest/doctest.h>

#include "fracture/peridynamics/far_ends.h"

#include <cstdlib>
#include <vector>

namespace stockwork::peridynamics_far_ends_test
{
using peridynamics::FarEnd;

namespace
{
/// Of a row of sites numbered from zero, bonds one and two to either side: images beyond the plane
/// of symmetry at its first site, and none beyond its last one.
std::vector<FarEnd> in_a_row(const int site, const int n_sites)
{
  std::vector<FarEnd> ends;
  for (const int offset : {-2, -1, 1, 2})
  {
    const int far = site + offset;
    if (far >= n_sites)
      ends.push_back({static_cast<unsigned int>(site), 0, true});
    else
      ends.push_back({static_cast<unsigned int>(std::abs(far)), far < 0});
  }
  return ends;
}
} // namespace


TEST_CASE("sites of a row share their far ends, but for those beside its ends")
{
  for (const int n_sites : {10, 1000})
  {
    peridynamics::FarEnds far_ends;
    far_ends.reinit(n_sites, 4);
    for (int i = 0; i < n_sites; ++i)
      far_ends.set(i, in_a_row(i, n_sites));
    for (int i = 0; i < n_sites; ++i)
      for (unsigned int b = 0; b < 4; ++b)
      {
        const FarEnd expected = in_a_row(i, n_sites)[b], found = far_ends(i, b);
        CHECK(found.site == expected.site);
        CHECK(found.mirrored == expected.mirrored);
        CHECK(found.absent == expected.absent);
      }
    // Two at each end, and all others.
    CHECK(far_ends.n_lists() == 5);
  }
}
} // namespace stockwork::peridynamics_far_ends_test
