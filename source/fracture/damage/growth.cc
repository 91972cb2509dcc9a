#include "fracture/damage/damage.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace stockwork::damage
{
using dealii::Point;
using dealii::SymmetricTensor;
using dealii::Tensor;

template <int dim>
std::vector<typename Damage<dim>::Candidate>
Damage<dim>::candidates(const Collectives &collectives) const
{
  std::vector<Candidate> mine;
  for (const auto &owned : band.owned())
    for (const unsigned int f : owned.cell->face_indices())
    {
      if (!band.cells[owned.number].crosses(f) || owned.cell->at_boundary(f))
        continue;
      const auto neighbour = owned.cell->neighbor(f);
      const bool fits = neighbour->is_active() && neighbour->level() == owned.cell->level();
      if (fits && band.number(neighbour))
        continue;
      mine.push_back({describe<dim>(neighbour), {owned.number}, {f}, fits});
    }
  std::vector<Candidate> all = collectives.gather(mine);
  std::sort(all.begin(), all.end(),
            [](const Candidate &a, const Candidate &b) {
              return a.cell.id < b.cell.id || (a.cell.id == b.cell.id && a.behind[0] < b.behind[0]);
            });
  std::vector<Candidate> merged;
  for (const Candidate &one : all)
    if (!merged.empty() && merged.back().cell.id == one.cell.id)
    {
      merged.back().behind.push_back(one.behind[0]);
      merged.back().faces_behind.push_back(one.faces_behind[0]);
    }
    else
      merged.push_back(one);
  return merged;
}


template <int dim>
void Damage<dim>::crack(Candidate &candidate,
                        const Tensor<1, dim> &across,
                        const std::vector<CrackCell<dim>> &beside) const
{
  CrackCell<dim> &cell = candidate.cell;
  Tensor<1, dim> of_others;
  Point<dim> entry;
  for (unsigned int k = 0; k < candidate.behind.size(); ++k)
  {
    const CrackCell<dim> &other = band.cells[candidate.behind[k]];
    of_others +=
      (other.normal * band.cells[candidate.behind[0]].normal < 0. ? -1. : 1.) * other.normal;
    entry += other.crossing(candidate.faces_behind[k]) / double(candidate.behind.size());
  }
  cell.normal = across * of_others < 0. ? -across : across;
  cell.on_plane = entry;
  cell.part_by_plane();
  // A vertex is on the side on which the cracked cells have it: those beside, and before them those
  // behind.
  std::vector<const CrackCell<dim> *> others;
  for (const CrackCell<dim> &other : beside)
    others.push_back(&other);
  for (const unsigned int number : candidate.behind)
    others.push_back(&band.cells[number]);
  for (const CrackCell<dim> *const other : others)
  {
    const bool turned = other->normal * cell.normal < 0.;
    for (unsigned int v = 0; v < CrackCell<dim>::n_vertices; ++v)
      for (unsigned int w = 0; w < CrackCell<dim>::n_vertices; ++w)
        if (cell.vertices[v].distance(other->vertices[w]) < 1e-6 * other->size())
        {
          const bool is_plus = other->is_on_plus_side(w) != turned;
          cell.plus = is_plus ? cell.plus | (1u << v) : cell.plus & ~(1u << v);
        }
  }
}


template <int dim>
double Damage<dim>::closing_stress(const CrackCell<dim> &crack) const
{
  return -(crack.normal * (scene.in_situ_stress(crack.centre()) * crack.normal));
}


template <int dim>
double Damage<dim>::reached_share(const unsigned int number, const State &state) const
{
  constexpr double full = std::numeric_limits<double>::infinity();
  const CrackCell<dim> &crack = band.cells[number];
  if (!crack.bare || !state.segment_pressure || !std::isnan(scene.crack_pressure) ||
      !band.is_front(number) || state.segment_pressure(crack.key()) >= closing_stress(crack))
    return full;
  const auto held = [&](const unsigned int i)
  {
    const CrackCell<dim> &cell = band.cells[i];
    return std::max(0., cell.area() * (band.jump(i, state.current.extra) * cell.normal));
  };
  const double own = held(number);
  double next = 0., next_area = crack.area();
  for (unsigned int f = 0; f < Band<dim>::n_faces; ++f)
    if (const unsigned int j = band.neighbour(number, f); j != Band<dim>::none && held(j) > next)
    {
      next = held(j);
      next_area = band.cells[j].area();
    }
  if (own == 0. || next == 0.)
    return 0.;
  // With w ~ x^(2/3) at the distance x from the front, V ~ x^(5/3) is beyond any place.
  const double ratio = std::pow(own / (own + next), 0.6);
  return next_area / crack.area() * ratio / (1. - ratio);
}


template <int dim>
typename Damage<dim>::Behind Damage<dim>::look_behind(const Candidate &candidate,
                                                      const State &state) const
{
  Behind result;
  result.pressure = state.segment_pressure ? -std::numeric_limits<double>::infinity() : 0.;
  for (const unsigned int number : candidate.behind)
  {
    const CrackCell<dim> &crack = band.cells[number];
    const auto jumps = band.jumps(number, state.current.extra);
    for (unsigned int q = 0; q < jumps.size(); ++q)
    {
      const double greatest = seam(crack, q, jumps[q]).greatest;
      result.opens |= greatest > law(crack).start;
      result.broken |= greatest >= law(crack).critical;
    }
    result.reached = std::max(result.reached, reached_share(number, state));
    if (!state.segment_pressure)
      continue;
    const double pressure = state.segment_pressure(crack.key());
    result.pressure = std::max(result.pressure, pressure);
    result.net = std::max(result.net, std::abs(pressure - closing_stress(crack)));
  }
  return result;
}


namespace
{
/// Unit vector, its components rounded to 1e-6, so that the noise of a solver neither tilts a crack
/// nor tells numbers of ranks apart.
template <int dim>
Tensor<1, dim> rounded(const Tensor<1, dim> &v)
{
  Tensor<1, dim> result;
  for (unsigned int d = 0; d < dim; ++d)
    result[d] = 1e-6 * std::round(1e6 * v[d]);
  return result / result.norm();
}
} // namespace


template <int dim>
std::vector<RockAhead<dim>> Damage<dim>::look_ahead(const std::vector<Candidate> &all,
                                                    const State &state,
                                                    const Collectives &collectives) const
{
  std::vector<HalfDisc<dim>> discs;
  for (const Candidate &candidate : all)
  {
    Tensor<1, dim> ahead;
    Point<dim> entry;
    for (unsigned int k = 0; k < candidate.behind.size(); ++k)
    {
      const CrackCell<dim> &behind = band.cells[candidate.behind[k]];
      const Tensor<1, dim> there = candidate.cell.centre() - behind.centre();
      ahead += there - (there * behind.normal) * behind.normal;
      entry += behind.crossing(candidate.faces_behind[k]) / double(candidate.behind.size());
    }
    if (ahead.norm() > 0.)
      ahead /= ahead.norm();
    const double h = candidate.cell.size();
    discs.push_back({entry, ahead, parameters.averaging_radius * h});
    discs.push_back({entry, ahead, parameters.direction_radius * h});
  }
  return average_ahead<dim>(
    discs, *mesh_view, [this](const unsigned int cell) { return band.is_cracked(cell); }, scene,
    state, collectives);
}


template <int dim>
double Damage<dim>::drive(const Candidate &candidate,
                          const Behind &behind,
                          const SymmetricTensor<2, dim> &stress)
{
  if (laws.count(candidate.cell.region) == 0)
    choose_strength(candidate.cell.region, candidate.cell.size());
  const Tensor<1, dim> &normal = band.cells[candidate.behind[0]].normal;
  const double tension =
    parameters.straight ? normal * (stress * normal) : dealii::eigenvalues(stress)[0];
  return (behind.pressure + tension) / (parameters.growth_threshold * law(candidate.cell).strength);
}


template <int dim>
bool Damage<dim>::may_crack(const Candidate &candidate, const Behind &behind)
{
  const double strength = law(candidate.cell).strength;
  // A crack that has not begun to open needs no more length, and where the fluid's pressure alone
  // exceeds the strength there would be no end to it. Where it does so by far, there is no process
  // zone worth the name. A dry crack goes on at the threshold: the seam's compliance ahead of the
  // damage counts.
  if ((!behind.opens && behind.pressure != 0.) || (!behind.broken && behind.net > 10. * strength))
  {
    arrested |= behind.net > 20. * strength;
    return false;
  }
  // Suction at the front and the tension ahead, both many times the strength, leave a difference
  // that tells nothing: there the fluid has to have arrived.
  return behind.reached >= 1.;
}


template <int dim>
unsigned int Damage<dim>::front_advances() const
{
  return n_cracked <= parameters.front_share * n_moving ? 0 : n_advances;
}


template <int dim>
bool Damage<dim>::swells_in_vain(const State &state) const
{
  if (!std::isnan(scene.crack_pressure) || band.cells.size() == n_initial)
    return false;
  double now = 0., before = 0.;
  for (unsigned int i = 0; i < band.cells.size(); ++i)
  {
    if (band.is_front(i))
      return false;
    const CrackCell<dim> &crack = band.cells[i];
    now += crack.area() * (crack.normal * band.jump(i, state.current.extra));
    before += crack.area() * (crack.normal * band.jump(i, state.committed.extra));
  }
  return now > before * (1. + 1e-9);
}


template <int dim>
Verdict
Damage<dim>::advance(const StepContext &, const State &state, const Collectives &collectives)
{
  Verdict verdict;
  verdict.advances = front_advances();
  const auto stop = [&verdict](const std::string &reason)
  {
    verdict.kind = Verdict::Kind::stop;
    verdict.reason = reason;
    return verdict;
  };
  if (press_faces(state))
  {
    verdict.kind = Verdict::Kind::topology_changed;
    return verdict;
  }
  if (!parameters.growth)
    return verdict;
  // In the step in which it gets there it is accepted.
  if (committed.size() == band.cells.size() && swells_in_vain(state))
    return stop("the fracture has come to the boundary of the domain, or to another one, on all "
                "sides, and more is pumped into it.");

  std::vector<Candidate> all = candidates(collectives);
  const auto rock = look_ahead(all, state, collectives);
  arrested = false;
  if (n_advances == 0)
    n_moving = 0;
  std::vector<CrackCell<dim>> more;
  for (unsigned int i = 0; i < all.size(); ++i)
  {
    Candidate &candidate = all[i];
    const Behind behind = look_behind(candidate, state);
    const double driven = drive(candidate, behind, rock[2 * i].stress);
    n_moving += n_advances == 0 && driven > 0.5;
    if (!may_crack(candidate, behind) || driven < 1. - 1e-6)
      continue;
    if (n_advances >= parameters.most_advances || !candidate.fits)
    {
      if (!candidate.fits && !needs_mesh)
        misfit = candidate.cell.centre();
      needs_mesh |= !candidate.fits;
      verdict.held_back = true;
      continue;
    }
    crack(candidate,
          parameters.straight ? band.cells[candidate.behind[0]].normal
                              : rounded(dealii::eigenvectors(rock[2 * i + 1].stress)[0].second),
          more);
    candidate.cell.bare = behind.broken;
    candidate.cell.reached = behind.broken ? 0. : 1.;
    if (const double size = candidate.cell.size(); size > largest_cell(candidate.cell))
    {
      std::ostringstream reason;
      reason << "the crack at (" << candidate.cell.centre() << ") has come to cells of " << size
             << " m. Larger ones than " << largest_cell(candidate.cell)
             << " m do not resolve the process zone. Make the cells alike as far as the fracture "
                "shall run.";
      return stop(reason.str());
    }
    if (candidate.cell.is_cut() && candidate.cell.area() > 0.)
      more.push_back(candidate.cell);
  }
  if (needs_mesh && waits_for_mesh)
  {
    std::ostringstream reason;
    reason << "the crack has come to cells of another size at (" << misfit
           << "), and refining the mesh has not changed that. Make the cells alike as far as the "
              "fracture shall run: 'Cell size' halves some of those that it lies between.";
    return stop(reason.str());
  }
  constexpr unsigned int enough = 10;
  if (arrested && n_advances == 0 && more.empty() && n_arrested >= enough)
    return stop("no fracture has grown for " + std::to_string(enough) +
                " steps, although the fluid's net pressure is more than 20 times the strength of "
                "the rock: its process zone is longer than the fracture. A greater 'Tensile "
                "strength', or none, which lets the model choose one for the cells, may do.");
  if (!more.empty())
  {
    ++n_advances;
    n_cracked += more.size();
    band.add(more);
    find_segments();
    verdict.kind = Verdict::Kind::topology_changed;
    verdict.advances = front_advances();
  }
  return verdict;
}


template std::vector<typename Damage<2>::Candidate>
Damage<2>::candidates(const Collectives &) const;
template std::vector<typename Damage<3>::Candidate>
Damage<3>::candidates(const Collectives &) const;
template double Damage<2>::reached_share(unsigned int, const State &) const;
template double Damage<3>::reached_share(unsigned int, const State &) const;
template Verdict Damage<2>::advance(const StepContext &, const State &, const Collectives &);
template Verdict Damage<3>::advance(const StepContext &, const State &, const Collectives &);
} // namespace stockwork::damage
