#include "fracture/damage/crack_cell.h"

#include "stockwork/mesh/key.h"

#include <cmath>

namespace stockwork::damage
{
using dealii::GeometryInfo;
using dealii::Point;
using dealii::Tensor;

template <int dim>
Point<dim> CrackCell<dim>::centre() const
{
  Point<dim> sum;
  for (const auto &vertex : vertices)
    sum += vertex / n_vertices;
  return sum;
}


template <int dim>
double CrackCell<dim>::angle_to_mesh() const
{
  double cosine = 0.;
  for (unsigned int d = 0; d < dim; ++d)
  {
    const Tensor<1, dim> line = face_centre(2 * d + 1) - face_centre(2 * d);
    cosine = std::max(cosine, std::abs(normal * line) / line.norm());
  }
  return std::acos(std::min(cosine, 1.)) * 180. / dealii::numbers::PI;
}


template <int dim>
bool CrackCell<dim>::crosses(const unsigned int face) const
{
  unsigned int n_plus = 0;
  constexpr unsigned int n = GeometryInfo<dim>::vertices_per_face;
  for (unsigned int v = 0; v < n; ++v)
    n_plus += is_on_plus_side(GeometryInfo<dim>::face_to_cell_vertices(face, v));
  return n_plus > 0 && n_plus < n;
}


template <int dim>
void CrackCell<dim>::part_by_plane()
{
  const double tolerance = 1e-9 * size();
  plus = 0;
  for (unsigned int v = 0; v < n_vertices; ++v)
    if (normal * (vertices[v] - on_plane) > tolerance)
      plus |= 1u << v;
}


template <int dim>
Tensor<1, dim> CrackCell<dim>::gradient_integral(double &volume) const
{
  // Mean over the edges in each direction, of the place and of phi.
  Tensor<2, dim> jacobian;
  Tensor<1, dim> slope;
  constexpr double share = 1. / (n_vertices / 2);
  for (unsigned int v = 0; v < n_vertices; ++v)
    for (unsigned int d = 0; d < dim; ++d)
    {
      const double sign = (v >> d) & 1 ? share : -share;
      for (unsigned int i = 0; i < dim; ++i)
        jacobian[i][d] += sign * vertices[v][i];
      slope[d] += is_on_plus_side(v) ? sign : 0.;
    }
  volume = std::abs(determinant(jacobian));
  return volume * (transpose(invert(jacobian)) * slope);
}


template <int dim>
double CrackCell<dim>::area() const
{
  double volume = 0.;
  return gradient_integral(volume) * normal;
}


template <int dim>
double CrackCell<dim>::volume() const
{
  double result = 0.;
  gradient_integral(result);
  return result;
}


template <int dim>
Tensor<1, dim> CrackCell<dim>::lean() const
{
  double volume = 0.;
  const Tensor<1, dim> gradient = gradient_integral(volume);
  return gradient / (gradient * normal) - normal;
}


template <int dim>
std::array<Tensor<1, dim>, dim - 1> CrackCell<dim>::axes() const
{
  std::array<Tensor<1, dim>, dim - 1> t;
  if constexpr (dim == 2)
    t[0] = dealii::cross_product_2d(normal);
  else
  {
    // The edge that lies least along the normal.
    double least = 2.;
    for (unsigned int d = 0; d < dim; ++d)
    {
      Tensor<1, dim> edge = vertices[1u << d] - vertices[0];
      edge /= edge.norm();
      if (std::abs(edge * normal) < least - 1e-6)
      {
        least = std::abs(edge * normal);
        t[0] = edge - (edge * normal) * normal;
      }
    }
    t[0] /= t[0].norm();
    t[1] = dealii::cross_product_3d(normal, t[0]);
  }
  return t;
}


template <int dim>
std::array<Tensor<1, dim>, CrackCell<dim>::n_points> CrackCell<dim>::points() const
{
  const auto t = axes();
  const double reach = 0.5 * std::pow(area(), 1. / (dim - 1)) / std::sqrt(3.);
  std::array<Tensor<1, dim>, n_points> result;
  for (unsigned int q = 0; q < n_points; ++q)
    for (unsigned int k = 0; k < dim - 1; ++k)
      result[q] += ((q >> k) & 1 ? reach : -reach) * t[k];
  return result;
}


template <int dim>
double CrackCell<dim>::size() const
{
  return std::pow(volume(), 1. / dim);
}


template <int dim>
Point<dim> CrackCell<dim>::face_centre(const unsigned int face) const
{
  Point<dim> sum;
  constexpr unsigned int n = GeometryInfo<dim>::vertices_per_face;
  for (unsigned int v = 0; v < n; ++v)
    sum += vertices[GeometryInfo<dim>::face_to_cell_vertices(face, v)] / n;
  return sum;
}


template <int dim>
Point<dim> CrackCell<dim>::crossing(const unsigned int face) const
{
  Point<dim> sum;
  unsigned int n = 0;
  const auto height = [this](const unsigned int v) { return normal * (vertices[v] - on_plane); };
  for (unsigned int l = 0; l < GeometryInfo<dim>::lines_per_face; ++l)
  {
    const unsigned int line = dim == 2 ? face : GeometryInfo<dim>::face_to_cell_lines(face, l),
                       v = GeometryInfo<dim>::line_to_cell_vertices(line, 0),
                       w = GeometryInfo<dim>::line_to_cell_vertices(line, 1);
    if (is_on_plus_side(v) == is_on_plus_side(w))
      continue;
    // The plane may miss an edge whose ends have got their sides from another cell.
    const double a = height(v), b = height(w);
    const double t = a != b ? std::min(1., std::max(0., a / (a - b))) : 0.5;
    sum += vertices[v] + t * (vertices[w] - vertices[v]);
    ++n;
  }
  return n > 0 ? Point<dim>(sum / n) : centre();
}


template <int dim>
std::uint64_t CrackCell<dim>::key() const
{
  return Key().add(id);
}


template struct CrackCell<2>;
template struct CrackCell<3>;
} // namespace stockwork::damage
