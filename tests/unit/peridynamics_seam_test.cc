// Waves across the rim of the peridynamic zone: a strip that cannot expand sideways, elements
// below, bonds above, and a pulse that comes from the elements. Stiffness and mass are those that
// the program assembles. Lengths in cells, wave speed one.
#include <doctest/doctest.h>

#include "scenario.h"

#include <deal.II/lac/lapack_full_matrix.h>
#include <deal.II/lac/vector.h>

#include <cmath>

namespace stockwork::peridynamics_seam_test
{
using Matrix = dealii::LAPACKFullMatrix<double>;
using Vector = dealii::Vector<double>;

namespace
{
enum class Mass
{
  consistent, ///< of the elements, in all rows: what the model takes
  lumped      ///< gathered at the nodes, in the rows of bonds
};

/// Nodes of the strip, and the first one with bonds.
constexpr unsigned int n_nodes = 301, seam = 150;

/// Of the strip in tests/data/strip.prm, per area. All nodes of a layer move alike.
struct Strip
{
  template <int dim>
  static Strip assemble(std::vector<std::string> settings, const Mass mass = Mass::consistent)
  {
    if (dim == 3)
    {
      const std::vector<std::string> space{
        "Dimension=3", "Mesh/Box/Lower corner=0, 0, 0", "Mesh/Box/Upper corner=1 m, 1 m, 300 m",
        "Boundary conditions/Roller=left, right, front, back, bottom"};
      settings.insert(settings.begin(), space.begin(), space.end());
    }
    Strip strip;
    strip.stiffness = layers<dim>(settings).first;
    settings.push_back("Time/Inertia=on");
    const auto [sum, acceleration] = layers<dim>(settings);
    strip.masses = sum;
    strip.masses.add(-1., strip.stiffness);
    strip.masses /= acceleration;
    if (mass == Mass::lumped)
      for (unsigned int i = seam; i + 4 < n_nodes; ++i)
      {
        double total = 0.;
        for (unsigned int j = 0; j < n_nodes; ++j)
        {
          total += strip.masses(i, j);
          strip.masses(i, j) = 0.;
        }
        strip.masses(i, i) = total;
      }
    return strip;
  }

  Matrix stiffness, masses;
  unsigned int n = n_nodes;

private:
  /// Rows of the nodes along one edge, per area, and the factor of the mass in them.
  template <int dim>
  static std::pair<Matrix, double> layers(const std::vector<std::string> &settings)
  {
    ScenarioIn<dim> scenario(STOCKWORK_TEST_DATA "/strip.prm", settings);
    scenario.begin_step();
    std::map<dealii::types::global_dof_index, unsigned int> layer_of, row_of;
    for (const auto &cell : scenario.system.bulk_dofs().active_cell_iterators())
      for (const unsigned int v : cell->vertex_indices())
      {
        const auto x = cell->vertex(v);
        double aside = 0.;
        for (unsigned int d = 0; d + 1 < dim; ++d)
          aside += x[d];
        const auto dof = cell->vertex_dof_index(v, dim - 1);
        layer_of[dof] = std::lround(x[dim - 1]);
        if (aside < 0.5)
          row_of[dof] = std::lround(x[dim - 1]);
      }
    Matrix matrix(n_nodes);
    matrix = 0.;
    for (const auto &entry : scenario.linearise().bulk)
      if (const auto row = row_of.find(entry.row()); row != row_of.end())
        if (const auto column = layer_of.find(entry.column()); column != layer_of.end())
          matrix(row->second, column->second) += (1 << (dim - 1)) * entry.value();
    return {matrix, scenario.context.acceleration};
  }
};

/// A pulse of the given length, 100 cells from the left end, runs to the right for some time.
struct Motion
{
  Motion(const Strip &strip, const double length, const double end, const double dt)
    : u(strip.n)
    , v(strip.n)
  {
    for (unsigned int i = 0; i < strip.n; ++i)
      if (const double x = (i - 100.) / length; std::abs(x) < 0.5)
      {
        u(i) = 0.5 + 0.5 * std::cos(2. * M_PI * x);
        v(i) = M_PI / length * std::sin(2. * M_PI * x);
      }
    // Newmark's scheme with beta = 1/4, gamma = 1/2, is the trapezoidal rule.
    Matrix system(strip.masses);
    system *= 4. / (dt * dt);
    system.add(1., strip.stiffness);
    system.compute_lu_factorization();
    Vector next(strip.n), product(strip.n), known(strip.n);
    for (double t = 0.; t < end; t += dt)
    {
      known = v;
      known *= 4. / dt;
      known.add(4. / (dt * dt), u);
      strip.masses.vmult(next, known);
      strip.stiffness.vmult(product, u);
      next -= product;
      system.solve(next);
      for (unsigned int i = 0; i < strip.n; ++i)
        v(i) = 2. / dt * (next(i) - u(i)) - v(i);
      u = next;
    }
  }

