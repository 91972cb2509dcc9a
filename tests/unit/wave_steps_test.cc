// Whether a tip is fast against waves, and the steps that resolve them then.
#include <doctest/doctest.h>

#include <boost/archive/binary_iarchive.hpp>
#include <boost/archive/binary_oarchive.hpp>

#include <cmath>
#include <sstream>
#include <utility>

#include "coupling/wave_steps.h"
#include "rock/wave_speeds.h"

#include "stockwork/rock/linear_stiffness.h"

namespace stockwork::wave_steps_test
{
using namespace dealii;

/// Waves of shear 2000 m/s, of compression 2000 sqrt(3) m/s: Poisson's ratio is 1/4.
Rock rock_of_waves(const std::string &pores = "")
{
  ParameterHandler prm;
  Rock::declare_parameters(prm);
  prm.parse_input_from_string("subsection Rock\n set Young modulus = 25 GPa\n"
                              " set Poisson ratio = 0.25\n set Density = 2500 kg/m^3\n" +
                              pores + "end");
  Rock rock;
  rock.parse_parameters(prm);
  return rock;
}

TEST_CASE("Rayleigh's waves and those of compression")
{
  const RockProperties rock = rock_of_waves().main();
  CHECK(rayleigh_speed(rock) == doctest::Approx(0.9194 * 2000.).epsilon(2e-3)); // Viktorov 1967
  CHECK(fastest_wave_speed(rock, false) == doctest::Approx(2000. * std::sqrt(3.)));
  // lambda + 2 G is 30 GPa, alpha^2 M another 20.
  const RockProperties porous =
    rock_of_waves(" set Bulk model = poroelastic\n set Biot coefficient = 1\n"
                  " set Biot modulus = 20 GPa\n set Permeability = 1e-14 m^2\n")
      .main();
  CHECK(fastest_wave_speed(porous, true) == doctest::Approx(std::sqrt(50e9 / 2500.)));
  CHECK(fastest_wave_speed(porous, false) == doctest::Approx(2000. * std::sqrt(3.)));
  // The stiffest axis.
  RockProperties layered = rock;
  layered.stiffness = LinearStiffness<3>(rock).tensor();
  (*layered.stiffness)[1][1][1][1] = 90e9;
  CHECK(fastest_wave_speed(layered, false) == doctest::Approx(6000.));
}

TEST_CASE("a tip is as fast as it comes into segments; steps resolve waves in a segment")
{
  const Rock rock = rock_of_waves();
  std::vector<NetworkSegment<2>> segments(2);
  segments[0].area = 1.5;
  segments[1].area = 0.5;
  WaveSteps waves;
  CHECK(std::isinf(waves.longest()));
  waves.set_segments(segments, rock);
  CHECK(waves.longest() == doctest::Approx(0.5 / (2000. * std::sqrt(3.)))); // 1 m in the mean
  CHECK(!waves.is_fast(10.));                                               // by default, none is
  const double speed = 1. / rayleigh_speed(rock.main()); // of a metre in a second

  CHECK(waves.tip_speed(0.1, 0) == 0.);
  CHECK(waves.tip_speed(0.1, 1) == 0.); // from where in it, nobody knows
  CHECK(waves.tip_speed(0.1, 3) == doctest::Approx(20. * speed));
  waves.accept(1., 1);
  waves.accept(1., 0);
  CHECK(waves.tip_speed(1., 1) == doctest::Approx(speed / 3.)); // two segments in all of the time
  waves.accept(1., 2);
  waves.accept(1., 1);
  waves.accept(1., 2);
  CHECK(waves.tip_speed(1., 0) == doctest::Approx(4. * speed / 4.)); // the last five segments
  CHECK(waves.tip_speed(1., 4) == doctest::Approx(5. * speed / 2.));
  CHECK(waves.tip_speed(1., 9) == doctest::Approx(8. * speed));
  waves.accept(9., 0); // it has stopped
  CHECK(waves.tip_speed(1., 0) == doctest::Approx(4. * speed / 13.));

  std::stringstream file;
  {
    boost::archive::binary_oarchive archive(file);
    archive << std::as_const(waves);
  }
  WaveSteps again;
  again.set_segments(segments, rock);
  boost::archive::binary_iarchive archive(file);
  archive >> again;
  CHECK(again.tip_speed(1., 2) == waves.tip_speed(1., 2));
}
} // namespace stockwork::wave_steps_test
