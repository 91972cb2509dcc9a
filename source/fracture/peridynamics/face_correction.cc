// The surface correction follows a growing fracture.
#include "fracture/peridynamics/peridynamics.h"

#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/connected_components.hpp>

namespace stockwork::peridynamics
{
namespace
{
/// Of the stretch at which bonds soften, up to which the surface correction may make them stiffer.
constexpr double relaxed = 0.5;
/// Of the damage of a fracture's sites that it makes up for, how much may wait: it changes the rows
/// of all sites around, and another factor of the rock after each step of a growing fracture would
/// cost more than all else.
constexpr double may_wait = 0.03;

/// Numbers of the sites that have lost bonds, fracture by fracture: those that touch one another.
template <int dim>
std::vector<std::vector<unsigned int>> sites_of_fractures(const Zone<dim> &zone,
                                                          const std::vector<double> &damage)
{
  constexpr unsigned int none = dealii::numbers::invalid_unsigned_int;
  std::vector<unsigned int> damaged, vertex(damage.size(), none);
  for (const unsigned int site : zone.peridynamic_sites())
    if (damage[site] > 0.)
    {
      vertex[site] = damaged.size();
      damaged.push_back(site);
    }
  boost::adjacency_list<boost::vecS, boost::vecS, boost::undirectedS> touching(damaged.size());
  for (unsigned int v = 0; v < damaged.size(); ++v)
    for (unsigned int k = 0; k < dealii::Utilities::pow(3, dim) / 2; ++k) // half of those around it
    {
      Place<dim> place = zone.sites()[damaged[v]].place;
      for (unsigned int d = 0, rest = k; d < dim; ++d, rest /= 3)
        place[d] += static_cast<int>(rest % 3) - 1;
      if (const unsigned int other = zone.find(place); other != none && vertex[other] != none)
        add_edge(v, vertex[other], touching);
    }
  std::vector<unsigned int> fracture_of(damaged.size());
  std::vector<std::vector<unsigned int>> fractures(
    damaged.empty() ? 0 : connected_components(touching, fracture_of.data()));
  for (unsigned int v = 0; v < damaged.size(); ++v)
    fractures[fracture_of[v]].push_back(damaged[v]);
  return fractures;
}
} // namespace


template <int dim>
void Peridynamics<dim>::correct_faces()
{
  // With the pressure in the bonds faces are those of a crack without load in rock under a uniform
  // stress: free of stress across them and, but near the tips, along them. Bonds that are left
  // there do nothing, and stiffer ones would oppose the strain of the pressure.
  if (!parameters.surface_correction || parameters.in_bonds || parameters.explicit_steps)
    return;
  const auto is_relaxed = [&](const unsigned int site)
  {
    for (unsigned int b = 0; b < lattice.stencil.size(); ++b)
      if (!lattice.bonds.is_broken(site, b) &&
          (1. - softening_bonds.damage(site, b)) * lattice.elongation(site, b, displacement) >
            relaxed * lattice.softening.first * relative_stretch(site, b) *
              lattice.coefficients[b].length)
        return false;
    return true;
  };
  std::vector<unsigned int> changed;
  for (const std::vector<unsigned int> &sites : sites_of_fractures(lattice.zone, lattice.damage))
  {
    std::vector<unsigned int> behind;
    double missing = 0., made_up_for = 0.;
    for (const unsigned int i : sites)
    {
      made_up_for += lattice.corrected_damage[i];
      if (lattice.damage[i] > lattice.corrected_damage[i] && is_relaxed(i))
      {
        missing += lattice.damage[i] - lattice.corrected_damage[i];
        behind.push_back(i);
      }
    }
    if (missing < may_wait * made_up_for)
      continue;
    for (const unsigned int i : behind)
    {
      lattice.corrected_damage[i] = committed_correction[lattice.zone.sites()[i].place] =
        lattice.damage[i];
      changed.push_back(i);
      lattice.append_family(i, changed);
    }
  }
  row_versions.change(changed);
}

template void Peridynamics<2>::correct_faces();
template void Peridynamics<3>::correct_faces();
} // namespace stockwork::peridynamics
