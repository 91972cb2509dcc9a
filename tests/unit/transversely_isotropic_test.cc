#include <doctest/doctest.h>

#include <deal.II/base/parameter_handler.h>

#include "stockwork/rock/linear_stiffness.h"
#include "stockwork/rock/registry.h"

namespace stockwork
{
namespace transversely_isotropic
{
void register_law(RockLawRegistry &registry);
}

namespace transversely_isotropic_test
{
using namespace dealii;

namespace
{
SymmetricTensor<4, 3> stiffness_with(const Tensor<1, 3> &normal)
{
  RockLawRegistry registry;
  transversely_isotropic::register_law(registry);
  const RockLawEntry &entry = registry.all().at("transversely isotropic");
  ParameterHandler prm;
  entry.declare_parameters(prm);
  prm.parse_input_from_string(
    "set Young modulus along = 40 GPa\nset Young modulus across = 15 GPa\n"
    "set Poisson ratio along = 0.2\nset Poisson ratio across = 0.1\n"
    "set Shear modulus across = 6 GPa\n");
  RockProperties properties;
  properties.layer_normal = normal / normal.norm();
  return entry.stiffness(prm, "", properties);
}
} // namespace

TEST_CASE("five constants are what tests on turned specimens would measure")
{
  for (const Tensor<1, 3> &normal :
       {Tensor<1, 3>({0., 0., 1.}), Tensor<1, 3>({0., 1., 0.}), Tensor<1, 3>({-0.5, 0.866, 0.}),
        Tensor<1, 3>({0.3, -0.7, 0.4})})
  {
    const SymmetricTensor<4, 3> compliance = invert(stiffness_with(normal));
    const Tensor<1, 3> n = normal / normal.norm();
    Tensor<1, 3> any({0.2, 0.5, -0.9});
    any -= (any * n) * n;
    const Tensor<1, 3> s = any / any.norm(), t = cross_product_3d(n, s);
    const auto along = [](const SymmetricTensor<2, 3> &strain, const Tensor<1, 3> &d)
    { return d * (strain * d); };
    const auto pulled_across = compliance * symmetrize(outer_product(n, n)),
               pulled_along = compliance * symmetrize(outer_product(s, s)),
               sheared = compliance * symmetrize(outer_product(n, s));
    CHECK(along(pulled_across, n) == doctest::Approx(1. / 15e9).epsilon(1e-12));
    CHECK(along(pulled_across, s) == doctest::Approx(-0.1 / 15e9).epsilon(1e-12));
    CHECK(along(pulled_along, s) == doctest::Approx(1. / 40e9).epsilon(1e-12));
    CHECK(along(pulled_along, t) == doctest::Approx(-0.2 / 40e9).epsilon(1e-12));
    CHECK(along(pulled_along, n) == doctest::Approx(-0.1 / 15e9).epsilon(1e-12));
    // Stress components of half: the engineering shear strain is 1/2 over G'.
    CHECK(2. * (n * (sheared * s)) == doctest::Approx(0.5 / 6e9).epsilon(1e-12));
  }
}

TEST_CASE("plane stress leaves none across the plane, plane strain no strain")
{
  RockProperties rock;
  rock.stiffness = stiffness_with(Tensor<1, 3>({-0.5, 0.866, 0.}));
  SymmetricTensor<2, 3> strain;
  strain[0][0] = 1e-3;
  strain[1][1] = -2e-4;
  strain[0][1] = 3e-4;
  SymmetricTensor<2, 2> in_plane;
  in_plane[0][0] = 1e-3;
  in_plane[1][1] = -2e-4;
  in_plane[0][1] = 3e-4;
  for (const bool plane_stress : {false, true})
  {
    rock.plane_stress = plane_stress;
    if (plane_stress)
      strain[2][2] = -(*rock.stiffness * strain)[2][2] / (*rock.stiffness)[2][2][2][2];
    const SymmetricTensor<2, 3> whole = *rock.stiffness * strain;
    const SymmetricTensor<2, 2> plane = LinearStiffness<2>(rock).stress(in_plane);
    for (unsigned int i = 0; i < 2; ++i)
      for (unsigned int j = i; j < 2; ++j)
        CHECK(plane[i][j] == doctest::Approx(whole[i][j]).epsilon(1e-12));
  }
}

TEST_CASE("permeability across and along turned layers")
{
  RockProperties rock;
  rock.permeability = 4e-15;
  rock.permeability_across = 1e-16;
  rock.layer_normal = Tensor<1, 3>({-0.6, 0.8, 0.});
  const SymmetricTensor<2, 2> k = rock.permeability_tensor<2>();
  const Tensor<1, 2> n({-0.6, 0.8}), s({0.8, 0.6});
  CHECK((k * n - 1e-16 * n).norm() < 1e-28);
  CHECK((k * s - 4e-15 * s).norm() < 1e-27);
}
} // namespace transversely_isotropic_test
} // namespace stockwork
