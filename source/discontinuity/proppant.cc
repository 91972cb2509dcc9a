#include "discontinuity/proppant.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace stockwork
{
namespace
{
/// Where the nearest point of a polyline is, from 0 at its first corner to 1 at its last.
template <int dim>
double place_along(const std::vector<dealii::Point<dim>> &polyline, const dealii::Point<dim> &point)
{
  double before = 0., place = 0., nearest = std::numeric_limits<double>::infinity();
  for (unsigned int i = 0; i + 1 < polyline.size(); ++i)
  {
    const dealii::Tensor<1, dim> along = polyline[i + 1] - polyline[i];
    const double t = std::clamp((point - polyline[i]) * along / along.norm_square(), 0., 1.);
    const double distance = point.distance(polyline[i] + t * along);
    if (distance < nearest)
    {
      nearest = distance;
      place = before + t * along.norm();
    }
    before += along.norm();
  }
  return place / before;
}
} // namespace


template <int dim>
double
propped_gap(const InitialCrack<dim> &crack, const CrackPath<dim> &path, const unsigned int piece)
{
  if (crack.proppant.aperture == 0.)
    return 0.;
  const auto is_mouth = [&](const CrackEnd end, const dealii::Point<dim> &given)
  {
    const CrackPiece<dim> &last = path.piece_at(end);
    return last.at_boundary[static_cast<int>(end)] &&
           path.tip(end).distance(given) < last.cell_size();
  };
  const bool mouth_first = is_mouth(CrackEnd::first, crack.points.front()),
             mouth_last = is_mouth(CrackEnd::last, crack.points.back());
  const double s = place_along(crack.points, path.pieces[piece].centre());
  const double x = mouth_first && mouth_last ? 0.
                   : mouth_first             ? s
                   : mouth_last              ? 1. - s
                                             : 2. * s - 1.;
  const double rest = std::max(0., 1. - x * x);
  return crack.proppant.aperture * rest * std::sqrt(rest);
}


template <int dim>
std::function<double(unsigned int, unsigned int)>
propped_gaps(const std::vector<InitialCrack<dim>> &cracks, const Discontinuity<dim> &discontinuity)
{
  if (std::none_of(cracks.begin(), cracks.end(),
                   [](const auto &crack) { return crack.proppant.aperture > 0.; }))
    return {};
  return [&cracks, &discontinuity](const unsigned int crack, const unsigned int piece)
  {
    // One that has begun on another is none of the case.
    return crack < cracks.size() ? propped_gap(cracks[crack], discontinuity.paths()[crack], piece)
                                 : 0.;
  };
}


template <int dim>
void add_proppant(const std::vector<InitialCrack<dim>> &cracks,
                  const Discontinuity<dim> &discontinuity,
                  std::vector<Segment<dim>> &segments)
{
  for (unsigned int c = 0; c < cracks.size(); ++c)
  {
    if (cracks[c].kind != InitialCrack<dim>::Kind::propped)
      continue;
    const CrackPath<dim> &path = discontinuity.paths()[c];
    for (const CrackSpan &span : discontinuity.spans(c))
    {
      const std::uint64_t key = discontinuity.key(c, span);
      const auto segment = std::find_if(segments.begin(), segments.end(),
                                        [key](const auto &s) { return s.key == key; });
      // Another rank's, or where the crack has grown: half a span beyond the end, or more.
      if (segment == segments.end() || cracks[c].distance(segment->centre) > 0.25 * segment->area)
        continue;
      double room = 0.;
      for (unsigned int i = span.first; i <= span.last; ++i)
        room += path.pieces[i].length() * propped_gap(cracks[c], path, i);
      segment->opening.constant -= room / discontinuity.length(c, span);
      segment->propped_conductivity = cracks[c].proppant.conductivity;
    }
  }
}


template double propped_gap(const InitialCrack<2> &, const CrackPath<2> &, unsigned int);
template std::function<double(unsigned int, unsigned int)>
propped_gaps(const std::vector<InitialCrack<2>> &, const Discontinuity<2> &);
template void add_proppant(const std::vector<InitialCrack<2>> &,
                           const Discontinuity<2> &,
                           std::vector<Segment<2>> &);
} // namespace stockwork
