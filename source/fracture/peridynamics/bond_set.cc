#include "fracture/peridynamics/bond_set.h"

#include <algorithm>

namespace stockwork::peridynamics
{
template <int dim>
void BondSet<dim>::reinit(const Zone<dim> &new_zone, const std::vector<StencilBond<dim>> &bonds)
{
  zone = &new_zone;
  stencil = bonds;
  index_of_offset.clear();
  for (unsigned int b = 0; b < stencil.size(); ++b)
    index_of_offset[stencil[b].offset] = b;
  number.assign(zone->sites().size(), dealii::numbers::invalid_unsigned_int);
  unsigned int n = 0;
  for (const unsigned int i : zone->peridynamic_sites())
    number[i] = n++;
  broken = BrokenBonds(n, stencil.size());
}


template <int dim>
unsigned int BondSet<dim>::bond(const Place<dim> &offset) const
{
  const auto found = index_of_offset.find(offset);
  return found == index_of_offset.end() ? dealii::numbers::invalid_unsigned_int : found->second;
}


template <int dim>
unsigned int BondSet<dim>::reflected(const unsigned int b, const unsigned int mirrored) const
{
  if (mirrored == 0)
    return b;
  Place<dim> offset = stencil[b].offset;
  for (unsigned int d = 0; d < dim; ++d)
    if (mirrored >> d & 1)
      offset[d] = -offset[d];
  return bond(offset);
}


template <int dim>
std::vector<BondView> BondSet<dim>::views_of(const unsigned int site, const unsigned int bond) const
{
  std::vector<BondView> views;
  for_each_view(site, bond,
                [&](const unsigned int s, const unsigned int b) { views.emplace_back(s, b); });
  std::sort(views.begin(), views.end());
  views.erase(std::unique(views.begin(), views.end()), views.end());
  return views;
}


template <int dim>
void BondSet<dim>::set_broken(const unsigned int site, const unsigned int bond)
{
  for_each_view(site, bond,
                [&](const unsigned int s, const unsigned int b) { broken.set(number[s], b); });
}


template <int dim>
unsigned int BondSet<dim>::n_broken(const unsigned int site) const
{
  unsigned int n = 0;
  broken.for_each(number[site], [&](const unsigned int) { ++n; });
  return n;
}


template <int dim>
double BondSet<dim>::damage(const unsigned int site) const
{
  if (!broken.any(number[site]))
    return 0.;
  double gone = 0., all = 0.;
  for (const StencilBond<dim> &bond : stencil)
    all += bond.volume_fraction;
  broken.for_each(
    number[site], [&](const unsigned int b)
    { gone += stencil[b].volume_fraction * zone->sites()[zone->far_end(site, b).site].volume; });
  return gone / all;
}


template <int dim>
std::vector<unsigned int> BondSet<dim>::damaged_sites() const
{
  std::vector<unsigned int> sites;
  for (const std::size_t k : broken.sites())
    sites.push_back(zone->peridynamic_sites()[k]);
  return sites;
}


template <int dim>
std::vector<BondPlaces<dim>> BondSet<dim>::places() const
{
  std::vector<BondPlaces<dim>> result;
  if (zone == nullptr)
    return result;
  for (const std::size_t k : broken.sites())
    broken.for_each(k,
                    [&, i = zone->peridynamic_sites()[k]](const unsigned int b)
                    {
                      if (b < stencil.size() / 2 || zone->far_end(i, b).mirrored != 0)
                        result.push_back(places(i, b));
                    });
  std::sort(result.begin(), result.end());
  return result;
}


template <int dim>
BondPlaces<dim> BondSet<dim>::places(const unsigned int site, const unsigned int bond) const
{
  const Place<dim> &from = zone->sites()[site].place;
  Place<dim> far = from;
  for (unsigned int d = 0; d < dim; ++d)
    far[d] += stencil[bond].offset[d];
  return {from, far};
}


template <int dim>
std::optional<BondView> BondSet<dim>::find(const BondPlaces<dim> &places) const
{
  const auto [first, second] = places;
  for (const auto &[from, to] : {std::make_pair(first, second), std::make_pair(second, first)})
  {
    const unsigned int site = zone->find(from);
    Place<dim> offset;
    for (unsigned int d = 0; d < dim; ++d)
      offset[d] = to[d] - from[d];
    const unsigned int b = bond(offset);
    if (site != dealii::numbers::invalid_unsigned_int && zone->sites()[site].has_bonds &&
        b != dealii::numbers::invalid_unsigned_int && can_break(site, b))
      return std::make_pair(site, b);
  }
  return {};
}


template <int dim>
void BondSet<dim>::set_broken(const std::vector<BondPlaces<dim>> &places)
{
  for (const BondPlaces<dim> &ends : places)
    if (const auto found = find(ends))
      set_broken(found->first, found->second);
}


template class BondSet<2>;
template class BondSet<3>;
} // namespace stockwork::peridynamics
