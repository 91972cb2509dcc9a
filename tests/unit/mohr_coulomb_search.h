#pragma once

#include "rock/mohr_coulomb/strength.h"

#include <array>
#include <cmath>
#include <vector>

namespace stockwork::test
{
/// The return to the Mohr-Coulomb surface by trying everything, for tests: all solutions of its
/// equations on one, two or three of the nine planes of the surface, unsorted. They are admissible,
/// flow goes forwards along each of their planes, and the cohesion is the one that belongs to the
/// plastic strain. On given planes the plastic strain is linear in the cohesion, so its size is the
/// root of a quadratic equation.
class MohrCoulombSearch
{
public:
  using Vector = std::array<double, 3>;

  MohrCoulombSearch(const mohr_coulomb::Strength &strength, const double lambda, const double mu)
    : strength(strength)
    , mu(mu)
  {
    const double sine = std::sin(strength.friction_angle), flow = std::sin(strength.dilation_angle);
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int j = 0; j < 3; ++j)
        if (i != j)
        {
          Plane plane;
          plane.a[i] = 1. + sine;
          plane.a[j] = -1. + sine;
          plane.g[i] = 1. + flow;
          plane.g[j] = -1. + flow;
          plane.k = 2. * std::cos(strength.friction_angle);
          planes.push_back(plane);
        }
    if (strength.has_cut_off())
      for (unsigned int i = 0; i < 3; ++i)
      {
        Plane plane;
        plane.a[i] = plane.g[i] = 1.;
        plane.k = strength.tension_cut_off / strength.cohesion;
        planes.push_back(plane);
      }
    for (Plane &plane : planes)
      for (unsigned int d = 0; d < 3; ++d)
        plane.step[d] = lambda * (plane.g[0] + plane.g[1] + plane.g[2]) + 2. * mu * plane.g[d];
  }

  /// @param before equivalent plastic strain
  std::vector<Vector> operator()(const Vector &trial, const double before = 0.) const
  {
    std::vector<Vector> found;
    const unsigned int n = planes.size();
    for (unsigned int i = 0; i < n; ++i)
    {
      try_planes({i}, trial, before, found);
      for (unsigned int j = i + 1; j < n; ++j)
      {
        try_planes({i, j}, trial, before, found);
        for (unsigned int k = j + 1; k < n; ++k)
          try_planes({i, j, k}, trial, before, found);
      }
    }
    return found;
  }

private:
  struct Plane
  {
    Vector a{}, g{}, step{}; ///< a . s = c k, flow along g, which takes the stress along step
    double k = 0.;
  };

  static double dot(const Vector &a, const Vector &b)
  {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  }

  void try_planes(const std::vector<unsigned int> &active,
                  const Vector &trial,
                  const double before,
                  std::vector<Vector> &found) const
  {
    // Gauss's elimination of (a_i . D g_j) m_j = a_i . trial - c k_i, for both terms on the right.
    const unsigned int n = active.size();
    double m[3][5];
    for (unsigned int i = 0; i < n; ++i)
    {
      for (unsigned int j = 0; j < n; ++j)
        m[i][j] = dot(planes[active[i]].a, planes[active[j]].step);
      m[i][n] = dot(planes[active[i]].a, trial);
      m[i][n + 1] = -planes[active[i]].k;
    }
    for (unsigned int c = 0; c < n; ++c)
    {
      unsigned int pivot = c;
      for (unsigned int r = c + 1; r < n; ++r)
        if (std::abs(m[r][c]) > std::abs(m[pivot][c]))
          pivot = r;
      if (std::abs(m[pivot][c]) < 1e-9 * mu)
        return;
      for (unsigned int col = 0; col < n + 2; ++col)
        std::swap(m[c][col], m[pivot][col]);
      for (unsigned int r = 0; r < n; ++r)
        if (r != c)
        {
          const double factor = m[r][c] / m[c][c];
          for (unsigned int col = c; col < n + 2; ++col)
            m[r][col] -= factor * m[c][col];
        }
    }
    Vector constant{}, slope{}; // of the plastic strain as a function of the cohesion
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int d = 0; d < 3; ++d)
      {
        constant[d] += m[i][n] / m[i][i] * planes[active[i]].g[d];
        slope[d] += m[i][n + 1] / m[i][i] * planes[active[i]].g[d];
      }
    for (const double cohesion : cohesions(constant, slope, before))
    {
      Vector stress = trial;
      bool admissible = true;
      const double k = 2. * strength.cohesion;
      for (unsigned int i = 0; i < n; ++i)
      {
        const double multiplier = (m[i][n] + cohesion * m[i][n + 1]) / m[i][i];
        admissible = admissible && multiplier > -1e-12 * k / mu;
        for (unsigned int d = 0; d < 3; ++d)
          stress[d] -= multiplier * planes[active[i]].step[d];
      }
      for (const Plane &plane : planes)
        admissible = admissible && dot(plane.a, stress) < cohesion * plane.k + 1e-10 * k;
      if (admissible)
        found.push_back(stress);
    }
  }

  /// Those for which the plastic strain constant + c slope leads to the cohesion c.
  std::vector<double>
  cohesions(const Vector &constant, const Vector &slope, const double before) const
  {
    const double modulus = strength.hardening_modulus, start = strength.cohesion_after(before);
    if (modulus == 0. || start == strength.final_cohesion)
      return {start};
    const auto strain = [&](const double c)
    {
      return Vector{
        {constant[0] + c * slope[0], constant[1] + c * slope[1], constant[2] + c * slope[2]}};
    };
    std::vector<double> result;
    const double room = (strength.final_cohesion - start) / modulus;
    const Vector last = strain(strength.final_cohesion);
    if (std::isfinite(room) && std::sqrt(2. / 3. * dot(last, last)) >= room)
      result.push_back(strength.final_cohesion);
    // 3/2 x^2 = |e + H x slope|^2 with e the strain at the start
    const Vector e = strain(start);
    const double a = 1.5 - modulus * modulus * dot(slope, slope), b = modulus * dot(e, slope),
                 c = dot(e, e), root = b * b + a * c;
    if (root < 0.)
      return result;
    // of a x^2 - 2 b x - c = 0, without differences of what is nearly equal
    const double sum = b + (b >= 0. ? 1. : -1.) * std::sqrt(root);
    for (const double x : {sum / a, -c / sum})
      if (x >= 0. && x < room)
        result.push_back(start + modulus * x);
    return result;
  }

  mohr_coulomb::Strength strength;
  double mu;
  std::vector<Plane> planes;
};
} // namespace stockwork::test