  /// Of the elements between the first nodes.
  double energy(const unsigned int n_nodes) const
  {
    double sum = 0.;
    for (unsigned int i = 0; i + 1 < n_nodes; ++i)
      sum += 0.5 * (u(i + 1) - u(i)) * (u(i + 1) - u(i)) +
             (v(i) * v(i) + v(i) * v(i + 1) + v(i + 1) * v(i + 1)) / 6.;
    return sum;
  }

  Vector u, v;
};

/// Energy that comes back into the elements, over what was sent: that of the difference to a strip
/// of elements alone, for they leave short waves behind, too.
double reflected_energy(const Strip &elements, const Strip &both, const double length)
{
  const double end = 110., dt = 0.25;
  const Motion sent(elements, length, 0., dt), alone(elements, length, end, dt);
  Motion back(both, length, end, dt);
  back.u -= alone.u;
  back.v -= alone.v;
  return back.energy(seam) / sent.energy(n_nodes);
}

const std::vector<std::string> without_bonds{"Fracture/Model=none"};
} // namespace


TEST_CASE("peridynamics: long waves pass between elements and bonds, short ones return")
{
  const Strip elements = Strip::assemble<2>(without_bonds), both = Strip::assemble<2>({});
  // A wrong modulus of bonds would reflect as well, and pass for something else: that of a layer
  // inside.
  double modulus = 0.;
  for (unsigned int j = 0; j < n_nodes; ++j)
    modulus -= 0.5 * both.stiffness(200, j) * std::pow(j - 200., 2);
  CHECK(modulus == doctest::Approx(1.).epsilon(1e-9));
  CHECK(both.stiffness(200, 203) != 0.); // a horizon of three cells
  CHECK(both.masses(200, 201) == doctest::Approx(1. / 6.).epsilon(1e-9));

  for (const auto &[length, most] : {std::make_pair(4., 0.5), {8., 0.022}, {16., 0.0019}})
  {
    const double reflected = reflected_energy(elements, both, length);
    CAPTURE(length);
    CAPTURE(reflected);
    CHECK(reflected < most);
    CHECK(reflected > 0.5 * most);
  }
  // A mass of its own for every node makes the lattice slower than the elements.
  const Strip lumped = Strip::assemble<2>({}, Mass::lumped);
  CHECK(reflected_energy(elements, lumped, 8.) > 0.1);
  CHECK(reflected_energy(elements, lumped, 16.) > 0.004);
}

TEST_CASE("peridynamics: where all of the rock is bonds, sites are mass points")
{
  const Strip strip = Strip::assemble<2>({"Fracture/peridynamics/Zone=(0, 0) to (1 m, 300 m)",
                                          "Boundary conditions/Roller=left, right, bottom, top"});
  for (const unsigned int i : {1u, 150u, 299u})
  {
    CHECK(strip.masses(i, i) == doctest::Approx(1.).epsilon(1e-9));
    CHECK(std::abs(strip.masses(i, i + 1)) < 1e-9);
    CHECK(std::abs(strip.masses(i, i - 1)) < 1e-9);
  }
}

TEST_CASE("peridynamics: waves across the rim in three dimensions")
{
  const std::vector<std::string> zone{
    "Fracture/peridynamics/Zone=(0, 0, 150 m) to (1 m, 1 m, 296 m)"};
  const Strip elements = Strip::assemble<3>(without_bonds), both = Strip::assemble<3>(zone);
  for (const auto &[length, most] : {std::make_pair(8., 0.022), {16., 0.0019}})
  {
    const double reflected = reflected_energy(elements, both, length);
    CAPTURE(length);
    CAPTURE(reflected);
    CHECK(reflected < most);
    CHECK(reflected > 0.5 * most);
  }
}
} // namespace stockwork::peridynamics_seam_test
