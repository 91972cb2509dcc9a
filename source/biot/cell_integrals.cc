#include "biot/cell_integrals.h"

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>

namespace stockwork
{
using namespace dealii;

template <int dim>
bool is_axis_parallel_box(const typename Triangulation<dim>::cell_iterator &cell,
                          Tensor<1, dim> &extents)
{
  const Point<dim> origin = cell->vertex(0);
  for (unsigned int d = 0; d < dim; ++d)
    extents[d] = cell->vertex(1u << d)[d] - origin[d];
  const double tolerance = 1e-12 * extents.norm();
  for (unsigned int v = 0; v < cell->n_vertices(); ++v)
    for (unsigned int d = 0; d < dim; ++d)
      if (std::abs(cell->vertex(v)[d] - origin[d] - ((v >> d) & 1u ? extents[d] : 0.)) > tolerance)
        return false;
  return true;
}


template <int dim>
CellIntegrals<dim>::CellIntegrals(const Mapping<dim> &mapping, const FiniteElement<dim> &fe)
  : layout(fe)
  , fe_values(mapping,
              fe,
              QGauss<dim>(fe.base_element(0).degree + 1),
              update_values | update_gradients | update_JxW_values)
{
  const unsigned int n_u = layout.n_u, n_p = layout.n_p;
  gradients.resize(dim * dim * n_u * n_u);
  masses.resize(n_u * n_u);
  divergences.resize(dim * n_p * n_u);
  pressure_gradients.resize(n_p * n_p);
  pressure_masses.resize(n_p * n_p);
  pressure_means.resize(n_p);
  shape_gradients.resize(dim * n_u);
  shape_values.resize(n_u);

  unit.gradients.resize(gradients.size());
  unit.masses.resize(masses.size());
  unit.divergences.resize(divergences.size());
  unit.pressure_gradients.resize(dim * n_p * n_p);
  unit.pressure_masses.resize(n_p * n_p);
  unit.pressure_means.resize(n_p);

  const QGauss<dim> quadrature(fe.base_element(0).degree + 1);
  std::vector<double> value(n_u), pressure(n_p);
  std::vector<Tensor<1, dim>> gradient(n_u), pressure_gradient(n_p);
  for (unsigned int q = 0; q < quadrature.size(); ++q)
  {
    const Point<dim> x = quadrature.point(q);
    const double w = quadrature.weight(q);
    for (unsigned int a = 0; a < n_u; ++a)
    {
      value[a] = fe.base_element(0).shape_value(a, x);
      gradient[a] = fe.base_element(0).shape_grad(a, x);
    }
    for (unsigned int a = 0; a < n_p; ++a)
    {
      pressure[a] = fe.base_element(1).shape_value(a, x);
      pressure_gradient[a] = fe.base_element(1).shape_grad(a, x);
    }

    for (unsigned int a = 0; a < n_u; ++a)
      for (unsigned int b = 0; b < n_u; ++b)
      {
        for (unsigned int i = 0; i < dim; ++i)
          for (unsigned int j = 0; j < dim; ++j)
            unit.gradients[((i * dim + j) * n_u + a) * n_u + b] +=
              gradient[a][i] * gradient[b][j] * w;
        unit.masses[a * n_u + b] += value[a] * value[b] * w;
      }
    for (unsigned int a = 0; a < n_p; ++a)
    {
      unit.pressure_means[a] += pressure[a] * w;
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int b = 0; b < n_u; ++b)
          unit.divergences[(i * n_p + a) * n_u + b] += pressure[a] * gradient[b][i] * w;
      for (unsigned int b = 0; b < n_p; ++b)
      {
        unit.pressure_masses[a * n_p + b] += pressure[a] * pressure[b] * w;
        for (unsigned int i = 0; i < dim; ++i)
          unit.pressure_gradients[(i * n_p + a) * n_p + b] +=
            pressure_gradient[a][i] * pressure_gradient[b][i] * w;
      }
    }
  }
}


template <int dim>
bool CellIntegrals<dim>::reinit(const typename DoFHandler<dim>::active_cell_iterator &cell)
{
  Tensor<1, dim> extents;
  if (is_axis_parallel_box<dim>(cell, extents))
  {
    // Vertices carry rounding errors, so equal boxes are equal to a few digits less than all.
    if ((extents - box).norm() <= 1e-12 * extents.norm())
      return false;
    by_scaling(extents);
    box = extents;
  }
  else
  {
    fe_values.reinit(cell);
    by_quadrature();
    box = Tensor<1, dim>();
  }
  return true;
}


