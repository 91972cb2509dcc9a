#include "fracture/peridynamics/peridynamics.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <tuple>

namespace stockwork::peridynamics
{
using dealii::Point;
using dealii::SymmetricTensor;
using dealii::Tensor;

namespace
{
/// Stretches that differ by less are equal: symmetric bonds break together, on any number of ranks.
constexpr double resolution = 1e-6;
/// Solves within a step after which it is too long.
constexpr unsigned int most_passes = 60;
} // namespace


template <int dim>
double Peridynamics<dim>::elongation(const unsigned int site,
                                     const unsigned int bond,
                                     const std::vector<double> &u) const
{
  const FarEnd end = zone.far_end(site, bond);
  double sum = 0.;
  for (unsigned int d = 0; d < dim; ++d)
    sum += coefficients[bond].direction[d] *
           ((end.mirrored >> d & 1 ? -1. : 1.) * u[end.site * dim + d] - u[site * dim + d]);
  return sum;
}


template <int dim>
double Peridynamics<dim>::in_situ_stretch(const Point<dim> &middle, const unsigned int bond) const
{
  if (in_situ_is_zero)
    return 0.;
  const RockProperties &rock = scene.rock.main();
  const double lambda = rock.lame_lambda(), mu = rock.shear_modulus();
  SymmetricTensor<2, dim> effective = scene.in_situ_stress(middle);
  if (scene.has_pore_pressure)
    effective += rock.biot_coefficient * scene.in_situ_pore_pressure(middle) *
                 dealii::unit_symmetric_tensor<dim>();
  const SymmetricTensor<2, dim> strain =
    (effective -
     lambda / (dim * lambda + 2. * mu) * trace(effective) * dealii::unit_symmetric_tensor<dim>()) /
    (2. * mu);
  const Tensor<1, dim> &e = coefficients[bond].direction;
  return e * (strain * e);
}


template <int dim>
std::vector<double> Peridynamics<dim>::pressure_stretch(const State &state,
                                                        const Collectives &collectives) const
{
  std::vector<double> result(cells.size(), 0.);
  if (!parameters.effective_stretch || !state.segment_pressure)
    return result;
  const RockProperties &rock = scene.rock.main();
  const double compliance = 1. / (dim * rock.lame_lambda() + 2. * rock.shear_modulus());
  if (scene.has_pore_pressure)
  {
    for (unsigned int i = 0; i < owned_cells.size(); ++i)
    {
      const LinearFunctional &pore = owned_segments[i].pore_pressure;
      double pressure = pore.constant;
      for (unsigned int k = 0; k < pore.bulk.size(); ++k)
        pressure += pore.bulk_coefficients[k] * state.current.bulk(pore.bulk[k]);
      result[owned_cells[i]] = -rock.biot_coefficient * compliance * pressure;
    }
    collectives.sum(result);
  }
  for (unsigned int i = 0; i < cells.size(); ++i)
    result[i] += compliance * state.segment_pressure(all_segments[i].key);
  return result;
}


template <int dim>
double Peridynamics<dim>::relief_at(const Point<dim> &place,
                                    const std::vector<double> &relief) const
{
  double nearest = parameters.horizon + 1., result = 0.;
  for (unsigned int i = 0; i < cells.size(); ++i)
  {
    double square = 0.;
    for (unsigned int d = 0; d < dim; ++d)
      square += std::pow(place[d] - cells[i].place[d] - 0.5, 2);
    // Of several equally near, the one that relieves most, whatever their order.
    const double distance = std::sqrt(square);
    if (distance < nearest - resolution || (distance < nearest + resolution && relief[i] > result))
    {
      nearest = std::min(nearest, distance);
      result = relief[i];
    }
  }
  return result;
}


template <int dim>
std::vector<typename Peridynamics<dim>::Candidate> Peridynamics<dim>::overstretched(
  const std::vector<double> &u, const std::vector<double> &relief, bool &at_rim) const
{
  double most_relief = 0.;
  for (const double r : relief)
    most_relief = std::max(most_relief, r);
  std::vector<Candidate> candidates;
  const unsigned int half = stencil.size() / 2;
  for (const unsigned int i : zone.peridynamic_sites())
    for (unsigned int b = 0; b < stencil.size(); ++b)
    {
      if (bonds.is_broken(i, b))
        continue;
      const bool breakable = bonds.can_break(i, b);
      if (b >= half && breakable && zone.far_end(i, b).mirrored == 0)
        continue; // seen from the other end
      double stretch = elongation(i, b, u) / coefficients[b].length;
      if (!in_situ_is_zero)
        stretch += in_situ_stretch(zone.position(zone.sites()[i].place) +
                                     0.5 * coefficients[b].length * coefficients[b].direction,
                                   b);
      // What breaks a bond is its energy; bonds beside a crack are stiffer.
      const double share = std::sqrt(stiffness(i, b) / coefficients[b].stiffness);
      const auto ratio_with = [&](const double more)
      { return std::round(share * (stretch + more) / critical_stretch / resolution) * resolution; };
      if (ratio_with(most_relief) < 1.)
        continue;
      Point<dim> middle;
      for (unsigned int d = 0; d < dim; ++d)
        middle[d] = zone.sites()[i].place[d] + 0.5 * stencil[b].offset[d];
      const double ratio = ratio_with(relief_at(middle, relief));
      if (ratio < 1.)
        continue;
      if (breakable)
        candidates.push_back({ratio, i, b});
      else
        at_rim = true;
    }
  std::sort(candidates.begin(), candidates.end(),
            [](const Candidate &a, const Candidate &b)
            {
              return std::make_tuple(-a.stretch, a.site, a.bond) <
                     std::make_tuple(-b.stretch, b.site, b.bond);
            });
  return candidates;
}


template <int dim>
Verdict Peridynamics<dim>::advance(const StepContext &context,
                                   const State &state,
                                   const Collectives &collectives)
{
  Verdict verdict;
  if (!parameters.growth)
    return verdict;

  const std::vector<double> u = zone.displacement(state.current.bulk, collectives);
  bool at_rim = false;
  const std::vector<Candidate> candidates =
    overstretched(u, pressure_stretch(state, collectives), at_rim);
  if (at_rim && !told_of_rim)
  {
    messages.push_back("A crack has reached the rim of the peridynamic zone and cannot grow "
                       "beyond. Enlarge 'Fracture/peridynamics/Zone'.");
    told_of_rim = true;
  }

  const unsigned int n_tips = std::max<std::size_t>(n_tips_before, 1);
  const unsigned int n_new = cells.size() - n_segments_before;
  if (candidates.empty())
  {
    verdict.dt_limit = context.dt * (n_new > n_tips ? 0.6 : n_new > 0 ? 0.8 : 1.25);
    return verdict;
  }
  if (n_new > parameters.most_advances * n_tips || passes >= most_passes)
  {
    verdict.kind = Verdict::Kind::reject;
    std::ostringstream reason;
    reason << "a tip wants to advance by more than " << parameters.most_advances
           << " cells in a step";
    verdict.reason = passes >= most_passes ? "bonds go on breaking" : reason.str();
    return verdict;
  }

  // The most stretched first, those as much stretched with them.
  for (unsigned int k = 0; k < candidates.size(); ++k)
  {
    if (k >= parameters.bonds_per_pass &&
        candidates[k].stretch <
          candidates[parameters.bonds_per_pass - 1].stretch - 0.5 * resolution)
      break;
    const auto [stretch, site, bond] = candidates[k];
    if (bonds.is_broken(site, bond))
      continue; // the image of another
    bonds.for_each_view(site, bond,
                        [&](const unsigned int s, const unsigned int b)
                        {
                          if (bonds.is_broken(s, b))
                            return;
                          const double length = stretch * critical_stretch * coefficients[b].length;
                          dissipated += 0.25 * zone.sites()[s].share * coefficients[b].stiffness *
                                        length * length;
                        });
    bonds.set_broken(site, bond);
  }

  // A new segment begins at the pressure of those beside it.
  std::map<std::uint64_t, double> known;
  for (const auto &segment : all_segments)
    known[segment.key] = state.segment_pressure ? state.segment_pressure(segment.key) : 0.;
  refresh_segments();
  for (const auto &segment : all_segments)
    if (known.count(segment.key) == 0)
      for (const auto &neighbour : segment.neighbours)
        if (const auto beside = known.find(neighbour.key); beside != known.end())
          initial_pressure[segment.key] = beside->second;
  refresh_segments();
  ++passes;
  ++version;
  verdict.kind = Verdict::Kind::topology_changed;
  return verdict;
}

#define INSTANTIATE(dim)                                                                        \
  template double Peridynamics<dim>::elongation(unsigned int, unsigned int,                     \
                                                const std::vector<double> &) const;             \
  template double Peridynamics<dim>::in_situ_stretch(const Point<dim> &, unsigned int) const;   \
  template std::vector<double> Peridynamics<dim>::pressure_stretch(const State &,               \
                                                                   const Collectives &) const;  \
  template double Peridynamics<dim>::relief_at(const Point<dim> &, const std::vector<double> &) \
    const;                                                                                      \
  template std::vector<Peridynamics<dim>::Candidate> Peridynamics<dim>::overstretched(          \
    const std::vector<double> &, const std::vector<double> &, bool &) const;                    \
  template Verdict Peridynamics<dim>::advance(const StepContext &, const State &,               \
                                              const Collectives &);
INSTANTIATE(2)
INSTANTIATE(3)
#undef INSTANTIATE
} // namespace stockwork::peridynamics
