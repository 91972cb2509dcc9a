#pragma once

#include <cstddef>
#include <unordered_map>
#include <vector>

namespace stockwork::peridynamics
{
/// The far end of a bond. Beyond a plane of symmetry (a roller boundary) it is the image of a site
/// of the domain, with the components of displacement in `mirrored` reversed.
/// Beyond a free boundary there is none: the bond is absent, and leads back to its own site.
struct FarEnd
{
  unsigned int site;
  unsigned char mirrored = 0; ///< bit d: reflected in direction d
  bool absent = false;
};

/// The far ends of the bonds of sites. A bond leads as far on in the numbering as that of the next
/// site in a row does, so nearly all sites share a list of such ways with others, and a site has
/// only the number of its list: in three dimensions its 250 far ends would be 2 kB.
class FarEnds
{
public:
  /// Of no site so far.
  void reinit(std::size_t n_sites, unsigned int n_bonds);

  /// @param ends of all of its bonds
  void set(unsigned int site, const std::vector<FarEnd> &ends);

  FarEnd operator()(const unsigned int site, const unsigned int bond) const
  {
    return on_list(list_of[site], site, bond);
  }

  /// Where a bond would lead to if the site were like the one that was set last.
  /// @pre one has been set
  FarEnd as_of_the_last(const unsigned int site, const unsigned int bond) const
  {
    return on_list(last, site, bond);
  }

  std::size_t n_lists() const
  {
    return n_bonds == 0 ? 0 : ways.size() / n_bonds;
  }

private:
  FarEnd on_list(const unsigned int list, const unsigned int site, const unsigned int bond) const
  {
    FarEnd end = ways[static_cast<std::size_t>(list) * n_bonds + bond];
    end.site += site;
    return end;
  }

  bool is_list(unsigned int list, unsigned int site, const std::vector<FarEnd> &ends) const;

  unsigned int n_bonds = 0, last = 0;
  std::vector<FarEnd> ways; ///< list after list; the site counts from the bond's own, modulo 2^32
  std::vector<unsigned int> list_of; ///< by site
  std::unordered_multimap<std::size_t, unsigned int> lists_by_hash;
};
} // namespace stockwork::peridynamics
