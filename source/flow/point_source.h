#pragma once

#include "stockwork/exchange/collectives.h"
#include "stockwork/exchange/scene.h"
#include "stockwork/exchange/segment.h"
#include "stockwork/mesh/mesh_view.h"

#include <vector>

namespace stockwork
{
/// Where a well is open to the rock: a point, or in two dimensions a line across the plane. Its
/// fluid enters the pores over a disc or ball of radius R about it with the density
///
///   w(r) ~ 1 - (r/R)^2,   integral of w = 1,
///
/// and the rock's pressure at it is the mean of the pore pressure with the same weight, so that
/// what couples well and rock is one functional and its transpose. Between the borehole of radius
/// r_w and R, flow is steady and radial (from a time of R^2/c on), and with F(r) the share of the
/// fluid that enters within r
///
///   2-D:  p_b - mean = Q mu/(2 pi k) [ln(R/r_w) - int F^2/r dr],       the integral is 11/24
///   3-D:  p_b - mean = Q mu/(4 pi k) [1/r_w - 1/R - int F^2/r^2 dr],   the integral is 3/(7R)
///
/// The mean that the elements find is less, by the energy of what they cannot follow; for linear
/// elements of edges h_d along e_d that is, to leading order,
///
///   Q mu sum_d int h_d^2/12 (e_d.k.e_d) (d^2 p_1/de_d^2)^2,   p_1 the pressure for Q mu = 1,
///
/// a 24th of Q mu/(2 pi k) where R is two cells. It is added, so that the pressure in the borehole
/// does not hang on the cells.
///
/// This takes the place of Peaceman's well index (1978, SPE J. 18), whose radius belongs to the
/// cells; R is chosen once and kept, so nothing jumps when cells are split. In layered rock r is
/// measured as r^2 = k_e x.k^-1.x with k_e = det(k)^(1/dim), which makes the flow isotropic, and a
/// round borehole becomes an ellipse or ellipsoid, whose pressure far away is that of a circle or
/// sphere of another radius (Peaceman 1983, SPE J. 23).
template <int dim>
class PointSource
{
public:
  /// What the deck says of it.
  struct Entries
  {
    dealii::Point<dim> point;
    double fraction = 1.;        ///< share of the disc or ball that is in the model
    double borehole_radius = 0.; ///< r_w; 0: nobody asks for the pressure in the borehole [m]
    double radius = 0.; ///< R, in layered rock of as large a disc or ball; 0: two cells [m]
  };

  explicit PointSource(const Entries &entries)
    : entries(entries)
    , radius(entries.radius)
  {
  }

  /// The mesh is new. Collective.
  /// @throws InputError with what is wrong with the place: "... is outside of the mesh"
  void setup(const MeshView<dim> &mesh, const Scene<dim> &scene, const Collectives &);

  /// The mean pore pressure [Pa]: the part of it that this rank's cells have; the ranks' sum is
  /// the mean. Its transpose is the density of the source.
  const LinearFunctional &mean_pressure() const
  {
    return functional;
  }

  /// (p_b - mean) over the rate into the model [Pa s/m^3].
  double resistance() const
  {
    return resistance_in_model;
  }

  /// In-situ pore pressure, mean over the source [Pa].
  double in_situ_pressure() const
  {
    return in_situ_mean;
  }

  const dealii::Point<dim> &point() const
  {
    return entries.point;
  }

  double borehole_radius() const
  {
    return entries.borehole_radius;
  }

  /// R [m]; 0 before the first mesh.
  double source_radius() const
  {
    return radius;
  }

  /// Of an earlier run.
  void set_source_radius(const double of_checkpoint)
  {
    radius = of_checkpoint;
  }

  /// Whether a piece of this size about a place comes into the disc or ball.
  bool reaches(const dealii::Point<dim> &place, const double size) const
  {
    return distance(place) < radius + 0.5 * size;
  }

private:
  /// What the cells at the point say. Collective.
  void look_at_cells(const MeshView<dim> &mesh, const Scene<dim> &scene, const Collectives &);

  /// Integrate the weight over the cells. Collective.
  void integrate(const MeshView<dim> &mesh, const Scene<dim> &scene, const Collectives &);

  void check_constraints(const MeshView<dim> &mesh, const Collectives &) const;

  /// Second derivatives of the steady pressure in an unbounded body, by rate and viscosity [1/m^4;
  /// 1/m^5 in 3-D].
  dealii::SymmetricTensor<2, dim> curvature(const dealii::Point<dim> &x) const;

  /// What the linear elements of this mesh lack of the mean pressure, by rate and viscosity [1/m^2;
  /// 1/m^3 in 3-D]. Collective.
  double lack_of_elements(const MeshView<dim> &mesh, const Collectives &) const;

  void find_resistance(const MeshView<dim> &mesh, double viscosity, const Collectives &);

  /// From the point, in the metric of the flow [m].
  double distance(const dealii::Point<dim> &x) const
  {
    const dealii::Tensor<1, dim> d = x - entries.point;
    return std::sqrt(d * (metric * d));
  }

  Entries entries;
  double radius;
  bool is_ready = false;                        ///< has seen a mesh
  dealii::SymmetricTensor<2, dim> permeability; ///< at the point [m^2]
  dealii::SymmetricTensor<2, dim> metric = dealii::unit_symmetric_tensor<dim>();
  double widest = 1., narrowest = 1.; ///< semi-axes of the disc or ball over R
  LinearFunctional functional;
  double resistance_in_model = 0.;
  double in_situ_mean = 0.;
};
} // namespace stockwork
