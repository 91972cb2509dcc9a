// A plane-strain hydraulic fracture, driven at a constant rate; the model holds
// both wings, or one beside a plane of symmetry.
#include "verification/analytical/kgd.h"
#include "verification/analytical/hydraulic_fracture.h"

#include "stockwork/base/error.h"

#include "mesh/box.h"
#include "verification/reference/problems.h"

namespace stockwork::reference
{
using namespace dealii;

namespace
{
analytical::KgdParameters kgd_parameters(const ReferenceInput<2> &input)
{
  const RockProperties &rock = input.rock.main();
  if (!(input.injection_rate > 0.))
    throw InputError(
      "The reference solution of the KGD fracture needs a well with a positive rate.");
  if (!(rock.energy_release_rate > 0.))
    throw InputError(
      "The reference solution of the KGD fracture needs 'Rock/Fracture toughness' or "
      "'Rock/Critical energy release rate'.");
  if (input.n_wells > 1 || !input.rate_is_constant)
    throw InputError(
      "The reference solution of the KGD fracture is for one well of constant rate.");
  if (input.layered)
    throw InputError("The reference solution of the KGD fracture is for rock without regions.");
  if (input.has_stress_gradient)
    throw InputError(
      "The reference solution of the KGD fracture is for in-situ stress without a gradient.");
  if (input.cracks.size() > 1)
    throw InputError("The reference solution of the KGD fracture is for one crack.");
  if (input.start_time != 0.)
    throw InputError("The reference solution of the KGD fracture begins with the pumping, at 'Time/"
                     "Start time = 0'.");
  return {rock.young_modulus, rock.plane_stress ? 0. : rock.poisson_ratio,
          input.rock.fluid().viscosity, rock.toughness(), input.injection_rate};
}


/// Those without leak-off.
analytical::KgdParameters tight_kgd_parameters(const ReferenceInput<2> &input)
{
  if (input.leaks)
    throw InputError("This reference solution is for a fracture that does not leak; 'Fracture "
                     "flow/Leak-off' is set. 'kgd carter' has Carter leak-off, 'none' compares "
                     "with nothing.");
  return kgd_parameters(input);
}


/// The number of wings in the model: one if a crack begins on the boundary. The well must be where
/// the solution has it, and pump what so many wings take.
unsigned int n_wings(const ReferenceInput<2> &input)
{
  if (input.cracks.empty())
    throw InputError("The reference solution of the KGD fracture needs an initial crack.");
  const Point<2> first = input.cracks[0].front(), last = input.cracks[0].back();
  unsigned int wings = 2;
  Point<2> mouth = first + 0.5 * (last - first);
  for (const Point<2> &end : {first, last})
    if (on_side_of_box(end, input.lower, input.upper))
    {
      wings = 1;
      mouth = end;
    }
  if (std::abs(input.fraction_in_model - 0.5 * wings) > 1e-6)
    throw InputError(
      wings == 2 ? "The reference solution of the KGD fracture has both wings in the model: "
                   "'Fraction in model = 1' of the well."
                 : "The reference solution of the KGD fracture has one wing in the model, for the "
                   "crack begins on a side: 'Fraction in model = 0.5' of the well.");
  for (const Point<2> &point : input.perforations)
    if (point.distance(mouth) > 0.1 * first.distance(last))
      throw InputError("The reference solution of the KGD fracture is pumped from the middle of "
                       "the crack, or from the side on which it begins.");
  return wings;
}


class KgdReference : public ReferenceSolution<2>
{
public:
  KgdReference(const analytical::KgdParameters &parameters, const unsigned int wings)
    : kgd(parameters)
    , wings(wings)
  {
  }

  std::string name() const override
  {
    return "KGD, self-similar for every toughness (Adachi & Detournay 2002)";
  }

  std::map<std::string, double> values(const double time) const override
  {
    return {{"equivalent_length", wings * kgd.half_length(time)},
            {"inlet_aperture", kgd.inlet_opening(time)},
            {"net_inlet_pressure", kgd.inlet_pressure(time)},
            {"fracture_volume", 0.5 * wings * kgd.volume(time)}};
  }

private:
  analytical::Kgd kgd;
  unsigned int wings;
};


class KgdVertexReference : public ReferenceSolution<2>
{
public:
  KgdVertexReference(const analytical::KgdParameters &parameters, const unsigned int wings)
    : kgd(parameters)
    , rate(parameters.rate)
    , wings(wings)
  {
  }

