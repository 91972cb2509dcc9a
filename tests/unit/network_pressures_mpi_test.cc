// Which pressures segments have before anything flows: given ones, and those that new ones start
// from.
#include <doctest/doctest.h>

#include "network_fixture.h"

#include <limits>

#include "stockwork/base/error.h"

namespace stockwork::network_pressures_mpi_test
{
using doctest::Approx;

namespace
{
const Chain::Entries one_well = {{"Fracture flow/Minimum aperture", "1 um"},
                                 {"Wells/Well 1/Control", "rate"},
                                 {"Wells/Well 1/Rate", "1e-4 m^2/s"},
                                 {"Wells/Well 1/Perforations", "0.25, 0"}};
} // namespace


TEST_CASE("where the pressure is given, the fluid loads the rock and what it fills is supplied")
{
  Chain chain(4);
  chain.network.set_pressures(2e6, {});
  chain.set_up({{"Fracture flow/Minimum aperture", "1 um"}});
  CHECK(chain.network.unknowns().empty());
  const auto balance = chain.step(1.);
  const double filled = 2e6 / chain.stiffness * 4 * chain.h;
  CHECK(balance.step.injected == Approx(filled));
  CHECK(balance.fracture_volume == Approx(filled));
  CHECK(balance.relative_error < 1e-12);
  CHECK(chain.network.pressure(1000, chain.unknowns(chain.bulk, chain.extra)) == 2e6);
  CHECK_FALSE(chain.network.unknown(1000));
  // A well would have no effect.
  CHECK_THROWS_AS(chain.set_up(one_well), stockwork::InputError);
}

TEST_CASE("a new pressure starts from the neighbour's, or from that at which the segment opens")
{
  // Compression of 2 MPa across the segments, growing along them; tension across the last.
  const auto stress = [](const dealii::Point<2> &x)
  {
    dealii::SymmetricTensor<2, 2> stress;
    stress[0][0] = -9e6;
    stress[1][1] = x[0] > 2. ? 1e6 : -2e6 - 1e6 * x[0];
    return stress;
  };
  Chain chain(5);
  chain.network.set_pressures(std::numeric_limits<double>::quiet_NaN(), stress);
  chain.edit = [](auto &segments)
  {
    segments[1].propped_conductivity = 1e-13;
    for (auto &segment : segments)
      segment.pore_pressure.constant = 3e5;
  };
  chain.set_up(one_well);
  CHECK(chain.extra[0] == Approx(2.25e6));
  CHECK(chain.extra[1] == Approx(3e5)); // proppant keeps it open
  CHECK(chain.extra[2] == Approx(3.25e6));
  CHECK(chain.extra[4] == 0.);

  // Grown by two: the first has a neighbour; the second none with a pressure of its own.
  chain.extra[4] = 7e6;
  chain.n = 7;
  chain.bulk.resize(7);
  chain.bulk_reference.resize(7);
  chain.edit = [](auto &) {};
  chain.network.set_pressures(std::numeric_limits<double>::quiet_NaN(),
                              [](const auto &) { return dealii::SymmetricTensor<2, 2>(); });
  chain.update_segments();
  CHECK(chain.extra[1] == Approx(3e5)); // what is there stays
  CHECK(chain.extra[5] == Approx(7e6));
  CHECK(chain.extra[6] == 0.);

  // Between two that have one, the nearer counts.
  chain.extra[2] = 4e6;
  const auto segments_of = [&](const double to_left, const double to_right)
  {
    return [=](auto &segments)
    {
      segments[3].key = 5;
      segments[2].neighbours[1].key = segments[4].neighbours[0].key = 5;
      segments[3].neighbours[0].distance = to_left;
      segments[3].neighbours[1].distance = to_right;
    };
  };
  chain.edit = segments_of(0.1, 0.2);
  chain.update_segments();
  CHECK(chain.extra[0] == Approx(4e6)); // keys are in order, and 5 comes first
  chain.edit = [](auto &) {};
  chain.update_segments();
  chain.edit = segments_of(0.2, 0.1);
  chain.update_segments();
  CHECK(chain.extra[0] == Approx(7e6));
}
} // namespace stockwork::network_pressures_mpi_test
