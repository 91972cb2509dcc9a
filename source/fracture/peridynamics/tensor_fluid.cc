#include "flow/conductivity.h"
#include "fracture/peridynamics/peridynamics.h"

#include <deal.II/base/quadrature_lib.h>

namespace stockwork::peridynamics
{
using dealii::Tensor;

namespace
{
/// Aperture at which a closed fracture conducts [m], as that of the network by default.
constexpr double minimum_aperture = 10e-6;
} // namespace


/// After Sun et al. (2021), Eqs. 16 and 17, with the cubic law: in a cell that the fracture passes
/// with area A, rock of height V/A and permeability w^3/(12 V/A) (I - n n) conducts what the
/// fracture does (printed: w^2/12 I, by V/(A w) too much). Segments have no neighbours then and no
/// drop of pressure to the pores, so that their pressure is the cell's mean; their opening, their
/// load on the rock and the wells stay the network's.
template <int dim>
void Peridynamics<dim>::assemble_tensor_fluid(const StepContext &context,
                                              const State &state,
                                              Sink &sink) const
{
  constexpr unsigned int n = 1 << dim;
  const double volume = dealii::Utilities::fixed_power<dim>(zone.spacing());
  const dealii::QGauss<dim> quadrature(2);
  LocalSystem local;
  std::array<Tensor<1, dim>, n> gradient; // along the fracture
  for (const Segment<dim> &segment : owned_segments)
  {
    const LinearFunctional &B = segment.opening, &P = segment.pore_pressure;
    double w = B.constant;
    for (unsigned int k = 0; k < B.bulk.size(); ++k)
      w += B.bulk_coefficients[k] * state.current.bulk(B.bulk[k]);
    const ValueAndSlope cubed = hydraulic_aperture_cubed(w, minimum_aperture);
    const double factor =
      context.effective_dt() / (12. * scene.rock.fluid().viscosity * volume / segment.area);

    local.bulk = P.bulk;
    local.bulk.insert(local.bulk.end(), B.bulk.begin(), B.bulk.end());
    local.reinit();
    for (unsigned int q = 0; q < quadrature.size(); ++q)
    {
      Tensor<1, dim> flow; // gradient of the pressure along the fracture
      for (unsigned int v = 0; v < n; ++v)
      {
        for (unsigned int d = 0; d < dim; ++d)
        {
          gradient[v][d] = (v >> d & 1 ? 1. : -1.) / zone.spacing();
          for (unsigned int e = 0; e < dim; ++e)
            if (e != d)
              gradient[v][d] *= v >> e & 1 ? quadrature.point(q)[e] : 1. - quadrature.point(q)[e];
        }
        gradient[v] -= (gradient[v] * segment.normal) * segment.normal;
        flow += state.current.bulk(P.bulk[v]) * gradient[v];
      }
      const double weight = factor * quadrature.weight(q) * volume;
      for (unsigned int a = 0; a < n; ++a)
      {
        local.residual(a) -= weight * cubed.value * (gradient[a] * flow);
        for (unsigned int b = 0; b < n; ++b)
          local.matrix(a, b) -= weight * cubed.value * (gradient[a] * gradient[b]);
        for (unsigned int k = 0; k < B.bulk.size(); ++k)
          local.matrix(a, n + k) -=
            weight * cubed.slope * B.bulk_coefficients[k] * (gradient[a] * flow);
      }
    }
    sink.add(local);
  }
}

template void
Peridynamics<2>::assemble_tensor_fluid(const StepContext &, const State &, Sink &) const;
template void
Peridynamics<3>::assemble_tensor_fluid(const StepContext &, const State &, Sink &) const;
} // namespace stockwork::peridynamics
