// A straight crack under given net pressure: in a body so large that its walls do not count
// (Sneddon & Elliott 1946), or in the middle of a box with rollers on all sides.
#include "verification/analytical/line_crack.h"
#include "verification/analytical/anisotropic_crack.h"
#include "verification/analytical/crack_in_box.h"

#include "stockwork/base/error.h"
#include "stockwork/rock/linear_stiffness.h"

#include "mesh/box.h"
#include "verification/reference/problems.h"

#include <cmath>
#include <functional>
#include <optional>

namespace stockwork::reference
{
using namespace dealii;

namespace
{
/// A straight crack; with its mirror image where it begins on a plane of symmetry.
struct StraightCrack
{
  Point<2> centre;
  double half_length;
  double angle;
  unsigned int n_wings; ///< in the model
};


StraightCrack straight_crack(const ReferenceInput<2> &input)
{
  if (input.cracks.empty())
    throw InputError("The reference solution of a pressurised crack needs an initial crack.");
  if (!std::isfinite(input.crack_pressure))
    throw InputError("The reference solution of a pressurised crack needs its pressure given, "
                     "'Cracks/Fluid pressure'.");
  if (input.layered || input.has_stress_gradient || input.cracks.size() > 1 ||
      input.cracks[0].size() > 2)
    throw InputError(
      "The reference solution of a pressurised crack is for one straight crack, rock "
      "without regions and in-situ stress without a gradient.");
  if (input.crack_pressure < 0.)
    throw InputError("The reference solution of a pressurised crack is for one that is open: "
                     "'Cracks/Fluid pressure' is below the in-situ compression across the crack.");
  const Point<2> first = input.cracks[0].front(), last = input.cracks[0].back();
  const Tensor<1, 2> along = last - first;
  StraightCrack crack{(first + last) / 2., along.norm() / 2., std::atan2(along[1], along[0]), 2};
  for (const auto &[end, other] : {std::make_pair(first, last), std::make_pair(last, first)})
    if (on_side_of_box(end, input.lower, input.upper))
      return {end, (other - end).norm(), crack.angle, 1};
  return crack;
}


class LineCrackField : public Field<2>
{
public:
  using Displacement = std::function<Tensor<1, 2>(const Point<2> &)>;

  LineCrackField(const Displacement &displacement_at, const bool has_pore_pressure)
    : Field<2>(has_pore_pressure)
    , displacement_at(displacement_at)
  {
  }

protected:
  void evaluate(const Point<2> &point, Tensor<1, 2> &displacement, double &pressure) const override
  {
    displacement = displacement_at(point);
    pressure = 0.;
  }

private:
  Displacement displacement_at;
};


/// Young's modulus and Poisson's ratio with which plane strain is what the rock is in its plane.
std::pair<double, double> plane_strain_constants(const RockProperties &rock)
{
  if (!rock.plane_stress)
    return {rock.young_modulus, rock.poisson_ratio};
  const double ratio = rock.poisson_ratio / (1. + rock.poisson_ratio);
  return {2. * rock.shear_modulus() * (1. + ratio), ratio};
}


class LineCrackReference : public ReferenceSolution<2>
{
public:
  LineCrackReference(const analytical::LineCrackParameters &parameters,
                     const unsigned int n_wings,
                     const bool has_pore_pressure)
    : crack(parameters)
    , n_wings(n_wings)
    , solution(std::make_shared<LineCrackField>(
        [line = this->crack](const Point<2> &x)
        {
          const auto u = line.displacement(x[0], x[1]);
          return Tensor<1, 2>({u[0], u[1]});
        },
        has_pore_pressure))
  {
  }

  std::string name() const override
  {
    return "Crack in an infinite body (Sneddon & Elliott 1946)";
  }

  std::shared_ptr<Function<2>> field() const override
  {
    return solution;
  }

