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
#include "stockwork/mesh/key.h"

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
  std::vector<double> stretch;
  for (unsigned int i = 0; i < cells.size(); ++i)
    stretch.push_back(state.current.extra[aperture_unknown(i) + 1] / zone.spacing());
  return stretch;
}


template <int dim>
std::vector<ExtraUnknown> Peridynamics<dim>::unknowns_of_faces() const
{
  std::vector<ExtraUnknown> unknowns;
  for (const Segment<dim> &segment : all_segments)
  {
    // As the pressure of its fluid starts.
    const double closing =
      -(segment.normal * (scene.in_situ_stress(segment.centre) * segment.normal));
    unknowns.push_back({Key().add(segment.key).add(0)});
    unknowns.push_back(
      {Key().add(segment.key).add(1), strain_of_pressure * zone.spacing() * std::max(0., closing)});
  }
  return unknowns;
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
  released.clear();
  if (!in_situ_is_zero)
    for (unsigned int i = 0; i < cells.size(); ++i)
      released.push_back(released_strain(i));
  if (!parameters.tracked)
    crossed.reinit(zone, stencil, cells, parameters.horizon);

  const double alpha = scene.rock.main().biot_coefficient;
  std::vector<Faces *> faces_of(cells.size(), nullptr);
  faces.assign(owned_cells.size(), Faces());
  for (unsigned int k = 0; k < owned_cells.size(); ++k)
  {
    Segment<dim> &segment = owned_segments[k];
    Faces &own = faces[k];
    faces_of[owned_cells[k]] = &own;
    own.aperture = aperture_unknown(owned_cells[k]);
    own.push = own.aperture + 1;
    own.area = segment.area;
    own.gamma = strain_of_pressure;
    own.spacing = zone.spacing();
    segment.opening = LinearFunctional();
    segment.opening.extra.push_back(own.aperture);
    segment.opening.extra_coefficients.push_back(1.);
    segment.share_of_pores = 0.;
    if (!scene.has_pore_pressure)
      continue;
    segment.taken_from_pores = own.biot_coefficient = alpha;
    own.pores = &segment.pore_pressure;
  }
  // Force by the stretch of the cell, and by the stress in situ, of each dof.
  std::vector<std::map<dealii::types::global_dof_index, std::array<double, 2>>> by_dof(
    cells.size());

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
        if (faces_of[cell] == nullptr)
          continue;
        auto &sums = by_dof[cell];
        const double in_situ = in_situ_is_zero ? 0. : e * (released[cell] * e);
        const auto add = [&](const dealii::types::global_dof_index dof, const double direction)
        {
          sums[dof][0] += share * force * direction;
          sums[dof][1] += share * force * in_situ * direction;
        };
        for (unsigned int d = 0; d < dim; ++d)
        {
          add(zone.sites()[i].dofs[d], -e[d]);
          add(zone.sites()[end.site].dofs[d], end.mirrored >> d & 1 ? -e[d] : e[d]);
        }
        faces_of[cell]->by_stretch += share * force * coefficients[b].length;
        faces_of[cell]->constant += share * force * coefficients[b].length * in_situ;
      }
    }
  for (unsigned int k = 0; k < owned_cells.size(); ++k)
    for (const auto &[dof, sums] : by_dof[owned_cells[k]])
    {
      faces[k].ends.push_back(dof);
      faces[k].of_ends.push_back(sums[0]);
      faces[k].in_situ.push_back(sums[1]);
    }

  softening_shares.clear();
  for (unsigned int n = 0; n < softening_bonds.size(); ++n)
  {
    const auto &[site, bond] = softening_bonds[n].view;
    softening_shares.push_back(shares_of(site, bond, false));
    for (const auto &[cell, share] : softening_shares.back())
      if (Faces *own = faces_of[cell])
      {
        own->bonds.push_back(n);
        own->of_bonds.push_back(share * push(softening_bonds[n].view));
      }
  }
}


template <int dim>
double Peridynamics<dim>::push(const BondView &view) const
{
  double sum = 0.;
  for (const auto &[s, b] : views_of(view.first, view.second))
    sum += 0.5 * zone.sites()[s].share * coefficients[b].stiffness * coefficients[b].length;
  return sum;
}


template <int dim>
double Peridynamics<dim>::aperture(const unsigned int owned, const State &state) const
{
  return value(owned_segments[owned].opening, state.current);
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


#define INSTANTIATE(dim)                                                                    \
  template SymmetricTensor<2, dim> Peridynamics<dim>::released_strain(unsigned int) const;  \
  template std::vector<double> Peridynamics<dim>::fluid_stretch(const State &) const;       \
  template double Peridynamics<dim>::fractured_stretch(                                     \
    unsigned int, unsigned int, const CellShares &, const std::vector<double> &) const;     \
  template CellShares Peridynamics<dim>::shares_of(unsigned int, unsigned int, bool) const; \
  template void Peridynamics<dim>::open_by_bonds();                                         \
  template double Peridynamics<dim>::push(const BondView &) const;                          \
  template double Peridynamics<dim>::aperture(unsigned int, const State &) const;           \
  template std::vector<ExtraUnknown> Peridynamics<dim>::unknowns_of_faces() const;          \
  template std::vector<unsigned int> Peridynamics<dim>::sites_of_crossing_bonds() const;
INSTANTIATE(2)
INSTANTIATE(3)
#undef INSTANTIATE
} // namespace stockwork::peridynamics
