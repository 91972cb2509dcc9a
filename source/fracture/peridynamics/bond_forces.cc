#include "fracture/peridynamics/bond_forces.h"

#include "fracture/peridynamics/lanes.h"

#include <algorithm>
#include <cstdlib>

namespace stockwork::peridynamics
{
namespace
{
/// Registers swept at once.
constexpr int n_registers = 2;
constexpr int sweep_width = n_registers * n_lanes;

/// n registers of sites that follow one another, and what their displacement is.
template <int dim, typename Value, int n>
struct SitesInARow
{
  static constexpr int width = sizeof(Value) / sizeof(double); ///< sites in a register

  SitesInARow(const LatticeField<dim> &u, const std::size_t first)
  {
    for (unsigned int d = 0; d < dim; ++d)
    {
      at[d] = u[d].data() + first;
      for (int r = 0; r < n; ++r)
        load(own[d][r], at[d] + r * width);
    }
  }

  std::array<const double *, dim> at; ///< of the first site, by component
  Value own[dim][n];
};
} // namespace

template <int dim>
std::size_t LatticeBox<dim>::n_sites() const
{
  std::size_t n = 1;
  for (const unsigned int s : size)
    n *= s;
  return n;
}

template <int dim>
std::array<unsigned int, dim> LatticeBox<dim>::position(std::size_t site) const
{
  std::array<unsigned int, dim> position;
  for (unsigned int d = 0; d < dim; ++d)
  {
    position[d] = site % size[d];
    site /= size[d];
  }
  return position;
}

template <int dim>
std::ptrdiff_t LatticeBox<dim>::stride(const std::array<int, dim> &offset) const
{
  std::ptrdiff_t stride = 0;
  for (int d = dim - 1; d >= 0; --d)
    stride = stride * static_cast<std::ptrdiff_t>(size[d]) + offset[d];
  return stride;
}

template <int dim>
bool LatticeBox<dim>::inside(const std::size_t site, const unsigned int margin) const
{
  const auto at = position(site);
  for (unsigned int d = 0; d < dim; ++d)
    if (at[d] < margin || at[d] + margin >= size[d])
      return false;
  return true;
}

template <int dim>
BondForces<dim>::BondForces(const LatticeBox<dim> &box,
                            const std::vector<StencilBond<dim>> &stencil,
                            const BondLaw &law,
                            const double spacing)
  : box(box)
  , law(law)
  , bonds(bond_coefficients(stencil, law, spacing))
  , dilatation_stiffness(law.dilatation_modulus)
  , reach(0)
{
  for (unsigned int d = 0; d < dim; ++d)
    dilatation_stiffness *= spacing;
  for (const auto &bond : stencil)
  {
    strides.push_back(box.stride(bond.offset));
    for (const int component : bond.offset)
      reach = std::max<unsigned int>(reach, std::abs(component));
  }
  for (unsigned int b = 0; b < bonds.size() / 2; ++b)
  {
    Pair pair;
    pair.by = strides[b];
    pair.per_length = 1. / bonds[b].length;
    pair.stiffness = bonds[b].stiffness;
    for (unsigned int d = 0; d < dim; ++d)
    {
      pair.direction[d] = bonds[b].direction[d];
      pair.force[d] = bonds[b].stiffness * bonds[b].direction[d];
      pair.dilatation[d] = bonds[b].dilatation * bonds[b].direction[d];
    }
    pairs.push_back(pair);
  }
  if (law.state_based())
    dilatation.assign(box.n_sites(), 0.);
}

template <int dim>
double BondForces<dim>::elongation(const LatticeField<dim> &u,
                                   const std::size_t site,
                                   const unsigned int b) const
{
  double sum = 0.;
  for (unsigned int d = 0; d < dim; ++d)
    sum += bonds[b].direction[d] * (u[d][site + strides[b]] - u[d][site]);
  return sum;
}

template <int dim>
double BondForces<dim>::stretch(const LatticeField<dim> &u,
                                const std::size_t site,
                                const unsigned int bond) const
{
  return elongation(u, site, bond) / bonds[bond].length;
}

template <int dim>
template <typename Wide, typename Narrow>
void BondForces<dim>::for_each_block(const unsigned int margin,
                                     const Wide &wide,
                                     const Narrow &narrow) const
{
  for (const unsigned int s : box.size)
    if (s <= 2 * margin)
      return;
  const unsigned int length = box.size[0] - 2 * margin;
  const unsigned int layers = (dim == 3 ? box.size[dim - 1] - 2 * margin : 1);
  for (unsigned int z = 0; z < layers; ++z)
    for (unsigned int y = margin; y < box.size[1] - margin; ++y)
    {
      const std::size_t layer = (dim == 3 ? z + margin : 0);
      for_each_block_of({(layer * box.size[1] + y) * box.size[0] + margin, length}, wide, narrow);
    }
}

template <int dim>
template <typename Wide, typename Narrow>
void BondForces<dim>::for_each_block_of(const Span &row,
                                        const Wide &wide,
                                        const Narrow &narrow) const
{
  unsigned int x = 0;
  for (; x + sweep_width <= row.length; x += sweep_width)
    wide(row.first + x);
  // A block that sees some sites twice takes less time than sites one by one.
  if (x > 0 && x < row.length)
    wide(row.first + row.length - sweep_width);
  else
    for (; x < row.length; ++x)
      narrow(row.first + x);
}

// Opposite bonds have opposite directions: what is even in the direction (force of the bond's own
// elongation) takes the sum of the two neighbours, what is odd their difference.

template <int dim>
template <typename Value, int n>
void BondForces<dim>::sweep_dilatation(const LatticeField<dim> &u, const std::size_t first)
{
  constexpr int width = sizeof(Value) / sizeof(double);
  Value theta[n] = {};
  for (const Pair &pair : pairs)
    for (int r = 0; r < n; ++r)
      for (unsigned int d = 0; d < dim; ++d)
      {
        const double *const at = u[d].data() + first + r * width;
        Value ahead, behind;
        load(ahead, at + pair.by);
        load(behind, at - pair.by);
        theta[r] += pair.dilatation[d] * (ahead - behind);
      }
  for (int r = 0; r < n; ++r)
    store(theta[r], dilatation.data() + first + r * width);
}

template <int dim>
template <typename Value, int n>
void BondForces<dim>::sweep(const LatticeField<dim> &u,
                            const std::size_t first,
                            LatticeField<dim> &force) const
{
  const SitesInARow<dim, Value, n> sites(u, first);
  const auto &[at, own] = sites;
  constexpr int width = SitesInARow<dim, Value, n>::width;
  Value sum[dim][n] = {};
  for (const Pair &pair : pairs)
    for (int r = 0; r < n; ++r)
    {
      Value elongation = {};
      for (unsigned int d = 0; d < dim; ++d)
      {
        const double *const here = at[d] + r * width;
        Value ahead, behind;
        load(ahead, here + pair.by);
        load(behind, here - pair.by);
        elongation += pair.direction[d] * ((ahead - own[d][r]) + (behind - own[d][r]));
      }
      for (unsigned int d = 0; d < dim; ++d)
        sum[d][r] += pair.force[d] * elongation;
    }
  if (law.state_based())
    for (const Pair &pair : pairs)
      for (int r = 0; r < n; ++r)
      {
        const double *const theta = dilatation.data() + first + r * width;
        Value ahead, behind;
        load(ahead, theta + pair.by);
        load(behind, theta - pair.by);
        const Value difference = dilatation_stiffness * (ahead - behind);
        for (unsigned int d = 0; d < dim; ++d)
          sum[d][r] += pair.dilatation[d] * difference;
      }
  for (unsigned int d = 0; d < dim; ++d)
    for (int r = 0; r < n; ++r)
      store(sum[d][r], force[d].data() + first + r * width);
}

template <int dim>
template <typename Value, int n>
void BondForces<dim>::watch(const LatticeField<dim> &u,
                            const std::size_t first,
                            const double limit,
                            LatticeField<dim> &force,
                            std::vector<std::size_t> &stretched) const
{
  const SitesInARow<dim, Value, n> sites(u, first);
  const auto &[at, own] = sites;
  constexpr int width = SitesInARow<dim, Value, n>::width;
  Value sum[dim][n] = {}, greatest[n] = {};
  for (const Pair &pair : pairs)
    for (int r = 0; r < n; ++r)
    {
      Value of_ahead = {}, of_behind = {};
      for (unsigned int d = 0; d < dim; ++d)
      {
        const double *const here = at[d] + r * width;
        Value ahead, behind;
        load(ahead, here + pair.by);
        load(behind, here - pair.by);
        of_ahead += pair.direction[d] * (ahead - own[d][r]);
        of_behind += pair.direction[d] * (own[d][r] - behind);
      }
      const Value longer = of_ahead > of_behind ? of_ahead : of_behind,
                  stretch = pair.per_length * longer;
      greatest[r] = stretch > greatest[r] ? stretch : greatest[r];
      for (unsigned int d = 0; d < dim; ++d)
        sum[d][r] += pair.force[d] * (of_ahead - of_behind);
    }
  for (unsigned int d = 0; d < dim; ++d)
    for (int r = 0; r < n; ++r)
      store(sum[d][r], force[d].data() + first + r * width);
  double of_sites[n * width];
  for (int r = 0; r < n; ++r)
    store(greatest[r], of_sites + r * width);
  for (int i = 0; i < n * width; ++i)
    if (of_sites[i] > limit)
      stretched.push_back(first + i);
}

template <int dim>
template <typename Value, int n>
void BondForces<dim>::sweep_energy(const LatticeField<dim> &u,
                                   const std::size_t first,
                                   std::vector<double> &energy) const
{
  const SitesInARow<dim, Value, n> sites(u, first);
  const auto &[at, own] = sites;
  constexpr int width = SitesInARow<dim, Value, n>::width;
  Value sum[n] = {};
  for (const Pair &pair : pairs)
    for (int r = 0; r < n; ++r)
    {
      Value of_ahead = {}, of_behind = {};
      for (unsigned int d = 0; d < dim; ++d)
      {
        const double *const here = at[d] + r * width;
        Value ahead, behind;
        load(ahead, here + pair.by);
        load(behind, here - pair.by);
        of_ahead += pair.direction[d] * (ahead - own[d][r]);
        of_behind += pair.direction[d] * (own[d][r] - behind);
      }
      sum[r] += pair.stiffness * (of_ahead * of_ahead + of_behind * of_behind);
    }
  for (int r = 0; r < n; ++r)
    store(0.25 * sum[r], energy.data() + first + r * width);
}

template <int dim>
void BondForces<dim>::energies(const LatticeField<dim> &u, std::vector<double> &energy) const
{
  for (const Span &row : swept)
    for_each_block_of(
      row, [&](const std::size_t site) { sweep_energy<Lanes, n_registers>(u, site, energy); },
      [&](const std::size_t site) { sweep_energy<double, 1>(u, site, energy); });
}

template <int dim>
void BondForces<dim>::evaluate(const LatticeField<dim> &u,
                               LatticeField<dim> &force,
                               const double limit,
                               std::vector<std::size_t> *const stretched) const
{
  if (stretched != nullptr)
    stretched->clear();
  for (const Span &row : swept)
    if (stretched != nullptr)
      for_each_block_of(
        row,
        [&](const std::size_t site)
        { watch<Lanes, n_registers>(u, site, limit, force, *stretched); },
        [&](const std::size_t site) { watch<double, 1>(u, site, limit, force, *stretched); });
    else
      for_each_block_of(
        row, [&](const std::size_t site) { sweep<Lanes, n_registers>(u, site, force); },
        [&](const std::size_t site) { sweep<double, 1>(u, site, force); });
}

template <int dim>
void BondForces<dim>::compute_dilatation(const LatticeField<dim> &u, const BrokenBonds &broken)
{
  for_each_block(
    reach, [&](const std::size_t site) { sweep_dilatation<Lanes, n_registers>(u, site); },
    [&](const std::size_t site) { sweep_dilatation<double, 1>(u, site); });
  for (const std::size_t site : broken.sites())
    if (box.inside(site, reach))
      broken.for_each(site, [&](const unsigned int b)
                      { dilatation[site] -= bonds[b].dilatation * elongation(u, site, b); });
}

template <int dim>
void BondForces<dim>::evaluate(const LatticeField<dim> &u,
                               const BrokenBonds &broken,
                               LatticeField<dim> &force)
{
  if (law.state_based())
    compute_dilatation(u, broken);
  for_each_block(
    margin(), [&](const std::size_t site) { sweep<Lanes, n_registers>(u, site, force); },
    [&](const std::size_t site) { sweep<double, 1>(u, site, force); });

  for (const std::size_t site : broken.sites())
    if (box.inside(site, margin()))
      broken.for_each(site,
                      [&](const unsigned int b)
                      {
                        double magnitude = bonds[b].stiffness * elongation(u, site, b);
                        if (law.state_based())
                          magnitude += dilatation_stiffness * bonds[b].dilatation *
                                       (dilatation[site] + dilatation[site + strides[b]]);
                        for (unsigned int d = 0; d < dim; ++d)
                          force[d][site] -= magnitude * bonds[b].direction[d];
                      });
}

template struct LatticeBox<2>;
template struct LatticeBox<3>;
template class BondForces<2>;
template class BondForces<3>;
} // namespace stockwork::peridynamics
