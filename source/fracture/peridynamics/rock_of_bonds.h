#pragma once

#include "fracture/peridynamics/zone.h"
#include "stockwork/rock/rock.h"

#include <functional>
#include <vector>

namespace stockwork::peridynamics
{
/// Rock that differs from place to place, as bonds see it: by its regions and its random fields, in
/// the cells of the lattice, where elements have the same. Of rock that is one and the same nothing
/// is kept, and all factors are one.
///
/// A bond is a spring whose stiffness varies along it, so what it has of a modulus is the harmonic
/// mean along its way through the cells; between two cells it has the mean of both. Then a body of
/// layers under a stress across them has the strain of each layer, whatever the horizon; with the
/// harmonic mean of what there is at the bond's ends, layers are up to half a cell too thick.
///
/// A bond takes the energy of the rock where it crosses the fracture; so a fracture takes the
/// integral of G_c along its way. Where no path says where that is, it is the bond's middle.
template <int dim>
class RockOfBonds
{
public:
  /// Collective. @p energy_across gives what bonds across a plane take in such rock, in any unit;
  /// @p of_cell the rock of a cell that this rank owns, by its active cell index and its centre.
  void
  reinit(const Zone<dim> &zone,
         const std::vector<StencilBond<dim>> &stencil,
         const Rock &rock,
         const std::function<double(const RockProperties &)> &energy_across,
         const std::function<RockProperties(unsigned int, const dealii::Point<dim> &)> &of_cell,
         const Collectives &collectives);

  bool is_uniform() const
  {
    return cells.empty();
  }

  /// Of a bond of a peridynamic site, the shear modulus over that of the rock outside of regions.
  double modulus(const unsigned int site, const unsigned int bond) const
  {
    return is_uniform() ? 1. : of_bond(site, bond).modulus;
  }

  /// The same of the energy that the bond takes, at its middle.
  double energy(const unsigned int site, const unsigned int bond) const
  {
    return is_uniform() ? 1. : of_bond(site, bond).energy;
  }

  /// The same at a point.
  double energy(const dealii::Point<dim> &point) const;

  /// The shear modulus at a site, over that of the rock outside of regions.
  double modulus(unsigned int site) const;

  /// Biot's coefficient at the bond's middle, in rock that is not uniform.
  double biot_coefficient(const unsigned int site, const unsigned int bond) const
  {
    return of_bond(site, bond).biot_coefficient;
  }

  /// Lame's constant less the shear modulus at a site, in rock that is not uniform [Pa].
  double dilatation_modulus(unsigned int site) const;

private:
  struct OfCell
  {
    Place<dim> place; ///< of its lowest corner
    double modulus, energy, dilatation_modulus, biot_coefficient;

    template <class Archive>
    void serialize(Archive &ar, const unsigned int)
    {
      ar &place &modulus &energy &dilatation_modulus &biot_coefficient;
    }
  };

  struct OfBond
  {
    double modulus, energy, biot_coefficient;
  };

  const OfBond &of_bond(const unsigned int site, const unsigned int bond) const
  {
    const std::vector<OfBond> &all = of_bonds[number[site]];
    return all[all.size() == 1 ? 0 : bond];
  }

  /// Mean of a constant in those of the cells that there are; zero if there is none.
  double
  mean(const Place<dim> &origin, const std::vector<Place<dim>> &some, double OfCell::*what) const;

  const Zone<dim> *zone = nullptr;
  std::vector<OfCell> cells; ///< sorted by place, with the images beyond planes of symmetry
  std::vector<std::vector<OfBond>> of_bonds; ///< of a site; one where all are alike
  std::vector<unsigned int> number;          ///< of each site among these
};
} // namespace stockwork::peridynamics
