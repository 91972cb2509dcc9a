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

#include "discontinuity/contact.h"
#include "fracture/peridynamics/lattice_moduli.h"
#include "stockwork/mesh/key.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace stockwork::peridynamics
{
using dealii::SymmetricTensor;
using dealii::Tensor;

namespace
{
/// Faces that are nearer to one another touch [m].
constexpr double closed = 1e-12;
/// What bonds of a piece read of a jump, less all of it, from which on too few are there to tell.
constexpr double too_few_bonds = 0.5;
/// Of the opening at which nothing holds faces together any more, from which on they leak as bare
/// ones. By the energy, in all as much would leak as the tip has come, but the pores of the process
/// zone would lack pressure (doc/laboratory/peridynamics_paths.md).
constexpr double share_when_bare = 0.25;
} // namespace


template <int dim>
SymmetricTensor<2, dim> Peridynamics<dim>::released_strain(const unsigned int cell) const
{
  const Tensor<1, dim> &n = cells[cell].normal,
                       traction = scene.in_situ_stress(all_segments[cell].centre) * n;
  if constexpr (dim == 2)
    return (traction * n) * modes[cell][0] + (traction * cross_product_2d(n)) * modes[cell][1];
  else
    return lattice.strain_of_traction(n, traction);
}


template <int dim>
std::vector<SymmetricTensor<2, dim>> Peridynamics<dim>::strain_of_faces(const State &state) const
{
  std::vector<SymmetricTensor<2, dim>> strain;
  const double unit = 1. / (lattice.strain_of_pressure * lattice.zone.spacing());
  for (unsigned int i = 0; i < cells.size(); ++i)
  {
    strain.push_back(lattice.in_situ_is_zero ? SymmetricTensor<2, dim>() : released[i]);
    for (unsigned int m = 0; m < n_modes(); ++m)
      strain.back() += unit * state.current.extra[unknown_of_faces(i, m) + 1] * modes[i][m];
  }
  return strain;
}


template <int dim>
std::vector<ExtraUnknown> Peridynamics<dim>::unknowns_of_faces() const
{
  std::vector<ExtraUnknown> unknowns;
  for (const Segment<dim> &segment : all_segments)
    for (unsigned int m = 0; m < n_modes(); ++m)
    {
      // As the pressure of the fluid starts.
      const double closing =
        m == 0 ? -(segment.normal * (scene.in_situ_stress(segment.centre) * segment.normal)) : 0.;
      unknowns.push_back({Key().add(segment.key).add(2 * m)});
      unknowns.push_back(
        {Key().add(segment.key).add(2 * m + 1),
         lattice.strain_of_pressure * lattice.zone.spacing() * std::max(0., closing)});
    }
  return unknowns;
}


template <int dim>
double
Peridynamics<dim>::fractured_stretch(const unsigned int site,
                                     const unsigned int bond,
                                     const CellShares &shares,
                                     const std::vector<SymmetricTensor<2, dim>> &strain) const
{
  const Tensor<1, dim> &e = lattice.coefficients[bond].direction;
  double stretch = 0.;
  if (parameters.tracked && shares.empty())
    return dry_stretch(site, bond);
  for (const auto &[cell, share] : shares)
    stretch += share * (e * (strain[cell] * e));
  // The stress is that of the intact lattice; bonds beside a crack, or of other rock, are stiffer.
  return stretch * lattice.coefficients[bond].stiffness / lattice.stiffness(site, bond);
}


template <int dim>
CellShares Peridynamics<dim>::shares_of(const unsigned int site,
                                        const unsigned int bond,
                                        const bool always) const
{
  if (!parameters.tracked)
  {
    // What feels a given pressure is the same whatever the steps are.
    if (lattice.softening.brittle() && !std::isnan(scene.crack_pressure) && !always)
      return is_wet_bond(site, bond) ? crossed.of(site, bond, true) : CellShares();
    return crossed.of(site, bond, always);
  }
  const auto crossing = crossing_bonds.crossing(site, bond);
  return crossing ? paths.shares(*crossing, (parameters.horizon + 1.) * lattice.zone.spacing())
                  : CellShares();
}


template <int dim>
CellShares Peridynamics<dim>::shares_of_jump(const BondAcross<dim> &bond) const
{
  return parameters.tracked ? paths.shares(bond.crossing, same_place * lattice.zone.spacing())
                            : shares_of(bond.view.first, bond.view.second, true);
}


template <int dim>
std::vector<BondAcross<dim>> Peridynamics<dim>::bonds_across() const
{
  if (parameters.tracked)
    return crossing_bonds.all();
  std::vector<BondAcross<dim>> across;
  for (const unsigned int i : lattice.zone.peridynamic_sites())
    for (unsigned int b = 0; b < lattice.stencil.size(); ++b)
      if (lattice.bonds.is_broken(i, b))
        across.push_back({{i, b}, lattice.coefficients[b].direction, {}});
  return across;
}


/// On a piece of a fracture that is oblique to the mesh, bonds are not alike on the two sides of
/// its normal: of a uniform slip they would read up to 10 per cent as an opening, and of an opening
/// as much as a slip. That is taken off. Traction and jump are adjoint, so the load on the faces
/// has no part along them either. How much of a jump a piece reads stays as it is: its share of the
/// bonds. What softens takes part by the stretch that it has, so broken bonds count; but in porous
/// rock all bonds of a piece do, on a path. For those that break first in a process zone lean to
/// one side, and what makes up for that alone pulls at the others by what the pores press with,
/// which is more than their strength (doc/laboratory/peridynamics_paths.md).
template <int dim>
void Peridynamics<dim>::find_modes(const std::vector<BondAcross<dim>> &across)
{
  modes.assign(cells.size(), {});
  for (unsigned int i = 0; i < cells.size(); ++i)
  {
    modes[i][0] = lattice.strain_of_traction(cells[i].normal, cells[i].normal);
    if constexpr (dim == 2)
      modes[i][1] = lattice.strain_of_traction(cells[i].normal, cross_product_2d(cells[i].normal));
  }
  if constexpr (dim == 2)
  {
    if (!parameters.tracked && n_modes() == 1)
      return;
    // What modes read of jumps across the fracture and along it, over its area.
    std::vector<Tensor<2, dim>> reading(cells.size());
    for (const BondAcross<dim> &bond : across)
    {
      const auto &[site, b] = bond.view;
      if (!scene.has_pore_pressure && !lattice.bonds.is_broken(site, b))
        continue;
      const Tensor<1, dim> &e = bond.direction;
      // Half of a bond belongs to each end.
      const double force = 0.5 * lattice.zone.sites()[site].share *
                           lattice.coefficients[b].stiffness * lattice.coefficients[b].length;
      for (const auto &[cell, share] : shares_of_jump(bond))
      {
        const Tensor<1, dim> &n = cells[cell].normal;
        bool leads_up = e * n > 0.;
        if (parameters.tracked)
        {
          const TrackedPaths::Piece &piece = paths.wet_pieces()[cell];
          const bool normal_is_left = cross_product_2d(n) * (piece.to - piece.from) > 0.;
          leads_up = (e * paths.left(bond.crossing) > 0.) == normal_is_left;
        }
        const double elongated = (leads_up ? share : -share) * force / all_segments[cell].area;
        for (unsigned int m = 0; m < 2; ++m)
        {
          const double read = elongated * (e * (modes[cell][m] * e));
          reading[cell][m][0] += read * (e * n);
          reading[cell][m][1] += read * (e * cross_product_2d(n));
        }
      }
    }
    for (unsigned int i = 0; i < cells.size(); ++i)
    {
      if (std::abs(reading[i][0][0] - 1.) > too_few_bonds ||
          std::abs(reading[i][1][1] - 1.) > too_few_bonds)
        continue;
      const Tensor<2, dim> right = invert(reading[i]);
      const auto plain = modes[i];
      for (unsigned int m = 0; m < 2; ++m)
        modes[i][m] = reading[i][m][m] * (right[m][0] * plain[0] + right[m][1] * plain[1]);
    }
  }
}


template <int dim>
void Peridynamics<dim>::open_by_bonds()
{
  if (!parameters.tracked)
    crossed.reinit(lattice.zone, lattice.stencil, cells, parameters.horizon);
  const std::vector<BondAcross<dim>> across = bonds_across();
  find_modes(across);
  released.clear();
  if (!lattice.in_situ_is_zero)
    for (unsigned int i = 0; i < cells.size(); ++i)
      released.push_back(released_strain(i));

  // Of the bonds across a piece. The last piece of a fracture may have lost a single one, which
  // reads the same of both modes: faces that stick would be held twice by it.
  std::vector<double> broken_share(cells.size(), 0.), all_bonds(cells.size(), 0.);
  for (const BondAcross<dim> &bond : across)
    for (const auto &[cell, share] : shares_of_jump(bond))
    {
      const double part = share * lattice.coefficients[bond.view.second].stiffness;
      all_bonds[cell] += part;
      if (lattice.bonds.is_broken(bond.view.first, bond.view.second))
        broken_share[cell] += part;
    }
  for (unsigned int i = 0; i < cells.size(); ++i)
    broken_share[i] = all_bonds[i] > 0. ? broken_share[i] / all_bonds[i] : 0.;

  const unsigned int n = n_modes();
  std::vector<Faces *> faces_of(cells.size(), nullptr);
  faces.assign(owned_cells.size(), Faces());
  for (unsigned int k = 0; k < owned_cells.size(); ++k)
  {
    const unsigned int i = owned_cells[k];
    Segment<dim> &segment = owned_segments[k];
    Faces &own = faces[k];
    faces_of[i] = &own;
    own.area = std::pow(lattice.zone.spacing(), dim - 1);
    own.unit = 1. / (lattice.strain_of_pressure * lattice.zone.spacing());
    own.segment = segment.key;
    own.friction = parameters.friction;
    own.rub = broken_share[i] > too_few_bonds;
    for (unsigned int m = 0; m < n; ++m)
    {
      own.modes.emplace_back();
      own.modes[m].jump = unknown_of_faces(i, m);
      own.modes[m].traction = own.modes[m].jump + 1;
      own.modes[m].of_tractions.assign(n, 0.);
    }
    segment.opening = LinearFunctional();
    segment.opening.extra.push_back(own.modes[0].jump);
    segment.opening.extra_coefficients.push_back(own.area / segment.area);
    segment.share_of_pores = 0.;
    if (!scene.has_pore_pressure)
      continue;
    segment.taken_from_pores = own.biot_coefficient = biot_coefficient(i);
    segment.bare_aperture = bare_aperture(i);
    own.pores = parameters.tracked ? &pores_of_pieces[i] : &segment.pore_pressure;
  }
  // Of each dof, what it adds to the jumps, and the force of the stress in situ.
  std::vector<std::map<dealii::types::global_dof_index, std::array<double, 3>>> by_dof(
    cells.size());

  // A bond right across a piece reads nothing of its slip. Rounding errors in place of that would
  // be all that stands on a diagonal, and systems of equations are scaled by their diagonals.
  const auto read = [&](const unsigned int cell, const unsigned int m, const Tensor<1, dim> &e)
  {
    const double strain = e * (modes[cell][m] * e);
    return std::abs(strain) > same_place * lattice.strain_of_pressure ? strain : 0.;
  };
  for (const BondAcross<dim> &bond : across)
  {
    const auto &[i, b] = bond.view;
    if (!lattice.bonds.is_broken(i, b))
      continue;
    // Half of a bond belongs to each end.
    const Tensor<1, dim> &e = lattice.coefficients[b].direction;
    const double length = lattice.coefficients[b].length,
                 force =
                   0.5 * lattice.zone.sites()[i].share * lattice.coefficients[b].stiffness * length;
    const FarEnd end = lattice.zone.far_end(i, b);
    for (const auto &[cell, share] : shares_of(i, b, true))
    {
      if (faces_of[cell] == nullptr)
        continue;
      const double in_situ = lattice.in_situ_is_zero ? 0. : e * (released[cell] * e);
      // By a stress as much as in the lattice the bond is the longer the softer it is.
      const double longer = length / lattice.rock_of_bonds.modulus(i, b);
      std::array<double, 3> sums{{0., 0., share * force * in_situ}};
      for (unsigned int m = 0; m < n; ++m)
      {
        Faces::Mode &mode = faces_of[cell]->modes[m];
        sums[m] = share * force * read(cell, m, e);
        mode.constant += sums[m] * longer * in_situ;
        for (unsigned int k = 0; k < n; ++k)
          mode.of_tractions[k] += sums[m] * longer * read(cell, k, e);
      }
      const auto add = [&](const dealii::types::global_dof_index dof, const double direction)
      {
        auto &of_dof = by_dof[cell][dof];
        for (unsigned int k = 0; k < sums.size(); ++k)
          of_dof[k] += direction * sums[k];
      };
      for (unsigned int d = 0; d < dim; ++d)
      {
        add(lattice.zone.sites()[i].dofs[d], -e[d]);
        add(lattice.zone.sites()[end.site].dofs[d], end.mirrored >> d & 1 ? -e[d] : e[d]);
      }
    }
  }
  for (unsigned int k = 0; k < owned_cells.size(); ++k)
    for (const auto &[dof, sums] : by_dof[owned_cells[k]])
    {
      faces[k].ends.push_back(dof);
      faces[k].in_situ.push_back(sums[2]);
      for (unsigned int m = 0; m < n; ++m)
        faces[k].modes[m].of_ends.push_back(sums[m]);
    }

  softening_shares.clear();
  for (unsigned int number = 0; number < softening_bonds.size(); ++number)
  {
    const auto &[site, bond] = softening_bonds[number].view;
    const Tensor<1, dim> &e = lattice.coefficients[bond].direction;
    softening_shares.push_back(shares_of(site, bond, false));
    for (const auto &[cell, share] : softening_shares.back())
      if (Faces *own = faces_of[cell])
      {
        own->bonds.push_back(number);
        for (unsigned int m = 0; m < n; ++m)
          own->modes[m].of_bonds.push_back(share * lattice.push(softening_bonds[number].view) *
                                           (e * (modes[cell][m] * e)));
      }
  }
}


/// The force that softens linearly parts at 2 G_c over the strength, which goes with the root of
/// G_c and of the modulus.
template <int dim>
double Peridynamics<dim>::bare_aperture(const unsigned int cell) const
{
  if constexpr (dim == 2)
    if (parameters.tracked)
    {
      const TrackedPaths::Piece &piece = paths.wet_pieces()[cell];
      const RockProperties &main = scene.rock.main(),
                           &here = scene.rock(
                             lattice.regions[lattice.zone.active_cell_index(cells[cell].place)]);
      if (paths.end_at({piece.path, 0.5 * (piece.begin + piece.end)}))
        return share_when_bare * 2. * main.energy_release_rate / lattice.strength() *
               std::sqrt(here.energy_release_rate / main.energy_release_rate *
                         main.shear_modulus() / here.shear_modulus());
    }
  return 0.; // an initial crack has no bridges
}


template <int dim>
void Peridynamics<dim>::commit_contact(const State &state)
{
  const double force = std::pow(lattice.zone.spacing(), dim - 1) /
                       (lattice.strain_of_pressure * lattice.zone.spacing()); // by y
  for (unsigned int i = 0; i < cells.size(); ++i)
  {
    if (state.current.extra[unknown_of_faces(i, 0)] < closed && !told_of_contact)
    {
      messages.push_back(faces_touch(parameters.friction));
      told_of_contact = true;
    }
    if (n_modes() == 1)
      continue;
    const unsigned int slip = unknown_of_faces(i, 1);
    dissipated -= force * state.current.extra[slip + 1] *
                  (state.current.extra[slip] - state.committed.extra[slip]);
  }
}


template <int dim>
void Peridynamics<dim>::keep_committed_cells()
{
  std::vector<Place<dim>> found;
  for (const FractureCell<dim> &cell : cells)
    found.push_back(cell.place);
  for (const auto &[place, normal] : committed_cells)
    if (!std::binary_search(found.begin(), found.end(), place))
    {
      FractureCell<dim> kept{place, {}};
      for (unsigned int d = 0; d < dim; ++d)
        kept.normal[d] = normal[d];
      cells.push_back(kept);
    }
  std::sort(cells.begin(), cells.end(),
            [](const auto &a, const auto &b) { return a.place < b.place; });
}


template <int dim>
double Peridynamics<dim>::aperture(const unsigned int owned, const State &state) const
{
  return value(owned_segments[owned].opening, state.current);
}


#define INSTANTIATE(dim)                                                                          \
  template SymmetricTensor<2, dim> Peridynamics<dim>::released_strain(unsigned int) const;        \
  template std::vector<SymmetricTensor<2, dim>> Peridynamics<dim>::strain_of_faces(const State &) \
    const;                                                                                        \
  template double Peridynamics<dim>::fractured_stretch(                                           \
    unsigned int, unsigned int, const CellShares &, const std::vector<SymmetricTensor<2, dim>> &) \
    const;                                                                                        \
  template CellShares Peridynamics<dim>::shares_of(unsigned int, unsigned int, bool) const;       \
  template void Peridynamics<dim>::find_modes(const std::vector<BondAcross<dim>> &);              \
  template void Peridynamics<dim>::open_by_bonds();                                               \
  template double Peridynamics<dim>::bare_aperture(unsigned int) const;                           \
  template void Peridynamics<dim>::commit_contact(const State &);                                 \
  template void Peridynamics<dim>::keep_committed_cells();                                        \
  template double Peridynamics<dim>::aperture(unsigned int, const State &) const;                 \
  template std::vector<ExtraUnknown> Peridynamics<dim>::unknowns_of_faces() const;
INSTANTIATE(2)
INSTANTIATE(3)
#undef INSTANTIATE
} // namespace stockwork::peridynamics
