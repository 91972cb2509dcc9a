// Where the perforations of wells open into: segments of fractures, or cells of the rock.
#include <algorithm>
#include <limits>
#include <sstream>

#include "flow/wells.h"
#include "stockwork/base/error.h"
#include "stockwork/base/quantity.h"

namespace stockwork
{
template <int dim>
void Wells<dim>::set_mesh(const MeshView<dim> &mesh,
                          const Scene<dim> &scene,
                          const Collectives &collectives)
{
  for (Well &well : wells)
  {
    if (!well.in_rock)
      continue;
    for (Perforation &perforation : well.perforations)
      try
      {
        perforation.source->setup(mesh, scene, collectives);
      }
      catch (const InputError &error)
      {
        throw perforation_error(well, perforation, error.what());
      }
    const PointSource<dim> &first = *well.perforations[0].source;
    well.initial_pressure = first.in_situ_pressure();
    well.least_stress = std::numeric_limits<double>::infinity();
    for (const Perforation &perforation : well.perforations)
      well.least_stress = std::min(
        well.least_stress, -dealii::eigenvalues(scene.in_situ_stress(perforation.point))[0]);
    if (first.resistance() > 0.)
      well.conductance = 1. / first.resistance();
    if (well.has_own_minimum && well.minimum_pressure > well.initial_pressure)
      throw EntryError("Wells/Well " + std::to_string(well.number) + "/Minimum pressure",
                       to_string(well.minimum_pressure, dimension::pressure),
                       "a pressure of at most " +
                         to_string(well.initial_pressure, dimension::pressure) +
                         ", that in situ: above it the rock would be injected into");
    if (well.pressure_control && well.initial_pressure > 0. && well.value.minimum() < 0.)
      well.value.refuse("pressures from 0 (vacuum) on, for that in situ is counted from there");
    // Where pressures are net ones, zero is nothing special.
    if (!well.has_own_minimum && well.minimum_pressure == 0. && well.initial_pressure == 0.)
      well.minimum_pressure = -std::numeric_limits<double>::infinity();
  }
  check_distances();
}


template <int dim>
void Wells<dim>::check_distances() const
{
  // Outside of its own disc or ball a source's pressure is that of a point, and its mean over
  // another that does not hold the point is that in the middle.
  for (const Well &well : wells)
    for (const Well &other_well : wells)
      if (well.in_rock && other_well.in_rock)
        for (const Perforation &one : well.perforations)
          for (const Perforation &other : other_well.perforations)
            if (&one != &other && one.source->reaches(other.point, 0.) &&
                std::max(one.source->borehole_radius(), other.source->borehole_radius()) > 0.)
              throw perforation_error(
                well, one,
                "is nearer than " + to_string(one.source->source_radius(), dimension::length) +
                  " to another that opens into the rock, which lies within its source, so that the "
                  "pressure in the boreholes is not known: smaller cells there, or a smaller "
                  "'Source radius'");
}


template <int dim>
bool Wells<dim>::sources_reach(const dealii::Point<dim> &place, const double size) const
{
  for (const Well &well : wells)
    if (well.in_rock)
      for (const Perforation &perforation : well.perforations)
        if (perforation.source->reaches(place, size))
          return true;
  return false;
}


template <int dim>
void Wells<dim>::locate_in_rock(Well &well, const std::vector<NetworkSegment<dim>> &segments) const
{
  if (!(well.perforations[0].source->borehole_radius() > 0.))
    return; // a source in pores, whatever there is beside them
  for (const Perforation &perforation : well.perforations)
    for (const auto &segment : segments)
      if (perforation.source->reaches(segment.centre, segment.size()))
      {
        well.is_reached = true;
        if (!has_started)
          throw perforation_error(
            well, perforation,
            "is nearer than " + to_string(perforation.source->source_radius(), dimension::length) +
              " to a fracture, where the pressure in the borehole is not known: let it open into "
              "the fracture, move it, take smaller cells there, or leave 'Borehole radius' empty");
      }
}


template <int dim>
void Wells<dim>::locate(const std::vector<NetworkSegment<dim>> &segments,
                        const bool pressure_is_given)
{
  for (Well &well : wells)
    if (well.in_rock)
      locate_in_rock(well, segments);
  const bool is_first = !has_started;
  has_started = true;
  for (Well &well : wells)
  {
    if (well.in_rock)
      continue;
    for (Perforation &perforation : well.perforations)
    {
      double nearest = std::numeric_limits<double>::infinity();
      for (const auto &segment : segments)
        nearest = std::min(nearest, segment.centre.distance(perforation.point));

      perforation.segments.clear();
      for (unsigned int i = 0; i < segments.size(); ++i)
        if (segments[i].centre.distance(perforation.point) <= nearest + 1e-6 * segments[i].size())
          perforation.segments.push_back(i);

      const auto complain = [&](const std::string &what)
      { throw perforation_error(well, perforation, what); };
      if (segments.empty())
        complain("is on none, for there are none at the start. Give an initial crack");
      if (nearest > segments[perforation.segments.front()].size())
        complain("is on none; the nearest segment of one is at distance " +
                 std::to_string(nearest) + " m");
      if (pressure_is_given)
        complain("is on one whose pressure is given, so the well would have no effect");
    }
    well.initial_pressure = segments[well.perforations[0].segments[0]].initial_pressure;
  }
  if (is_first)
    check_openings();
}


template <int dim>
void Wells<dim>::check_openings() const
{
  // A segment has one pressure: nothing says how two rates divide that both follow from it.
  for (const Well &well : wells)
    for (const Well &other_well : wells)
      if (!well.in_rock && !other_well.in_rock &&
          (&well == &other_well || (well.pressure_control && other_well.pressure_control)))
        for (const Perforation &one : well.perforations)
          for (const Perforation &other : other_well.perforations)
            if (&one != &other && one.segments == other.segments)
            {
              std::ostringstream message;
              message << "opens into the same segment of the fracture as (" << other.point
                      << "), so that the share of each is not known: leave one out, or take "
                         "smaller cells";
              throw perforation_error(well, one, message.str());
            }
}


#define INSTANTIATE(dim)                                                             \
  template void Wells<dim>::set_mesh(const MeshView<dim> &, const Scene<dim> &,      \
                                     const Collectives &);                           \
  template bool Wells<dim>::sources_reach(const dealii::Point<dim> &, double) const; \
  template void Wells<dim>::locate(const std::vector<NetworkSegment<dim>> &, bool);
INSTANTIATE(2)
INSTANTIATE(3)
#undef INSTANTIATE
} // namespace stockwork
