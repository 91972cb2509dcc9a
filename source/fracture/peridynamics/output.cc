#include "fracture/peridynamics/peridynamics.h"

#include <cmath>
#include <set>
#include <sstream>

namespace stockwork::peridynamics
{
using dealii::Point;
using dealii::Tensor;


template <int dim>
FractureSummary Peridynamics<dim>::summary(const State &state, const Collectives &collectives) const
{
  FractureSummary result;
  std::vector<double> apertures(fracture.cells.size(), 0.);
  for (unsigned int k = 0; k < fracture.owned_cells.size(); ++k)
    apertures[fracture.owned_cells[k]] = fracture.aperture(k, state);
  collectives.sum(apertures);
  std::vector<double> sums(3, 0.); // length, broken length, tips
  for (const unsigned int i : fracture.owned_cells)
  {
    const double broken = broken_share<dim>(lattice.zone, lattice.stencil, fracture.cells[i],
                                            [this](const unsigned int site, const unsigned int bond)
                                            { return softening_bonds.damage(site, bond); });
    if (broken < 0.5 && is_beside(fracture.cells, apertures, parameters.horizon + 1., i))
      continue; // it has softened without opening
    sums[0] += fracture.segments[i].area;
    sums[1] += broken * fracture.segments[i].area;
    sums[2] += fracture.segments[i].at_tip;
  }
  collectives.sum(sums);
  result.length = sums[0];
  result.broken_length = sums[1];
  result.n_tips = static_cast<unsigned int>(sums[2]);
  if (parameters.tracked)
  {
    // The tip of an elastic crack that is the same from afar: by the M-integral about the front it
    // is int (1 - phi/G_c) ds behind it, phi the work of separation, whatever the law of the
    // tractions. The model's tips are by the energy dissipated, which is less by what would come
    // back.
    double elastic = paths.length();
    for (const auto &[first, last] : tips.energy_to_come(paths))
      elastic += (first + last) / lattice.energy_across;
    result.length = paths.length() + tips.half_process_zones(paths);
    result.equivalent_length = elastic - 0.5 * length_that_holds();
    result.broken_length = std::max(0., tips.broken_length(paths) - length_that_holds());
  }
  result.dissipated_energy = dissipated;
  result.stored_energy =
    explicit_bonds ? collectives.sum(explicit_bonds->stored() + explicit_bonds->stored_by_fluid())
                   : strain_energy(lattice.zone.displacement(state.current.bulk, collectives));
  result.cost = cost();
  return result;
}


template <int dim>
double Peridynamics<dim>::length_that_holds() const
{
  double energy = 0.;
  if constexpr (dim == 2)
    for (const BondAcross<dim> &bond : crossing_bonds)
      if (const auto &[site, b] = bond.view;
          !lattice.bonds.is_broken(site, b) && !paths.end_at(bond.crossing) &&
          scene.cracks[bond.crossing.path].kind != InitialCrack<dim>::Kind::open &&
          lattice.bonds.views_of(site, b).front() == bond.view)
      {
        const SofteningBond *softened = softening_bonds.find(site, b);
        energy += lattice.energy_at_unit_stretch(bond.view) *
                  (lattice.softening.first * lattice.softening.last -
                   (softened != nullptr ? lattice.softening.separation(softened->trial) : 0.));
      }
  return energy / lattice.energy_across;
}


template <int dim>
std::string Peridynamics<dim>::cost() const
{
  // Displacements that the row of a node has entries for, itself included.
  std::set<Place<dim>> reach{Place<dim>()};
  for (const StencilBond<dim> &bond : lattice.stencil)
    reach.insert(bond.offset);
  if (parameters.state_based)
    for (const Place<dim> &first : std::set<Place<dim>>(reach))
      for (const StencilBond<dim> &bond : lattice.stencil)
      {
        Place<dim> place = first;
        for (unsigned int d = 0; d < dim; ++d)
          place[d] += bond.offset[d];
        reach.insert(place);
      }
  const double of_elements = std::pow(3., dim), longer = reach.size() / of_elements;
  const double share = static_cast<double>(lattice.zone.n_peridynamic_sites()) / n_nodes;
  std::ostringstream text;
  text.precision(3);
  text << "Peridynamic zone: " << lattice.zone.n_peridynamic_sites() << " nodes, " << 100. * share
       << " % of all; their momentum rows have " << longer << " times the entries of elements', "
       << "which makes the matrix of the rock " << 1. + share * (longer - 1.) << " times as large";
  return text.str();
}


template <int dim>
void Peridynamics<dim>::write_fields(const State &state, FieldSink<dim> &sink) const
{
  std::vector<double> mean_damage(lattice.zone.n_active_cells(), 0.);
  for (const Place<dim> &cell : lattice.zone.cells())
    if (lattice.zone.owns(cell))
    {
      double sum = 0.;
      for (unsigned int v = 0; v < 1u << dim; ++v)
      {
        Place<dim> place = cell;
        for (unsigned int d = 0; d < dim; ++d)
          place[d] += v >> d & 1;
        sum += lattice.damage[lattice.zone.find(place)];
      }
      mean_damage[lattice.zone.active_cell_index(cell)] = sum / (1 << dim);
    }
  sink.add_cell_field("damage", mean_damage);

  if constexpr (dim == 2)
    for (unsigned int k = 0; k < fracture.owned_segments.size(); ++k)
    {
      const Segment<dim> &segment = fracture.owned_segments[k];
      std::vector<std::pair<std::string, double>> values{{"aperture", fracture.aperture(k, state)},
                                                         {"damage", 1.}};
      if (parameters.friction > 0.)
        values.emplace_back("slip", pressure_in_bonds.slip(fracture.owned_cells[k], state));
      if (state.segment_pressure)
        values.emplace_back("fluid_pressure", state.segment_pressure(segment.key));
      Tensor<1, dim> along;
      along[0] = segment.normal[1];
      along[1] = -segment.normal[0];
      sink.add_fracture_piece(
        {segment.centre - 0.5 * segment.area * along, segment.centre + 0.5 * segment.area * along},
        values);
    }
  if (parameters.written != Parameters<dim>::Bonds::none)
    write_bonds(sink);
}


template <int dim>
void Peridynamics<dim>::write_bonds(FieldSink<dim> &sink) const
{
  for (const unsigned int i : lattice.zone.peridynamic_sites())
    for (unsigned int b = 0; b < lattice.stencil.size() && lattice.zone.sites()[i].owner == rank;
         ++b)
    {
      const bool broken = lattice.bonds.is_broken(i, b),
                 mirrored = lattice.zone.far_end(i, b).mirrored != 0;
      if (mirrored || (lattice.bonds.can_break(i, b) && b >= lattice.stencil.size() / 2) ||
          (parameters.written == Parameters<dim>::Bonds::broken && !broken))
        continue; // seen from the other end
      const Point<dim> from = lattice.zone.position(lattice.zone.sites()[i].place);
      const double longer = explicit_bonds ? explicit_bonds->elongation(i, b)
                            : displacement.size() == dim * lattice.zone.sites().size()
                              ? lattice.elongation(i, b, displacement)
                              : 0.;
      const double stretch =
        longer / lattice.coefficients[b].length / lattice.critical_stretch / relative_stretch(i, b);
      sink.add_bond(from, from + lattice.coefficients[b].length * lattice.coefficients[b].direction,
                    {{"broken", broken ? 1. : 0.}, {"stretch", stretch}});
    }
}

#define INSTANTIATE(dim)                                                                         \
  template double Peridynamics<dim>::length_that_holds() const;                                  \
  template std::string Peridynamics<dim>::cost() const;                                          \
  template FractureSummary Peridynamics<dim>::summary(const State &, const Collectives &) const; \
  template void Peridynamics<dim>::write_bonds(FieldSink<dim> &) const;                          \
  template void Peridynamics<dim>::write_fields(const State &, FieldSink<dim> &) const;
INSTANTIATE(2)
INSTANTIATE(3)
#undef INSTANTIATE
} // namespace stockwork::peridynamics
