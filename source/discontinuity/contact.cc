#include "discontinuity/contact.h"

#include "stockwork/base/quantity.h"
#include "stockwork/exchange/in_situ_contact.h"

#include <algorithm>
#include <sstream>

namespace stockwork
{
using dealii::Tensor;

void declare_friction(dealii::ParameterHandler &prm)
{
  prm.declare_entry("Friction coefficient", "0", Quantity(dimension::number, Range::non_negative()),
                    "Coulomb's, between the faces of a crack that touch: shear traction over what "
                    "presses them together beyond the fluid's pressure. 0: they slide freely. In "
                    "rock without pores a crack begins with fluid at the in-situ stress across it, "
                    "so nothing presses its faces until that pressure falls.");
}


std::string faces_touch(const double friction)
{
  std::ostringstream text;
  text << "Faces of a crack touch. ";
  if (friction > 0.)
    text << "The coefficient of their friction is " << friction << ".";
  else
    text << "They slide without friction, for 'Friction coefficient' is 0.";
  return text.str();
}


template <int dim>
typename FaceContact<dim>::Patch FaceContact<dim>::patch(const Discontinuity<dim> &discontinuity,
                                                         const unsigned int crack,
                                                         const unsigned int piece) const
{
  const auto &pieces = discontinuity.paths()[crack].pieces;
  const auto &ends_on = discontinuity.paths()[crack].ends_on;
  const auto &spans = discontinuity.spans(crack);
  const unsigned int n = spans.size();
  const unsigned int span =
    std::find_if(spans.begin(), spans.end(), [piece](const auto &s) { return piece <= s.last; }) -
    spans.begin();
  Patch patch;
  patch.first = spans[span].first;
  patch.last = spans[span].last;
  if (n >= 4 && span < 2 && pieces.front().inside[0] && ends_on[0] < 0)
  {
    patch.first = 0;
    patch.last = spans[1].last;
  }
  else if (n >= 4 && span + 2 >= n && pieces.back().inside[1] && ends_on[1] < 0)
  {
    patch.first = spans[n - 2].first;
    patch.last = pieces.size() - 1;
  }
  for (unsigned int i = patch.first; i <= patch.last; ++i)
  {
    patch.length += pieces[i].length();
    if (minimum_gap)
      patch.minimum_gap += pieces[i].length() * minimum_gap(crack, i);
  }
  patch.minimum_gap /= patch.length;
  for (unsigned int i = patch.first; i <= patch.last; ++i)
    for (const auto &[unknown, unit] : discontinuity.mean_jumps(crack, i))
    {
      const auto found =
        std::find_if(patch.jumps.begin(), patch.jumps.end(),
                     [unknown = unknown](const auto &jump) { return jump.first == unknown; });
      const Tensor<1, dim> share = pieces[i].length() / patch.length * unit;
      if (found == patch.jumps.end())
        patch.jumps.emplace_back(unknown, share);
      else
        found->second += share;
    }
  return patch;
}


template <int dim>
Tensor<1, dim> FaceContact<dim>::slip(const CrackPiece<dim> &piece) const
{
  const auto found = slips.find(piece.key(domain_size));
  return found == slips.end() ? Tensor<1, dim>() : found->second;
}


template <int dim>
double FaceContact<dim>::carried_by(const CrackPiece<dim> &piece) const
{
  const auto found = carried.find(piece.key(domain_size));
  return found == carried.end() ? 0. : found->second;
}


template <int dim>
ContactResponse<dim> FaceContact<dim>::traction(const Discontinuity<dim> &discontinuity,
                                                const unsigned int crack,
                                                const unsigned int index,
                                                const std::vector<double> &extra,
                                                const double broken) const
{
  const Patch patch = this->patch(discontinuity, crack, index);
  const CrackPiece<dim> &piece = discontinuity.paths()[crack].pieces[patch.first];
  Tensor<1, dim> jump;
  for (const auto &[unknown, unit] : patch.jumps)
    jump += extra[unknown] * unit;
  // A seam that still holds cannot carry on what pressed it (see commit): once faces touch, it is
  // stiffer instead. Not before, for the suction at the tip of a growing fracture closes seams,
  // too.
  const double seam = broken < 1. && closing ? 10. : 1.;
  const double plane_modulus = rock(piece.region).plane_modulus();
  const ContactLaw law{seam * stiffness * plane_modulus / piece.cell_size(), friction};
  return law.evaluate(piece.normal(), jump - patch.minimum_gap * piece.normal(), slip(piece),
                      broken, carried_by(piece));
}


template <int dim>
void FaceContact<dim>::start(const Scene<dim> &scene,
                             const Discontinuity<dim> &discontinuity,
                             const std::function<double(const CrackPiece<dim> &)> &broken)
{
  pressed.clear();
  for (unsigned int c = 0; c < discontinuity.paths().size(); ++c)
    for (unsigned int i = 0; i < discontinuity.paths()[c].pieces.size(); ++i)
    {
      const CrackPiece<dim> &piece = discontinuity.paths()[c].pieces[i];
      const double traction = in_situ_contact(scene, piece.centre(), piece.normal());
      if (traction < 0. && broken(piece) >= 1. && i == patch(discontinuity, c, i).first)
        pressed[piece.key(domain_size)] = traction;
    }
}


template <int dim>
Tensor<2, dim> FaceContact<dim>::tangent(const CrackPiece<dim> &piece,
                                         const ContactResponse<dim> &response) const
{
  if (response.secant == 0.) // open, or they stick
    return response.tangent;
  const Tensor<1, dim> direction = response.shear / response.shear.norm();
  const double share = sliding[piece.key(domain_size)].share(response.shear * piece.along > 0.);
  return response.tangent + share * response.secant * outer_product(direction, direction);
}


template <int dim>
void FaceContact<dim>::assemble(const Discontinuity<dim> &discontinuity,
                                const unsigned int crack,
                                const unsigned int index,
                                const std::vector<double> &extra,
                                Sink &sink,
                                const double broken) const
{
  const Patch patch = this->patch(discontinuity, crack, index);
  const ContactResponse<dim> response = traction(discontinuity, crack, index, extra, broken);
  if (index != patch.first || response.normal == 0.)
    return;
  const CrackPiece<dim> &piece = discontinuity.paths()[crack].pieces[index];
  const Tensor<1, dim> force = patch.length * (response.normal * piece.normal() + response.shear);
  const Tensor<2, dim> stiffness = patch.length * tangent(piece, response);
  const auto &jumps = patch.jumps;
  LocalSystem local;
  for (const auto &[unknown, unit] : jumps)
    local.extra.push_back(unknown);
  local.reinit();
  for (unsigned int i = 0; i < jumps.size(); ++i)
  {
    local.residual(i) = jumps[i].second * force;
    for (unsigned int j = 0; j < jumps.size(); ++j)
      local.matrix(i, j) = jumps[i].second * (stiffness * jumps[j].second);
  }
  sink.add(local);
}


template <int dim>
bool FaceContact<dim>::press(const Discontinuity<dim> &discontinuity,
                             const unsigned int crack,
                             const unsigned int index,
                             const std::vector<double> &extra,
                             const double opening,
                             const double broken,
                             const Press which)
{
  if (broken < 1. || index != patch(discontinuity, crack, index).first)
    return false;
  const ContactResponse<dim> response = traction(discontinuity, crack, index, extra, broken);
  const Tensor<1, dim> n = discontinuity.paths()[crack].pieces[index].normal();
  const double gap = std::abs(response.gap);
  const std::uint64_t key = discontinuity.paths()[crack].pieces[index].key(domain_size);
  if (which == Press::parting && (response.gap <= 0. || pressed.count(key) == 0))
    return false;
  // Where faces have not parted yet, what is left of a penalty's overlap is the measure.
  if (response.normal == 0. || gap <= 0.005 * std::max(opening, maximum_opening) ||
      gap * (n * (response.tangent * n)) <= -0.01 * response.normal)
    return false;
  carried[key] = response.normal;
  return true;
}


template <int dim>
void FaceContact<dim>::commit(const Discontinuity<dim> &discontinuity,
                              const unsigned int crack,
                              const unsigned int index,
                              const std::vector<double> &extra,
                              const double broken)
{
  const ContactResponse<dim> response = traction(discontinuity, crack, index, extra, broken);
  maximum_opening = std::max(maximum_opening, response.gap);
  touched = touched || (response.normal < 0. && broken >= 1.);
  const Patch patch = this->patch(discontinuity, crack, index);
  if (index != patch.first)
    return;
  const std::uint64_t key = discontinuity.paths()[crack].pieces[index].key(domain_size);
  // What holds in tension, too, would be torn by the step in which this pressure goes.
  if (response.normal < 0. && broken >= 1.)
    pressed[key] = response.normal;
  else
    pressed.erase(key);
  if (!has_friction())
    return;
  Tensor<1, dim> &committed = slips[key];
  friction_work += patch.length * (response.shear * (response.slip - committed));
  committed = response.slip;
}


template <int dim>
std::vector<std::string> FaceContact<dim>::take_messages()
{
  if (!touched || said)
    return {};
  said = true;
  return {faces_touch(friction)};
}


template class FaceContact<2>;
} // namespace stockwork
