#pragma once

#include <memory>

namespace stockwork::analytical
{
/// A plane-strain hydraulic fracture driven from its middle at a constant rate through an
/// impermeable, infinite elastic body, without fluid lag (Khristianovic & Zheltov 1955, Geertsma &
/// de Klerk 1969; the similarity solution for every toughness after Spence & Sharp 1985, Adachi &
/// Detournay 2002, Garagash & Detournay 2005).
struct KgdParameters
{
  double youngs_modulus; ///< Pa
  double poisson_ratio;
  double viscosity; ///< mu, Pa s, positive
  double toughness; ///< K_Ic, Pa sqrt(m); 0 gives the viscosity vertex
  double rate;      ///< Q0, of both wings per unit thickness, m^2/s

  /// E' = E / (1 - nu^2), Pa.
  double plane_strain_modulus() const;

  /// K_m = 4 sqrt(2/pi) K_Ic / (E'^3 mu' Q0)^(1/4) with mu' = 12 mu: below 1 viscosity governs,
  /// above 4 toughness.
  double dimensionless_toughness() const;
};


/// The profiles of the similarity solution: half length l = gamma L, opening w = eps L Omega(xi),
/// net pressure p = eps E' Pi(xi), with xi = x/l, L = (E' Q0^3 t^4 / mu')^(1/6) and
/// eps = (mu' / (E' t))^(1/3). Solved by Newton's method when made (some 20 ms); accurate to
/// 5e-7 in gamma, Omega(0), Pi(0).
class KgdSimilarity
{
public:
  explicit KgdSimilarity(double dimensionless_toughness);
  ~KgdSimilarity();
  KgdSimilarity(KgdSimilarity &&) noexcept;
  KgdSimilarity &operator=(KgdSimilarity &&) noexcept;

  double gamma() const;

  /// 0 <= xi; zero from the tip on.
  double Omega(double xi) const;

  /// 0 <= xi < 1; tends to minus infinity at the tip.
  double Pi(double xi) const;

private:
  struct Profiles;
  std::unique_ptr<const Profiles> profiles;
};


/// The fracture in physical units. x is the distance from the inlet (either wing), t the time
/// since injection began; lengths in m, pressures in Pa.
class Kgd
{
public:
  explicit Kgd(const KgdParameters &);

  double half_length(double t) const;
  double tip_speed(double t) const;
  double inlet_opening(double t) const;

  /// Net of the in-situ stress.
  double inlet_pressure(double t) const;

  double opening(double x, double t) const;
  double pressure(double x, double t) const;

  /// Of both wings, m^2 per unit thickness.
  double volume(double t) const;

  const KgdSimilarity &similarity() const
  {
    return profiles;
  }

private:
  double length_scale(double t) const;
  double small_number(double t) const;

  KgdParameters parameters;
  double modulus;
  KgdSimilarity profiles;
};


/// The limit of no viscosity: the pressure is uniform and the stress intensity K_Ic at all times
/// (toughness vertex).
class KgdToughnessVertex
{
public:
  /// The viscosity is not used.
  explicit KgdToughnessVertex(const KgdParameters &);

  double half_length(double t) const;
  double inlet_opening(double t) const;
  double pressure(double t) const;
  double opening(double x, double t) const;

private:
  KgdParameters parameters;
  double modulus;
};
} // namespace stockwork::analytical
