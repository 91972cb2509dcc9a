#include "fracture/peridynamics/peridynamics.h"

#include <algorithm>

namespace stockwork::peridynamics
{
using dealii::Point;
using dealii::Tensor;

namespace
{
/// Stiffness that broken bonds keep where a site has lost nearly all of them.
constexpr double remaining_share = 1e-6;
constexpr double nearly_detached = 0.9;
/// Of the bonds' stiffness at a free face, where about half of them are gone.
constexpr double most_correction = 2.;
} // namespace


template <int dim>
CellRole<dim> Peridynamics<dim>::role(const CellIterator &cell) const
{
  const auto normal = normals.find(cell->active_cell_index());
  return {nullptr, zone.skipped_rows(cell->active_cell_index()),
          normal != normals.end() ? &normal->second : nullptr};
}


template <int dim>
void Peridynamics<dim>::add_couplings(
  const std::function<void(const std::vector<dealii::types::global_dof_index> &)> &couple) const
{
  std::vector<dealii::types::global_dof_index> dofs(2 * dim);
  for (const unsigned int i : zone.peridynamic_sites())
    if (zone.sites()[i].owner == rank)
      for (unsigned int b = 0; b < stencil.size(); ++b)
      {
        const Site<dim> &far = zone.sites()[zone.far_end(i, b).site];
        for (unsigned int d = 0; d < dim; ++d)
        {
          dofs[d] = zone.sites()[i].dofs[d];
          dofs[dim + d] = far.dofs[d];
        }
        couple(dofs);
      }
}


template <int dim>
double Peridynamics<dim>::stiffness(const unsigned int site, const unsigned int bond) const
{
  const double here = damage[site], there = damage[zone.far_end(site, bond).site];
  const double whole = coefficients[bond].stiffness;
  if (bonds.is_broken(site, bond))
    return std::max(here, there) > nearly_detached ? remaining_share * whole : 0.;
  if (!parameters.surface_correction)
    return whole;
  const auto share_lost = [](const double d) { return std::min(1. / (1. - d), most_correction); };
  return 0.5 * (share_lost(here) + share_lost(there)) * whole;
}


template <int dim>
double Peridynamics<dim>::strain_energy(const std::vector<double> &u) const
{
  const auto half_bond = [&](const unsigned int i, const unsigned int b)
  {
    const double stretched = elongation(i, b, u);
    return 0.25 * zone.sites()[i].share * stiffness(i, b) * stretched * stretched;
  };
  double energy = 0.;
  for (const unsigned int i : zone.peridynamic_sites())
    for (unsigned int b = 0; b < stencil.size(); ++b)
      energy += half_bond(i, b);
  for (const SofteningBond &bond : softening_bonds)
    for (const auto &[i, b] : views_of(bond.view.first, bond.view.second))
      energy -= softening.damage(bond.trial) * half_bond(i, b);
  return energy;
}


template <int dim>
void Peridynamics<dim>::assemble_bulk(const StepContext &, Sink &sink) const
{
  LocalSystem local;
  local.bulk.resize(2 * dim);
  for (const unsigned int i : zone.peridynamic_sites())
  {
    const Site<dim> &site = zone.sites()[i];
    if (site.owner != rank)
      continue;
    for (unsigned int b = 0; b < stencil.size(); ++b)
    {
      const double k = site.share * stiffness(i, b);
      if (k == 0.)
        continue;
      // The force on this end; that on the other is in its own row.
      const FarEnd end = zone.far_end(i, b);
      const Tensor<1, dim> &e = coefficients[b].direction;
      local.reinit();
      for (unsigned int d = 0; d < dim; ++d)
      {
        local.bulk[d] = site.dofs[d];
        local.bulk[dim + d] = zone.sites()[end.site].dofs[d];
        for (unsigned int c = 0; c < dim; ++c)
        {
          local.matrix(d, c) = k * e[d] * e[c];
          local.matrix(d, dim + c) = (end.mirrored >> c & 1 ? k : -k) * e[d] * e[c];
        }
      }
      sink.add(local);
    }
  }
}


/// The cracks release the in-situ traction of their faces.
template <int dim>
void Peridynamics<dim>::assemble(const StepContext &, const State &state, Sink &sink) const
{
  assemble_softening(state, sink);
  if (in_situ_is_zero)
    return;
  LocalSystem local;
  for (const unsigned int i : owned_cells)
  {
    const Tensor<1, dim> &n = cells[i].normal;
    const Tensor<1, dim> traction = scene.in_situ_stress(all_segments[i].centre) * n;
    Tensor<1, dim> shear = traction - (traction * n) * n;
    const double tau = shear.norm();
    local.bulk = all_segments[i].opening.bulk;
    local.reinit();
    const auto &opening = all_segments[i].opening.bulk_coefficients;
    for (unsigned int k = 0; k < opening.size(); ++k)
      local.residual(k) -= all_segments[i].area * (traction * n) * opening[k];
    if (tau > 0.)
    {
      const LinearFunctional slip = jump(zone, cells[i], Tensor<1, dim>(shear / tau));
      for (unsigned int k = 0; k < slip.bulk.size(); ++k)
        local.residual(k) -= all_segments[i].area * tau * slip.bulk_coefficients[k];
    }
    sink.add(local);
  }
}

#define INSTANTIATE(dim)                                                                      \
  template CellRole<dim> Peridynamics<dim>::role(const CellIterator &) const;                 \
  template void Peridynamics<dim>::add_couplings(                                             \
    const std::function<void(const std::vector<dealii::types::global_dof_index> &)> &) const; \
  template double Peridynamics<dim>::stiffness(unsigned int, unsigned int) const;             \
  template double Peridynamics<dim>::strain_energy(const std::vector<double> &) const;        \
  template void Peridynamics<dim>::assemble_bulk(const StepContext &, Sink &) const;          \
  template void Peridynamics<dim>::assemble(const StepContext &, const State &, Sink &) const;
INSTANTIATE(2)
INSTANTIATE(3)
#undef INSTANTIATE
} // namespace stockwork::peridynamics
