#include "fracture/peridynamics/peridynamics.h"

#include "discontinuity/contact.h"
#include "flow/permeability_tensor.h"
#include "fracture/peridynamics/foresight.h"
#include "fracture/peridynamics/rows_of_nodes.h"
#include "fracture/peridynamics/wording.h"
#include "mesh/box_list.h"
#include "stockwork/base/error.h"
#include "stockwork/base/quantity.h"
#include "stockwork/fracture/needs.h"

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

template <int dim>
Peridynamics<dim>::Peridynamics(const Parameters<dim> &parameters, const Scene<dim> &scene)
  : parameters(parameters)
  , scene(scene)
  , lattice(this->parameters, scene)
  , softening_bonds(lattice)
  , new_paths(lattice)
  , crossing_bonds(lattice)
  , tips(lattice, softening_bonds, crossing_bonds)
  , pressure_in_bonds(lattice, softening_bonds, paths, crossing_bonds, fracture)
{
  if (parameters.growth)
    needs::energy_release_rate(scene.rock, "peridynamics", "or 'Growth = false'");
  if (parameters.as_published && !parameters.tensor_fluid &&
      scene.rock.bulk_model() == "poroelastic")
    throw EntryError("Fracture/peridynamics/Closure", "as published",
                     "'conserving' in porous rock (Rock/Bulk model), or 'Fluid = permeability "
                     "tensor'");
  if (parameters.boxes.empty())
    needs::initial_crack(scene, "peridynamics", "or the box of its 'Zone'");
  refuse_what_bonds_do_not_know(parameters, scene);
  refuse_explicit_steps(parameters, scene);
  shape.cracks = scene.cracks;
  shape.boxes = parameters.boxes;
  shape.margin = parameters.margin;
  if (parameters.cell_size > 0.)
  {
    lattice.set_law(parameters.cell_size);
    messages = foresee(lattice, parameters.cell_size);
  }
}


template <int dim>
Requirements Peridynamics<dim>::requirements() const
{
  Requirements requirements;
  requirements.symmetric = false;
  requirements.pore_pressure = requirements.fluid_in_pores = parameters.tensor_fluid;
  requirements.has_fracture = !scene.cracks.empty() || parameters.growth;
  requirements.may_grow = parameters.growth;
  requirements.random_rock = true;
  // As seen in kgd/sun, kgd/toughness, minifrac and radial/toughness.
  requirements.time_of_step = dim == 2 ? 7.5 : 25.;
  requirements.memory_per_unknown = dim == 2 ? 12e3 : 48e3;
  if (parameters.explicit_steps)
  {
    // No matrix has bonds in it; as seen in dry/*.
    requirements.time_of_step = dim == 2 ? 1. : 3.;
    requirements.memory_per_unknown = dim == 2 ? 1e3 : 5e3;
  }
  return requirements;
}


