// A well cannot take what is not there. One segment on a Winkler foundation holds the volume h p/k.
#include <doctest/doctest.h>

#include "network_fixture.h"

#include "stockwork/base/error.h"

namespace stockwork::wells_mpi_test
{
using doctest::Approx;

namespace
{
Chain::Entries well(const std::string &rate, const Chain::Entries &more = {})
{
  Chain::Entries entries = {{"Fracture flow/Minimum aperture", "1 um"},
                            {"Wells/Well 1/Control", "rate"},
                            {"Wells/Well 1/Rate", rate},
                            {"Wells/Well 1/Perforations", "0.25, 0"}};
  entries.insert(entries.end(), more.begin(), more.end());
  return entries;
}

const std::string in_and_out = "0 s: 1e-4 m^2/s; 2 s: -1e-4 m^2/s; 5 s: 1e-4 m^2/s";
} // namespace

TEST_CASE("at its least pressure a well takes what flows")
{
  Chain chain(1);
  Chain::Entries bound = {{"Wells/Well 1/Minimum pressure", "1e5 Pa"}};
  double stored = 0.;
  SUBCASE("directly")
  {
    chain.set_up(well(in_and_out, bound));
  }
  SUBCASE("and gives what expands in the borehole")
  {
    chain.compressibility = 5e-10;
    bound.emplace_back("Wells/Well 1/Borehole volume", "0.2 m^2");
    stored = 0.2 * 5e-10;
    chain.set_up(well(in_and_out, bound));
  }
  const double capacity = chain.h / chain.stiffness + stored;
  const auto pressure = [&]() { return chain.wells()[0].borehole_pressure; };
  const auto close = [](const double x) { return Approx(x).epsilon(1e-3); }; // fluid compressed

  chain.begin_step(2.);
  chain.solve();
  CHECK(pressure() == close(2e-4 / capacity));
  CHECK(chain.wells()[0].rate == 1e-4);
  chain.commit();
  chain.begin_step(1.);
  chain.solve();
  CHECK(pressure() == close(1e-4 / capacity));
  CHECK(chain.wells()[0].rate == -1e-4);
  chain.commit();

  for (const double left : {1e-4 - 1e5 * capacity, 0.})
  {
    chain.begin_step(1.);
    chain.solve();
    const auto balance = chain.balance();
    CHECK(pressure() == Approx(1e5).epsilon(1e-10));
    CHECK(std::abs(chain.wells()[0].rate + left) < 1e-3 * 1e-4);
    CHECK(chain.wells()[0].wanted_rate == -1e-4);
    CHECK(balance.step.outflow == Approx(-chain.wells()[0].rate));
    CHECK(std::abs(balance.step.defect()) < 1e-15);
    chain.commit();
  }
  chain.step(1.); // fills again
  CHECK(pressure() == close(1e5 + 1e-4 / capacity));
}

TEST_CASE(
  "without an entry the bound is vacuum, or where the fluid cavitates; an injector has none")
{
  const auto bounds = [](const Chain::Entries &entries)
  {
    Chain chain(1);
    chain.set_up(entries);
    return chain.network.minimum_well_pressures();
  };
  CHECK(bounds(well("1e-4 m^2/s")).empty());
  CHECK(bounds(well("0 s: 1e-4 m^2/s; 5 s: 0")).empty());
  REQUIRE(bounds(well(in_and_out)).size() == 1);
  CHECK(bounds(well(in_and_out))[0].second == 0.);
  CHECK(bounds(well("f(t) = 1e-4*cos(t)"))[0].second == 0.);
  CHECK(bounds(well(in_and_out, {{"Fracture flow/Vapour pressure", "-3 MPa"}}))[0].second == -3e6);
  CHECK(bounds(well(in_and_out, {{"Wells/Well 1/Minimum pressure", "2 MPa"}}))[0].second == 2e6);
  CHECK_THROWS_AS(bounds(well("1e-4 m^2/s", {{"Wells/Well 1/Minimum pressure", "2 MPa"}})),
                  InputError);
  CHECK_THROWS_AS(bounds(well(in_and_out, {{"Wells/Well 1/Minimum pressure", "2 m"}})), InputError);
  CHECK_THROWS_AS(bounds(well("0", {{"Wells/Well 1/Control", "pressure"},
                                    {"Wells/Well 1/Minimum pressure", "2 MPa"}})),
                  InputError);
}

TEST_CASE("two perforations, one of them far from what is left")
{
  Chain chain(6);
  chain.set_up(
    well("0 s: 1e-4 m^2/s; 10 s: -1e-4 m^2/s", {{"Wells/Well 1/Perforations", "0.25, 0; 0.75, 0"},
                                                {"Wells/Well 1/Minimum pressure", "20 kPa"}}));
  for (unsigned int i = 0; i < 10; ++i)
    chain.step(1.);
  for (unsigned int i = 0; i < 10; ++i)
  {
    chain.begin_step(2.);
    chain.solve();
    const auto balance = chain.balance();
    const auto report = chain.wells()[0];
    chain.commit();
    CHECK(balance.relative_error < 1e-9);
    CHECK(report.rate >= -1e-4);
    CHECK(report.borehole_pressure >= 2e4 * (1. - 1e-9));
    CHECK(report.perforation_rates[0] + report.perforation_rates[1] ==
          Approx(report.rate).epsilon(1e-6));
    for (unsigned int k = 0; k < chain.n; ++k)
      CHECK(chain.extra[k] >= 2e4 * (1. - 1e-9));
  }
  CHECK(chain.wells()[0].rate > -0.1e-4);
  CHECK(chain.wells()[0].borehole_pressure == Approx(2e4));
}
} // namespace stockwork::wells_mpi_test
