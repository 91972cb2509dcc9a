#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace stockwork::peridynamics
{
/// Which bonds of which sites are broken: one bit per site and bond of the stencil. Both ends of a
/// bond have a bit; who breaks it sets both.
class BrokenBonds
{
public:
  BrokenBonds(const std::size_t n_sites = 0, const unsigned int n_bonds = 0)
    : words_per_site((n_bonds + 63) / 64)
    , words(n_sites * words_per_site, 0)
  {
  }

  bool operator()(const std::size_t site, const unsigned int bond) const
  {
    return words[site * words_per_site + bond / 64] >> (bond % 64) & 1u;
  }

  void set(const std::size_t site, const unsigned int bond)
  {
    if (!any(site))
      damaged.push_back(site);
    words[site * words_per_site + bond / 64] |= std::uint64_t(1) << (bond % 64);
  }

  bool any(const std::size_t site) const
  {
    for (unsigned int w = 0; w < words_per_site; ++w)
      if (words[site * words_per_site + w] != 0)
        return true;
    return false;
  }

  /// The sites that have broken bonds, in the order in which they lost the first one.
  const std::vector<std::size_t> &sites() const
  {
    return damaged;
  }

  /// Call @p f(bond) for each broken bond of @p site.
  template <typename Function>
  void for_each(const std::size_t site, const Function &f) const
  {
    for (unsigned int w = 0; w < words_per_site; ++w)
    {
      const std::uint64_t word = words[site * words_per_site + w];
      for (unsigned int bit = 0; bit < 64 && word >> bit != 0; ++bit)
        if (word >> bit & 1u)
          f(64 * w + bit);
    }
  }

private:
  std::size_t words_per_site;
  std::vector<std::uint64_t> words;
  std::vector<std::size_t> damaged;
};
} // namespace stockwork::peridynamics