template <int dim>
void Peridynamics<dim>::setup(const MeshView<dim> &mesh_view, const Collectives &collectives)
{
  ranks = collectives;
  rank = collectives.rank();
  if (parameters.explicit_steps && !lattice.zone.sites().empty())
    keep_bonds();
  n_nodes = mesh_view.dof_handler.n_dofs() / mesh_view.dof_handler.get_fe().dofs_per_vertex;
  lattice.setup(shape, mesh_view, collectives);
  // Where elements lie between, they pull with all of the stress at sites that have lost a part of
  // their bonds, beyond the side. And the matrix of bonds has no columns of what is prescribed:
  // only explicit steps, which have none, feel bonds to nodes that the deck moves.
  if ((!is_all_bonds() || !parameters.explicit_steps) && parameters.free_boundaries &&
      !lattice.zone.is_divided())
    if (const auto side = lattice.zone.moved_side_within((parameters.horizon - same_place) *
                                                         lattice.zone.spacing()))
      throw unsuitable_mesh(
        std::string("The peridynamic zone comes nearer than a horizon, ") +
        to_string(parameters.horizon * lattice.zone.spacing(), dimension::length) +
        ", to the side that " + "the deck moves at the " + ((*side)[1] == 0 ? "lower" : "upper") +
        " end of " + "xyz"[(*side)[0]] +
        ": bonds would be missing there, and the force with them. Keep it away by a larger box, "
        "smaller cells or less of 'Margin' and 'Zone', or, with 'Time/Scheme = explicit', let "
        "'Zone' hold all of the rock.");
  for (const auto &box : parameters.boxes)
    if (box.get_neighbor_type(lattice.zone.all_rock()) == dealii::NeighborType::not_neighbors)
      throw EntryError("Fracture/peridynamics/Zone", to_string(box),
                       "boxes that hold some of the rock");
  for (const auto &box : parameters.unbreakable)
  {
    const bool holds_some =
      std::any_of(lattice.zone.peridynamic_sites().begin(), lattice.zone.peridynamic_sites().end(),
                  [&](const unsigned int i)
                  {
                    return box.point_inside(lattice.zone.position(lattice.zone.sites()[i].place),
                                            same_place * lattice.zone.spacing());
                  });
    if (collectives.max(holds_some ? 1. : 0.) == 0. && parameters.zone_growth == 0)
      throw EntryError("Fracture/peridynamics/Unbreakable", to_string(box),
                       "boxes that hold nodes of the peridynamic zone");
  }
  cracked.reinit(lattice.zone, lattice.stencil);
  if (!started && parameters.cell_size == 0.)
    for (std::string &message : foresee(lattice, lattice.zone.spacing()))
      messages.push_back(std::move(message));
  if (!started)
    for (std::string &message : foresee_rows_of_nodes(lattice))
      messages.push_back(std::move(message));

  if (started)
  {
    lattice.bonds.set_broken(committed_bonds);
    restore_softening();
  }
  else
  {
    cut_initial_cracks();
    keep_bonds();
    soften_cohesive_cracks();
    if constexpr (dim == 2)
      if (parameters.tracked)
      {
        paths.reinit(
          oriented_cracks(lattice), lattice.zone.spacing(),
          [&](const Point<dim> &end)
          { return lattice.zone.is_inside(end, same_place * lattice.zone.spacing()); },
          parameters.cohesive_energy);
        if (const auto place = paths.overlap())
        {
          throw InputError(
            "Cracks: at " + in_metres(*place) +
            " two of them, or two legs of one, lie upon one another, or cross in "
            "the middle of a cell's length of both. With "
            "'Fracture/peridynamics/Tracking = path' there must be one crack at a "
            "place: leave one out, or move one by a part of a cell; or set 'Tracking = none'.");
        }
        if (const auto place = paths.cross())
        {
          const InitialCrack<dim> &crack = *std::min_element(
            scene.cracks.begin(), scene.cracks.end(),
            [&](const auto &a, const auto &b) { return a.distance(*place) < b.distance(*place); });
          throw EntryError(crack.entry, crack.text,
                           "a crack that does not cross another one or itself, as at " +
                             in_metres(*place) +
                             ", with 'Fracture/peridynamics/Tracking = path'; it may end there. "
                             "Give it as two cracks that do, or set 'Tracking = none'");
        }
        committed_paths = paths;
        tips.committed_energy.assign(scene.cracks.size(), {{0., 0.}});
      }
    if (!parameters.tracked)
      set_initial_normals();
    if (parameters.surface_correction)
      for (const unsigned int i : lattice.zone.peridynamic_sites())
        if (const double gone =
              lattice.bonds.damage(i) + lattice.zone.absent_share(i, lattice.stencil);
            gone > 0.)
          committed_correction[lattice.zone.sites()[i].place] = gone;
  }
  row_versions.restart(lattice.zone.sites().size());
  crossing_bonds.forget();
  refresh_segments();
  if (!started && parameters.tracked && parameters.growth)
    new_paths.refuse_in_situ_tension(paths);
  started = true;
  if (parameters.explicit_steps)
    make_explicit_bonds();
  if (explicit_bonds && lattice.stretch_of_given_pressure() != 0.)
  {
    pressure_in_bonds.find_crossed();
    open_explicit_bonds(collectives);
  }
}


template <int dim>
void Peridynamics<dim>::keep_bonds()
{
  committed_bonds = of_all_ranks(lattice.bonds.places());
  committed_cracked = of_all_ranks(cracked.places());
}