  std::map<std::string, double> values(double) const override
  {
    const auto intensity = crack.stress_intensity();
    return {{"inlet_aperture", crack.opening(0.)},
            {"fracture_volume", 0.5 * n_wings * crack.volume()},
            {"stress_intensity_I", intensity.mode_I},
            {"stress_intensity_II", intensity.mode_II}};
  }

private:
  analytical::LineCrack crack;
  unsigned int n_wings;
  std::shared_ptr<LineCrackField> solution;
};


class AnisotropicCrackReference : public ReferenceSolution<2>
{
public:
  AnisotropicCrackReference(const analytical::AnisotropicCrack &crack,
                            const unsigned int n_wings,
                            const bool has_pore_pressure)
    : crack(crack)
    , n_wings(n_wings)
    , solution(std::make_shared<LineCrackField>(
        [crack](const Point<2> &x) { return crack.displacement(x); }, has_pore_pressure))
  {
  }

  std::string name() const override
  {
    return "Crack in an infinite anisotropic body (Lekhnitskii 1963; Sih, Paris and Irwin 1965)";
  }

  std::shared_ptr<Function<2>> field() const override
  {
    return solution;
  }

  std::map<std::string, double> values(double) const override
  {
    return {{"inlet_aperture", crack.opening()},
            {"fracture_volume", 0.5 * n_wings * crack.volume()},
            {"stress_intensity_I", crack.mode_I()},
            {"stress_intensity_II", crack.mode_II()},
            {"energy_release_rate", crack.energy_release_rate()}};
  }

private:
  analytical::AnisotropicCrack crack;
  unsigned int n_wings;
  std::shared_ptr<LineCrackField> solution;
};


class CrackInBoxReference : public ReferenceSolution<2>
{
public:
  CrackInBoxReference(const analytical::CrackInBoxParameters &parameters,
                      const unsigned int n_wings)
    : crack(parameters)
    , n_wings(n_wings)
  {
  }

  std::string name() const override
  {
    return "Crack in a box with rollers (collinear and mirrored cracks)";
  }

  std::map<std::string, double> values(double) const override
  {
    return {{"inlet_aperture", crack.opening(0.)},
            {"fracture_volume", 0.5 * n_wings * crack.volume()},
            {"stress_intensity_I", crack.stress_intensity()}};
  }

private:
  analytical::CrackInBox crack;
  unsigned int n_wings;
};
} // namespace


Made<2> make_line_crack(const ParameterHandler &, const ReferenceInput<2> &input)
{
  const StraightCrack crack = straight_crack(input);
  const RockProperties &rock = input.rock.main();
  auto [modulus, ratio] = plane_strain_constants(rock);
  if (rock.stiffness)
  {
    const LinearStiffness<2> stiffness(rock);
    if (!PlaneElasticity(stiffness.tensor(), direction(crack.angle)).is_degenerate())
      return std::make_unique<AnisotropicCrackReference>(
        analytical::AnisotropicCrack(stiffness.tensor(), crack.centre, crack.half_length,
                                     crack.angle, input.crack_pressure, input.crack_shear),
        crack.n_wings, input.has_pore_pressure);
    // Isotropic in the plane of the run, as layers in this plane are.
    const double mu = stiffness.shear_modulus();
    ratio = 0.5 * (1. - mu / stiffness.bulk_modulus());
    modulus = 2. * mu * (1. + ratio);
  }
  return std::make_unique<LineCrackReference>(
    analytical::LineCrackParameters{modulus, ratio, crack.half_length, input.crack_pressure,
                                    input.crack_shear, crack.angle, crack.centre[0],
                                    crack.centre[1]},
    crack.n_wings, input.has_pore_pressure);
}


Made<2> make_crack_in_box(const ParameterHandler &, const ReferenceInput<2> &input)
{
  const StraightCrack crack = straight_crack(input);
  const RockProperties &rock = input.rock.main();
  if (std::abs(std::sin(crack.angle)) > 1e-8)
    throw InputError("The reference solution 'crack in box' is for a crack along the x axis.");
  const auto [modulus, ratio] = plane_strain_constants(rock);
  const double half_width =
    crack.n_wings == 1 ? input.upper[0] - input.lower[0] : 0.5 * (input.upper[0] - input.lower[0]);
  return std::make_unique<CrackInBoxReference>(
    analytical::CrackInBoxParameters{modulus, ratio, crack.half_length, half_width,
                                     0.5 * (input.upper[1] - input.lower[1]), input.crack_pressure},
    crack.n_wings);
}
} // namespace stockwork::reference
