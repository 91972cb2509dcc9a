#include "fracture/peridynamics/peridynamics.h"

#include "fracture/peridynamics/few_columns.h"
#include "fracture/peridynamics/state_based.h"
#include "stockwork/exchange/released_traction.h"

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <limits>

namespace stockwork::peridynamics
{
using dealii::Point;
using dealii::Tensor;

namespace
{
/// The sites that bonds across a fracture cell of this rank may lead to, and some more.
template <int dim>
std::vector<unsigned int> sites_of_crossing_bonds(const Lattice<dim> &lattice)
{
  // State-based ones to families of their ends besides.
  const int reach = (lattice.parameters.state_based ? 3 : 2) * lattice.parameters.horizon + 3;
  Place<dim> lower, upper;
  lower.fill(std::numeric_limits<int>::max());
  upper.fill(std::numeric_limits<int>::min());
  for (const Place<dim> &cell : lattice.zone.cells())
    if (lattice.zone.owns(cell))
      for (unsigned int d = 0; d < dim; ++d)
      {
        lower[d] = std::min(lower[d], cell[d]);
        upper[d] = std::max(upper[d], cell[d]);
      }
  std::vector<unsigned int> sites;
  for (unsigned int i = 0; i < lattice.zone.sites().size(); ++i)
  {
    bool is_near = true;
    for (unsigned int d = 0; d < dim; ++d)
      is_near = is_near && lattice.zone.sites()[i].place[d] > lower[d] - reach &&
                lattice.zone.sites()[i].place[d] < upper[d] + reach;
    if (is_near)
      sites.push_back(i);
  }
  return sites;
}
} // namespace


template <int dim>
CellRole<dim> Peridynamics<dim>::role(const CellIterator &cell) const
{
  const auto normal = normals.find(cell->active_cell_index());
  CellRole<dim> role;
  role.skip_stiffness = lattice.zone.skipped_rows(cell->active_cell_index());
  role.fracture_normal = normal != normals.end() ? &normal->second : nullptr;
  role.lumps_mass = is_all_bonds();
  return role;
}


template <int dim>
void Peridynamics<dim>::add_couplings(const Coupling &couple) const
{
  std::vector<dealii::types::global_dof_index> dofs(2 * dim);
  for (const unsigned int i : lattice.zone.peridynamic_sites())
    if (lattice.zone.sites()[i].owner == rank)
      for (unsigned int b = 0; b < lattice.stencil.size(); ++b)
      {
        const Site<dim> &far = lattice.zone.sites()[lattice.zone.far_end(i, b).site];
        for (unsigned int d = 0; d < dim; ++d)
        {
          dofs[d] = lattice.zone.sites()[i].dofs[d];
          dofs[dim + d] = far.dofs[d];
        }
        if (parameters.tensor_fluid && parameters.as_published)
        {
          dofs.resize(2 * dim);
          dofs.push_back(lattice.zone.sites()[i].pressure_dof);
          dofs.push_back(far.pressure_dof);
        }
        couple(dofs);
      }
  if (parameters.in_bonds)
    for (const unsigned int i : sites_of_crossing_bonds(lattice))
    {
      const Site<dim> &site = lattice.zone.sites()[i];
      dofs.assign(site.dofs.begin(), site.dofs.end());
      if (site.pressure_dof != dealii::numbers::invalid_dof_index)
        dofs.push_back(site.pressure_dof);
      couple(dofs);
    }
  if (!parameters.state_based)
    return;
  // The dilatation of a site couples all of its family.
  std::vector<unsigned int> family;
  for (const auto *sites : {&lattice.zone.peridynamic_sites(), &lattice.zone.rim_sites()})
    for (const unsigned int i : *sites)
    {
      family.assign(1, i);
      for (unsigned int b = 0; b < lattice.stencil.size(); ++b)
        family.push_back(lattice.zone.far_end(i, b).site);
      if (std::none_of(family.begin(), family.end(),
                       [&](const unsigned int k) { return has_rows(k); }))
        continue;
      dofs.clear();
      for (const unsigned int k : family)
        dofs.insert(dofs.end(), lattice.zone.sites()[k].dofs.begin(),
                    lattice.zone.sites()[k].dofs.end());
      couple(dofs);
    }
}


template <int dim>
double Peridynamics<dim>::strain_energy(const std::vector<double> &u) const
{
  const auto half_bond = [&](const unsigned int i, const unsigned int b)
  {
    const double stretched = lattice.elongation(i, b, u);
    return 0.25 * lattice.zone.sites()[i].share * lattice.stiffness(i, b) * stretched * stretched;
  };
  double energy = 0.;
  for (const unsigned int i : lattice.zone.peridynamic_sites())
    for (unsigned int b = 0; b < lattice.stencil.size(); ++b)
      energy += half_bond(i, b);
  if (parameters.state_based)
    for (const unsigned int i : lattice.zone.peridynamic_sites())
    {
      double theta = 0.;
      for (unsigned int b = 0; b < lattice.stencil.size(); ++b)
        if (!lattice.bonds.is_broken(i, b))
          theta += (1. - softening_bonds.damage(i, b)) * lattice.coefficients[b].dilatation *
                   lattice.elongation(i, b, u);
      theta *= lattice.dilatation_factor(i);
      energy += 0.5 * lattice.dilatation_modulus(i) *
                dealii::Utilities::fixed_power<dim>(lattice.zone.spacing()) *
                lattice.zone.sites()[i].share * theta * theta;
    }
  for (const SofteningBond &bond : softening_bonds)
    for (const auto &[i, b] : lattice.bonds.views_of(bond.view.first, bond.view.second))
      energy -= lattice.softening.damage(bond.trial) * half_bond(i, b);
  return energy;
}


template <int dim>
void Peridynamics<dim>::assemble(const StepContext &,
                                 const dealii::IndexSet &rows,
                                 Sink &sink) const
{
  const auto are_wanted = [&](const Site<dim> &site)
  {
    return std::any_of(site.dofs.begin(), site.dofs.end(),
                       [&](const auto dof) { return rows.is_element(dof); });
  };
  LocalSystem local;
  local.bulk.resize(2 * dim);
  for (const unsigned int i : lattice.zone.peridynamic_sites())
  {
    const Site<dim> &site = lattice.zone.sites()[i];
    if (site.owner != rank || !are_wanted(site))
      continue;
    for (unsigned int b = 0; b < lattice.stencil.size(); ++b)
    {
      const double k = site.share * lattice.stiffness(i, b);
      if (k == 0.)
        continue;
      // The force on this end; that on the other is in its own row.
      const FarEnd end = lattice.zone.far_end(i, b);
      const Tensor<1, dim> &e = lattice.coefficients[b].direction;
      local.reinit();
      for (unsigned int d = 0; d < dim; ++d)
      {
        local.bulk[d] = site.dofs[d];
        local.bulk[dim + d] = lattice.zone.sites()[end.site].dofs[d];
        for (unsigned int c = 0; c < dim; ++c)
        {
          local.matrix(d, c) = k * e[d] * e[c];
          local.matrix(d, dim + c) = (end.mirrored >> c & 1 ? k : -k) * e[d] * e[c];
        }
      }
      sink.add(local);
    }
  }

  if (!parameters.state_based)
    return;
  std::vector<Tensor<2, dim>> stiffness(lattice.zone.sites().size());
  for (const unsigned int i : lattice.zone.peridynamic_sites())
    if (has_rows(i) && are_wanted(lattice.zone.sites()[i]))
      assemble_dilatations(i, stiffness, local, sink);
}


template <int dim>
void Peridynamics<dim>::assemble_dilatations(const unsigned int i,
                                             std::vector<Tensor<2, dim>> &stiffness,
                                             LocalSystem &local,
                                             Sink &sink) const
{
  std::vector<unsigned int> neighbours{i}, family, coupled;
  for (unsigned int b = 0; b < lattice.stencil.size(); ++b)
    neighbours.push_back(lattice.zone.far_end(i, b).site);
  std::sort(neighbours.begin(), neighbours.end());
  neighbours.erase(std::unique(neighbours.begin(), neighbours.end()), neighbours.end());

  std::vector<Tensor<1, dim>> functional;
  for (const unsigned int s : neighbours)
  {
    const double modulus = lattice.find_dilatation(s, family, functional);
    Tensor<1, dim> own;
    for (unsigned int k = 0; k < family.size(); ++k)
      if (family[k] == i)
        own += modulus * functional[k];
    for (unsigned int k = 0; k < family.size(); ++k)
      stiffness[family[k]] += outer_product(own, functional[k]);
    coupled.insert(coupled.end(), family.begin(), family.end());
  }
  std::sort(coupled.begin(), coupled.end());
  coupled.erase(std::unique(coupled.begin(), coupled.end()), coupled.end());

  const auto &rows = lattice.zone.sites()[i].dofs;
  for (unsigned int first = 0; first < coupled.size(); first += most_columns)
  {
    const unsigned int n = std::min<unsigned int>(most_columns, coupled.size() - first);
    local.bulk.assign(rows.begin(), rows.end());
    for (unsigned int k = 0; k < n; ++k)
    {
      const auto &columns = lattice.zone.sites()[coupled[first + k]].dofs;
      local.bulk.insert(local.bulk.end(), columns.begin(), columns.end());
    }
    local.reinit();
    for (unsigned int k = 0; k < n; ++k)
    {
      Tensor<2, dim> &entry = stiffness[coupled[first + k]];
      for (unsigned int d = 0; d < dim; ++d)
        for (unsigned int c = 0; c < dim; ++c)
          local.matrix(d, (k + 1) * dim + c) = entry[d][c];
      entry = 0.;
    }
    sink.add(local);
  }
}


template <int dim>
void Peridynamics<dim>::assemble(const StepContext &context, const State &state, Sink &sink) const
{
  assemble_softening(state, sink);
  if (parameters.state_based && !softening_bonds.empty())
    assemble_soft_dilatation(state, sink);
  for (const PublishedLoad<dim> &load : published)
    load.assemble(state, sink);
  if (parameters.tensor_fluid)
    assemble_tensor_fluid(context, state, sink);
  if (parameters.tensor_fluid && parameters.as_published)
    assemble_published_closure(context, state, sink);
  if (parameters.in_bonds)
    pressure_in_bonds.assemble(state, sink);
  if (lattice.in_situ_is_zero || parameters.in_bonds)
    return;
  LocalSystem local;
  for (const unsigned int i : fracture.owned_cells)
  {
    local.bulk = fracture.segments[i].opening.bulk;
    local.reinit();
    const std::vector<Tensor<1, dim>> of_corners = jumps(lattice.zone, fracture.cells[i]);
    add_released_traction<dim>(scene, fracture.segments[i].centre, fracture.cells[i].normal,
                               fracture.segments[i].area, of_corners, local.residual);
    sink.add(local);
  }
}

#define INSTANTIATE(dim)                                                                           \
  template CellRole<dim> Peridynamics<dim>::role(const CellIterator &) const;                      \
  template void Peridynamics<dim>::add_couplings(const Coupling &) const;                          \
  template double Peridynamics<dim>::strain_energy(const std::vector<double> &) const;             \
  template void Peridynamics<dim>::assemble(const StepContext &, const dealii::IndexSet &, Sink &) \
    const;                                                                                         \
  template void Peridynamics<dim>::assemble_dilatations(                                           \
    const unsigned int, std::vector<Tensor<2, dim>> &, LocalSystem &, Sink &) const;               \
  template void Peridynamics<dim>::assemble(const StepContext &, const State &, Sink &) const;
INSTANTIATE(2)
INSTANTIATE(3)
#undef INSTANTIATE
} // namespace stockwork::peridynamics