template <int dim>
template <class T>
std::vector<T> Peridynamics<dim>::of_all_ranks(std::vector<T> mine) const
{
  if (!lattice.zone.is_divided())
    return mine;
  mine = ranks->gather(mine);
  std::sort(mine.begin(), mine.end());
  mine.erase(std::unique(mine.begin(), mine.end()), mine.end());
  return mine;
}


template <int dim>
std::vector<FractureCell<dim>> Peridynamics<dim>::fracture_cells() const
{
  std::vector<FractureCell<dim>> found = find_fracture_cells(lattice.zone, cracked);
  if (!lattice.zone.is_divided())
    return found;
  found = ranks->gather(found); // each knows its own
  std::sort(found.begin(), found.end(),
            [](const auto &a, const auto &b) { return a.place < b.place; });
  return found;
}


template <int dim>
void Peridynamics<dim>::keep_committed_cells()
{
  std::vector<Place<dim>> found;
  for (const FractureCell<dim> &cell : fracture.cells)
    found.push_back(cell.place);
  for (const auto &[place, normal] : committed_cells)
    if (!std::binary_search(found.begin(), found.end(), place))
    {
      FractureCell<dim> kept{place, {}};
      for (unsigned int d = 0; d < dim; ++d)
        kept.normal[d] = normal[d];
      fracture.cells.push_back(kept);
    }
  std::sort(fracture.cells.begin(), fracture.cells.end(),
            [](const auto &a, const auto &b) { return a.place < b.place; });
}


template <int dim>
void Peridynamics<dim>::refresh_segments()
{
  const std::vector<double> damage_before = lattice.damage,
                            corrected_before = lattice.corrected_damage;
  lattice.find_damage();
  if (parameters.surface_correction)
  {
    lattice.corrected_damage.assign(lattice.zone.sites().size(), 0.);
    for (const auto &[place, corrected] : committed_correction)
      if (const unsigned int i = lattice.zone.find(place);
          i != dealii::numbers::invalid_unsigned_int)
        lattice.corrected_damage[i] = corrected;
  }
  const std::vector<FractureCell<dim>> cells_before = fracture.cells;
  if (parameters.tracked)
    follow_paths();
  else
  {
    fracture.cells = fracture_cells();
    align_normals<dim>(fracture.cells, parameters.horizon + 1,
                       [this](const Place<dim> &place)
                       { return committed_normals.count(place) != 0; });
    for (FractureCell<dim> &cell : fracture.cells)
      if (const auto old = committed_normals.find(cell.place); old != committed_normals.end())
        for (unsigned int d = 0; d < dim; ++d)
          cell.normal[d] = old->second[d];
    if (parameters.in_bonds)
      keep_committed_cells();
    fracture.segments = make_segments(lattice.zone, fracture.cells);
  }
  fracture.at_front.clear();
  published.clear();
  if (parameters.as_published && !parameters.tensor_fluid)
  {
    const RockProperties &rock = scene.rock.main();
    const double stretch_of_pressure = 1. / (dim * rock.lame_lambda() + 2. * rock.shear_modulus());
    const auto loads = published_loads(lattice.zone, lattice.bonds, lattice.coefficients,
                                       stretch_of_pressure, fracture.cells);
    for (unsigned int i = 0; i < fracture.cells.size(); ++i)
      if (lattice.zone.owns(fracture.cells[i].place))
        published.emplace_back(fracture.segments[i], loads[i]);
  }
  fracture.owned_segments.clear();
  fracture.owned_cells.clear();
  normals.clear();
  for (unsigned int i = 0; i < fracture.cells.size(); ++i)
  {
    Segment<dim> &segment = fracture.segments[i];
    fracture.at_front.push_back(
      parameters.tracked ? segment.at_tip : is_at_front(lattice.zone, fracture.cells[i], segment));
    if (scene.has_pore_pressure && lattice.zone.owns(fracture.cells[i].place))
    {
      segment.region = lattice.regions[lattice.zone.active_cell_index(fracture.cells[i].place)];
      segment.share_of_pores = lattice.rock_at(fracture.cells[i].place).biot_coefficient;
    }
    // Unknowns are measured from the in-situ pressure.
    segment.pore_pressure.constant = scene.in_situ_pore_pressure(segment.centre);
    if (lattice.zone.owns(fracture.cells[i].place))
    {
      fracture.owned_cells.push_back(i);
      if (scene.has_pore_pressure && !parameters.as_published && !parameters.in_bonds)
        normals[lattice.zone.active_cell_index(fracture.cells[i].place)] = fracture.cells[i].normal;
      fracture.owned_segments.push_back(segment);
      if (parameters.tensor_fluid)
      {
        permeability_tensor::leave_to_pores(fracture.owned_segments.back());
        // As published, its load is the bonds' affair, and its opening makes no room.
        if (parameters.as_published)
        {
          fracture.owned_segments.back().share_of_pores = 1.;
          published.emplace_back(segment, LinearFunctional());
        }
      }
    }
  }
  if (parameters.in_bonds)
    pressure_in_bonds.follow();
  segments_lag = false;
  if (!parameters.explicit_steps) // there is no matrix
    find_changed_rows(damage_before, corrected_before, cells_before);
}