  std::string name() const override
  {
    return "KGD, toughness vertex";
  }

  std::map<std::string, double> values(const double time) const override
  {
    return {{"equivalent_length", wings * kgd.half_length(time)},
            {"inlet_aperture", kgd.inlet_opening(time)},
            {"net_inlet_pressure", kgd.pressure(time)},
            {"fracture_volume", 0.5 * wings * rate * time}};
  }

private:
  analytical::KgdToughnessVertex kgd;
  double rate;
  unsigned int wings;
};


class KgdHistoryReference : public ReferenceSolution<2>
{
public:
  KgdHistoryReference(const analytical::HydraulicFractureParameters &parameters,
                      const double last_time,
                      const unsigned int wings,
                      const std::string &title)
    : kgd(parameters, last_time)
    , leaks(parameters.leak_off_coefficient > 0.)
    , wings(wings)
    , title(title)
  {
  }

  std::string name() const override
  {
    return title;
  }

  double valid_until() const override
  {
    return kgd.valid_until();
  }

  std::map<std::string, double> values(const double time) const override
  {
    std::map<std::string, double> result = {
      {"equivalent_length", wings * kgd.half_length(time)},
      {"inlet_aperture", kgd.inlet_opening(time)},
      {"net_inlet_pressure", kgd.inlet_pressure(time)},
      {"fracture_volume", 0.5 * wings * kgd.fracture_volume(time)}};
    if (leaks)
      result["leaked_volume"] = 0.5 * wings * kgd.leaked_volume(time);
    return result;
  }

private:
  analytical::HydraulicFracture kgd;
  bool leaks;
  unsigned int wings;
  std::string title;
};
} // namespace


Made<2> make_kgd(const ParameterHandler &, const ReferenceInput<2> &input)
{
  return std::make_unique<KgdReference>(tight_kgd_parameters(input), n_wings(input));
}


Made<2> make_kgd_vertex(const ParameterHandler &, const ReferenceInput<2> &input)
{
  return std::make_unique<KgdVertexReference>(tight_kgd_parameters(input), n_wings(input));
}


Made<2> make_kgd_carter(const ParameterHandler &, const ReferenceInput<2> &input)
{
  if (!(input.carter_coefficient > 0.))
    throw InputError("The reference solution 'kgd carter' needs 'Fracture flow/Leak-off = carter' "
                     "with a positive coefficient.");
  return std::make_unique<KgdHistoryReference>(
    analytical::HydraulicFractureParameters{kgd_parameters(input), input.carter_coefficient},
    input.end_time, n_wings(input), "KGD with Carter leak-off (Adachi & Detournay 2008)");
}


Made<2> make_kgd_box(const ParameterHandler &, const ReferenceInput<2> &input)
{
  const unsigned int wings = n_wings(input);
  if (input.leaks && !(input.carter_coefficient > 0.))
    throw InputError("The reference solution 'kgd box' knows Carter leak-off only.");
  const auto &crack = input.cracks[0];
  if (std::abs(crack.front()[1] - crack.back()[1]) > 1e-3 * crack.front().distance(crack.back()))
    throw InputError("The reference solution 'kgd box' is for a crack along the x axis.");
  for (const char *side : {"left", "right", "bottom", "top"})
    if (input.is_roller && !input.is_roller(side))
      throw InputError("The reference solution 'kgd box' has rollers all round; '" +
                       std::string(side) + "' is none.");
  return std::make_unique<KgdHistoryReference>(
    analytical::HydraulicFractureParameters{kgd_parameters(input), input.carter_coefficient,
                                            (input.upper[0] - input.lower[0]) / wings,
                                            0.5 * (input.upper[1] - input.lower[1])},
    input.end_time, wings, "KGD in a box with rollers all round");
}
} // namespace stockwork::reference
