#pragma once

#include "fracture/peridynamics/bond_forces.h"
#include "fracture/peridynamics/softening.h"
#include "fracture/peridynamics/uneven_bonds.h"
#include "fracture/peridynamics/zone.h"
#include "stockwork/fracture/explicit_rock.h"

#include <functional>

namespace stockwork::peridynamics
{
/// The bonds of all rock, moved by explicit steps. Sites whose bonds are all whole are swept by the
/// stencil (BondForces); the others, beside cracks and free boundaries, have a list of their bonds,
/// and are swept with the stiffness that these have left (UnevenBonds). Bond by bond one looks at
/// sites only where one is about to soften or break, or where fluid pushes.
/// A bond has its history at both ends, and both see the same elongation, so no rank tells another
/// what has broken.
///
/// Brittle bonds may have fluid of a given pressure in all cracks: it is part of their law, see
/// pressure_in_bonds.h. Of whole bonds it counts for those of *wet* sites, which have a broken
/// one.
template <int dim>
class ExplicitBonds : public ExplicitRock
{
public:
  /// What a bond is like at the start.
  struct Bond
  {
    double stiffness; ///< of what is left of it by volume, elastic; zero: absent, or broken where
                      ///< no fluid pushes [N/m]
    double amplification; ///< stretch of a whole bond of the same energy, over its own; zero:
                          ///< it never breaks
    double greatest = 0.; ///< stretch so far, of such a bond
    double by_fluid = 0.; ///< stretch that the pressure in the cracks makes good for
    double told = 0.;     ///< `greatest` when changes were asked for the last time
  };

  /// @param by_fluid stretch that the pressure in the cracks makes good for, of a bond of the
  /// lattice
  /// @param bond of a site and a bond of the stencil
  ExplicitBonds(const Zone<dim> &zone,
                const std::vector<StencilBond<dim>> &stencil,
                const BondLaw &law,
                const SofteningLaw &softening,
                double by_fluid,
                const std::function<Bond(unsigned int site, unsigned int bond)> &bond,
                unsigned int rank);

  dealii::IndexSet seen() const override;
  void set_layout(const Vector &vector) override;
  void add_row_sums(Vector &sums) const override;
  void forces(const Vector &displacement, bool breaks, Vector &force) override;

  double n_terms() const override
  {
    return static_cast<double>(own_sites.size()) * stencil.size();
  }

  double work() const override
  {
    return work_of_fluid;
  }

  std::vector<unsigned int> detached() const override;

  /// A bond that has begun to soften, or has broken.
  struct Softened
  {
    Place<dim> place; ///< of the site
    unsigned int bond;
    double greatest; ///< stretch

    template <class Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &place &bond &greatest;
    }
  };

  /// Of this rank's sites, each seen from each of its ends here, those that have softened, or
  /// broken, since the last call.
  std::vector<Softened> take_changes();

  /// Of a bond of one of this rank's sites, by the last displacement [m].
  double elongation(unsigned int site, unsigned int bond) const;

  /// In what of the bonds holds, by the last displacement, on this rank's sites [J; J/m in 2-D].
  double stored() const;

  /// By this rank's sites, since the start [J; J/m in 2-D].
  double dissipated() const
  {
    return energy;
  }

  /// By the fluid's pressure, in what is broken, on this rank's sites [J; J/m in 2-D].
  double stored_by_fluid() const;

private:
  /// A site whose bonds are not all whole and elastic.
  struct Listed
  {
    unsigned int own; ///< number among the own sites
    std::vector<Bond> bonds;
    bool is_damaged = false;  ///< one of them has softened, or is broken
    bool has_changed = false; ///< since changes were asked for
  };

  /// In the box.
  std::size_t place_of(unsigned int site) const;

  double elongation_at(std::size_t place, unsigned int bond) const
  {
    double sum = 0.;
    for (unsigned int d = 0; d < dim; ++d)
      sum += coefficients[bond].direction[d] * (u[d][place + strides[bond]] - u[d][place]);
    return sum;
  }

  /// 0: whole, 1: broken.
  double damage(const Bond &bond) const
  {
    return bond.greatest > 0. ? softening.damage(bond.greatest) : 0.;
  }

  void find_box();
  void find_sources();
  void find_spans();
  void find_runs();
  void list(unsigned int own, const std::vector<Bond> &bonds);

  /// What the sweep is to know of a bond.
  void tell_sweep(const Listed &site, unsigned int bond);

  /// The force on a site, bond by bond.
  void look_at(Listed &site, bool breaks);

  /// Let each rank know which of the sites that it sees are wet.
  void find_wet_sites();

  /// Whether a whole bond feels the fluid: one of its ends is wet. Both ends of it, which may be on
  /// two ranks, have to say the same, so they go by what was broken before this displacement.
  bool feels_fluid(const std::size_t place, const unsigned int bond) const
  {
    return by_fluid != 0. && (is_wet[place] || is_wet[place + strides[bond]]);
  }

  const Zone<dim> &zone;
  const std::vector<StencilBond<dim>> stencil;
  const SofteningLaw softening;
  const double by_fluid;
  const std::vector<BondCoefficients<dim>> coefficients;
  const unsigned int rank;

  LatticeBox<dim> box;
  Place<dim> corner;                    ///< of the box
  std::vector<unsigned int> own_sites;  ///< in the order of the box
  std::vector<unsigned int> own_places; ///< in the box
  std::vector<double> own_shares;       ///< of their cells that lie in the domain
  std::vector<unsigned int> on_planes;  ///< numbers of own sites of which this is less than one
  std::vector<std::ptrdiff_t> strides;  ///< of the bonds
  std::vector<unsigned int> number;     ///< of own sites by place in the box; invalid: not own

  /// Where the displacement at a place of the box is from that is no own site: a site of another
  /// rank, or an image.
  struct Source
  {
    std::size_t place;
    unsigned int site;
    unsigned char mirrored;
    std::array<unsigned int, dim> local; ///< unknowns
  };
  std::vector<Source> sources;
  std::vector<std::array<unsigned int, dim>> own_unknowns; ///< local numbers

  /// Own sites that follow one another in the box, and whose nodes do in the numbering.
  struct Run
  {
    std::size_t place;                      ///< of the first
    std::array<unsigned int, dim> unknowns; ///< of the first; each next one has them dim on
    unsigned int length;
  };
  std::vector<Run> runs;

  std::unique_ptr<BondForces<dim>> kernel;
  std::unique_ptr<UnevenBonds<dim>> uneven; ///< those of the listed sites
  LatticeField<dim> u, u_before, f;
  std::vector<Bond> bonds_of_lattice; ///< whole, of a site
  std::vector<Listed> listed;
  std::vector<unsigned int> list_of; ///< of own sites; or why it is not among them
  std::vector<std::size_t> stretched, beyond;
  std::vector<bool> is_wet; ///< of the places of the box, before what the last displacement broke
  Vector wetness;           ///< of the sites, at the unknowns of their first component
  double energy = 0., work_of_fluid = 0.;
};
} // namespace stockwork::peridynamics
