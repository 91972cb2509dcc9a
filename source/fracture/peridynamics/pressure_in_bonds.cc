// `Closure = in bonds`: the fluid's pressure is part of the law of bonds. A crack under a net
// pressure p is one without load in rock under a uniform stress p, less the uniform field. So what
// counts for a bond of length l is its elongation under both, the effective one
//
//   e* = e + l p / (C11 + (d-1) C12),
//
// in which it softens and breaks; and its force is k (e - D e*): none of the pressure while it is
// whole, a push of k l p / (C11 + (d-1) C12) on its ends when it is broken. The volume adjoint to
// that is the sum of k l D e* / (C11 + (d-1) C12), and each bond's goes to the cell where it
// crosses the fracture. What stress in situ acts on the plane of the fracture belongs to p; what
// shear does, is a uniform field of its own.
#include "fracture/peridynamics/peridynamics.h"

#include "fracture/peridynamics/lattice_moduli.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace stockwork::peridynamics
{
using dealii::SymmetricTensor;
using dealii::Tensor;


template <int dim>
SymmetricTensor<2, dim> Peridynamics<dim>::released_strain(const unsigned int cell) const
{
  const LatticeModuli moduli = lattice_moduli<dim>(stencil, law, zone.spacing());
  const Tensor<1, dim> &n = cells[cell].normal;
  const Tensor<1, dim> traction = scene.in_situ_stress(all_segments[cell].centre) * n;
  const double normal = traction * n;
  const Tensor<1, dim> shear = traction - normal * n;
  SymmetricTensor<2, dim> strain =
    normal * strain_of_pressure * dealii::unit_symmetric_tensor<dim>();
  for (unsigned int i = 0; i < dim; ++i)
    for (unsigned int j = i; j < dim; ++j)
      strain[i][j] +=
        (n[i] * shear[j] + n[j] * shear[i]) / (i == j ? moduli.c11 - moduli.c12 : 2. * moduli.c44);
  return strain;
}


template <int dim>
std::vector<double> Peridynamics<dim>::fluid_stretch(const State &state) const
{
  std::vector<double> stretch(cells.size(), 0.);
  for (unsigned int i = 0; i < cells.size() && state.segment_pressure; ++i)
    stretch[i] = strain_of_pressure * state.segment_pressure(all_segments[i].key);
  return stretch;
}


template <int dim>
double Peridynamics<dim>::fractured_stretch(const unsigned int site,
                                            const unsigned int bond,
                                            const CellShares &shares,
                                            const std::vector<double> &of_pressure) const
{
  const Tensor<1, dim> &e = coefficients[bond].direction;
  double stretch = 0.;
  for (const auto &[cell, share] : shares)
    stretch += share * (of_pressure[cell] + (in_situ_is_zero ? 0. : e * (released[cell] * e)));
  // The field is that of the intact lattice; bonds beside a crack are stiffer.
  return stretch * coefficients[bond].stiffness / stiffness(site, bond);
}


template <int dim>
CellShares Peridynamics<dim>::shares_of(const unsigned int site,
                                        const unsigned int bond,
                                        const bool always) const
{
  if (!parameters.tracked)
    return crossed.of(site, bond, always);
  const auto crossing = crossing_of(site, bond);
  return crossing ? paths.shares(*crossing, (parameters.horizon + 1.) * zone.spacing())
                  : CellShares();
}


template <int dim>
void Peridynamics<dim>::open_by_bonds()
{
  const double unit = strain_of_pressure;
  released.clear();
  if (!in_situ_is_zero)
    for (unsigned int i = 0; i < cells.size(); ++i)
      released.push_back(released_strain(i));
  if (!parameters.tracked)
    crossed.reinit(zone, stencil, cells, parameters.horizon);

  std::vector<unsigned int> owned(cells.size(), dealii::numbers::invalid_unsigned_int);
  for (unsigned int k = 0; k < owned_cells.size(); ++k)
    owned[owned_cells[k]] = k;
  // Volume that a displacement gives the fluid, and force of the stress in situ, by dof.
  std::vector<std::map<dealii::types::global_dof_index, std::array<double, 2>>> by_dof(
    owned_segments.size());
  for (Segment<dim> &segment : owned_segments)
    segment.opening = LinearFunctional();

  for (const unsigned int i : zone.peridynamic_sites())
    for (unsigned int b = 0; b < stencil.size(); ++b)
    {
      if (!bonds.is_broken(i, b))
        continue;
      // Half of a bond belongs to each end.
      const Tensor<1, dim> &e = coefficients[b].direction;
      const double force =
        0.5 * zone.sites()[i].share * coefficients[b].stiffness * coefficients[b].length;
      const FarEnd end = zone.far_end(i, b);
      for (const auto &[cell, share] : shares_of(i, b, true))
      {
        if (owned[cell] == dealii::numbers::invalid_unsigned_int)
          continue;
        auto &sums = by_dof[owned[cell]];
        Segment<dim> &segment = owned_segments[owned[cell]];
        const double in_situ = in_situ_is_zero ? 0. : e * (released[cell] * e);
        const auto add = [&](const dealii::types::global_dof_index dof, const double direction)
        {
          sums[dof][0] += share * force * unit * direction;
          sums[dof][1] += share * force * in_situ * direction;
        };
        for (unsigned int d = 0; d < dim; ++d)
        {
          add(zone.sites()[i].dofs[d], -e[d]);
          add(zone.sites()[end.site].dofs[d], end.mirrored >> d & 1 ? -e[d] : e[d]);
        }
        const double volume = share * force * unit * coefficients[b].length / segment.area;
        segment.opening_by_pressure += volume * unit;
        segment.opening.constant += volume * in_situ;
      }
    }

  softening_shares.clear();
  for (unsigned int n = 0; n < softening_bonds.size(); ++n)
  {
    const auto &[site, bond] = softening_bonds[n].view;
    softening_shares.push_back(shares_of(site, bond, false));
    for (const auto &[cell, share] : softening_shares.back())
      if (const unsigned int k = owned[cell]; k != dealii::numbers::invalid_unsigned_int)
      {
        owned_segments[k].opening.extra.push_back(n);
        owned_segments[k].opening.extra_coefficients.push_back(
          share * pushed_volume(softening_bonds[n].view) / owned_segments[k].area);
      }
  }

  released_forces.clear();
  for (unsigned int k = 0; k < owned_segments.size(); ++k)
  {
    Segment<dim> &segment = owned_segments[k];
    LinearFunctional force;
    for (const auto &[dof, sums] : by_dof[k])
    {
      segment.opening.bulk.push_back(dof);
      segment.opening.bulk_coefficients.push_back(sums[0] / segment.area);
      if (in_situ_is_zero)
        continue;
      force.bulk.push_back(dof);
      force.bulk_coefficients.push_back(sums[1]);
    }
    released_forces.push_back(force);
  }
}


template <int dim>
double Peridynamics<dim>::pushed_volume(const BondView &view) const
{
  double sum = 0.;
  for (const auto &[s, b] : views_of(view.first, view.second))
    sum += 0.5 * zone.sites()[s].share * coefficients[b].stiffness * coefficients[b].length;
  return sum * strain_of_pressure;
}


template <int dim>
double Peridynamics<dim>::aperture(const unsigned int owned, const State &state) const
{
  const Segment<dim> &segment = owned_segments[owned];
  double w = value(segment.opening, state.current);
  if (segment.opening_by_pressure != 0. && state.segment_pressure)
    w += segment.opening_by_pressure * state.segment_pressure(segment.key);
  return w;
}


template <int dim>
std::vector<unsigned int> Peridynamics<dim>::sites_of_crossing_bonds() const
{
  const int reach = 2 * parameters.horizon + 3;
  Place<dim> lower, upper;
  lower.fill(std::numeric_limits<int>::max());
  upper.fill(std::numeric_limits<int>::min());
  for (const Place<dim> &cell : zone.cells())
    if (zone.owns(cell))
      for (unsigned int d = 0; d < dim; ++d)
      {
        lower[d] = std::min(lower[d], cell[d]);
        upper[d] = std::max(upper[d], cell[d]);
      }
  std::vector<unsigned int> sites;
  for (unsigned int i = 0; i < zone.sites().size(); ++i)
  {
    bool is_near = true;
    for (unsigned int d = 0; d < dim; ++d)
      is_near = is_near && zone.sites()[i].place[d] > lower[d] - reach &&
                zone.sites()[i].place[d] < upper[d] + reach;
    if (is_near)
      sites.push_back(i);
  }
  return sites;
}


template <int dim>
void Peridynamics<dim>::assemble_released_stress(Sink &sink) const
{
  LocalSystem local;
  for (const LinearFunctional &force : released_forces)
  {
    local.bulk = force.bulk;
    local.reinit();
    for (unsigned int i = 0; i < force.bulk.size(); ++i)
      local.residual(i) = -force.bulk_coefficients[i];
    sink.add(local);
  }
}


#define INSTANTIATE(dim)                                                                    \
  template SymmetricTensor<2, dim> Peridynamics<dim>::released_strain(unsigned int) const;  \
  template std::vector<double> Peridynamics<dim>::fluid_stretch(const State &) const;       \
  template double Peridynamics<dim>::fractured_stretch(                                     \
    unsigned int, unsigned int, const CellShares &, const std::vector<double> &) const;     \
  template CellShares Peridynamics<dim>::shares_of(unsigned int, unsigned int, bool) const; \
  template void Peridynamics<dim>::open_by_bonds();                                         \
  template double Peridynamics<dim>::pushed_volume(const BondView &) const;                 \
  template double Peridynamics<dim>::aperture(unsigned int, const State &) const;           \
  template std::vector<unsigned int> Peridynamics<dim>::sites_of_crossing_bonds() const;    \
  template void Peridynamics<dim>::assemble_released_stress(Sink &) const;
INSTANTIATE(2)
INSTANTIATE(3)
#undef INSTANTIATE
} // namespace stockwork::peridynamics
