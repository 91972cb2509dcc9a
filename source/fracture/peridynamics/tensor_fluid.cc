#include "flow/permeability_tensor.h"
#include "fracture/peridynamics/peridynamics.h"

#include <deal.II/base/geometry_info.h>

#include <algorithm>
#include <cmath>

namespace stockwork::peridynamics
{
namespace
{
/// The zone's cells are squares (cubes) of one size.
template <int dim>
permeability_tensor::Cell<dim> cell_of_size(const double spacing)
{
  std::array<dealii::Point<dim>, 1 << dim> vertices;
  for (unsigned int v = 0; v < vertices.size(); ++v)
    vertices[v] = spacing * dealii::GeometryInfo<dim>::unit_cell_vertex(v);
  return permeability_tensor::Cell<dim>(vertices);
}

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


template <int dim>
void Peridynamics<dim>::assemble_tensor_fluid(const StepContext &context,
                                              const State &state,
                                              Sink &sink) const
{
  const auto cell = cell_of_size<dim>(lattice.zone.spacing());
  for (const Segment<dim> &segment : fracture.owned_segments)
    permeability_tensor::add_flow(
      cell, segment,
      conductance(value(segment.opening, state.current), parameters.minimum_aperture,
                  cell.volume / segment.area, parameters.as_published),
      context.effective_dt() / scene.rock.fluid().viscosity, state, sink);
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
  for (const unsigned int i : lattice.zone.peridynamic_sites())
    for (unsigned int b = 0; b < lattice.stencil.size() && has_rows(i); ++b)
    {
      const Site<dim> &site = lattice.zone.sites()[i],
                      &far = lattice.zone.sites()[lattice.zone.far_end(i, b).site];
      if (!lattice.bonds.is_broken(i, b))
        continue;
      const double push = 0.5 * stretch_of_pressure * site.share *
                          lattice.coefficients[b].stiffness * lattice.coefficients[b].length;
      local.bulk[dim] = site.pressure_dof;
      local.bulk[dim + 1] = far.pressure_dof;
      local.reinit();
      for (unsigned int d = 0; d < dim; ++d)
      {
        local.bulk[d] = site.dofs[d];
        for (unsigned int end = 0; end < 2; ++end)
        {
          local.matrix(d, dim + end) = -push * lattice.coefficients[b].direction[d];
          local.residual(d) +=
            local.matrix(d, dim + end) * state.current.bulk(local.bulk[dim + end]);
        }
      }
      sink.add(local);
    }

  const auto shape = cell_of_size<dim>(lattice.zone.spacing());
  for (unsigned int i = 0; i < fracture.owned_segments.size(); ++i)
  {
    const Segment<dim> &segment = fracture.owned_segments[i];
    const auto region =
      lattice
        .regions[lattice.zone.active_cell_index(fracture.cells[fracture.owned_cells[i]].place)];
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
