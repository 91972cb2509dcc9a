#include "fracture/peridynamics/peridynamics.h"

#include <algorithm>

namespace stockwork::peridynamics
{
template <int dim>
void Peridynamics<dim>::find_changed_rows(const std::vector<double> &damage_before,
                                          const std::vector<double> &corrected_before,
                                          const std::vector<FractureCell<dim>> &cells_before)
{
  // Within a step bonds only break, and after it they are as they were before: as many broken ones
  // are the same.
  const std::vector<unsigned int> n_broken_before = n_broken;
  n_broken.assign(lattice.zone.sites().size(), 0);
  for (const unsigned int i : lattice.zone.peridynamic_sites())
    n_broken[i] = lattice.bonds.n_broken(i);
  if (n_broken_before.size() != n_broken.size())
    return; // the zone is new, and so are all rows
  std::vector<unsigned int> changed;
  for (const unsigned int i : lattice.zone.peridynamic_sites())
  {
    const bool broken = n_broken[i] != n_broken_before[i];
    const bool corrected =
      parameters.surface_correction && lattice.corrected_damage[i] != corrected_before[i];
    if (!broken && !corrected)
      continue;
    changed.push_back(i);
    // What others see of a site.
    if (corrected || parameters.state_based ||
        lattice.is_nearly_detached(lattice.damage[i]) !=
          lattice.is_nearly_detached(damage_before[i]))
      lattice.append_family(i, changed);
  }
  const auto add_corners =
    [&](const std::vector<FractureCell<dim>> &some, const std::vector<FractureCell<dim>> &others)
  {
    for (const FractureCell<dim> &cell : some)
      if (std::none_of(others.begin(), others.end(),
                       [&](const FractureCell<dim> &other)
                       { return cell.place == other.place && cell.normal == other.normal; }))
        for (unsigned int v = 0; v < 1u << dim; ++v)
        {
          Place<dim> corner = cell.place;
          for (unsigned int d = 0; d < dim; ++d)
            corner[d] += v >> d & 1;
          if (const unsigned int site = lattice.zone.find(corner);
              site != dealii::numbers::invalid_unsigned_int)
            changed.push_back(site);
        }
  };
  if (scene.has_pore_pressure && !parameters.in_bonds)
  {
    add_corners(cells_before, fracture.cells);
    add_corners(fracture.cells, cells_before);
  }
  row_versions.change(changed);
}


template <int dim>
std::optional<std::vector<dealii::types::global_dof_index>>
Peridynamics<dim>::changed_rows(const unsigned int since) const
{
  if (!row_versions.reach_back_to(since))
    return {};
  std::vector<dealii::types::global_dof_index> rows;
  for (unsigned int i = 0; i < lattice.zone.sites().size(); ++i)
    if (const Site<dim> &site = lattice.zone.sites()[i];
        site.owner == rank && row_versions.has_changed(i, since))
    {
      rows.insert(rows.end(), site.dofs.begin(), site.dofs.end());
      if (scene.has_pore_pressure)
        rows.push_back(site.pressure_dof);
    }
  return rows;
}

#define INSTANTIATE(dim)                                                                      \
  template void Peridynamics<dim>::find_changed_rows(const std::vector<double> &,             \
                                                     const std::vector<double> &,             \
                                                     const std::vector<FractureCell<dim>> &); \
  template std::optional<std::vector<dealii::types::global_dof_index>>                        \
  Peridynamics<dim>::changed_rows(unsigned int) const;
INSTANTIATE(2)
INSTANTIATE(3)
#undef INSTANTIATE
} // namespace stockwork::peridynamics
