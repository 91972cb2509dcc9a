#pragma once

#include "verification/analytical/poroelastic_medium.h"
#include "verification/reference_solution.h"

#include <deal.II/base/tensor.h>
#include <deal.II/lac/vector.h>

namespace stockwork::reference
{
// One function per file of this folder; all are entered in the table of reference_solution.cc.
// `prm` stands in subsection Verification. Each throws InputError if the deck does not describe
// its problem.
template <int dim>
using Made = std::unique_ptr<ReferenceSolution<dim>>;

template <int dim>
Made<dim> make_column(const dealii::ParameterHandler &prm, const ReferenceInput<dim> &input);
Made<2> make_mandel(const dealii::ParameterHandler &prm, const ReferenceInput<2> &input);
template <int dim>
Made<dim> make_cryer(const dealii::ParameterHandler &prm, const ReferenceInput<dim> &input);
template <int dim>
Made<dim> make_bar_wave(const dealii::ParameterHandler &prm, const ReferenceInput<dim> &input);
template <int dim>
Made<dim> make_porous_wave(const dealii::ParameterHandler &prm, const ReferenceInput<dim> &input);
Made<2> make_line_crack(const dealii::ParameterHandler &prm, const ReferenceInput<2> &input);
Made<2> make_crack_in_box(const dealii::ParameterHandler &prm, const ReferenceInput<2> &input);
Made<2> make_parallel_cracks(const dealii::ParameterHandler &prm, const ReferenceInput<2> &input);
Made<2> make_double_cantilever(const dealii::ParameterHandler &prm, const ReferenceInput<2> &input);
Made<2> make_three_point_bending(const dealii::ParameterHandler &prm,
                                 const ReferenceInput<2> &input);
Made<2> make_kgd(const dealii::ParameterHandler &prm, const ReferenceInput<2> &input);
Made<2> make_kgd_vertex(const dealii::ParameterHandler &prm, const ReferenceInput<2> &input);
Made<2> make_kgd_carter(const dealii::ParameterHandler &prm, const ReferenceInput<2> &input);
Made<2> make_kgd_box(const dealii::ParameterHandler &prm, const ReferenceInput<2> &input);
template <int dim>
Made<dim> make_cavity(const dealii::ParameterHandler &prm, const ReferenceInput<dim> &input);
Made<2> make_footing(const dealii::ParameterHandler &prm, const ReferenceInput<2> &input);
template <int dim>
Made<dim> make_sources(const dealii::ParameterHandler &prm, const ReferenceInput<dim> &input);
Made<3> make_penny_crack(const dealii::ParameterHandler &prm, const ReferenceInput<3> &input);
Made<3> make_pkn(const dealii::ParameterHandler &prm, const ReferenceInput<3> &input);
Made<3> make_radial(const dealii::ParameterHandler &prm, const ReferenceInput<3> &input);

/// Share of the first disc among the cracks that planes of symmetry leave in the model.
double share_of_disc(const ReferenceInput<3> &input);

/// The rock of the deck in the form of the analytical solutions.
inline analytical::PoroelasticMedium medium(const Rock &rock)
{
  const RockProperties &r = rock.main();
  return {r.young_modulus,        r.poisson_ratio, r.biot_coefficient,
          r.inverse_biot_modulus, r.permeability,  rock.fluid().viscosity};
}


/// Displacement and pore pressure as the function that errors and boundary values are formed with.
template <int dim>
class Field : public dealii::Function<dim>
{
public:
  explicit Field(const bool has_pore_pressure)
    : dealii::Function<dim>(dim + (has_pore_pressure ? 1 : 0))
  {
  }

  double value(const dealii::Point<dim> &point, const unsigned int component) const override
  {
    dealii::Tensor<1, dim> displacement;
    double pressure = 0.;
    evaluate(point, displacement, pressure);
    return component < dim ? displacement[component] : pressure;
  }

  void vector_value(const dealii::Point<dim> &point, dealii::Vector<double> &values) const override
  {
    dealii::Tensor<1, dim> displacement;
    double pressure = 0.;
    evaluate(point, displacement, pressure);
    for (unsigned int d = 0; d < dim; ++d)
      values(d) = displacement[d];
    if (this->n_components > dim)
      values(dim) = pressure;
  }

protected:
  /// At the function's time.
  virtual void evaluate(const dealii::Point<dim> &point,
                        dealii::Tensor<1, dim> &displacement,
                        double &pressure) const = 0;
};
} // namespace stockwork::reference