template <int dim>
void CellIntegrals<dim>::by_scaling(const Tensor<1, dim> &extents)
{
  const unsigned int n_u = layout.n_u, n_p = layout.n_p;
  volume = 1.;
  for (unsigned int d = 0; d < dim; ++d)
    volume *= extents[d];

  const auto scale = [](double *out, const double *in, const unsigned int n, const double factor)
  {
    for (unsigned int k = 0; k < n; ++k)
      out[k] = factor * in[k];
  };
  for (unsigned int i = 0; i < dim; ++i)
    for (unsigned int j = 0; j < dim; ++j)
      scale(&gradients[(i * dim + j) * n_u * n_u], &unit.gradients[(i * dim + j) * n_u * n_u],
            n_u * n_u, volume / (extents[i] * extents[j]));
  scale(masses.data(), unit.masses.data(), masses.size(), volume);
  if (n_p == 0)
    return;
  for (unsigned int i = 0; i < dim; ++i)
    scale(&divergences[i * n_p * n_u], &unit.divergences[i * n_p * n_u], n_p * n_u,
          volume / extents[i]);
  scale(pressure_masses.data(), unit.pressure_masses.data(), n_p * n_p, volume);
  scale(pressure_means.data(), unit.pressure_means.data(), n_p, volume);
  std::fill(pressure_gradients.begin(), pressure_gradients.end(), 0.);
  for (unsigned int i = 0; i < dim; ++i)
  {
    const double factor = volume / (extents[i] * extents[i]);
    const double *in = &unit.pressure_gradients[i * n_p * n_p];
    for (unsigned int k = 0; k < n_p * n_p; ++k)
      pressure_gradients[k] += factor * in[k];
  }
}


template <int dim>
void CellIntegrals<dim>::by_quadrature()
{
  const unsigned int n_u = layout.n_u, n_p = layout.n_p;
  for (auto *array :
       {&gradients, &masses, &divergences, &pressure_gradients, &pressure_masses, &pressure_means})
    std::fill(array->begin(), array->end(), 0.);
  volume = 0.;
  for (const unsigned int q : fe_values.quadrature_point_indices())
  {
    const double w = fe_values.JxW(q);
    volume += w;
    for (unsigned int a = 0; a < n_u; ++a)
    {
      const Tensor<1, dim> &gradient = fe_values.shape_grad(layout.u[a * dim], q);
      for (unsigned int d = 0; d < dim; ++d)
        shape_gradients[d * n_u + a] = gradient[d];
      shape_values[a] = fe_values.shape_value(layout.u[a * dim], q);
    }
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < dim; ++j)
        for (unsigned int a = 0; a < n_u; ++a)
        {
          const double left = shape_gradients[i * n_u + a] * w;
          const double *right = &shape_gradients[j * n_u];
          double *out = &gradients[((i * dim + j) * n_u + a) * n_u];
          for (unsigned int b = 0; b < n_u; ++b)
            out[b] += left * right[b];
        }
    for (unsigned int a = 0; a < n_u; ++a)
    {
      const double left = shape_values[a] * w;
      for (unsigned int b = 0; b < n_u; ++b)
        masses[a * n_u + b] += left * shape_values[b];
    }
    for (unsigned int a = 0; a < n_p; ++a)
    {
      const double value = fe_values.shape_value(layout.p[a], q) * w;
      pressure_means[a] += value;
      for (unsigned int i = 0; i < dim; ++i)
      {
        const double *right = &shape_gradients[i * n_u];
        double *out = &divergences[(i * n_p + a) * n_u];
        for (unsigned int b = 0; b < n_u; ++b)
          out[b] += value * right[b];
      }
      const Tensor<1, dim> gradient = fe_values.shape_grad(layout.p[a], q) * w;
      for (unsigned int b = 0; b < n_p; ++b)
      {
        pressure_masses[a * n_p + b] += value * fe_values.shape_value(layout.p[b], q);
        pressure_gradients[a * n_p + b] += gradient * fe_values.shape_grad(layout.p[b], q);
      }
    }
  }
}


template class CellIntegrals<2>;
template class CellIntegrals<3>;
template bool is_axis_parallel_box<2>(const typename Triangulation<2>::cell_iterator &,
                                      Tensor<1, 2> &);
template bool is_axis_parallel_box<3>(const typename Triangulation<3>::cell_iterator &,
                                      Tensor<1, 3> &);
} // namespace stockwork
