// Waves along the last axis from the loaded top of a column that cannot expand sideways: dry (bar
// wave) or saturated and drained at the top (porous wave).
#include "verification/analytical/bar_wave.h"
#include "verification/analytical/porous_wave.h"

#include "stockwork/base/error.h"
#include "stockwork/base/quantity.h"

#include "verification/reference/problems.h"

#include <cmath>
#include <map>

namespace stockwork::reference
{
using namespace dealii;

namespace
{
double required_rise_time(const ParameterHandler &prm)
{
  if (prm.get("Rise time").empty())
    throw EntryError("Verification/Rise time", "", "a time > 0 s, such as '2 s'");
  return get_quantity(prm, "Rise time", dimension::time);
}


/// The final load on the top, after a look whether the deck applies it as the solution assumes.
template <int dim>
double load_on_top(const ReferenceInput<dim> &input,
                   const double rise_time,
                   const std::function<double(double)> &history,
                   const std::string &formula)
{
  const double load = -input.normal_traction("top", 1e3 * rise_time);
  for (const double s : {0.1, 0.3, 0.5, 0.8, 1.5, 4.})
    if (std::abs(-input.normal_traction("top", s * rise_time) - load * history(s)) >
        1e-6 * std::abs(load))
      throw InputError("The reference solution assumes a load on the top that grows as " + formula +
                       " with s = t/'Verification/Rise time', but 'Boundary conditions/Normal "
                       "traction' says otherwise.");
  return load;
}


template <int dim>
class BarWaveField : public Field<dim>
{
public:
  BarWaveField(const analytical::BarWaveParameters &parameters,
               const double top,
               const bool has_pore_pressure)
    : Field<dim>(has_pore_pressure)
    , wave(parameters)
    , top(top)
  {
  }

protected:
  void evaluate(const Point<dim> &point, Tensor<1, dim> &displacement, double &) const override
  {
    displacement[dim - 1] = -wave.displacement(top - point[dim - 1], this->get_time());
  }

private:
  analytical::BarWave wave;
  double top;
};


template <int dim>
class PorousWaveField : public Field<dim>
{
public:
  PorousWaveField(const analytical::PorousWaveParameters &parameters, const double top)
    : Field<dim>(true)
    , length(parameters.length)
    , wave(parameters)
    , now(wave.at(parameters.rise_time))
    , top(top)
  {
  }

  void set_time(const double time) override
  {
    if (time != this->get_time() && time > 0.)
    {
      now = wave.at(time);
      known.clear();
    }
    Function<dim>::set_time(time);
  }

protected:
  void
  evaluate(const Point<dim> &point, Tensor<1, dim> &displacement, double &pressure) const override
  {
    if (this->get_time() <= 0.)
      return;
    // A value is expensive, and many points are at the same depth.
    const double depth = top - point[dim - 1];
    const auto key = std::lround(depth / (1e-9 * length));
    auto found = known.find(key);
    if (found == known.end())
      found =
        known.emplace(key, std::make_pair(now.displacement(depth), now.pressure(depth))).first;
    displacement[dim - 1] = -found->second.first;
    pressure = found->second.second;
  }

private:
  double length;
  analytical::PorousWave wave;
  analytical::PorousWaveAtTime now;
  double top;
  mutable std::map<long, std::pair<double, double>> known; ///< by depth, to 1e-9 of the length
};


template <int dim>
class WaveReference : public ReferenceSolution<dim>
{
public:
  WaveReference(const std::string &title, std::shared_ptr<Field<dim>> solution)
    : title(title)
    , solution(std::move(solution))
  {
  }

  std::string name() const override
  {
    return title;
  }

  std::shared_ptr<Function<dim>> field() const override
  {
    return solution;
  }

private:
  std::string title;
  std::shared_ptr<Field<dim>> solution;
};
} // namespace


template <int dim>
Made<dim> make_bar_wave(const ParameterHandler &prm, const ReferenceInput<dim> &input)
{
  const double ramp_time = required_rise_time(prm);
  const double load = load_on_top<dim>(
    input, ramp_time,
    [](const double s) { return s < 1. ? std::pow(std::sin(0.5 * numbers::PI * s), 2) : 1.; },
    "sin^2(pi s/2) up to s = 1");
  return std::make_unique<WaveReference<dim>>(
    "Wave in a bar (d'Alembert)",
    std::make_shared<BarWaveField<dim>>(
      analytical::BarWaveParameters{medium(input.rock).uniaxial_modulus(),
                                    input.rock.main().density,
                                    input.upper[dim - 1] - input.lower[dim - 1], load, ramp_time},
      input.upper[dim - 1], input.has_pore_pressure));
}


template <int dim>
Made<dim> make_porous_wave(const ParameterHandler &prm, const ReferenceInput<dim> &input)
{
  const double rise_time = required_rise_time(prm);
  const double load = load_on_top<dim>(
    input, rise_time, [](const double s) { return 1. - std::exp(-s) * (1. + s + 0.5 * s * s); },
    "1 - exp(-s) (1 + s + s^2/2)");
  const analytical::PoroelasticMedium rock = medium(input.rock);
  return std::make_unique<WaveReference<dim>>(
    "Wave in a saturated column (u-p form, Laplace transform)",
    std::make_shared<PorousWaveField<dim>>(
      analytical::PorousWaveParameters{
        rock.uniaxial_modulus(), input.rock.main().density, rock.biot_coefficient,
        rock.inverse_biot_modulus, rock.permeability / rock.viscosity,
        input.upper[dim - 1] - input.lower[dim - 1], load, rise_time},
      input.upper[dim - 1]));
}


template Made<2> make_bar_wave<2>(const ParameterHandler &, const ReferenceInput<2> &);
template Made<3> make_bar_wave<3>(const ParameterHandler &, const ReferenceInput<3> &);
template Made<2> make_porous_wave<2>(const ParameterHandler &, const ReferenceInput<2> &);
template Made<3> make_porous_wave<3>(const ParameterHandler &, const ReferenceInput<3> &);
} // namespace stockwork::reference
