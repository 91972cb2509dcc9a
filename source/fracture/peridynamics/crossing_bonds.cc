#include "fracture/peridynamics/crossing_bonds.h"

#include <algorithm>
#include <cmath>

namespace stockwork::peridynamics
{
using dealii::Point;
using dealii::Tensor;

template <int dim>
CrossingBonds<dim>::CrossingBonds(const Lattice<dim> &lattice)
  : lattice(lattice)
{
}


template <int dim>
void CrossingBonds<dim>::forget()
{
  followed.reset();
}


template <int dim>
bool CrossingBonds<dim>::follow(const TrackedPaths &paths)
{
  if constexpr (dim == 2)
  {
    if (followed && paths.run_as(*followed))
      return false;
    followed = paths;
    bonds.clear();
    const auto &cracks = lattice.scene.cracks;
    std::vector<bool> is_near(lattice.zone.sites().size(), false);
    const int reach = lattice.parameters.horizon + 1;
    for (const auto &[lower, upper] : paths.boxes())
    {
      Place<dim> first, last;
      for (unsigned int d = 0; d < dim; ++d)
      {
        const double origin = lattice.zone.position(Place<dim>{})[d];
        first[d] =
          static_cast<int>(std::floor((lower[d] - origin) / lattice.zone.spacing())) - reach;
        last[d] = static_cast<int>(std::ceil((upper[d] - origin) / lattice.zone.spacing())) + reach;
      }
      for (int x = first[0]; x <= last[0]; ++x)
        for (int y = first[1]; y <= last[1]; ++y)
          if (const unsigned int site = lattice.zone.find({{x, y}});
              site != dealii::numbers::invalid_unsigned_int)
            is_near[site] = true;
    }
    for (const unsigned int i : lattice.zone.peridynamic_sites())
      for (unsigned int b = 0; b < lattice.stencil.size() && is_near[i]; ++b)
      {
        // Beyond planes of symmetry paths go on as images.
        const Place<dim> &from = lattice.zone.sites()[i].place;
        const FarEnd end = lattice.zone.far_end(i, b);
        const Place<dim> &image = lattice.zone.sites()[end.site].place;
        std::optional<BondAcross<dim>> across;
        bool is_cohesive = false;
        for (unsigned int mirrored = 0; mirrored <= end.mirrored; ++mirrored)
        {
          if ((mirrored & ~static_cast<unsigned int>(end.mirrored)) != 0)
            continue;
          BondAcross<dim> bond{{i, b}, lattice.coefficients[b].direction, {}};
          Place<dim> first = from, last = from;
          for (unsigned int d = 0; d < dim; ++d)
          {
            last[d] += lattice.stencil[b].offset[d];
            if (mirrored >> d & 1)
            {
              first[d] = image[d] + last[d] - from[d];
              last[d] = image[d];
              bond.direction[d] = -bond.direction[d];
            }
          }
          const Point<dim> start = lattice.zone.position(first), stop = lattice.zone.position(last);
          const auto crosses = [&](const unsigned int crack, const auto kind)
          { return cracks[crack].kind == kind && paths.crosses_initial(crack, start, stop); };
          const auto crossing = paths.crossing(start, stop);
          for (unsigned int c = 0; c < cracks.size() && crossing; ++c)
          {
            is_cohesive |= crosses(c, InitialCrack<dim>::Kind::cohesive);
            bond.was_cut |= (c != crossing->path || paths.end_at(*crossing)) &&
                            crosses(c, InitialCrack<dim>::Kind::open);
          }
          if (!crossing || across)
            continue;
          bond.crossing = *crossing;
          across = bond;
        }
        if (!across)
          continue;
        across->cohesive = is_cohesive;
        if (is_cohesive)
          across->share = lattice.parameters.cohesive_energy;
        bonds.push_back(*across);
      }
  }
  return dim == 2;
}


template <int dim>
const BondAcross<dim> *CrossingBonds<dim>::find(const unsigned int site,
                                                const unsigned int bond) const
{
  const BondView view(site, bond);
  const auto found =
    std::lower_bound(bonds.begin(), bonds.end(), view,
                     [](const BondAcross<dim> &a, const BondView &b) { return a.view < b; });
  return found == bonds.end() || found->view != view ? nullptr : &*found;
}

template class CrossingBonds<2>;
template class CrossingBonds<3>;
} // namespace stockwork::peridynamics