template <int dim>
dealii::ArrayView<const Segment<dim>> Peridynamics<dim>::segments() const
{
  return dealii::make_array_view(fracture.owned_segments);
}


template <int dim>
void Peridynamics<dim>::begin_step(const StepContext &context)
{
  passes = 0;
  has_let_fluid_back = false;
  // An attempt that this model has not rejected has not converged.
  softening_bonds.begin_attempt(context.attempt, has_rejected);
  has_rejected = false;
  dissipated = committed_energy;
  n_messages_before = messages.size();
  told_of_rim_before = told_of_rim;
  told_of_pressure_before = told_of_pressure;
  told_of_new_paths_before = new_paths.told;
  n_segments_before = fracture.cells.size();
  extent_before = extent();
  n_tips_before = 0;
  for (const bool at_end : fracture.at_front)
    n_tips_before += at_end;
}


template <int dim>
double Peridynamics<dim>::softened_in_step() const
{
  double energy = 0.;
  for (const SofteningBond &bond : softening_bonds)
    energy +=
      relative_energy(bond.view.first, bond.view.second) *
      lattice.energy_at_unit_stretch(bond.view) *
      (lattice.softening.dissipated(bond.trial) - lattice.softening.dissipated(bond.committed));
  return energy;
}


template <int dim>
bool Peridynamics<dim>::commit(const StepContext &context, const State &state)
{
  if (passes > 0 && !parameters.explicit_steps) // no such step is taken back, see save()
    keep_bonds();
  if (parameters.tracked)
  {
    paths.keep_fluid();
    tell_of_boundary();
    committed_paths = paths;
    tips.commit(paths);
  }
  dissipated += softened_in_step();
  softening_bonds.commit();
  if (context.attempt == 0 || fracture.cells.size() > n_segments_before)
    stops_at_rim = 0;
  if (parameters.in_bonds)
  {
    dissipated += pressure_in_bonds.work_of_friction(state);
    if (!told_of_contact && pressure_in_bonds.touches(state))
    {
      messages.push_back(faces_touch(parameters.friction));
      told_of_contact = true;
    }
    committed_cells.clear();
    for (const FractureCell<dim> &cell : fracture.cells)
      if (!parameters.tracked)
        committed_cells.emplace_back(
          cell.place, std::vector<double>(cell.normal.begin_raw(), cell.normal.end_raw()));
  }
  committed_energy = dissipated;
  const double settled = (parameters.horizon + 1.5) * lattice.zone.spacing();
  std::vector<Point<dim>> front;
  for (unsigned int i = 0; i < fracture.cells.size(); ++i)
    if (fracture.at_front[i])
      front.push_back(fracture.segments[i].centre);
  for (unsigned int i = 0; i < fracture.cells.size() && !parameters.tracked; ++i)
    if (committed_normals.count(fracture.cells[i].place) == 0 &&
        std::none_of(front.begin(), front.end(),
                     [&](const Point<dim> &end)
                     { return end.distance(fracture.segments[i].centre) < settled; }))
      committed_normals.emplace(fracture.cells[i].place,
                                std::vector<double>(fracture.cells[i].normal.begin_raw(),
                                                    fracture.cells[i].normal.end_raw()));
  correct_faces();
  // Beside another path, which of them a bond crosses hangs on ways. The next step must not find
  // those of an earlier pass, which a restart does not know.
  if (segments_lag)
    refresh_segments();
  return !parameters.explicit_steps && enlarge_zone(); // it is all of the rock already
}


