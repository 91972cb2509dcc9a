#include "fracture/peridynamics/rock_of_bonds.h"

#include "fracture/peridynamics/lattice_moduli.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace stockwork::peridynamics
{
using dealii::Point;
using dealii::Tensor;

namespace
{
/// A part of a bond's way: in one cell, or between some.
template <int dim>
struct PartOfWay
{
  double share;                  ///< of the bond's length
  std::vector<Place<dim>> cells; ///< from the bond's site
};


/// The cells that touch a point of the lattice, in spacings.
template <int dim>
std::vector<Place<dim>> cells_around(const Tensor<1, dim> &point)
{
  std::vector<Place<dim>> cells{Place<dim>()};
  for (unsigned int d = 0; d < dim; ++d)
  {
    const int nearest = static_cast<int>(std::lround(point[d]));
    const bool is_between = std::abs(point[d] - nearest) < same_place;
    const std::size_t n = cells.size();
    for (std::size_t i = 0; i < n; ++i)
    {
      cells[i][d] = is_between ? nearest : static_cast<int>(std::floor(point[d]));
      if (!is_between)
        continue;
      cells.push_back(cells[i]);
      cells.back()[d] = nearest - 1;
    }
  }
  return cells;
}


template <int dim>
Tensor<1, dim> along(const StencilBond<dim> &bond, const double share)
{
  Tensor<1, dim> point;
  for (unsigned int d = 0; d < dim; ++d)
    point[d] = share * bond.offset[d];
  return point;
}


template <int dim>
std::vector<PartOfWay<dim>> way_of(const StencilBond<dim> &bond)
{
  std::vector<double> ends{0., 1.};
  for (unsigned int d = 0; d < dim; ++d)
    for (int k = 1; k < std::abs(bond.offset[d]); ++k)
      ends.push_back(static_cast<double>(k) / std::abs(bond.offset[d]));
  std::sort(ends.begin(), ends.end());
  std::vector<PartOfWay<dim>> parts;
  for (unsigned int i = 0; i + 1 < ends.size(); ++i)
    if (ends[i + 1] - ends[i] > same_place)
      parts.push_back(
        {ends[i + 1] - ends[i], cells_around(along(bond, 0.5 * (ends[i] + ends[i + 1])))});
  return parts;
}


bool is_the_same(const RockProperties &a, const RockProperties &b)
{
  const auto same = [](const double x, const double y)
  { return x == y || (std::isnan(x) && std::isnan(y)); };
  return !a.is_random() && !b.is_random() && a.young_modulus == b.young_modulus &&
         a.poisson_ratio == b.poisson_ratio && a.biot_coefficient == b.biot_coefficient &&
         same(a.energy_release_rate, b.energy_release_rate);
}
} // namespace


template <int dim>
double RockOfBonds<dim>::mean(const Place<dim> &origin,
                              const std::vector<Place<dim>> &some,
                              double OfCell::*what) const
{
  double sum = 0.;
  unsigned int n = 0;
  for (Place<dim> place : some)
  {
    for (unsigned int d = 0; d < dim; ++d)
      place[d] += origin[d];
    const auto found =
      std::lower_bound(cells.begin(), cells.end(), place,
                       [](const OfCell &cell, const Place<dim> &p) { return cell.place < p; });
    if (found == cells.end() || found->place != place)
      continue;
    sum += (*found).*what;
    ++n;
  }
  return n > 0 ? sum / n : 0.;
}


template <int dim>
void RockOfBonds<dim>::reinit(
  const Zone<dim> &zone,
  const std::vector<StencilBond<dim>> &stencil,
  const Rock &rock,
  const std::function<double(const RockProperties &)> &energy_across,
  const std::function<RockProperties(unsigned int, const Point<dim> &)> &of_cell,
  const Collectives &collectives)
{
  this->zone = &zone;
  cells.clear();
  of_bonds.clear();
  const RockProperties &main = rock.main();
  bool is_one = !main.is_random();
  for (unsigned int region = 1; region <= Rock::max_regions; ++region)
    is_one = is_one && is_the_same(rock(region), main);
  if (is_one)
    return;

  const double of_main = energy_across(main);
  int reach = 0;
  for (const StencilBond<dim> &bond : stencil)
    for (unsigned int d = 0; d < dim; ++d)
      reach = std::max(reach, std::abs(bond.offset[d]) + 1);
  for (const auto &[place, index] : zone.cells_of_this_rank())
  {
    Point<dim> centre = zone.position(place);
    for (unsigned int d = 0; d < dim; ++d)
      centre[d] += 0.5 * zone.spacing();
    const RockProperties here = of_cell(index, centre);
    cells.push_back({place, here.shear_modulus() / main.shear_modulus(),
                     std::isnan(of_main) ? 1. : energy_across(here) / of_main,
                     here.lame_lambda() - here.shear_modulus(), here.biot_coefficient});
  }
  cells = collectives.gather(cells);
  // No bond that is known here goes through a cell whose corners are not.
  const auto is_far = [&](const OfCell &cell)
  {
    for (unsigned int v = 0; v < 1u << dim; ++v)
    {
      Place<dim> corner = cell.place;
      for (unsigned int d = 0; d < dim; ++d)
        corner[d] += static_cast<int>(v >> d & 1);
      if (zone.find(corner) != dealii::numbers::invalid_unsigned_int)
        return false;
    }
    return true;
  };
  if (zone.is_divided())
    cells.erase(std::remove_if(cells.begin(), cells.end(), is_far), cells.end());
  std::map<Place<dim>, OfCell> all;
  for (OfCell cell : cells)
  {
    const Place<dim> place = cell.place;
    zone.for_each_image(place, reach,
                        [&](const Place<dim> &image, unsigned int)
                        {
                          cell.place = image;
                          all.emplace(image, cell);
                        });
  }
  cells.clear();
  for (const auto &cell : all)
    cells.push_back(cell.second);

  std::vector<std::vector<PartOfWay<dim>>> ways;
  std::vector<std::vector<Place<dim>>> middles;
  for (const StencilBond<dim> &bond : stencil)
  {
    ways.push_back(way_of(bond));
    middles.push_back(cells_around(along(bond, 0.5)));
  }
  number.assign(zone.sites().size(), 0);
  std::map<std::array<double, 3>, unsigned int> where_all_are_alike;
  std::vector<OfBond> bonds(stencil.size());
  for (const unsigned int i : zone.peridynamic_sites())
  {
    const Place<dim> &place = zone.sites()[i].place;
    bool alike = true;
    for (unsigned int b = 0; b < stencil.size(); ++b)
    {
      double compliance = 0., known = 0.;
      for (const PartOfWay<dim> &part : ways[b])
        if (const double here = mean(place, part.cells, &OfCell::modulus); here > 0.)
        {
          compliance += part.share / here;
          known += part.share;
        }
      // Bonds that would leave the rock have nothing of it.
      bonds[b] = {known > 0. ? known / compliance : 0., mean(place, middles[b], &OfCell::energy),
                  mean(place, middles[b], &OfCell::biot_coefficient)};
      // Rounding must not make bonds differ.
      alike = alike && std::abs(bonds[b].modulus - bonds[0].modulus) < 1e-12 * bonds[0].modulus &&
              bonds[b].energy == bonds[0].energy &&
              bonds[b].biot_coefficient == bonds[0].biot_coefficient;
    }
    if (!alike)
    {
      number[i] = of_bonds.size();
      of_bonds.push_back(bonds);
      continue;
    }
    const OfBond one{modulus(i), bonds[0].energy, bonds[0].biot_coefficient};
    const auto [found, is_new] = where_all_are_alike.emplace(
      std::array<double, 3>{{one.modulus, one.energy, one.biot_coefficient}},
      static_cast<unsigned int>(of_bonds.size()));
    number[i] = found->second;
    if (is_new)
      of_bonds.push_back({one});
  }
}


template <int dim>
double RockOfBonds<dim>::energy(const Point<dim> &point) const
{
  return is_uniform()
           ? 1.
           : mean(Place<dim>(), cells_around<dim>((point - zone->origin()) / zone->spacing()),
                  &OfCell::energy);
}


template <int dim>
double RockOfBonds<dim>::modulus(const unsigned int site) const
{
  return is_uniform()
           ? 1.
           : mean(zone->sites()[site].place, cells_around(Tensor<1, dim>()), &OfCell::modulus);
}


template <int dim>
double RockOfBonds<dim>::dilatation_modulus(const unsigned int site) const
{
  return mean(zone->sites()[site].place, cells_around(Tensor<1, dim>()),
              &OfCell::dilatation_modulus);
}

template class RockOfBonds<2>;
template class RockOfBonds<3>;
} // namespace stockwork::peridynamics
