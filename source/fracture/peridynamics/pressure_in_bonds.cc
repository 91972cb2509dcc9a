#include "fracture/peridynamics/pressure_in_bonds.h"

#include "fracture/peridynamics/pores_across.h"
#include "stockwork/exchange/in_situ_contact.h"
#include "stockwork/mesh/key.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace stockwork::peridynamics
{
using dealii::SymmetricTensor;
using dealii::Tensor;

namespace
{
/// Faces that are nearer to one another touch, in lattice spacings.
constexpr double closed = 1e-11;
/// What bonds of a piece read of a jump, less all of it, from which on too few are there to tell.
constexpr double too_few_bonds = 0.5;
/// Of the opening at which nothing holds faces together any more, from which on they leak as bare
/// ones. By the energy, in all as much would leak as the tip has come, but the pores of the process
/// zone would lack pressure (doc/laboratory/peridynamics_paths.md).
constexpr double share_when_bare = 0.25;
} // namespace


template <int dim>
PressureInBonds<dim>::PressureInBonds(const Lattice<dim> &lattice,
                                      const SofteningBonds<dim> &softening_bonds,
                                      const TrackedPaths &paths,
                                      const CrossingBonds<dim> &crossing_bonds,
                                      Fracture<dim> &fracture)
  : lattice(lattice)
  , parameters(lattice.parameters)
  , scene(lattice.scene)
  , softening_bonds(softening_bonds)
  , paths(paths)
  , crossing_bonds(crossing_bonds)
  , fracture(fracture)
{
}


template <int dim>
SymmetricTensor<2, dim> PressureInBonds<dim>::released_strain(const unsigned int cell) const
{
  const Tensor<1, dim> &n = fracture.cells[cell].normal,
                       traction = scene.in_situ_stress(fracture.segments[cell].centre) * n;
  if constexpr (dim == 2)
    return (traction * n) * modes[cell][0] + (traction * cross_product_2d(n)) * modes[cell][1];
  else
    return lattice.strain_of_traction(n, traction);
}


template <int dim>
std::vector<SymmetricTensor<2, dim>> PressureInBonds<dim>::strain(const State &state) const
{
  std::vector<SymmetricTensor<2, dim>> strain;
  const double unit = 1. / (lattice.strain_of_pressure * lattice.zone.spacing());
  for (unsigned int i = 0; i < fracture.cells.size(); ++i)
  {
    strain.push_back(lattice.in_situ_is_zero ? SymmetricTensor<2, dim>() : released[i]);
    for (unsigned int m = 0; m < n_modes(); ++m)
      strain.back() += unit * state.current.extra[unknown_of_traction(i, m)] * modes[i][m];
  }
  return strain;
}


template <int dim>
std::vector<ExtraUnknown> PressureInBonds<dim>::unknowns() const
{
  std::vector<ExtraUnknown> unknowns;
  for (const Segment<dim> &segment : fracture.segments)
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
double PressureInBonds<dim>::stretch(const unsigned int site,
                                     const unsigned int bond,
                                     const CellShares &shares,
                                     const std::vector<SymmetricTensor<2, dim>> &strain) const
{
  const Tensor<1, dim> &e = lattice.coefficients[bond].direction;
  double stretch = 0.;
  if (parameters.tracked && shares.empty())
    return dry_stretch(site, bond);
  for (const auto &[cell, share] : shares)
  {
    AssertIndexRange(cell, strain.size());
    stretch += share * (e * (strain[cell] * e));
  }
  // The stress is that of the intact lattice; bonds beside a crack, or of other rock, are stiffer.
  return stretch * lattice.coefficients[bond].stiffness / lattice.stiffness(site, bond);
}


template <int dim>
double PressureInBonds<dim>::stretch_of_traction(const unsigned int cell,
                                                 const unsigned int mode,
                                                 const unsigned int bond) const
{
  const Tensor<1, dim> &e = lattice.coefficients[bond].direction;
  return e * (modes[cell][mode] * e) / (lattice.strain_of_pressure * lattice.zone.spacing());
}


template <int dim>
double PressureInBonds<dim>::dry_stretch(const unsigned int site, const unsigned int bond) const
{
  if constexpr (dim == 2)
    if (!lattice.in_situ_is_zero)
      if (const auto crossing = crossing_bonds.crossing(site, bond);
          crossing && !paths.is_wet(crossing->path))
        return lattice.dry_stretch(site, bond, paths.point(*crossing), paths.left(*crossing));
  return 0.;
}


template <int dim>
CellShares PressureInBonds<dim>::shares(const unsigned int site,
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
CellShares PressureInBonds<dim>::shares_of_jump(const BondAcross<dim> &bond) const
{
  return parameters.tracked ? paths.shares(bond.crossing, same_place * lattice.zone.spacing())
                            : shares(bond.view.first, bond.view.second, true);
}


template <int dim>
std::vector<BondAcross<dim>> PressureInBonds<dim>::bonds_across() const
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
void PressureInBonds<dim>::find_modes(const std::vector<BondAcross<dim>> &across)
{
  modes.assign(fracture.cells.size(), {});
  for (unsigned int i = 0; i < fracture.cells.size(); ++i)
  {
    modes[i][0] = lattice.strain_of_traction(fracture.cells[i].normal, fracture.cells[i].normal);
    if constexpr (dim == 2)
      modes[i][1] = lattice.strain_of_traction(fracture.cells[i].normal,
                                               cross_product_2d(fracture.cells[i].normal));
  }
  if constexpr (dim == 2)
  {
    if (!parameters.tracked && n_modes() == 1)
      return;
    // What modes read of jumps across the fracture and along it, over its area.
    std::vector<Tensor<2, dim>> reading(fracture.cells.size());
    for (const BondAcross<dim> &bond : across)
    {
      const auto &[site, b] = bond.view;
      if (!scene.has_pore_pressure && !lattice.bonds.is_broken(site, b))
        continue;
      const Tensor<1, dim> &e = bond.direction;
      for (const auto &[cell, share] : shares_of_jump(bond))
      {
        const Tensor<1, dim> &n = fracture.cells[cell].normal;
        bool leads_up = e * n > 0.;
        if (parameters.tracked)
        {
          const TrackedPaths::Piece &piece = paths.wet_pieces()[cell];
          const bool normal_is_left = cross_product_2d(n) * (piece.to - piece.from) > 0.;
          leads_up = (e * paths.left(bond.crossing) > 0.) == normal_is_left;
        }
        const double elongated = (leads_up ? share : -share) / fracture.segments[cell].area;
        for (unsigned int m = 0; m < 2; ++m)
        {
          const double read = elongated * pull(site, b, e, modes[cell][m]);
          reading[cell][m][0] += read * (e * n);
          reading[cell][m][1] += read * (e * cross_product_2d(n));
        }
      }
    }
    for (unsigned int i = 0; i < fracture.cells.size(); ++i)
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
void PressureInBonds<dim>::find_crossed()
{
  crossed.reinit(lattice.zone, lattice.stencil, fracture.cells, parameters.horizon);
}


template <int dim>
void PressureInBonds<dim>::follow()
{
  if (!parameters.tracked)
    find_crossed();
  const std::vector<BondAcross<dim>> across = bonds_across();
  find_modes(across);
  released.clear();
  if (!lattice.in_situ_is_zero)
    for (unsigned int i = 0; i < fracture.cells.size(); ++i)
      released.push_back(released_strain(i));
  pores_of_pieces.clear();
  if (scene.has_pore_pressure && parameters.tracked)
    for (const Segment<dim> &segment : fracture.segments)
      pores_of_pieces.push_back(pores_across(lattice.zone, segment));
  make_faces(broken_shares(across));
  ByUnknown by_unknown(fracture.cells.size());
  add_broken(across, by_unknown);
  add_softening(by_unknown);
  if (parameters.tracked && !lattice.softening.brittle())
    find_room_before();
}


template <int dim>
std::vector<double>
PressureInBonds<dim>::broken_shares(const std::vector<BondAcross<dim>> &across) const
{
  std::vector<double> broken(fracture.cells.size(), 0.), all(fracture.cells.size(), 0.);
  for (const BondAcross<dim> &bond : across)
    for (const auto &[cell, share] : shares_of_jump(bond))
    {
      const double part = share * lattice.coefficients[bond.view.second].stiffness;
      all[cell] += part;
      if (lattice.bonds.is_broken(bond.view.first, bond.view.second))
        broken[cell] += part;
    }
  for (unsigned int i = 0; i < fracture.cells.size(); ++i)
    broken[i] = all[i] > 0. ? broken[i] / all[i] : 0.;
  return broken;
}


template <int dim>
void PressureInBonds<dim>::make_faces(const std::vector<double> &broken_share)
{
  const unsigned int n = n_modes();
  faces_of.assign(fracture.cells.size(), nullptr);
  faces.assign(fracture.owned_cells.size(), Faces());
  for (unsigned int k = 0; k < fracture.owned_cells.size(); ++k)
  {
    const unsigned int i = fracture.owned_cells[k];
    Segment<dim> &segment = fracture.owned_segments[k];
    Faces &own = faces[k];
    faces_of[i] = &own;
    own.area = std::pow(lattice.zone.spacing(), dim - 1);
    own.unit = 1. / (lattice.strain_of_pressure * lattice.zone.spacing());
    own.segment = segment.key;
    own.friction = parameters.friction;
    // The last piece of a fracture may have lost a single bond, which reads the same of both modes:
    // faces that stick would be held twice by it.
    own.rub = broken_share[i] > too_few_bonds;
    for (unsigned int m = 0; m < n; ++m)
    {
      own.modes.emplace_back();
      own.modes[m].traction = unknown_of_traction(i, m);
      own.modes[m].jump = own.modes[m].traction - 1;
      own.modes[m].of_tractions.assign(n, 0.);
    }
    segment.opening = LinearFunctional();
    segment.opening.extra.push_back(own.modes[0].jump);
    segment.opening.extra_coefficients.push_back(own.area / segment.area);
    segment.share_of_pores = 0.;
    if (!scene.has_pore_pressure)
      continue;
    own.in_situ_contact = in_situ_contact(scene, segment.centre, segment.normal);
    segment.taken_from_pores = own.biot_coefficient =
      lattice.rock_at(fracture.cells[i].place).biot_coefficient;
    segment.bare_aperture = bare_aperture(i);
    own.pores = parameters.tracked ? &pores_of_pieces[i] : &segment.pore_pressure;
  }
}


template <int dim>
double PressureInBonds<dim>::pull(const unsigned int site,
                                  const unsigned int bond,
                                  const Tensor<1, dim> &direction,
                                  const Strain &strain) const
{
  // Half of a bond belongs to each end.
  return 0.5 * lattice.zone.sites()[site].share * lattice.coefficients[bond].stiffness *
           lattice.coefficients[bond].length * (direction * (strain * direction)) +
         lattice.zone.sites()[site].share * lattice.force_of_dilatation(bond) * trace(strain);
}


template <int dim>
double PressureInBonds<dim>::longer(const unsigned int site,
                                    const unsigned int bond,
                                    const Strain &strain) const
{
  const Tensor<1, dim> &e = lattice.coefficients[bond].direction;
  return lattice.coefficients[bond].length / lattice.rock_of_bonds.modulus(site, bond) *
         (e * (strain * e));
}


template <int dim>
void PressureInBonds<dim>::add_broken(const std::vector<BondAcross<dim>> &across,
                                      ByUnknown &by_unknown)
{
  const unsigned int n = n_modes();
  ByDof by_dof(fracture.cells.size());
  const Strain of_pressure = lattice.strain_of_pressure * dealii::unit_symmetric_tensor<dim>();
  for (const BondAcross<dim> &bond : across)
  {
    const auto &[i, b] = bond.view;
    if (!lattice.bonds.is_broken(i, b))
      continue;
    const Tensor<1, dim> &e = lattice.coefficients[b].direction;
    const double least = same_place * pull(i, b, e, of_pressure),
                 dilates = lattice.zone.sites()[i].share * lattice.force_of_dilatation(b);
    const FarEnd end = lattice.zone.far_end(i, b);
    for (const auto &[cell, share] : shares(i, b, true))
    {
      if (faces_of[cell] == nullptr)
        continue;
      std::array<double, 3> sums{{0., 0., 0.}};
      for (unsigned int m = 0; m < n; ++m)
        if (const double own = pull(i, b, e, modes[cell][m]); std::abs(own) > least)
        {
          sums[m] = share * own;
          const double by_dilatation = share * dilates * longer(i, b, modes[cell][m]);
          const auto read = [&](const Strain &strain)
          { return sums[m] * longer(i, b, strain) + by_dilatation * trace(strain); };
          Faces::Mode &mode = faces_of[cell]->modes[m];
          if (!lattice.in_situ_is_zero)
            mode.constant += read(released[cell]);
          for (unsigned int k = 0; k < n; ++k)
            mode.of_tractions[k] += read(modes[cell][k]);
        }
      if (!lattice.in_situ_is_zero)
        sums[2] = share * pull(i, b, e, released[cell]);
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
  if (lattice.has_dilatations())
    add_dilatations(across, by_dof, by_unknown);
  for (unsigned int k = 0; k < fracture.owned_cells.size(); ++k)
    for (const auto &[dof, sums] : by_dof[fracture.owned_cells[k]])
    {
      faces[k].ends.push_back(dof);
      faces[k].in_situ.push_back(sums[2]);
      for (unsigned int m = 0; m < n; ++m)
        faces[k].modes[m].of_ends.push_back(sums[m]);
    }
}


template <int dim>
void PressureInBonds<dim>::add_softening(ByUnknown &by_unknown)
{
  softening_shares.clear();
  for (unsigned int number = 0; number < softening_bonds.size(); ++number)
  {
    const auto &[site, bond] = softening_bonds[number].view;
    const Tensor<1, dim> &e = lattice.coefficients[bond].direction;
    softening_shares.push_back(shares(site, bond, false));
    const double push = lattice.push({site, bond});
    double by_dilatation = 0.;
    if (parameters.state_based)
      for (const auto &[s, b] : lattice.bonds.views_of(site, bond))
        by_dilatation += lattice.zone.sites()[s].share * lattice.force_of_dilatation(b);
    for (const auto &[cell, share] : softening_shares.back())
      if (faces_of[cell] != nullptr)
        for (unsigned int m = 0; m < n_modes(); ++m)
        {
          const double of_force = share * push * (e * (modes[cell][m] * e));
          by_unknown[cell][number][m] += of_force + share * by_dilatation * trace(modes[cell][m]);
          if (parameters.state_based)
            by_unknown[cell][softening_bonds.unknown_of_lost_force(number)][m] += of_force;
        }
  }
  for (unsigned int cell = 0; cell < by_unknown.size(); ++cell)
    for (const auto &[unknown, of_modes] : by_unknown[cell])
    {
      faces_of[cell]->bonds.push_back(unknown);
      for (unsigned int m = 0; m < n_modes(); ++m)
        faces_of[cell]->modes[m].of_bonds.push_back(of_modes[m]);
    }
}


template <int dim>
void PressureInBonds<dim>::find_room_before()
{
  for (unsigned int k = 0; k < fracture.owned_cells.size(); ++k)
  {
    const auto &part_of = paths.wet_pieces()[fracture.owned_cells[k]].part_of;
    if (!part_of)
      continue;
    const Faces &own = faces[k];
    const Faces::Mode &across = own.modes[0];
    Segment<dim> &segment = fracture.owned_segments[k];
    segment.part_of = fracture.segments[*part_of].key;
    LinearFunctional &room = segment.room_before;
    room = LinearFunctional();
    room.bulk = own.ends;
    for (const double of_end : across.of_ends)
      room.bulk_coefficients.push_back(of_end / segment.area);
    room.extra = own.bonds;
    for (const double of_bond : across.of_bonds)
      room.extra_coefficients.push_back(of_bond / segment.area);
    for (unsigned int m = 0; m < n_modes(); ++m)
    {
      room.extra.push_back(unknown_of_traction(*part_of, m));
      room.extra_coefficients.push_back(own.unit * across.of_tractions[m] / segment.area);
    }
    room.constant = across.constant / segment.area;
  }
}


/// The force that softens linearly parts at 2 G_c over the strength, which goes with the root of
/// G_c and of the modulus.
template <int dim>
double PressureInBonds<dim>::bare_aperture(const unsigned int cell) const
{
  if constexpr (dim == 2)
    if (parameters.tracked && !lattice.softening.brittle())
    {
      const TrackedPaths::Piece &piece = paths.wet_pieces()[cell];
      const RockProperties &main = scene.rock.main(),
                           &here = lattice.rock_at(fracture.cells[cell].place);
      if (paths.end_at({piece.path, 0.5 * (piece.begin + piece.end)}))
        return share_when_bare * 2. * main.energy_release_rate / lattice.strength() *
               std::sqrt(here.energy_release_rate / main.energy_release_rate *
                         main.shear_modulus() / here.shear_modulus());
    }
  return 0.; // initial cracks and brittle bonds leave no bridges
}


template <int dim>
void PressureInBonds<dim>::assemble(const State &state, Sink &sink) const
{
  for (const Faces &own : faces)
    own.assemble(state, sink);
}


template <int dim>
bool PressureInBonds<dim>::touches(const State &state) const
{
  for (unsigned int i = 0; i < fracture.cells.size(); ++i)
    if (state.current.extra[unknown_of_traction(i, 0) - 1] < closed * lattice.zone.spacing())
      return true;
  return false;
}


template <int dim>
double PressureInBonds<dim>::work_of_friction(const State &state) const
{
  if (n_modes() == 1)
    return 0.;
  const double force = std::pow(lattice.zone.spacing(), dim - 1) /
                       (lattice.strain_of_pressure * lattice.zone.spacing()); // by the unknown
  double work = 0.;
  for (unsigned int i = 0; i < fracture.cells.size(); ++i)
  {
    const unsigned int traction = unknown_of_traction(i, 1), slip = traction - 1;
    work -= force * state.current.extra[traction] *
            (state.current.extra[slip] - state.committed.extra[slip]);
  }
  return work;
}


template <int dim>
double PressureInBonds<dim>::slip(const unsigned int cell, const State &state) const
{
  return state.current.extra[unknown_of_traction(cell, 1) - 1] *
         std::pow(lattice.zone.spacing(), dim - 1) / fracture.segments[cell].area;
}


template class PressureInBonds<2>;
template class PressureInBonds<3>;
} // namespace stockwork::peridynamics
