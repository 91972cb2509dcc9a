#include "fracture/peridynamics/uneven_bonds.h"

#include <algorithm>
#include <limits>

namespace stockwork::peridynamics
{
template <int dim>
UnevenBonds<dim>::UnevenBonds(const std::vector<BondCoefficients<dim>> &bonds,
                              const LatticeBox<dim> &box,
                              const std::vector<std::ptrdiff_t> &strides)
  : bonds(bonds)
  , strides(strides)
  , row_of(box.n_sites() / n_lanes + 1, dealii::numbers::invalid_unsigned_int)
{
}


template <int dim>
void UnevenBonds<dim>::add(const std::size_t site)
{
  unsigned int &row = row_of[site / n_lanes];
  if (row == dealii::numbers::invalid_unsigned_int)
  {
    if (is_starting && !rows.empty())
      share(rows.back());
    row = rows.size();
    rows.push_back({site / n_lanes * n_lanes, static_cast<unsigned int>(sets.size()), {}});
    Values absent;
    std::fill_n(absent.limit, n_lanes, std::numeric_limits<double>::infinity());
    sets.emplace_back(bonds.size(), absent);
  }
  rows[row].is_one[site % n_lanes] = true;
}


template <int dim>
void UnevenBonds<dim>::set(const std::size_t site,
                           const unsigned int bond,
                           const double stiffness,
                           const double limit)
{
  Row &row = rows[row_of[site / n_lanes]];
  if (row.set < n_shared) // it may be another's as well; few rows change, those beside cracks
  {
    sets.push_back(sets[row.set]);
    row.set = sets.size() - 1;
  }
  Values &of_bond = sets[row.set][bond];
  of_bond.stiffness[site % n_lanes] = stiffness;
  of_bond.limit[site % n_lanes] = limit;
}


template <int dim>
void UnevenBonds<dim>::share(Row &row)
{
  Assert(row.set + 1 == sets.size(), dealii::ExcMessage("rows are complete before the next"));
  // A set that has been shared is never written to again.
  const std::vector<Values> &own = sets[row.set];
  const auto [found, is_new] = known.emplace(
    std::string_view(reinterpret_cast<const char *>(own.data()), own.size() * sizeof(Values)),
    row.set);
  row.set = found->second;
  if (!is_new)
    sets.pop_back();
  n_shared = sets.size();
}


template <int dim>
void UnevenBonds<dim>::end_start()
{
  if (!rows.empty())
    share(rows.back());
  known.clear();
  is_starting = false;
}


template <int dim>
template <bool looks>
void UnevenBonds<dim>::sweep(const LatticeField<dim> &u,
                             LatticeField<dim> &force,
                             std::vector<std::size_t> *const beyond) const
{
  for (const Row &row : rows)
  {
    const Values *bond = sets[row.set].data();
    Lanes own[dim], sum[dim] = {};
    for (unsigned int d = 0; d < dim; ++d)
      load(own[d], u[d].data() + row.first);
    auto is_beyond = own[0] != own[0];
    for (unsigned int b = 0; b < bonds.size(); ++b, ++bond)
    {
      Lanes elongation = {}, stiffness;
      for (unsigned int d = 0; d < dim; ++d)
      {
        Lanes far;
        load(far, u[d].data() + row.first + strides[b]);
        elongation += bonds[b].direction[d] * (far - own[d]);
      }
      load(stiffness, bond->stiffness);
      if constexpr (looks)
      {
        Lanes limit;
        load(limit, bond->limit);
        is_beyond |= elongation > limit;
      }
      const Lanes along = stiffness * elongation;
      for (unsigned int d = 0; d < dim; ++d)
        sum[d] += bonds[b].direction[d] * along;
    }
    for (int i = 0; i < n_lanes; ++i)
      if (row.is_one[i])
      {
        for (unsigned int d = 0; d < dim; ++d)
          force[d][row.first + i] = sum[d][i];
        if (looks && is_beyond[i])
          beyond->push_back(row.first + i);
      }
  }
}


template <int dim>
void UnevenBonds<dim>::evaluate(const LatticeField<dim> &u,
                                LatticeField<dim> &force,
                                std::vector<std::size_t> *const beyond) const
{
  if (beyond == nullptr)
    return sweep<false>(u, force, nullptr);
  beyond->clear();
  sweep<true>(u, force, beyond);
}


template <int dim>
void UnevenBonds<dim>::energies(const LatticeField<dim> &u, std::vector<double> &energy) const
{
  for (const Row &row : rows)
  {
    const Values *bond = sets[row.set].data();
    Lanes sum = {};
    for (unsigned int b = 0; b < bonds.size(); ++b, ++bond)
    {
      Lanes elongation = {}, stiffness;
      for (unsigned int d = 0; d < dim; ++d)
      {
        Lanes own, far;
        load(own, u[d].data() + row.first);
        load(far, u[d].data() + row.first + strides[b]);
        elongation += bonds[b].direction[d] * (far - own);
      }
      load(stiffness, bond->stiffness);
      sum += 0.25 * stiffness * elongation * elongation;
    }
    for (int i = 0; i < n_lanes; ++i)
      if (row.is_one[i])
        energy[row.first + i] = sum[i];
  }
}


template class UnevenBonds<2>;
template class UnevenBonds<3>;
} // namespace stockwork::peridynamics
