#include "fracture/peridynamics/peridynamics.h"

#include "fracture/peridynamics/lattice_moduli.h"
#include "stockwork/base/error.h"

#include <boost/serialization/array.hpp>
#include <boost/serialization/map.hpp>
#include <boost/serialization/utility.hpp>
#include <boost/serialization/vector.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace stockwork::peridynamics
{
using dealii::Point;
using dealii::SymmetricTensor;
using dealii::Tensor;

namespace
{
std::string text(const double number)
{
  std::ostringstream stream;
  stream << number;
  return stream.str();
}

/// Stiffness that broken bonds keep where a site has lost nearly all of them.
constexpr double remaining_share = 1e-6;
constexpr double nearly_detached = 0.9;
/// Of the bonds' stiffness at a free face, where about half of them are gone.
constexpr double most_correction = 2.;
} // namespace


template <int dim>
Peridynamics<dim>::Peridynamics(const Parameters<dim> &parameters, const Scene<dim> &scene)
  : parameters(parameters)
  , scene(scene)
  , stencil(horizon_stencil<dim>(parameters.horizon, parameters.volumes))
{
  const RockProperties &rock = scene.rock.main();
  const double nu = bond_based_poisson_ratio(rock.plane_stress);
  if (std::abs(rock.poisson_ratio - nu) > 1e-6)
    throw EntryError("Rock/Poisson ratio", text(rock.poisson_ratio),
                     (rock.plane_stress ? std::string("1/3") : std::string("0.25")) +
                       " with bond-based peridynamics" +
                       (rock.plane_stress ? " in plane stress" : ""));
  if (!(rock.energy_release_rate > 0.) && parameters.growth)
    throw InputError("Peridynamics needs the rock's energy release rate G_c (Rock / Critical "
                     "energy release rate, or Fracture toughness), or 'Growth = false'.");
  if (scene.cracks.empty() && parameters.boxes.empty())
    throw InputError("Peridynamics needs an initial crack, or the box of its 'Zone'.");
  for (const auto &crack : scene.cracks)
    shape.cracks.push_back(crack.points);
  shape.boxes = parameters.boxes;
  shape.margin = parameters.margin;
}


template <int dim>
Requirements Peridynamics<dim>::requirements() const
{
  Requirements requirements;
  requirements.symmetric = false;
  requirements.symmetric_bulk = false;
  requirements.quasi_static_only = true;
  requirements.linear_elements = true;
  return requirements;
}


template <int dim>
void Peridynamics<dim>::setup(const Discretization<dim> &discretization,
                              const Collectives &collectives)
{
  rank = collectives.rank();
  zone.setup(shape, parameters.cell_size, stencil, discretization, collectives);
  bonds.reinit(zone, stencil);

  const RockProperties &rock = scene.rock.main();
  const double horizon = parameters.horizon * zone.spacing();
  law = bond_based_law<dim>(rock, stencil, zone.spacing());
  coefficients = bond_coefficients<dim>(stencil, law, zone.spacing());
  critical_stretch = continuum_critical_stretch<dim>(rock, horizon) *
                     (std::isnan(parameters.stretch_factor) ? trapping_factor(parameters.horizon)
                                                            : parameters.stretch_factor);
  in_situ_is_zero = true;
  for (const unsigned int i : zone.peridynamic_sites())
    in_situ_is_zero =
      in_situ_is_zero && scene.in_situ_stress(zone.position(zone.sites()[i].place)).norm() == 0.;

  if (started)
    bonds.set_broken(committed_bonds);
  else
  {
    cut_initial_cracks();
    committed_bonds = bonds.places();
    set_initial_normals();
    started = true;
  }
  ++version;
  refresh_segments();
}


template <int dim>
void Peridynamics<dim>::cut_initial_cracks()
{
  if constexpr (dim == 2)
    for (const auto &crack : scene.cracks)
    {
      if (crack.kind != InitialCrack<dim>::Kind::open)
        continue;
      const auto at_wall = [&](const Point<dim> &x)
      { return !zone.is_inside(x, 1e-6 * zone.spacing()); };
      for (unsigned int c = 0; c + 1 < crack.points.size(); ++c)
      {
        const Point<dim> &start = crack.points[c];
        const Tensor<1, dim> along = crack.points[c + 1] - start;
        const double length = along.norm(), reach = 1e-6 * zone.spacing();
        const auto side = [&](const Point<dim> &x)
        { return (along[0] * (x[1] - start[1]) - along[1] * (x[0] - start[0])) / length; };
        for (const unsigned int i : zone.peridynamic_sites())
          for (unsigned int b = 0; b < stencil.size(); ++b)
          {
            const Point<dim> from = zone.position(zone.sites()[i].place);
            const Tensor<1, dim> xi = zone.spacing() * stencil[b].length() * stencil[b].direction();
            // A node on the crack belongs to its left side.
            const double s = side(from), t = side(from + xi);
            if ((s >= -reach) == (t >= -reach) || !bonds.can_break(i, b))
              continue;
            const Point<dim> crossing = from + s / (s - t) * xi;
            const double place = (crossing - start) * along / length;
            // A bond right at a tip holds, or the crack would be longer by half a cell.
            const bool after_start = place > (c == 0 && !at_wall(start) ? reach : -reach);
            const bool before_end =
              place <
              length +
                (c + 2 == crack.points.size() && !at_wall(crack.points.back()) ? -reach : reach);
            if (after_start && before_end)
              bonds.set_broken(i, b);
          }
      }
    }
}


template <int dim>
void Peridynamics<dim>::set_initial_normals()
{
  if constexpr (dim == 2)
    for (const FractureCell<dim> &cell : find_fracture_cells(zone, bonds))
    {
      Point<dim> centre = zone.position(cell.place);
      for (unsigned int d = 0; d < dim; ++d)
        centre[d] += 0.5 * zone.spacing();
      double nearest = std::numeric_limits<double>::infinity();
      for (const auto &crack : scene.cracks)
        for (unsigned int c = 0; c + 1 < crack.points.size(); ++c)
        {
          const std::vector<Point<dim>> piece{crack.points[c], crack.points[c + 1]};
          const double distance = distance_from_polyline(centre, piece);
          if (crack.kind != InitialCrack<dim>::Kind::open || distance >= nearest)
            continue;
          nearest = distance;
          const Tensor<1, dim> along = (piece[1] - piece[0]) / piece[0].distance(piece[1]);
          const double upward = along[0] >= 0. ? 1. : -1.;
          committed_normals[cell.place] = {-upward * along[1], upward * along[0]};
        }
    }
}


template <int dim>
void Peridynamics<dim>::refresh_segments()
{
  damage.assign(zone.sites().size(), 0.);
  for (const unsigned int i : zone.peridynamic_sites())
    damage[i] = bonds.damage(i);
  cells = find_fracture_cells(zone, bonds);
  align_normals(cells, parameters.horizon + 1);
  for (FractureCell<dim> &cell : cells)
    if (const auto old = committed_normals.find(cell.place); old != committed_normals.end())
      for (unsigned int d = 0; d < dim; ++d)
        cell.normal[d] = old->second[d];
  all_segments = make_segments(zone, cells);
  owned_segments.clear();
  owned_cells.clear();
  for (unsigned int i = 0; i < cells.size(); ++i)
  {
    Segment<dim> &segment = all_segments[i];
    const auto &n = segment.normal;
    segment.given_pressure = scene.crack_pressure;
    const auto carried = initial_pressure.find(segment.key);
    segment.initial_pressure = carried != initial_pressure.end()
                                 ? carried->second
                                 : std::max(0., -(n * (scene.in_situ_stress(segment.centre) * n)));
    if (segment.pore_pressure.bulk.empty())
    {
      segment.pore_pressure.constant = scene.in_situ_pore_pressure(segment.centre);
      segment.pore_distance = 0.;
    }
    else // unknowns are measured from the in-situ pressure
      segment.pore_pressure.constant = scene.in_situ_pore_pressure(segment.centre);
    if (zone.owns(cells[i].place))
    {
      owned_cells.push_back(i);
      owned_segments.push_back(segment);
    }
  }
}


template <int dim>
dealii::ArrayView<const Segment<dim>> Peridynamics<dim>::segments() const
{
  return dealii::make_array_view(owned_segments);
}


template <int dim>
CellRole<dim> Peridynamics<dim>::role(const CellIterator &cell) const
{
  return {nullptr, zone.skipped_rows(cell->active_cell_index())};
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
void Peridynamics<dim>::assemble(const StepContext &, const State &, Sink &sink) const
{
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


template <int dim>
void Peridynamics<dim>::begin_step(const StepContext &)
{
  passes = 0;
  dissipated = committed_energy;
  n_messages_before = messages.size();
  told_of_rim_before = told_of_rim;
  n_segments_before = cells.size();
  n_tips_before = 0;
  for (const auto &segment : all_segments)
    n_tips_before += segment.at_tip;
}


template <int dim>
void Peridynamics<dim>::commit(const StepContext &, const State &)
{
  if (passes > 0)
    committed_bonds = bonds.places();
  committed_energy = dissipated;
  const double settled = (parameters.horizon + 1.5) * zone.spacing();
  for (unsigned int i = 0; i < cells.size(); ++i)
    if (std::none_of(all_segments.begin(), all_segments.end(),
                     [&](const Segment<dim> &other) {
                       return other.at_tip &&
                              other.centre.distance(all_segments[i].centre) < settled;
                     }))
      committed_normals.emplace(cells[i].place, std::vector<double>(cells[i].normal.begin_raw(),
                                                                    cells[i].normal.end_raw()));
  initial_pressure.clear();
}


template <int dim>
void Peridynamics<dim>::rollback()
{
  messages.resize(n_messages_before);
  told_of_rim = told_of_rim_before;
  dissipated = committed_energy;
  initial_pressure.clear();
  if (passes == 0)
    return;
  passes = 0;
  bonds.reinit(zone, stencil);
  bonds.set_broken(committed_bonds);
  ++version;
  refresh_segments();
}


template <int dim>
std::vector<std::string> Peridynamics<dim>::take_messages()
{
  std::vector<std::string> taken;
  taken.swap(messages);
  n_messages_before = 0;
  return taken;
}


template <int dim>
void Peridynamics<dim>::wanted_cell_size(
  const dealii::parallel::distributed::Triangulation<dim> &triangulation,
  std::vector<float> &sizes) const
{
  const double h = parameters.cell_size;
  if (h == 0.)
    return;
  for (const auto &cell : triangulation.active_cell_iterators())
    if (cell->is_locally_owned() &&
        shape.contains(cell->center(), h, parameters.horizon + 2. + 0.5 * cell->diameter() / h))
    {
      float &size = sizes[cell->active_cell_index()];
      size = std::min(size, static_cast<float>(h));
    }
}


template <int dim>
void Peridynamics<dim>::save(boost::archive::binary_oarchive &archive) const
{
  std::array<double, dim> origin;
  for (unsigned int d = 0; d < dim; ++d)
    origin[d] = zone.origin()[d];
  archive << origin << committed_bonds << committed_normals << committed_energy << told_of_rim;
}


template <int dim>
void Peridynamics<dim>::load(boost::archive::binary_iarchive &archive)
{
  std::array<double, dim> origin;
  archive >> origin >> committed_bonds >> committed_normals >> committed_energy >> told_of_rim;
  Point<dim> corner;
  for (unsigned int d = 0; d < dim; ++d)
    corner[d] = origin[d];
  started = true;
  dissipated = committed_energy;
  const bool known_mesh = !zone.sites().empty();
  if (!known_mesh)
    zone.set_origin(corner);
  else
  {
    bonds.reinit(zone, stencil);
    bonds.set_broken(committed_bonds);
    ++version;
    refresh_segments();
  }
}


template <int dim>
FractureSummary Peridynamics<dim>::summary(const State &, const Collectives &) const
{
  FractureSummary result;
  for (unsigned int i = 0; i < cells.size(); ++i)
  {
    result.length += all_segments[i].area;
    result.broken_length += broken_share(zone, bonds, cells[i]) * all_segments[i].area;
    result.n_tips += all_segments[i].at_tip;
  }
  result.dissipated_energy = dissipated;
  return result;
}


template <int dim>
void Peridynamics<dim>::write_fields(const State &state, FieldSink<dim> &sink) const
{
  std::vector<double> mean_damage(zone.n_active_cells(), 0.);
  for (const Place<dim> &cell : zone.cells())
    if (zone.owns(cell))
    {
      double sum = 0.;
      for (unsigned int v = 0; v < 1u << dim; ++v)
      {
        Place<dim> place = cell;
        for (unsigned int d = 0; d < dim; ++d)
          place[d] += v >> d & 1;
        sum += damage[zone.find(place)];
      }
      mean_damage[zone.active_cell_index(cell)] = sum / (1 << dim);
    }
  sink.add_cell_field("damage", mean_damage);

  if constexpr (dim == 2)
    for (const Segment<dim> &segment : owned_segments)
    {
      double aperture = 0.;
      for (unsigned int k = 0; k < segment.opening.bulk.size(); ++k)
        aperture +=
          segment.opening.bulk_coefficients[k] * state.current.bulk(segment.opening.bulk[k]);
      std::vector<std::pair<std::string, double>> values{{"aperture", aperture}, {"damage", 1.}};
      if (state.segment_pressure)
        values.emplace_back("fluid_pressure", state.segment_pressure(segment.key));
      Tensor<1, dim> along;
      along[0] = segment.normal[1];
      along[1] = -segment.normal[0];
      sink.add_fracture_piece(
        {segment.centre - 0.5 * segment.area * along, segment.centre + 0.5 * segment.area * along},
        values);
    }
}

template class Peridynamics<2>;
template class Peridynamics<3>;
} // namespace stockwork::peridynamics
