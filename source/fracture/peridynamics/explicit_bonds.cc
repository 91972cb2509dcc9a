#include "fracture/peridynamics/explicit_bonds.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace stockwork::peridynamics
{
namespace
{
/// In place of a number among the listed sites.
constexpr unsigned int unlisted = dealii::numbers::invalid_unsigned_int,
                       never_listed = unlisted - 1;

/// Sweeps look at a bond a little before it is stretched so far that it breaks: both of its ends
/// are then told by the same arithmetic.
constexpr double nearly = 1. - 1e-12;
} // namespace


template <int dim>
ExplicitBonds<dim>::ExplicitBonds(
  const Zone<dim> &zone,
  const std::vector<StencilBond<dim>> &stencil,
  const BondLaw &law,
  const SofteningLaw &softening,
  const double by_fluid,
  const std::function<Bond(unsigned int site, unsigned int bond)> &bond,
  const unsigned int rank)
  : zone(zone)
  , stencil(stencil)
  , softening(softening)
  , by_fluid(by_fluid)
  , coefficients(bond_coefficients<dim>(stencil, law, zone.spacing()))
  , rank(rank)
{
  find_box();
  find_sources();
  kernel = std::make_unique<BondForces<dim>>(box, stencil, law, zone.spacing());
  uneven = std::make_unique<UnevenBonds<dim>>(coefficients, box, strides);
  for (unsigned int k = 0; k < own_sites.size(); ++k)
  {
    std::vector<Bond> bonds;
    bool is_whole = true, stays_whole = true;
    for (unsigned int b = 0; b < stencil.size(); ++b)
    {
      bonds.push_back(bond(own_sites[k], b));
      const Bond &last = bonds.back();
      const bool is_elastic = last.stiffness == coefficients[b].stiffness && last.greatest == 0.;
      is_whole = is_whole && is_elastic && last.amplification == 1.;
      stays_whole = stays_whole && is_elastic && last.amplification == 0.;
    }
    if (stays_whole)
      list_of[k] = never_listed;
    if (is_whole || stays_whole)
      continue;
    list(k, bonds);
  }
  uneven->end_start();
  find_spans();
  for (const BondCoefficients<dim> &bond : coefficients)
    bonds_of_lattice.push_back({bond.stiffness, 1., 0., by_fluid});
  is_wet.assign(box.n_sites(), false);
  work_of_fluid = stored_by_fluid();
}


template <int dim>
std::size_t ExplicitBonds<dim>::place_of(const unsigned int site) const
{
  std::array<int, dim> offset;
  for (unsigned int d = 0; d < dim; ++d)
    offset[d] = zone.sites()[site].place[d] - corner[d];
  return box.stride(offset);
}


template <int dim>
void ExplicitBonds<dim>::find_box()
{
  int reach = 0;
  for (const StencilBond<dim> &bond : stencil)
    for (unsigned int d = 0; d < dim; ++d)
      reach = std::max(reach, std::abs(bond.offset[d]));
  Place<dim> upper;
  corner.fill(std::numeric_limits<int>::max());
  upper.fill(std::numeric_limits<int>::lowest());
  for (const unsigned int i : zone.peridynamic_sites())
    if (zone.sites()[i].owner == rank)
    {
      own_sites.push_back(i);
      for (unsigned int d = 0; d < dim; ++d)
      {
        const int around = d == 0 ? reach + UnevenBonds<dim>::overhang : reach;
        corner[d] = std::min(corner[d], zone.sites()[i].place[d] - around);
        upper[d] = std::max(upper[d], zone.sites()[i].place[d] + around);
      }
    }
  for (unsigned int d = 0; d < dim; ++d)
    box.size[d] = own_sites.empty() ? 0 : upper[d] - corner[d] + 1;
  for (const StencilBond<dim> &bond : stencil)
    strides.push_back(box.stride(bond.offset));
  std::sort(own_sites.begin(), own_sites.end(),
            [&](const unsigned int i, const unsigned int j) { return place_of(i) < place_of(j); });
  number.assign(box.n_sites(), unlisted);
  for (unsigned int k = 0; k < own_sites.size(); ++k)
  {
    own_places.push_back(place_of(own_sites[k]));
    own_shares.push_back(zone.sites()[own_sites[k]].share);
    if (own_shares[k] != 1.)
      on_planes.push_back(k);
    number[own_places.back()] = k;
  }
  list_of.assign(own_sites.size(), unlisted);
  for (unsigned int d = 0; d < dim; ++d)
  {
    u[d].assign(box.n_sites(), 0.);
    u_before[d].assign(box.n_sites(), 0.);
    f[d].assign(box.n_sites(), 0.);
  }
}


template <int dim>
void ExplicitBonds<dim>::find_sources()
{
  std::vector<bool> is_known(box.n_sites(), false);
  const auto add = [&](const std::size_t place, const FarEnd &from)
  {
    if (is_known[place])
      return;
    is_known[place] = true;
    sources.push_back({place, from.site, from.mirrored, {}});
  };
  for (const unsigned int place : own_places)
    is_known[place] = true;
  for (unsigned int k = 0; k < own_sites.size(); ++k)
    for (unsigned int b = 0; b < stencil.size(); ++b)
      if (const FarEnd end = zone.far_end(own_sites[k], b); !end.absent)
        add(own_places[k] + strides[b], end);
}


/// Own sites that follow one another in the direction of x, but for those listed at the start.
template <int dim>
void ExplicitBonds<dim>::find_spans()
{
  std::vector<typename BondForces<dim>::Span> spans;
  for (unsigned int k = 0; k < own_sites.size(); ++k)
  {
    if (list_of[k] < never_listed)
      continue;
    const std::size_t place = own_places[k];
    if (!spans.empty() && spans.back().first + spans.back().length == place)
      ++spans.back().length;
    else
      spans.push_back({place, 1});
  }
  kernel->sweep_only(spans);
}


template <int dim>
dealii::IndexSet ExplicitBonds<dim>::seen() const
{
  std::vector<dealii::types::global_dof_index> dofs;
  for (const Source &source : sources)
    dofs.insert(dofs.end(), zone.sites()[source.site].dofs.begin(),
                zone.sites()[source.site].dofs.end());
  std::sort(dofs.begin(), dofs.end());
  dealii::IndexSet set(dim * zone.n_peridynamic_sites());
  set.add_indices(dofs.begin(), std::unique(dofs.begin(), dofs.end()));
  return set;
}


template <int dim>
void ExplicitBonds<dim>::set_layout(const Vector &vector)
{
  const auto &partitioner = *vector.get_partitioner();
  for (Source &source : sources)
    for (unsigned int d = 0; d < dim; ++d)
      source.local[d] = partitioner.global_to_local(zone.sites()[source.site].dofs[d]);
  own_unknowns.clear();
  for (const unsigned int site : own_sites)
  {
    own_unknowns.emplace_back();
    for (unsigned int d = 0; d < dim; ++d)
      own_unknowns.back()[d] = partitioner.global_to_local(zone.sites()[site].dofs[d]);
  }
  find_runs();
  if (by_fluid != 0.)
  {
    wetness.reinit(vector);
    find_wet_sites();
  }
}


template <int dim>
void ExplicitBonds<dim>::find_runs()
{
  runs.clear();
  for (unsigned int k = 0; k < own_sites.size(); ++k)
  {
    const auto follows = [&](const Run &run)
    {
      bool does = run.place + run.length == own_places[k];
      for (unsigned int d = 0; d < dim; ++d)
        does = does && run.unknowns[d] + dim * run.length == own_unknowns[k][d];
      return does;
    };
    if (!runs.empty() && follows(runs.back()))
      ++runs.back().length;
    else
      runs.push_back({own_places[k], own_unknowns[k], 1});
  }
}


template <int dim>
void ExplicitBonds<dim>::add_row_sums(Vector &sums) const
{
  for (unsigned int k = 0; k < own_sites.size(); ++k)
    for (unsigned int b = 0; b < stencil.size(); ++b)
    {
      const double stiffness = list_of[k] < never_listed ? listed[list_of[k]].bonds[b].stiffness
                                                         : coefficients[b].stiffness;
      const dealii::Tensor<1, dim> &e = coefficients[b].direction;
      double of_components = 0.;
      for (unsigned int d = 0; d < dim; ++d)
        of_components += std::abs(e[d]);
      for (unsigned int d = 0; d < dim; ++d)
        sums.local_element(own_unknowns[k][d]) +=
          2. * zone.sites()[own_sites[k]].share * stiffness * std::abs(e[d]) * of_components;
    }
}


template <int dim>
void ExplicitBonds<dim>::list(const unsigned int own, const std::vector<Bond> &bonds)
{
  list_of[own] = listed.size();
  listed.push_back({own, bonds});
  Listed &site = listed.back();
  uneven->add(own_places[own]);
  for (unsigned int b = 0; b < stencil.size(); ++b)
  {
    site.is_damaged = site.is_damaged || damage(bonds[b]) > 0.;
    tell_sweep(site, b);
  }
  site.has_changed = site.is_damaged;
}


template <int dim>
void ExplicitBonds<dim>::tell_sweep(const Listed &site, const unsigned int b)
{
  const Bond &bond = site.bonds[b];
  const double damage = this->damage(bond);
  double limit = std::numeric_limits<double>::infinity();
  if (bond.by_fluid != 0. && damage > 0.)
    limit = -limit; // it pushes, and does work
  else if (bond.stiffness > 0. && bond.amplification > 0. && damage < 1.)
    limit =
      nearly * coefficients[b].length *
      (std::max(bond.greatest, softening.first) / bond.amplification - std::max(0., bond.by_fluid));
  uneven->set(own_places[site.own], b, (1. - damage) * bond.stiffness, limit);
}


template <int dim>
void ExplicitBonds<dim>::find_wet_sites()
{
  wetness.zero_out_ghost_values();
  for (const Listed &site : listed)
    for (const Bond &bond : site.bonds)
      if (bond.stiffness > 0. && softening.damage(bond.greatest) >= 1.)
        wetness.local_element(own_unknowns[site.own][0]) = 1.;
  wetness.update_ghost_values();
  for (unsigned int k = 0; k < own_sites.size(); ++k)
    is_wet[own_places[k]] = wetness.local_element(own_unknowns[k][0]) > 0.;
  for (const Source &source : sources)
    is_wet[source.place] = wetness.local_element(source.local[0]) > 0.;
}


template <int dim>
void ExplicitBonds<dim>::look_at(Listed &site, const bool breaks)
{
  const std::size_t place = own_places[site.own];
  const double share = own_shares[site.own];
  std::array<double, dim> sum = {};
  for (unsigned int b = 0; b < stencil.size(); ++b)
  {
    Bond &bond = site.bonds[b];
    if (bond.stiffness == 0.)
      continue;
    const BondCoefficients<dim> &whole = coefficients[b];
    const double elongation = elongation_at(place, b);
    // The pressure of the fluid is worth this elongation, see pressure_in_bonds.cc.
    const double of_fluid = bond.by_fluid * whole.length;
    const double damage_before = this->damage(bond);
    const bool has_fluid = damage_before > 0. || feels_fluid(place, b);
    const double effective = elongation + (has_fluid ? of_fluid : 0.);
    const double stretch = bond.amplification * effective / whole.length;
    double damage = damage_before;
    if (breaks && damage < 1. && stretch > softening.first && stretch > bond.greatest)
    {
      site.has_changed = site.is_damaged = true;
      bond.greatest = stretch;
      damage = softening.damage(stretch);
      tell_sweep(site, b);
    }
    if (breaks && damage > 0. && (damage != damage_before || of_fluid != 0.))
    {
      double before = effective - elongation;
      for (unsigned int d = 0; d < dim; ++d)
        before += whole.direction[d] * (u_before[d][place + strides[b]] - u_before[d][place]);
      // What the scheme takes from the motion, by the mean force times the elongation gained, less
      // what is stored: 1/2 k e_0 e_1 (D_1 - D_0), half of it at each end. With fluid elongations
      // are effective ones, and the fluid does p dV, V = k D e l / (C11 + (d-1) C12).
      const double half = 0.5 * share * bond.stiffness;
      energy += 0.5 * half * before * effective * (damage - damage_before);
      // Where a bond has broken dry, fluid comes when it has: its force acts at the end of this
      // displacement only, which is half of that, and it stores what it does elsewhere.
      work_of_fluid += half * of_fluid *
                       (has_fluid ? damage * effective - damage_before * before
                                  : 0.5 * damage * (effective - before + of_fluid));
    }
    const double force = bond.stiffness * ((1. - damage) * elongation - damage * of_fluid);
    for (unsigned int d = 0; d < dim; ++d)
      sum[d] += force * whole.direction[d];
  }
  for (unsigned int d = 0; d < dim; ++d)
    f[d][place] = sum[d];
}


template <int dim>
void ExplicitBonds<dim>::forces(const Vector &displacement, const bool breaks, Vector &force)
{
  if (breaks)
    std::swap(u, u_before);
  for (const Run &run : runs)
    for (unsigned int d = 0; d < dim; ++d)
    {
      const double *const from = displacement.begin() + run.unknowns[d];
      double *const to = u[d].data() + run.place;
      for (unsigned int j = 0; j < run.length; ++j)
        to[j] = from[dim * j];
    }
  for (const Source &source : sources)
    for (unsigned int d = 0; d < dim; ++d)
    {
      const double value = displacement.local_element(source.local[d]);
      u[d][source.place] = source.mirrored >> d & 1 ? -value : value;
    }
  kernel->evaluate(u, f, nearly * (softening.first - std::max(0., by_fluid)),
                   breaks ? &stretched : nullptr);
  const bool looks = breaks || by_fluid != 0.;
  uneven->evaluate(u, f, looks ? &beyond : nullptr);
  if (looks)
    for (const std::size_t place : beyond)
      look_at(listed[list_of[number[place]]], breaks);
  if (breaks)
    for (const std::size_t place : stretched)
      if (const unsigned int own = number[place]; list_of[own] == unlisted)
      {
        list(own, bonds_of_lattice);
        look_at(listed.back(), breaks);
      }
  if (breaks && by_fluid != 0.)
    find_wet_sites();
  for (const Run &run : runs)
    for (unsigned int d = 0; d < dim; ++d)
    {
      const double *const from = f[d].data() + run.place;
      double *const to = force.begin() + run.unknowns[d];
      for (unsigned int j = 0; j < run.length; ++j)
        to[dim * j] = from[j];
    }
  for (const unsigned int k : on_planes)
    for (unsigned int d = 0; d < dim; ++d)
      force.local_element(own_unknowns[k][d]) *= own_shares[k];
}


template <int dim>
std::vector<unsigned int> ExplicitBonds<dim>::detached() const
{
  constexpr double hardly = 0.05; // of the stiffness at the start
  std::vector<unsigned int> result;
  for (const Listed &site : listed)
  {
    if (!site.is_damaged)
      continue;
    // A row that comes off keeps the bonds along it.
    for (unsigned int d = 0; d < dim; ++d)
    {
      double left = 0., all = 0.;
      for (unsigned int b = 0; b < stencil.size(); ++b)
      {
        const Bond &bond = site.bonds[b];
        const double stiffness =
          bond.stiffness * coefficients[b].direction[d] * coefficients[b].direction[d];
        all += stiffness;
        left += stiffness * (1. - damage(bond));
      }
      if (left < hardly * all)
        result.push_back(own_unknowns[site.own][d]);
    }
  }
  return result;
}


template <int dim>
double ExplicitBonds<dim>::stored_by_fluid() const
{
  double stored = 0.;
  if (by_fluid == 0.)
    return stored;
  for (const Listed &site : listed)
    for (unsigned int b = 0; b < stencil.size(); ++b)
      if (const Bond &bond = site.bonds[b]; bond.greatest > 0.)
        stored += 0.25 * own_shares[site.own] * bond.stiffness * softening.damage(bond.greatest) *
                  std::pow(bond.by_fluid * coefficients[b].length, 2);
  return stored;
}


template <int dim>
double ExplicitBonds<dim>::stored() const
{
  std::vector<double> of_site(box.n_sites());
  kernel->energies(u, of_site);
  uneven->energies(u, of_site); // of the listed ones, in place of what they had if all were whole
  double stored = 0.;
  for (unsigned int k = 0; k < own_sites.size(); ++k)
    stored += own_shares[k] * of_site[own_places[k]];
  return stored;
}


template <int dim>
double ExplicitBonds<dim>::elongation(const unsigned int site, const unsigned int bond) const
{
  return elongation_at(place_of(site), bond);
}


template <int dim>
std::vector<typename ExplicitBonds<dim>::Softened> ExplicitBonds<dim>::take_changes()
{
  std::vector<Softened> result;
  for (Listed &site : listed)
  {
    if (!site.has_changed)
      continue;
    site.has_changed = false;
    for (unsigned int b = 0; b < stencil.size(); ++b)
      if (Bond &bond = site.bonds[b];
          bond.stiffness > 0. && bond.greatest > std::max(bond.told, softening.first))
      {
        result.push_back({zone.sites()[own_sites[site.own]].place, b, bond.greatest});
        bond.told = bond.greatest;
      }
  }
  return result;
}


template class ExplicitBonds<2>;
template class ExplicitBonds<3>;
} // namespace stockwork::peridynamics
