#include "fracture/peridynamics/uneven_bonds.h"

#include <algorithm>
#include <limits>
#include <string_view>
#include <unordered_map>

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
    row = rows.size();
    rows.push_back({site / n_lanes * n_lanes, static_cast<unsigned int>(n_rows.size()), {}});
    n_rows.push_back(1);
    Values absent;
    std::fill_n(absent.limit, n_lanes, std::numeric_limits<double>::infinity());
    values.resize(values.size() + bonds.size(), absent);
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
  if (n_rows[row.set] > 1)
  {
    --n_rows[row.set];
    const std::size_t begin = row.set * bonds.size();
    row.set = n_rows.size();
    n_rows.push_back(1);
    values.resize(values.size() + bonds.size());
    std::copy_n(values.begin() + begin, bonds.size(), values.end() - bonds.size());
  }
  Values &of_bond = values[row.set * bonds.size() + bond];
  of_bond.stiffness[site % n_lanes] = stiffness;
  of_bond.limit[site % n_lanes] = limit;
}


template <int dim>
void UnevenBonds<dim>::share_equal()
{
  std::unordered_map<std::string_view, unsigned int> known; // by their bytes
  std::vector<Values> shared;
  n_rows.clear();
  for (Row &row : rows)
  {
    const Values *const begin = values_of(row);
    const std::string_view bytes(reinterpret_cast<const char *>(begin),
                                 bonds.size() * sizeof(Values));
    const auto [set, is_new] = known.emplace(bytes, n_rows.size());
    if (is_new)
    {
      shared.insert(shared.end(), begin, begin + bonds.size());
      n_rows.push_back(0);
    }
    row.set = set->second;
    ++n_rows[row.set];
  }
  values = std::move(shared);
}


template <int dim>
template <bool looks>
void UnevenBonds<dim>::sweep(const LatticeField<dim> &u,
                             LatticeField<dim> &force,
                             std::vector<std::size_t> *const beyond) const
{
  for (const Row &row : rows)
  {
    const Values *bond = values_of(row);
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
    const Values *bond = values_of(row);
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
