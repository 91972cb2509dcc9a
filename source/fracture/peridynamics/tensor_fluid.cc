#include "flow/conductivity.h"
#include "fracture/peridynamics/peridynamics.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_q.h>

#include <algorithm>
#include <cmath>

namespace stockwork::peridynamics
{
using dealii::Tensor;

namespace
{
/// The functions of a cell of the pore pressure, at the points that its integrals are sums over.
template <int dim>
struct CellShape
{
  struct At
  {
    double weight; ///< [m^dim]
    std::array<double, 1 << dim> value;
    std::array<Tensor<1, dim>, 1 << dim> gradient; ///< [1/m]
  };
  std::vector<At> points;

  explicit CellShape(const double spacing)
  {
    const dealii::FE_Q<dim> element(1);
    const dealii::QGauss<dim> quadrature(2);
    points.resize(quadrature.size());
    for (unsigned int q = 0; q < quadrature.size(); ++q)
    {
      points[q].weight = quadrature.weight(q) * dealii::Utilities::fixed_power<dim>(spacing);
      for (unsigned int v = 0; v < 1u << dim; ++v)
      {
        points[q].value[v] = element.shape_value(v, quadrature.point(q));
        points[q].gradient[v] = element.shape_grad(v, quadrature.point(q)) / spacing;
      }
    }
  }
};

/// Cube of the hydraulic aperture; w^2 height in the closure as published.
ValueAndSlope conductance(const double w,
                          const double minimum_aperture,
                          const double height,
                          const bool as_published)
{
  if (!as_published)
    return hydraulic_aperture_cubed(w, minimum_aperture);
  const double open = std::max(w, 0.),
               squared = std::hypot(open * open, std::pow(minimum_aperture, 2));
  return {squared * height, 2. * std::pow(open, 3) / squared * height};
}
} // namespace


/// After Sun et al. (2021), Eqs. 16 and 17, with the cubic law: in a cell that the fracture passes
/// with area A, rock of height V/A and permeability w^3/(12 V/A) (I - n n) conducts what the
/// fracture does (printed: w^2/12, by V/(A w) too much). Segments have no neighbours then and no
/// drop of pressure to the pores, so that their pressure is the cell's mean; their opening, their
/// load on the rock and the wells stay the network's.
template <int dim>
void Peridynamics<dim>::assemble_tensor_fluid(const StepContext &context,
                                              const State &state,
                                              Sink &sink) const
{
  constexpr unsigned int n = 1 << dim;
  const double volume = dealii::Utilities::fixed_power<dim>(zone.spacing());
  const CellShape<dim> shape(zone.spacing());
  LocalSystem local;
  std::array<Tensor<1, dim>, n> gradient; // along the fracture
  for (const Segment<dim> &segment : owned_segments)
  {
    const LinearFunctional &B = segment.opening, &P = segment.pore_pressure;
    const double w = value(B, state.current);
    const double height = volume / segment.area;
    const ValueAndSlope cubed =
      conductance(w, parameters.minimum_aperture, height, parameters.as_published);
    const double factor = context.effective_dt() / (12. * scene.rock.fluid().viscosity * height);

    local.bulk = P.bulk;
    local.bulk.insert(local.bulk.end(), B.bulk.begin(), B.bulk.end());
    local.reinit();
    for (const auto &at : shape.points)
    {
      Tensor<1, dim> flow; // gradient of the pressure along the fracture
      for (unsigned int v = 0; v < n; ++v)
      {
        gradient[v] = at.gradient[v] - (at.gradient[v] * segment.normal) * segment.normal;
        flow += state.current.bulk(P.bulk[v]) * gradient[v];
      }
      const double weight = factor * at.weight;
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

/// What Sun et al. (2021) print for porous rock, as corrections of what there is otherwise.
/// Momentum: a bond pushes its ends apart by the mean of their pore pressures (Eqs. 7 and 28), and
/// a broken one does not; intact, all bonds together are the elements' load. Mass: in a fracture
/// cell the volume strain does not count, and the storage is that of fluid alone, 1/K_f over the
/// whole cell.
template <int dim>
void Peridynamics<dim>::assemble_published_closure(const StepContext &context,
                                                   const State &state,
                                                   Sink &sink) const
{
  constexpr unsigned int n = 1 << dim;
  const RockProperties &rock = scene.rock.main();
  LocalSystem local;

  const double stretch_of_pressure =
    rock.biot_coefficient / (dim * rock.lame_lambda() + 2. * rock.shear_modulus());
  local.bulk.resize(dim + 2);
  for (const unsigned int i : zone.peridynamic_sites())
    for (unsigned int b = 0; b < stencil.size() && has_rows(i); ++b)
    {
      const Site<dim> &site = zone.sites()[i], &far = zone.sites()[zone.far_end(i, b).site];
      if (!bonds.is_broken(i, b))
        continue;
      const double push =
        0.5 * stretch_of_pressure * site.share * coefficients[b].stiffness * coefficients[b].length;
      local.bulk[dim] = site.pressure_dof;
      local.bulk[dim + 1] = far.pressure_dof;
      local.reinit();
      for (unsigned int d = 0; d < dim; ++d)
      {
        local.bulk[d] = site.dofs[d];
        for (unsigned int end = 0; end < 2; ++end)
        {
          local.matrix(d, dim + end) = -push * coefficients[b].direction[d];
          local.residual(d) +=
            local.matrix(d, dim + end) * state.current.bulk(local.bulk[dim + end]);
        }
      }
      sink.add(local);
    }

  const CellShape<dim> shape(zone.spacing());
  for (unsigned int i = 0; i < owned_segments.size(); ++i)
  {
    const Segment<dim> &segment = owned_segments[i];
    const auto region = regions[zone.active_cell_index(cells[owned_cells[i]].place)];
    const double more_storage =
      (scene.rock.fluid().compressibility - scene.rock(region).inverse_biot_modulus) *
      context.pressure_rate / context.rate;
    const LinearFunctional &B = segment.opening, &P = segment.pore_pressure;
    const auto gain = [&](const auto dof)
    { return state.current.bulk(dof) - state.rate_reference.bulk(dof); };
    local.bulk = P.bulk;
    local.bulk.insert(local.bulk.end(), B.bulk.begin(), B.bulk.end());
    local.reinit();
    for (unsigned int a = 0; a < n; ++a) // what the segment's opening takes comes from nowhere
      for (unsigned int k = 0; k < B.bulk.size(); ++k)
        local.matrix(a, n + k) += segment.area / n * B.bulk_coefficients[k];
    for (const auto &at : shape.points)
      for (unsigned int a = 0; a < n; ++a)
        for (unsigned int v = 0; v < n; ++v)
        {
          local.matrix(a, v) -= more_storage * at.value[a] * at.value[v] * at.weight;
          for (unsigned int d = 0; d < dim; ++d) // the order of the functional, see jumps()
            local.matrix(a, n + v * dim + d) +=
              rock.biot_coefficient * at.value[a] * at.gradient[v][d] * at.weight;
        }
    for (unsigned int a = 0; a < n; ++a)
      for (unsigned int k = 0; k < local.bulk.size(); ++k)
        local.residual(a) += local.matrix(a, k) * gain(local.bulk[k]);
    sink.add(local);
  }
}

#define INSTANTIATE(dim)                                                                          \
  template void Peridynamics<dim>::assemble_tensor_fluid(const StepContext &, const State &,      \
                                                         Sink &) const;                           \
  template void Peridynamics<dim>::assemble_published_closure(const StepContext &, const State &, \
                                                              Sink &) const;
INSTANTIATE(2)
INSTANTIATE(3)
#undef INSTANTIATE
} // namespace stockwork::peridynamics
