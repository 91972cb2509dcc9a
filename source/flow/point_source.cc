#include "flow/point_source.h"

#include "stockwork/base/error.h"
#include "stockwork/base/quantity.h"

#include "mesh/geometry.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_values.h>

#include <boost/math/special_functions/ellint_rf.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>

namespace stockwork
{
using namespace dealii;

namespace
{
/// R in edges of the cells at the point. With fewer, elements do not carry the hill of pressure
/// within R; with more, what is left of the mesh is lost.
constexpr double cells_of_source = 2.;

/// Of what a disc or ball cut by sides has in the model.
constexpr double tolerance_of_share = 0.01;


/// Integral of 1 - (r/R)^2 over the whole disc or ball.
template <int dim>
double whole_weight(const double radius)
{
  return dim == 2 ? 0.5 * numbers::PI * radius * radius
                  : 8. * numbers::PI / 15. * radius * radius * radius;
}


/// Whether a cell, its border included, has a point.
template <int dim, class CellIterator>
bool has_point(const Mapping<dim> &mapping, const CellIterator &cell, const Point<dim> &point)
{
  if (cell->center().distance(point) > cell->diameter())
    return false;
  try
  {
    return GeometryInfo<dim>::is_inside_unit_cell(mapping.transform_real_to_unit_cell(cell, point),
                                                  1e-6);
  }
  catch (const typename Mapping<dim>::ExcTransformationFailed &)
  {
    return false;
  }
}


/// Of rock whose permeability is the law's own affair: nothing.
template <int dim>
bool permeability_is_constant(const Scene<dim> &scene, const types::material_id region)
{
  return !scene.rock_law || !scene.rock_law(region).changes_permeability();
}


template <int dim>
double difference(const SymmetricTensor<2, dim> &a, const SymmetricTensor<2, dim> &b)
{
  return (a - b).norm() / b.norm();
}
} // namespace


template <int dim>
void PointSource<dim>::look_at_cells(const MeshView<dim> &mesh,
                                     const Scene<dim> &scene,
                                     const Collectives &collectives)
{
  double size = 0.;
  constexpr unsigned int n = SymmetricTensor<2, dim>::n_independent_components;
  std::vector<double> components(n, -std::numeric_limits<double>::infinity());
  for (const auto &cell : mesh.dof_handler.active_cell_iterators())
    if (cell->is_locally_owned() && has_point<dim>(mesh.mapping, cell, entries.point))
    {
      size = std::max(size, cell_size(cell));
      const auto k =
        scene.rock.at(cell->material_id(), cell->center()).template permeability_tensor<dim>();
      for (unsigned int i = 0; i < n; ++i)
        components[i] =
          std::max(components[i], k[SymmetricTensor<2, dim>::unrolled_to_component_indices(i)]);
    }
  size = collectives.max(size);
  if (size == 0.)
    throw InputError("is outside of the mesh");
  for (unsigned int i = 0; i < n; ++i)
    permeability[SymmetricTensor<2, dim>::unrolled_to_component_indices(i)] =
      collectives.max(components[i]);
  if (entries.borehole_radius > 0.)
  {
    const double det = determinant(permeability);
    if (!(det > 0.))
      throw InputError("is in rock without permeability");
    const double mean = std::pow(det, 1. / dim);
    metric = mean * invert(permeability);
    const auto k = eigenvalues(permeability);
    constexpr double most = 20.; // seen: 1 % off at 10, 58 % at 100 where layers cross the cells
    if (k[0] > most * k[dim - 1])
      throw InputError("is in rock that lets more than 20 times as much fluid through along its "
                       "layers as across, where the cells do not resolve the pressure at a well: "
                       "leave 'Borehole radius' empty");
    widest = std::sqrt(k[0] / mean);
    narrowest = std::sqrt(k[dim - 1] / mean);
  }
  if (radius == 0.)
    radius = std::max(cells_of_source * size / narrowest, 2. * entries.borehole_radius);
  else if (!is_ready && entries.radius > 0. && radius * narrowest < size * (1. - 1e-6))
    throw InputError("has a source of radius " + to_string(radius * narrowest, dimension::length) +
                     " in a cell of " + to_string(size, dimension::length) +
                     ": take smaller cells there, or a larger 'Source radius'");
}


template <int dim>
void PointSource<dim>::integrate(const MeshView<dim> &mesh,
                                 const Scene<dim> &scene,
                                 const Collectives &collectives)
{
  const FiniteElement<dim> &fe = mesh.dof_handler.get_fe();
  const FEValuesExtractors::Scalar pressure(dim);
  std::vector<unsigned int> of_pressure;
  for (unsigned int i = 0; i < fe.n_dofs_per_cell(); ++i)
    if (fe.system_to_component_index(i).first == dim)
      of_pressure.push_back(i);

  // Parts of a quarter of the narrow radius: the weight is smooth but for its edge.
  std::map<unsigned int, std::unique_ptr<FEValues<dim>>> values_of; // by parts of an edge
  std::vector<types::global_dof_index> dofs(fe.n_dofs_per_cell());
  std::map<types::global_dof_index, double> coefficients;
  double share = 0., in_situ = 0., other_rock = 0., changes = 0.;
  for (const auto &cell : mesh.dof_handler.active_cell_iterators())
  {
    if (!cell->is_locally_owned() ||
        cell->center().distance(entries.point) > radius * widest + 0.5 * cell->diameter())
      continue;
    const unsigned int parts =
      std::clamp(std::ceil(4. * cell_size(cell) / (radius * narrowest)), 1., 16.);
    std::unique_ptr<FEValues<dim>> &values = values_of[parts];
    if (!values)
      values = std::make_unique<FEValues<dim>>(
        mesh.mapping, fe, QIterated<dim>(QGauss<1>(3), parts),
        update_values | update_quadrature_points | update_JxW_values);
    values->reinit(cell);
    cell->get_dof_indices(dofs);
    double in_cell = 0.;
    for (const unsigned int q : values->quadrature_point_indices())
    {
      const double r = distance(values->quadrature_point(q)) / radius;
      if (r >= 1.)
        continue;
      const double w = (1. - r * r) * values->JxW(q);
      in_cell += w;
      if (scene.in_situ_pore_pressure)
        in_situ += w * scene.in_situ_pore_pressure(values->quadrature_point(q));
      for (const unsigned int i : of_pressure)
        coefficients[dofs[i]] += w * (*values)[pressure].value(i, q);
    }
    if (in_cell == 0.)
      continue;
    share += in_cell;
    const auto k =
      scene.rock.at(cell->material_id(), cell->center()).template permeability_tensor<dim>();
    other_rock = std::max(other_rock, difference(k, permeability));
    if (!permeability_is_constant(scene, cell->material_id()))
      changes = 1.;
  }
  share = collectives.sum(share);
  if (const double found = share / whole_weight<dim>(radius);
      std::abs(found - entries.fraction) > tolerance_of_share * entries.fraction)
    throw InputError(
      "has " + to_string(found, dimension::number) + " of its " + (dim == 2 ? "disc" : "ball") +
      " of radius " + to_string(radius, dimension::length) +
      " in the model, where 'Fraction in model' says " +
      to_string(entries.fraction, dimension::number) +
      ": move it away from the boundary, or exactly onto planes of symmetry, or take smaller cells "
      "there or a 'Source radius'");
  if (entries.borehole_radius > 0. && collectives.max(other_rock) > 1e-9)
    throw InputError("is nearer than " + to_string(radius, dimension::length) +
                     " to rock of another permeability, where the pressure in the borehole is not "
                     "known: move it, take smaller cells there, or leave 'Borehole radius' empty");
  if (entries.borehole_radius > 0. && collectives.max(changes) > 0.)
    throw InputError(
      "is in rock whose permeability hangs on the stress, where the pressure in the "
      "borehole is not known: leave 'Borehole radius' empty, or 'Rock/Permeability decay stress'");

  functional = LinearFunctional();
  for (const auto &[dof, coefficient] : coefficients)
  {
    functional.bulk.push_back(dof);
    functional.bulk_coefficients.push_back(coefficient / share);
  }
  functional.constant = in_situ / share;
  in_situ_mean = collectives.sum(functional.constant);
}


template <int dim>
void PointSource<dim>::check_constraints(const MeshView<dim> &mesh,
                                         const Collectives &collectives) const
{
  // What enters at a prescribed pressure is gone at once.
  const auto is_prescribed = [&](const types::global_dof_index dof)
  {
    const auto *entries = mesh.constraints.get_constraint_entries(dof);
    return mesh.constraints.is_constrained(dof) && (entries == nullptr || entries->empty());
  };
  bool found = false;
  for (unsigned int i = 0; i < functional.bulk.size(); ++i)
  {
    found |= is_prescribed(functional.bulk[i]);
    if (const auto *entries = mesh.constraints.get_constraint_entries(functional.bulk[i]))
      for (const auto &entry : *entries)
        found |= is_prescribed(entry.first);
  }
  if (collectives.max(found ? 1. : 0.) > 0.)
    throw InputError("has cells within " + to_string(radius, dimension::length) +
                     " that lie at a side whose pore pressure is given: move it, or take smaller "
                     "cells there");
}


template <int dim>
SymmetricTensor<2, dim> PointSource<dim>::curvature(const Point<dim> &x) const
{
  const Tensor<1, dim> d = x - entries.point;
  const double r = distance(x), s = std::min(r / radius, 1.);
  const double mean = std::pow(determinant(permeability), 1. / dim);
  const double density = r < radius ? (1. - s * s) / whole_weight<dim>(radius) : 0.;
  // The share of the fluid that enters within r, over r^dim.
  const double within =
    dim == 2 ? (2. - s * s) * s * s / (r * r) : 0.5 * (5. - 3. * s * s) * s * s * s / (r * r * r);
  const double slope = -within / ((dim == 2 ? 2. : 4.) * numbers::PI * mean); // p'/r
  const double second = -density / mean - (dim - 1) * slope;                  // p''
  const Tensor<1, dim> along = metric * d;
  return slope * metric + ((second - slope) / (r * r)) * symmetrize(outer_product(along, along));
}


template <int dim>
double PointSource<dim>::lack_of_elements(const MeshView<dim> &mesh,
                                          const Collectives &collectives) const
{
  // It falls with the fourth power of the distance.
  constexpr double far = 8.;
  std::map<unsigned int, std::unique_ptr<FEValues<dim>>> values_of; // by parts of an edge
  double sum = 0.;
  for (const auto &cell : mesh.dof_handler.active_cell_iterators())
  {
    const double nearest = cell->center().distance(entries.point) - 0.5 * cell->diameter();
    if (!cell->is_locally_owned() || nearest > far * radius * widest)
      continue;
    const unsigned int parts =
      std::clamp(std::ceil(4. * cell_size(cell) / std::max(radius * narrowest, nearest)), 1., 16.);
    std::unique_ptr<FEValues<dim>> &values = values_of[parts];
    if (!values)
      values = std::make_unique<FEValues<dim>>(mesh.mapping, mesh.dof_handler.get_fe(),
                                               QIterated<dim>(QGauss<1>(2), parts),
                                               update_quadrature_points | update_JxW_values);
    values->reinit(cell);
    std::array<Tensor<1, dim>, dim> edges;
    for (unsigned int d = 0; d < dim; ++d)
      edges[d] = cell->face(2 * d + 1)->center() - cell->face(2 * d)->center();
    for (const unsigned int q : values->quadrature_point_indices())
    {
      const auto second = curvature(values->quadrature_point(q));
      for (const Tensor<1, dim> &h : edges)
      {
        const double along = h * (second * h);
        sum += values->JxW(q) / 12. * (h * (permeability * h)) * along * along /
               (h.norm_square() * h.norm_square());
      }
    }
  }
  return collectives.sum(sum);
}


template <int dim>
void PointSource<dim>::find_resistance(const MeshView<dim> &mesh,
                                       const double viscosity,
                                       const Collectives &collectives)
{
  if (entries.borehole_radius == 0.)
    return;
  if (entries.borehole_radius < 1e-6 * radius)
    throw InputError("has a borehole of radius " +
                     to_string(entries.borehole_radius, dimension::length) +
                     ", less than a millionth of that of its source, " +
                     to_string(radius, dimension::length) + ": is the unit right?");
  const auto k = eigenvalues(permeability);
  const double mean = std::pow(determinant(permeability), 1. / dim);
  double resistance;
  if constexpr (dim == 2)
  {
    // An ellipse at one pressure is a circle of the mean of its semi-axes.
    const double borehole =
      0.5 * entries.borehole_radius * (std::sqrt(mean / k[0]) + std::sqrt(mean / k[1]));
    resistance = (std::log(radius / borehole) - 11. / 24.) / (2. * numbers::PI * mean);
  }
  else
  {
    // An ellipsoid at one pressure: its capacity (Carlson's integral R_F).
    const double inverse =
      boost::math::ellint_rf(mean / k[0], mean / k[1], mean / k[2]) / entries.borehole_radius;
    resistance = (inverse - 10. / (7. * radius)) / (4. * numbers::PI * mean);
  }
  resistance += lack_of_elements(mesh, collectives) / entries.fraction;
  resistance_in_model = viscosity * resistance / entries.fraction;
  if (!(resistance > 0.))
    throw InputError("has a source of radius " + to_string(radius, dimension::length) +
                     ", which is not much more than that of its borehole: leave 'Source radius' "
                     "empty, or make it twice as large");
}


template <int dim>
void PointSource<dim>::setup(const MeshView<dim> &mesh,
                             const Scene<dim> &scene,
                             const Collectives &collectives)
{
  look_at_cells(mesh, scene, collectives);
  integrate(mesh, scene, collectives);
  if (!is_ready)
    check_constraints(mesh, collectives);
  find_resistance(mesh, scene.rock.fluid().viscosity, collectives);
  is_ready = true;
}


template class PointSource<2>;
template class PointSource<3>;
} // namespace stockwork
