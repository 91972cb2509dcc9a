#pragma once

#include "fracture/peridynamics/bond_law.h"
#include "fracture/peridynamics/broken_bonds.h"

namespace stockwork::peridynamics
{
/// The sites of a box, x fastest.
template <int dim>
struct LatticeBox
{
  std::array<unsigned int, dim> size;

  std::size_t n_sites() const;
  std::array<unsigned int, dim> position(std::size_t site) const;

  /// What a bond adds to the index of a site.
  std::ptrdiff_t stride(const std::array<int, dim> &offset) const;

  /// Whether the site is at least @p margin sites away from every face.
  bool inside(const std::size_t site, const unsigned int margin) const;
};

/// A vector on each site, one array per component.
template <int dim>
using LatticeField = std::array<std::vector<double>, dim>;

/// The forces that all bonds exert on the sites of a box: the residual of an elastic lattice with
/// broken bonds.
///
/// As all sites have the same stencil, a bond is three constants, and rows of sites are swept with
/// a bond and its opposite at a time. No list of neighbours is read, so what is touched is the
/// field, and the work is arithmetic. Broken bonds are swept like the others and then taken back
/// one by one: they are few.
template <int dim>
class BondForces
{
public:
  BondForces(const LatticeBox<dim> &box,
             const std::vector<StencilBond<dim>> &stencil,
             const BondLaw &law,
             const double spacing);

  /// Sites nearer than this to a face of the box supply displacements only, their force is zero:
  /// the reach of the stencil, or twice that if the law is state-based.
  unsigned int margin() const
  {
    return law.state_based() ? 2 * reach : reach;
  }

  /// The force on each site [N]; in 2-D per metre of thickness.
  void evaluate(const LatticeField<dim> &u, const BrokenBonds &broken, LatticeField<dim> &force);

  /// Sites in a row, in the direction of x.
  struct Span
  {
    std::size_t first;
    unsigned int length;
  };

  /// From now on, evaluate() is for these sites, all of them inside the margin.
  void sweep_only(const std::vector<Span> &spans)
  {
    swept = spans;
  }

  /// The force on each site, all bonds whole; bond-based.
  /// @param stretched becomes the sites that have a bond stretched beyond @p limit, some of them
  /// twice; may be null
  void evaluate(const LatticeField<dim> &u,
                LatticeField<dim> &force,
                double limit,
                std::vector<std::size_t> *stretched) const;

  /// Of each site, half of the energy of its bonds, all of them whole; bond-based [J; J/m in 2-D].
  void energies(const LatticeField<dim> &u, std::vector<double> &energy) const;

  /// Stretch of a bond, which must not leave the box.
  double stretch(const LatticeField<dim> &u, const std::size_t site, const unsigned int bond) const;

private:
  /// A bond and its opposite, ready for the sweep.
  struct Pair
  {
    std::ptrdiff_t by;                  ///< stride to the neighbour ahead; the other lies behind
    std::array<double, dim> direction;  ///< e
    std::array<double, dim> force;      ///< k e
    double stiffness;                   ///< k
    std::array<double, dim> dilatation; ///< g e
    double per_length;                  ///< 1/|xi|
  };

  LatticeBox<dim> box;
  BondLaw law;
  std::vector<BondCoefficients<dim>> bonds;
  std::vector<std::ptrdiff_t> strides;
  std::vector<Pair> pairs;
  double dilatation_stiffness; ///< A V
  unsigned int reach;
  std::vector<double> dilatation; ///< theta of each site, if state-based
  std::vector<Span> swept;

  double elongation(const LatticeField<dim> &u, const std::size_t site, const unsigned int b) const;
  void compute_dilatation(const LatticeField<dim> &u, const BrokenBonds &broken);

  template <typename Value, int n>
  void sweep_dilatation(const LatticeField<dim> &u, const std::size_t first);
  template <typename Value, int n>
  void sweep(const LatticeField<dim> &u, const std::size_t first, LatticeField<dim> &force) const;

  /// As sweep(), and which sites have a bond beyond the limit.
  template <typename Value, int n>
  void watch(const LatticeField<dim> &u,
             const std::size_t first,
             const double limit,
             LatticeField<dim> &force,
             std::vector<std::size_t> &stretched) const;

  template <typename Value, int n>
  void sweep_energy(const LatticeField<dim> &u,
                    const std::size_t first,
                    std::vector<double> &energy) const;

  /// Call @p wide(site) for blocks of sites and @p narrow(site) for those of a row shorter than a
  /// block. Some sites are in two blocks.
  template <typename Wide, typename Narrow>
  void for_each_block(const unsigned int margin, const Wide &wide, const Narrow &narrow) const;

  template <typename Wide, typename Narrow>
  void for_each_block_of(const Span &row, const Wide &wide, const Narrow &narrow) const;
};
} // namespace stockwork::peridynamics
