#include "fracture/cohesive_xfem/cohesive_xfem.h"

#include "discontinuity/cell_size_request.h"
#include "discontinuity/proppant.h"

#include <deal.II/dofs/dof_accessor.h>

#include <boost/serialization/array.hpp>
#include <boost/serialization/unordered_map.hpp>
#include <boost/serialization/unordered_set.hpp>
#include <boost/serialization/vector.hpp>

#include "stockwork/base/error.h"
#include "stockwork/base/quantity.h"
#include "stockwork/exchange/released_traction.h"
#include "stockwork/exchange/surroundings.h"
#include "stockwork/fracture/needs.h"
#include "stockwork/fracture/registry.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <numeric>
#include <sstream>

namespace stockwork::cohesive_xfem
{
using dealii::Point;
using dealii::SymmetricTensor;
using dealii::Tensor;

namespace
{
/// Of the faces, in stiffnesses of the rock over a cell: about three times that of the unbroken
/// seam. More, as for given cracks, makes Newton's method cycle at tips in viscous fluid.
constexpr double contact_stiffness = 20.;

CohesiveLaw
make_law(const Parameters &parameters, const RockProperties &rock, const double strength)
{
  const double shear_energy = std::isnan(rock.shear_energy_release_rate)
                                ? rock.energy_release_rate
                                : rock.shear_energy_release_rate;
  return CohesiveLaw::with_elastic_share(strength, parameters.shear_strength_ratio * strength,
                                         rock.energy_release_rate, shear_energy,
                                         parameters.mode_exponent, parameters.elastic_share);
}
} // namespace

template <int dim>
CohesiveXFEM<dim>::CohesiveXFEM(const Parameters &parameters, const Scene<dim> &scene)
  : parameters(parameters)
  , scene(scene)
  , discontinuity(scene.domain_size)
  , contact(parameters.friction, contact_stiffness, scene.rock, scene.domain_size)
{
  const RockProperties &rock = scene.rock.main();
  needs::energy_release_rate(scene.rock, "cohesive_xfem");
  contact.keep_apart(propped_gaps(scene.cracks, discontinuity));
  needs::initial_crack(scene, "cohesive_xfem");
  if (parameters.cohesive_energy < 1. &&
      std::none_of(scene.cracks.begin(), scene.cracks.end(),
                   [](const InitialCrack<dim> &crack)
                   { return crack.kind == InitialCrack<dim>::Kind::cohesive; }))
    throw EntryError("Fracture/cohesive_xfem/Cohesive energy",
                     to_string(parameters.cohesive_energy, dimension::number),
                     "1 without a crack in 'Cracks/Cohesive'");
  // Until the cell size is known, any positive strength will do.
  law = make_law(parameters, rock, std::isnan(rock.tensile_strength) ? 1. : rock.tensile_strength);
}


template <int dim>
void CohesiveXFEM<dim>::setup(const MeshView<dim> &d, const Collectives &collectives)
{
  mesh_view = std::make_unique<MeshView<dim>>(d);
  discontinuity.setup(d, collectives);
  if (!started)
    start(collectives);
  advances.assign(discontinuity.paths().size(), {{0, 0}});
  refresh_segments();
}


template <int dim>
void CohesiveXFEM<dim>::check_lengths()
{
  for (unsigned int c = 0; c < scene.cracks.size(); ++c)
  {
    const auto &corners = scene.cracks[c].points;
    const auto &pieces = discontinuity.paths()[c].pieces;
    // Its jumps would be those of the corners at its two ends, which are none.
    if (discontinuity.spans(c).size() < 2 && !pieces.front().at_boundary[0] &&
        !pieces.back().at_boundary[1])
      throw EntryError(scene.cracks[c].entry, scene.cracks[c].text,
                       "a crack through two cells or more; this one lies in one of " +
                         to_string(pieces.front().cell_size(), dimension::length));
    constexpr double far = 0.1; // cells
    for (const CrackEnd end : {CrackEnd::first, CrackEnd::last})
      if (const int other = discontinuity.paths()[c].ends_on[static_cast<int>(end)]; other >= 0)
      {
        const dealii::Point<dim> tip = discontinuity.paths()[c].tip(end),
                                 &wanted =
                                   end == CrackEnd::first ? corners.front() : corners.back();
        const double off = tip.distance(wanted);
        if (off <= far * discontinuity.paths()[c].piece_at(end).cell_size())
          continue;
        std::ostringstream text;
        text << "Crack " << c + 1 << " ends on crack " << other + 1 << " at (" << tip << "), "
             << std::setprecision(3) << off
             << " m from where the deck has it: what reaches beyond the other is cut off, and in a "
                "cell there is one place at which cracks end.";
        messages.push_back(text.str());
      }
    double given = 0., held = 0.;
    for (unsigned int k = 1; k < corners.size(); ++k)
      given += corners[k].distance(corners[k - 1]);
    for (const auto &piece : pieces)
      held += piece.length();
    if (std::abs(held - given) > 0.02 * given)
    {
      std::ostringstream text;
      text << std::setprecision(3) << "Crack " << c + 1 << " is " << held << " m long, not "
           << given
           << " m as in the deck: cracks of this model end where their line leaves a cell.";
      messages.push_back(text.str());
    }
  }
}


template <int dim>
double CohesiveXFEM<dim>::shortest_half_length() const
{
  double half = std::numeric_limits<double>::infinity();
  for (const auto &path : discontinuity.paths())
    if (const int n_tips = path.is_tip[0] + path.is_tip[1]; n_tips > 0)
      half = std::min(half, path.length() / n_tips);
  return half;
}


template <int dim>
double CohesiveXFEM<dim>::strength_of_cells(const double size)
{
  const RockProperties &rock = scene.rock.main();
  double strength = rock.tensile_strength;
  double plane_modulus = std::numeric_limits<double>::infinity(); // least along the initial cracks
  for (const auto &path : discontinuity.paths())
    for (const auto &piece : path.pieces)
      plane_modulus = std::min(plane_modulus, scene.rock(piece.region).plane_modulus());
  std::ostringstream message;
  if (std::isnan(strength))
  {
    // With fewer cells a crack advances by jumps, from cell to cell; with more, the zone in which
    // the rock still holds is long for no gain.
    constexpr double cells = 8.;
    strength = std::sqrt(plane_modulus * rock.energy_release_rate / (cells * size));
    message << "Tensile strength: " << strength << " Pa, chosen so that the cohesive length is "
            << cells << " cells of " << size << " m.";
    // A fluid that is injected gives way as soon as its crack grows.
    if (const double half = shortest_half_length();
        parameters.growth && std::isfinite(half) && scene.injection_rate == 0.)
    {
      // Seen from afar a crack is longer by a share of its cohesive length (Planas and Elices
      // 1992); where softening is linear by this one (tests/scenes/weak_by_cells).
      constexpr double of_zone = 0.42, hardly = 0.95;
      const double share = 1. / std::sqrt(1. + of_zone * cells * size / half);
      if (share < hardly)
        message << std::setprecision(3) << " So the shortest crack grows under " << share
                << " of the load that its toughness holds, and under " << hardly
                << " of it with cells of "
                << half / (of_zone * cells) * (1. / (hardly * hardly) - 1.) << " m.";
    }
    messages.push_back(message.str());
  }
  else if (const double length = plane_modulus * rock.energy_release_rate / (strength * strength);
           size > 0.25 * length * (1. + 1e-6))
  {
    message << "The cohesive length E'G_c/T^2 = " << length << " m is not resolved by cells of "
            << size << " m; pressure and width will be too large. Use cells of at most "
            << 0.25 * length << " m, or a lower tensile strength.";
    messages.push_back(message.str());
  }
  return strength;
}


template <int dim>
void CohesiveXFEM<dim>::start(const Collectives &collectives)
{
  discontinuity.cut(scene.cracks, collectives);

  messages.clear();
  largest_cell = 0.;
  for (const auto &path : discontinuity.paths())
    for (const auto &piece : path.pieces)
      largest_cell = std::max(largest_cell, piece.cell_size());

  check_lengths();
  law = make_law(parameters, scene.rock.main(), strength_of_cells(largest_cell));

  committed_damage.clear();
  committed_reach.clear();
  committed_bare_tips.clear();
  cemented.clear();
  for (unsigned int c = 0; c < scene.cracks.size(); ++c)
  {
    const bool open = scene.cracks[c].kind != InitialCrack<dim>::Kind::cohesive;
    const auto &pieces = discontinuity.paths()[c].pieces;
    for (const auto &piece : pieces)
    {
      const std::uint64_t key = piece.key(scene.domain_size);
      committed_damage[key].fill(open ? 1. : 0.);
      if (!open && parameters.cohesive_energy < 1.)
        cemented.insert(key);
    }
    for (const CrackSpan &span : discontinuity.spans(c))
    {
      const std::uint64_t key = discontinuity.key(c, span);
      committed_reach[key] = discontinuity.length(c, span);
      if (open)
        committed_bare_tips.insert(key);
    }
  }
  committed_paths = discontinuity.paths();
  committed_limits = GrowthLimits();
  committed_limits.has_grown.assign(committed_paths.size(), false);
  committed_limits.volume.assign(committed_paths.size(), 0.);
  limits = committed_limits;
  bare_tips = committed_bare_tips;
}


template <int dim>
void CohesiveXFEM<dim>::refresh_segments()
{
  all_segments = discontinuity.segments(scene.in_situ_pore_pressure);
  std::unordered_set<std::uint64_t> cohesive;
  for (unsigned int c = 0; c < discontinuity.paths().size(); ++c)
    for (unsigned int i = 0; i < discontinuity.paths()[c].pieces.size(); ++i)
      if (const PointDamage d = damage(discontinuity.paths()[c].pieces[i]);
          std::any_of(d.begin(), d.end(), [](const double at_point) { return at_point < 1.; }))
        cohesive.insert(discontinuity.segment_key(c, i));
  for (Segment<dim> &segment : all_segments)
  {
    segment.at_tip = segment.at_tip && bare_tips.count(segment.key) != 0;
    // Half of Carter's leak-off in the middle of the cohesive zone, where the tip of an elastic
    // fracture with the same toughness would be. What is broken, such as a notch of the deck, has
    // bare faces however narrow it is.
    segment.bare_aperture = cohesive.count(segment.key) != 0 ? 0.7 * law.critical_opening() : 0.;
  }
  add_proppant(scene.cracks, discontinuity, all_segments);
}


template <int dim>
void CohesiveXFEM<dim>::begin_step(const StepContext &context)
{
  advances.assign(discontinuity.paths().size(), {{0, 0}});
  n_messages_before = messages.size();
  n_presses = 0;
  if (context.step == 1)
    contact.start(scene, discontinuity,
                  [this](const CrackPiece<dim> &piece) { return broken_share(piece); });
  contact.begin_step();
}


template <int dim>
std::vector<ExtraUnknown> CohesiveXFEM<dim>::extra_unknowns() const
{
  return discontinuity.enrichment().unknowns();
}


template <int dim>
dealii::ArrayView<const Segment<dim>> CohesiveXFEM<dim>::segments() const
{
  return dealii::make_array_view(all_segments);
}


template <int dim>
CellRole<dim> CohesiveXFEM<dim>::role(const CellIterator &cell) const
{
  return {discontinuity.cut_cell(cell->active_cell_index()), nullptr};
}


template <int dim>
typename CohesiveXFEM<dim>::PointDamage
CohesiveXFEM<dim>::damage(const CrackPiece<dim> &piece) const
{
  const auto found = committed_damage.find(piece.key(scene.domain_size));
  return found == committed_damage.end() ? PointDamage{} : found->second;
}


template <int dim>
double CohesiveXFEM<dim>::broken_share(const CrackPiece<dim> &piece) const
{
  const PointDamage d = damage(piece);
  const JumpShapes<dim> shapes(piece);
  return std::inner_product(d.begin(), d.end(), shapes.share.begin(), 0.);
}


template <int dim>
NormalShear CohesiveXFEM<dim>::separation(const CrackPiece<dim> &piece,
                                          const JumpShapes<dim> &shapes,
                                          const unsigned int point,
                                          const std::vector<JumpColumn> &columns,
                                          const std::vector<double> &a) const
{
  const Tensor<1, dim> jump = shapes.jump(point, columns, a);
  return {jump * piece.normal(), jump * piece.along};
}


template <int dim>
double CohesiveXFEM<dim>::volume(const unsigned int crack,
                                 const CrackSpan &pieces,
                                 const Unknowns &unknowns) const
{
  double sum = 0.;
  for (unsigned int i = pieces.first; i <= pieces.last; ++i)
  {
    const CrackPiece<dim> &piece = discontinuity.paths()[crack].pieces[i];
    const auto &columns = discontinuity.enrichment().jumps(crack, i);
    const JumpShapes<dim> shapes(piece);
    for (unsigned int q = 0; q < n_points; ++q)
      sum += separation(piece, shapes, q, columns, unknowns.extra).normal * piece.length() *
             shapes.share[q];
  }
  return sum;
}


template <int dim>
double CohesiveXFEM<dim>::closing_stress(const CrackPiece<dim> &piece) const
{
  const Tensor<1, dim> normal = piece.normal();
  return -(normal * (scene.in_situ_stress(piece.centre()) * normal));
}


template <int dim>
void CohesiveXFEM<dim>::assemble(const StepContext &, const State &state, Sink &sink) const
{
  LocalSystem local;
  std::vector<Tensor<1, dim>> jumps;
  for (const auto &owned : discontinuity.owned_pieces())
  {
    const CrackPiece<dim> &piece = discontinuity.paths()[owned.crack].pieces[owned.piece];
    const auto &columns = discontinuity.enrichment().jumps(owned.crack, owned.piece);
    if (columns.empty())
      continue;
    const JumpShapes<dim> shapes(piece);
    const PointDamage history = damage(piece);
    const CohesiveLaw law = law_at(piece);
    const Tensor<1, dim> n = piece.normal(), t = piece.along;

    local.extra.clear();
    jumps.assign(columns.size(), Tensor<1, dim>());
    for (unsigned int i = 0; i < columns.size(); ++i)
    {
      local.extra.push_back(columns[i].extra);
      jumps[i][columns[i].component] = shapes.mean(columns[i]);
    }
    local.reinit();
    add_released_traction<dim>(scene, piece.centre(), n, piece.length(), jumps, local.residual);
    for (unsigned int q = 0; q < n_points; ++q)
    {
      const CohesiveResponse response =
        law.evaluate(separation(piece, shapes, q, columns, state.current.extra), history[q]);
      const Tensor<1, dim> traction = response.traction.normal * n + response.traction.shear * t;
      const auto &k = response.tangent;
      const double weight = piece.length() * shapes.share[q];
      for (unsigned int i = 0; i < columns.size(); ++i)
      {
        const double shape_i = shapes.value(q, columns[i]) * weight;
        const unsigned int di = columns[i].component;
        local.residual(i) += shape_i * traction[di];
        for (unsigned int j = 0; j < columns.size(); ++j)
        {
          const unsigned int dj = columns[j].component;
          local.matrix(i, j) += shape_i * shapes.value(q, columns[j]) *
                                (n[di] * (k[0][0] * n[dj] + k[0][1] * t[dj]) +
                                 t[di] * (k[1][0] * n[dj] + k[1][1] * t[dj]));
        }
      }
    }
    sink.add(local);
    contact.assemble(discontinuity, owned.crack, owned.piece, state.current.extra, sink,
                     broken_share(piece));
  }
}


template <int dim>
bool CohesiveXFEM<dim>::commit(const StepContext &, const State &state)
{
  started = true;
  for (unsigned int c = 0; c < discontinuity.paths().size(); ++c)
    for (unsigned int i = 0; i < discontinuity.paths()[c].pieces.size(); ++i)
    {
      const CrackPiece<dim> &piece = discontinuity.paths()[c].pieces[i];
      const auto &columns = discontinuity.enrichment().jumps(c, i);
      const JumpShapes<dim> shapes(piece);
      contact.commit(discontinuity, c, i, state.current.extra, broken_share(piece));
      const PointDamage old = damage(piece);
      const CohesiveLaw law = law_at(piece);
      PointDamage now = old;
      for (unsigned int q = 0; q < n_points; ++q)
        if (old[q] < 1.)
        {
          const NormalShear gap = separation(piece, shapes, q, columns, state.current.extra);
          now[q] = law.evaluate(gap, old[q]).damage;
          dissipated += piece.length() * shapes.share[q] *
                        (law.dissipation(gap, now[q]) - law.dissipation(gap, old[q]));
        }
      committed_damage[piece.key(scene.domain_size)] = now;
    }
  committed_paths = discontinuity.paths();

  std::unordered_map<std::uint64_t, double> reach;
  committed_bare_tips.clear();
  for (unsigned int c = 0; c < discontinuity.paths().size(); ++c)
    for (const CrackEnd end : {CrackEnd::first, CrackEnd::last})
    {
      const std::uint64_t key = discontinuity.key(c, discontinuity.span_at(c, end));
      const auto old = committed_reach.find(key);
      reach[key] =
        std::max(reached_length(c, end, state), old == committed_reach.end() ? 0. : old->second);
      if (bare_tips.count(key) != 0)
        committed_bare_tips.insert(key);
    }
  committed_reach.swap(reach);
  bare_tips = committed_bare_tips;
  for (unsigned int c = 0; c < limits.volume.size(); ++c)
    limits.volume[c] = volume(
      c, {0, static_cast<unsigned int>(committed_paths[c].pieces.size()) - 1}, state.current);
  committed_limits = limits;
  return false;
}


template <int dim>
void CohesiveXFEM<dim>::rollback()
{
  bare_tips = committed_bare_tips;
  discontinuity.restore(committed_paths);
  messages.resize(n_messages_before);
  limits = committed_limits;
  begin_step({});
  refresh_segments();
}


template <int dim>
void CohesiveXFEM<dim>::wanted_cell_size(
  const dealii::parallel::distributed::Triangulation<dim> &triangulation,
  std::vector<float> &sizes) const
{
  if (!mesh_view)
  {
    if (parameters.cell_size > 0.)
      request_cell_size(triangulation, scene.cracks, parameters.rings_ahead * parameters.cell_size,
                        parameters.cell_size, sizes);
    return;
  }
  request_cell_size(triangulation, discontinuity, parameters.rings_ahead, sizes);
}


template <int dim>
std::vector<std::string> CohesiveXFEM<dim>::take_messages()
{
  std::vector<std::string> taken;
  taken.swap(messages);
  n_messages_before = 0;
  for (const std::string &message : contact.take_messages())
    taken.push_back(message);
  return taken;
}


template <int dim>
void CohesiveXFEM<dim>::save(boost::archive::binary_oarchive &archive) const
{
  archive << committed_paths << committed_damage << committed_reach << committed_bare_tips
          << dissipated << started << law.strength << contact << largest_cell << committed_limits
          << cemented;
}


template <int dim>
void CohesiveXFEM<dim>::load(boost::archive::binary_iarchive &archive)
{
  double strength;
  archive >> committed_paths >> committed_damage >> committed_reach >> committed_bare_tips >>
    dissipated >> started >> strength >> contact >> largest_cell >> committed_limits >> cemented;
  limits = committed_limits;
  law = make_law(parameters, scene.rock.main(), strength);
  bare_tips = committed_bare_tips;
  discontinuity.replace(committed_paths);
  if (mesh_view)
  {
    begin_step({});
    refresh_segments();
  }
}


template <int dim>
FractureSummary CohesiveXFEM<dim>::summary(const State &state, const Collectives &) const
{
  FractureSummary result;
  for (unsigned int c = 0; c < discontinuity.paths().size(); ++c)
  {
    const auto &path = discontinuity.paths()[c];
    result.n_tips += path.is_tip[0] + path.is_tip[1];
    const auto &spans = discontinuity.spans(c);
    for (unsigned int i = 0, s = 0; i < path.pieces.size(); ++i)
    {
      s += i > spans[s].last;
      const CrackPiece<dim> &piece = path.pieces[i];
      const auto &columns = discontinuity.enrichment().jumps(c, i);
      const JumpShapes<dim> shapes(piece);
      const PointDamage history = damage(piece);
      const CohesiveLaw law = law_at(piece);
      const auto at_end = committed_reach.find(discontinuity.key(c, spans[s]));
      const double reached = at_end == committed_reach.end() ? piece.length()
                                                             : piece.length() * at_end->second /
                                                                 discontinuity.length(c, spans[s]);
      for (unsigned int q = 0; q < n_points; ++q)
      {
        const double length = reached * shapes.share[q], d = history[q];
        // What is cut but undamaged is intact rock.
        if (d > 0.)
          result.length += length;
        if (d >= 1.)
          result.broken_length += length;
        const NormalShear gap = separation(piece, shapes, q, columns, state.current.extra);
        const NormalShear traction = law.evaluate(gap, d).traction;
        result.stored_energy += 0.5 * piece.length() * shapes.share[q] *
                                (traction.normal * gap.normal + traction.shear * gap.shear);
      }
    }
  }
  result.dissipated_energy = dissipated + contact.work();
  return result;
}


template <int dim>
void CohesiveXFEM<dim>::write_fields(const State &state, FieldSink<dim> &sink) const
{
  for (const auto &owned : discontinuity.owned_pieces())
  {
    const CrackPiece<dim> &piece = discontinuity.paths()[owned.crack].pieces[owned.piece];
    const auto &columns = discontinuity.enrichment().jumps(owned.crack, owned.piece);
    const JumpShapes<dim> shapes(piece);
    const PointDamage d = damage(piece);
    double aperture = 0., shear = 0., mean_damage = 0.;
    for (unsigned int q = 0; q < n_points; ++q)
    {
      const NormalShear gap = separation(piece, shapes, q, columns, state.current.extra);
      aperture += gap.normal * shapes.share[q];
      shear += gap.shear * shapes.share[q];
      mean_damage += d[q] * shapes.share[q];
    }
    std::vector<std::pair<std::string, double>> values{{"aperture", aperture},
                                                       {"slip", shear},
                                                       {"damage", mean_damage},
                                                       {"crack", owned.crack + 1.}};
    const ContactResponse<dim> touching = contact.traction(
      discontinuity, owned.crack, owned.piece, state.current.extra, broken_share(piece));
    values.emplace_back("contact_pressure", -touching.normal);
    values.emplace_back("friction", touching.shear * piece.along);
    if (state.segment_pressure)
      values.emplace_back("fluid_pressure", state.segment_pressure(
                                              discontinuity.segment_key(owned.crack, owned.piece)));
    sink.add_fracture_piece({piece.ends[0], piece.ends[1]}, values);
  }
}

template class CohesiveXFEM<2>;


void register_model(FractureModelRegistry &registry);

void register_model(FractureModelRegistry &registry)
{
  FractureModelEntry entry;
  entry.description = "Cohesive cracks that cut through cells (extended finite elements).";
  entry.declare_parameters = Parameters::declare;
  entry.create_2d = [](dealii::ParameterHandler &prm, const Scene<2> &scene)
  { return std::make_unique<CohesiveXFEM<2>>(Parameters::parse(prm), scene); };
  registry.add("cohesive_xfem", entry);
}
} // namespace stockwork::cohesive_xfem
