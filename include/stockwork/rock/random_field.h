#pragma once

#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/point.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace stockwork
{
/// How constants of the rock vary from place to place: a constant of the deck times a factor that
/// has Weibull's distribution (Zhang et al. 2022, Eq. 41) with the scale 1,
///
///   P(factor < x) = 1 - exp(-x^m),   mean Gamma(1 + 1/m).
///
/// The factor is constant in each cell of a cubic lattice that has nothing to do with the mesh, and
/// a function of place and seed alone: it is the same on every mesh and rank and after a restart.
///
/// Correlated: a cell has the mean, with the weight exp(-2 r^2/l^2), of normal deviates of the
/// cells around it, made to have the variance 1 again, so that cells at the distance r are
/// correlated by exp(-r^2/l^2) in the deviate (to 0.3 % from two cells per l on); from the deviate
/// follows the factor of the same probability.
class RandomField
{
public:
  enum Property : unsigned int
  {
    young_modulus,
    tensile_strength,
    energy_release_rate, ///< in shear as well
    permeability,        ///< across the layers as well
    n_properties
  };

  /// As the deck calls it.
  static const char *name(Property property);

  /// Subsection `Random field`. In a region an empty entry means "as in the rock at large".
  static void declare_parameters(dealii::ParameterHandler &prm, bool is_region);

  /// @param path of the rock's subsection, for messages
  /// @param inherited of the rock at large, for a region; else one without properties
  /// @throws EntryError
  void parse_parameters(dealii::ParameterHandler &prm,
                        const std::string &path,
                        const RandomField &inherited);

  /// Whether anything varies.
  bool is_random() const;

  bool varies(const Property property) const
  {
    return has[property];
  }

  /// Whether what linear rock is assembled from varies.
  bool varies_in_bulk() const
  {
    return has[young_modulus] || has[permeability];
  }

  /// Of each property at a place; 1 for one that does not vary.
  template <int dim>
  std::array<double, n_properties> factors(const dealii::Point<dim> &place) const;

  double lattice_spacing() const
  {
    return spacing;
  }

  double mean_factor() const;

  /// Its standard deviation.
  double deviation() const;

  /// "Young modulus, tensile strength: Weibull, m = 10, lattice of 2 m, seed 1".
  std::string describe() const;

private:
  using Indices = std::array<std::int64_t, 3>; ///< of a cell of the lattice

  /// Number of the draw, which properties may share.
  std::uint64_t key(Property property, const Indices &cell) const;

  /// Normal deviate of a cell by itself.
  double normal_deviate(Property property, const Indices &cell) const;

  /// The probability of a greater factor.
  template <int dim>
  double exceedance(Property property, const Indices &cell) const;

  /// The weights of a row of cells around one, whose squares have the sum 1.
  void set_weights();

  std::array<bool, n_properties> has{};
  double modulus = 0.; ///< m, called the Weibull modulus or shape
  double spacing = 0.; ///< of the lattice [m]
  double length = 0.;  ///< of correlation [m]
  std::uint64_t seed = 0;
  bool independent = false;    ///< each property has a draw of its own
  std::vector<double> weights; ///< one for each distance in cells; empty: no correlation
};
} // namespace stockwork
