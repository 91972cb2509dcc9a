#pragma once

#include "fracture/peridynamics/bond_forces.h"
#include "fracture/peridynamics/lanes.h"

#include <deque>
#include <string_view>
#include <unordered_map>

namespace stockwork::peridynamics
{
/// The bonds of sites whose bonds are not all those of the lattice, beside cracks and free
/// boundaries: each has a stiffness of its own, up to an elongation of its own. Neighbouring sites
/// of a row are swept together, as by BondForces.
template <int dim>
class UnevenBonds
{
public:
  /// So many sites beyond what the bonds of a site reach, before and behind it in the order of the
  /// box, are read with it, and have to be in the box.
  static constexpr int overhang = n_lanes - 1;

  UnevenBonds(const std::vector<BondCoefficients<dim>> &bonds,
              const LatticeBox<dim> &box,
              const std::vector<std::ptrdiff_t> &strides);

  /// From now on, the bonds of this site are among those swept. They are absent until they are set.
  void add(std::size_t site);

  /// Of a site that has been added.
  /// @param stiffness [N/m]
  /// @param limit elongation beyond which the site is to be looked at [m]
  void set(std::size_t site, unsigned int bond, double stiffness, double limit);

  /// All sites of the start have been added and set, each row before the next. Until then rows with
  /// the same bonds, as along a straight boundary, keep them together: less to store and to read.
  void end_start();

  /// The force on these sites.
  /// @param beyond becomes the sites that have a bond longer than its limit; may be null
  void evaluate(const LatticeField<dim> &u,
                LatticeField<dim> &force,
                std::vector<std::size_t> *beyond) const;

  /// Of each of these sites, half of the energy of its bonds [J; J/m in 2-D].
  void energies(const LatticeField<dim> &u, std::vector<double> &energy) const;

private:
  /// Sites that follow one another.
  struct Row
  {
    std::size_t first;
    unsigned int set;                 ///< of values
    std::array<bool, n_lanes> is_one; ///< of these sites
  };

  /// Of a bond of a row.
  struct Values
  {
    double stiffness[n_lanes] = {}, limit[n_lanes];
  };

  /// The row that was added last is complete: let it have its set together with one like it.
  void share(Row &row);

  template <bool looks>
  void sweep(const LatticeField<dim> &u,
             LatticeField<dim> &force,
             std::vector<std::size_t> *beyond) const;

  std::vector<BondCoefficients<dim>> bonds;
  std::vector<std::ptrdiff_t> strides;
  std::vector<unsigned int> row_of; ///< of n_lanes sites of the box each
  std::vector<Row> rows;
  std::deque<std::vector<Values>> sets; ///< by bond
  std::size_t n_shared = 0;             ///< so many sets may be those of several rows
  std::unordered_map<std::string_view, unsigned int> known; ///< of these, at the start; by bytes
  bool is_starting = true;
};
} // namespace stockwork::peridynamics