template <int dim>
void Peridynamics<dim>::rollback()
{
  messages.resize(n_messages_before);
  told_of_rim = told_of_rim_before;
  told_of_pressure = told_of_pressure_before;
  new_paths.told = told_of_new_paths_before;
  dissipated = committed_energy;
  paths = committed_paths;
  find_crossing_bonds();
  segments_lag = false; // they are those of the last step, or are made anew
  if (passes == 0)
    return;
  passes = 0;
  lattice.bonds.reinit(lattice.zone, lattice.stencil);
  lattice.bonds.set_broken(committed_bonds);
  restore_softening();
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
    if (cell->is_locally_owned())
    {
      const double outside = shape.distance(cell->center(), h) - 0.5 * cell->diameter();
      const double wanted =
        h + parameters.cell_growth *
              std::max(0., outside -
                             ((parameters.state_based ? 2. : 1.) * parameters.horizon + 2.) * h);
      float &size = sizes[cell->active_cell_index()];
      size = std::min(size, static_cast<float>(wanted));
    }
}


template <int dim>
void Peridynamics<dim>::save(boost::archive::binary_oarchive &archive) const
{
  std::array<double, dim> origin;
  for (unsigned int d = 0; d < dim; ++d)
    origin[d] = lattice.zone.origin()[d];
  std::vector<std::array<Point<dim>, 2>> grown;
  for (auto box = shape.boxes.begin() + parameters.boxes.size(); box != shape.boxes.end(); ++box)
    grown.push_back({{box->get_boundary_points().first, box->get_boundary_points().second}});
  const auto broken =
               parameters.explicit_steps ? of_all_ranks(lattice.bonds.places()) : committed_bonds,
             open = parameters.explicit_steps ? of_all_ranks(cracked.places()) : committed_cracked;
  const auto softened = of_all_ranks(softening_bonds.committed.bonds);
  std::map<Place<dim>, double> correction;
  for (const auto &[place, corrected] : of_all_ranks(std::vector<std::pair<Place<dim>, double>>(
         committed_correction.begin(), committed_correction.end())))
    correction[place] = corrected;
  archive << origin << grown << broken << open << softened << committed_normals << correction
          << committed_energy << softening_bonds.committed.relaxation << told_of_pressure
          << committed_paths << tips.committed_energy << new_paths.told << committed_cells
          << told_of_contact << told_of_rim;
}


template <int dim>
void Peridynamics<dim>::load(boost::archive::binary_iarchive &archive)
{
  std::array<double, dim> origin;
  std::vector<std::array<Point<dim>, 2>> grown;
  archive >> origin >> grown >> committed_bonds >> committed_cracked >>
    softening_bonds.committed.bonds >> committed_normals >> committed_correction >>
    committed_energy >> softening_bonds.committed.relaxation >> told_of_pressure >>
    committed_paths >> tips.committed_energy >> new_paths.told >> committed_cells >>
    told_of_contact >> told_of_rim;
  paths = committed_paths;
  Point<dim> corner;
  for (unsigned int d = 0; d < dim; ++d)
    corner[d] = origin[d];
  shape.boxes = parameters.boxes;
  for (const auto &[lower, upper] : grown)
    shape.boxes.emplace_back(std::make_pair(lower, upper));
  started = true;
  dissipated = committed_energy;
  const bool known_mesh = !lattice.zone.sites().empty();
  if (!known_mesh)
    lattice.zone.set_origin(corner);
  else
  {
    lattice.bonds.reinit(lattice.zone, lattice.stencil);
    lattice.bonds.set_broken(committed_bonds);
    restore_softening();
    row_versions.restart(lattice.zone.sites().size());
    refresh_segments();
  }
}

template class Peridynamics<2>;
template class Peridynamics<3>;
} // namespace stockwork::peridynamics
