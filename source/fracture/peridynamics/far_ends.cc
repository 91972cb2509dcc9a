#include "fracture/peridynamics/far_ends.h"

#include <boost/functional/hash.hpp>

namespace stockwork::peridynamics
{
void FarEnds::reinit(const std::size_t n_sites, const unsigned int n)
{
  n_bonds = n;
  last = 0;
  ways.clear();
  lists_by_hash.clear();
  list_of.assign(n_sites, 0);
}


void FarEnds::set(const unsigned int site, const std::vector<FarEnd> &ends)
{
  if (!ways.empty() && is_list(last, site, ends))
  {
    list_of[site] = last;
    return;
  }
  std::size_t hash = 0;
  for (const FarEnd &end : ends)
  {
    boost::hash_combine(hash, end.site - site);
    boost::hash_combine(hash, end.mirrored);
    boost::hash_combine(hash, end.absent);
  }
  const auto [first, behind] = lists_by_hash.equal_range(hash);
  for (auto known = first; known != behind; ++known)
    if (is_list(known->second, site, ends))
    {
      list_of[site] = last = known->second;
      return;
    }
  list_of[site] = last = n_lists();
  lists_by_hash.emplace(hash, last);
  for (FarEnd end : ends)
  {
    end.site -= site;
    ways.push_back(end);
  }
}


bool FarEnds::is_list(const unsigned int list,
                      const unsigned int site,
                      const std::vector<FarEnd> &ends) const
{
  for (unsigned int b = 0; b < n_bonds; ++b)
  {
    const FarEnd known = on_list(list, site, b);
    if (known.site != ends[b].site || known.mirrored != ends[b].mirrored ||
        known.absent != ends[b].absent)
      return false;
  }
  return true;
}
} // namespace stockwork::peridynamics
