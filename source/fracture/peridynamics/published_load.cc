#include "fracture/peridynamics/published_load.h"

namespace stockwork::peridynamics
{
template <int dim>
std::vector<LinearFunctional>
published_loads(const Zone<dim> &zone,
                const BondSet<dim> &bonds,
                const std::vector<BondCoefficients<dim>> &coefficients,
                const double stretch_of_pressure,
                const std::vector<FractureCell<dim>> &cells)
{
  std::vector<std::vector<unsigned int>> cells_at(zone.sites().size());
  for (unsigned int k = 0; k < cells.size(); ++k)
    for (unsigned int v = 0; v < 1u << dim; ++v)
    {
      Place<dim> corner = cells[k].place;
      for (unsigned int d = 0; d < dim; ++d)
        corner[d] += v >> d & 1;
      cells_at[zone.find(corner)].push_back(k);
    }

  std::vector<std::map<dealii::types::global_dof_index, double>> forces(cells.size());
  for (const unsigned int i : zone.peridynamic_sites())
    for (unsigned int b = 0; b < coefficients.size(); ++b)
    {
      const unsigned int j = zone.far_end(i, b).site;
      if (bonds.is_broken(i, b) || (cells_at[i].empty() && cells_at[j].empty()))
        continue;
      const double push = 0.5 * stretch_of_pressure * zone.sites()[i].share *
                          coefficients[b].stiffness * coefficients[b].length;
      for (const unsigned int end : {i, j})
        for (const unsigned int k : cells_at[end])
          for (unsigned int d = 0; d < dim; ++d)
            forces[k][zone.sites()[i].dofs[d]] -=
              push / cells_at[end].size() * coefficients[b].direction[d];
    }

  std::vector<LinearFunctional> loads(cells.size());
  for (unsigned int k = 0; k < cells.size(); ++k)
    for (const auto &[dof, force] : forces[k])
    {
      loads[k].bulk.push_back(dof);
      loads[k].bulk_coefficients.push_back(force / fracture_area(cells[k].normal, zone.spacing()));
    }
  return loads;
}


template <int dim>
PublishedLoad<dim>::PublishedLoad(const Segment<dim> &segment, const LinearFunctional &forces)
  : segment(segment.key)
{
  std::map<dealii::types::global_dof_index, double> sum;
  for (unsigned int i = 0; i < forces.bulk.size(); ++i)
    sum[forces.bulk[i]] += segment.area * forces.bulk_coefficients[i];
  const LinearFunctional &opening = segment.opening;
  for (unsigned int i = 0; i < opening.bulk.size(); ++i)
    sum[opening.bulk[i]] -= segment.area * opening.bulk_coefficients[i];
  for (const auto &[dof, force] : sum)
  {
    difference.bulk.push_back(dof);
    difference.bulk_coefficients.push_back(force);
  }
}


template <int dim>
void PublishedLoad<dim>::assemble(const State &state, Sink &sink) const
{
  if (!state.segment_pressure)
    return;
  const double pressure = state.segment_pressure(segment);
  const auto unknown = state.segment_unknown(segment);
  LocalSystem local;
  local.bulk = difference.bulk;
  if (unknown)
    local.extra.push_back(*unknown);
  local.reinit();
  for (unsigned int i = 0; i < difference.bulk.size(); ++i)
  {
    local.residual(i) = -pressure * difference.bulk_coefficients[i];
    if (unknown)
      local.matrix(i, difference.bulk.size()) = -difference.bulk_coefficients[i];
  }
  sink.add(local);
}

#define INSTANTIATE(dim)                                                                         \
  template class PublishedLoad<dim>;                                                             \
  template std::vector<LinearFunctional> published_loads(                                        \
    const Zone<dim> &, const BondSet<dim> &, const std::vector<BondCoefficients<dim>> &, double, \
    const std::vector<FractureCell<dim>> &);
INSTANTIATE(2)
INSTANTIATE(3)
#undef INSTANTIATE
} // namespace stockwork::peridynamics
