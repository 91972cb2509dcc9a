// The flow in fractures, on a chain of segments over a Winkler foundation (network_fixture.h).
#include <doctest/doctest.h>

#include "network_fixture.h"

#include <sstream>

#include "stockwork/base/error.h"

namespace stockwork::network_mpi_test
{
using doctest::Approx;

namespace
{
const Chain::Entries one_well = {{"Fracture flow/Minimum aperture", "1 um"},
                                 {"Wells/Well 1/Control", "rate"},
                                 {"Wells/Well 1/Rate", "1e-4 m^2/s"},
                                 {"Wells/Well 1/Perforations", "0.25, 0"}};

Chain::Entries operator+(Chain::Entries a, const Chain::Entries &b)
{
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

/// Largest difference between the matrix and central differences of the residual, in units of the
/// largest entry of the row, after scaling by typical sizes of the unknowns.
double jacobian_error(Chain &chain, const std::vector<double> &sizes)
{
  const auto exact = chain.assemble();
  const unsigned int n = exact.residual.size();
  dealii::FullMatrix<double> difference(n, n);
  for (unsigned int j = 0; j < n; ++j)
  {
    double &x = j < chain.n_bulk() ? chain.bulk[j] : chain.extra[j - chain.n_bulk()];
    const double step = 1e-5 * sizes[j], old = x;
    x = old + step;
    const auto plus = chain.assemble().residual;
    x = old - step;
    const auto minus = chain.assemble().residual;
    x = old;
    for (unsigned int i = 0; i < n; ++i)
      difference(i, j) = (plus(i) - minus(i)) / (2. * step);
  }
  double worst = 0.;
  for (unsigned int i = 0; i < n; ++i)
  {
    double row = 0., error = 0.;
    for (unsigned int j = 0; j < n; ++j)
    {
      row = std::max(row, std::abs(exact.matrix(i, j)) * sizes[j]);
      error = std::max(error, std::abs(exact.matrix(i, j) - difference(i, j)) * sizes[j]);
    }
    if (row > 0.)
      worst = std::max(worst, error / row);
    else
      CHECK(error == 0.);
  }
  return worst;
}
} // namespace

TEST_CASE("flow through a slot of constant width is the cubic law's")
{
  Chain chain(5);
  chain.edit = [](auto &segments)
  {
    for (auto &segment : segments)
    {
      segment.opening = {};
      segment.opening.constant = 2e-4;
    }
  };
  chain.set_up({{"Fracture flow/Minimum aperture", "0.1 um"},
                {"Wells/Well 1/Control", "pressure"},
                {"Wells/Well 1/Pressure", "3 MPa"},
                {"Wells/Well 1/Perforations", "0.25, 0"},
                {"Wells/Well 2/Control", "pressure"},
                {"Wells/Well 2/Pressure", "1 MPa"},
                {"Wells/Well 2/Perforations", "2.25, 0"}});
  const auto balance = chain.step(2.);
  // 2 MPa over 4 segments of 0.5 m, for 2 s
  const double expected = std::pow(2e-4, 3) / (12. * 1e-3) * 2e6 / 2. * 2.;
  CHECK(balance.step.injected == Approx(expected).epsilon(1e-9));
  CHECK(balance.step.outflow == Approx(expected).epsilon(1e-9));
  CHECK(balance.relative_error < 1e-10);
  CHECK(chain.extra[2] == Approx(2e6));
}

TEST_CASE("the matrix is the derivative of the residual")
{
  Chain chain(6);
  chain.compressibility = 4e-10;
  chain.pore_storage = 1e-10;
  chain.n_model = 2;
  chain.edit = [](auto &segments)
  {
    for (unsigned int i = 0; i < segments.size(); ++i)
    {
      auto &B = segments[i].opening; // each opened by several unknowns, shared with others
      B.bulk = {i, (i + 1) % 6, 6 + i};
      B.bulk_coefficients = {0.8, 0.3 - 0.02 * i, 1e-12};
      B.extra = {i % 2};
      B.extra_coefficients = {0.4};
      B.constant = 1e-6;
    }
  };
  const Chain::Entries friction = {{"Wells/Well 1/Perforations", "0.25, 0; 1.25, 0; 1.75, 0"},
                                   {"Wells/Well 1/Perforation friction", "1e14"},
                                   {"Wells/Well 1/Borehole volume", "0.3"},
                                   {"Wells/Well 2/Control", "pressure"},
                                   {"Wells/Well 2/Pressure", "1 MPa"},
                                   {"Wells/Well 2/Perforation friction", "2e13"},
                                   {"Wells/Well 2/Perforations", "2.25, 0"}};
  Chain::Entries entries = one_well + friction;
  SUBCASE("no leak-off")
  {
  }
  SUBCASE("filter cake")
  {
    entries = entries + Chain::Entries{{"Fracture flow/Leak-off", "filter cake"},
                                       {"Fracture flow/Filter cake coefficient", "1e-11"}};
  }
  SUBCASE("resolved")
  {
    chain.mobility = 1e-15;
    entries = entries + Chain::Entries{{"Fracture flow/Leak-off", "resolved"}};
  }
  SUBCASE("Carter")
  {
    entries = entries + Chain::Entries{{"Fracture flow/Leak-off", "carter"},
                                       {"Fracture flow/Carter coefficient", "1e-5"}};
  }
  chain.set_up(entries);
  chain.begin_step(0.5);
  // Apertures from well below the minimum to well above, and one closed
  for (unsigned int i = 0; i < 6; ++i)
  {
    chain.bulk[i] = std::vector<double>{1e-4, 3e-5, 2e-6, -4e-5, 1e-6, 5e-5}[i];
    chain.bulk[6 + i] = 1e5 * i;
  }
  chain.extra[0] = 2e-6;
  chain.extra[1] = -3e-6;
  const unsigned int n_leaking = chain.extra.size() - 13; // none, or all
  REQUIRE((n_leaking == 0 || n_leaking == 6));
  for (unsigned int k = 0; k < 6; ++k)
    chain.extra[2 + k] = 2e6 + 3e5 * k * k;
  for (unsigned int k = 0; k < n_leaking; ++k)
    chain.extra[8 + k] = 1e6 + 1e5 * k;
  for (unsigned int k = 0; k < 5; ++k) // rates of the first well, its pressure; of the second
    chain.extra[8 + n_leaking + k] = std::vector<double>{3e5, -2e5, 4e5, 4e6, 3e5}[k];
  chain.bulk_reference[2] = 1e-4;
  chain.extra_reference[3] = 5e5;

  std::vector<double> sizes(12 + chain.extra.size(), 1e6);
  for (const unsigned int i : {0, 1, 2, 3, 4, 5, 12, 13})
    sizes[i] = 1e-6;
  CHECK(jacobian_error(chain, sizes) < 1e-7);

  CHECK(chain.assemble().matrix(0, 14) == Approx(-0.5 * 0.8)); // load: -A B^T
}

TEST_CASE("load and volume are adjoint: the matrix is symmetric where the conductivity is fixed")
{
  Chain chain(4);
  chain.pore_storage = 1e-10;
  chain.set_up(one_well + Chain::Entries{{"Wells/Well 1/Perforations", "0.25, 0; 1.75, 0"},
                                         {"Wells/Well 1/Perforation friction", "1e13"},
                                         {"Wells/Well 1/Borehole volume", "1"},
                                         {"Fracture flow/Leak-off", "filter cake"},
                                         {"Fracture flow/Filter cake coefficient", "1e-12"}});
  chain.begin_step(1.);
  for (unsigned int i = 0; i < 4; ++i)
    chain.bulk[i] = -1e-4; // closed: at the minimum conductivity
  for (unsigned int i = 0; i < chain.extra.size(); ++i)
    chain.extra[i] = 1e6 * (i + 1);
  const auto matrix = chain.assemble().matrix;
  double defect = 0.;
  for (unsigned int i = 0; i < matrix.m(); ++i)
    for (unsigned int j = 0; j < i; ++j)
      defect = std::max(defect, std::abs(matrix(i, j) - matrix(j, i)));
  CHECK(defect == 0.);
  CHECK(matrix.frobenius_norm() > 1.);
}

TEST_CASE("injected fluid is in the fracture, the borehole, or has leaked")
{
  Chain chain(8);
  chain.compressibility = 5e-10;
  Chain::Entries entries =
    one_well + Chain::Entries{{"Wells/Well 1/Perforations", "0.25,0; 2.25,0"},
                              {"Wells/Well 1/Perforation friction", "1e13"},
                              {"Wells/Well 1/Borehole volume", "2"}};
  SUBCASE("filter cake")
  {
    chain.pore_storage = 1e-9;
    entries = entries + Chain::Entries{{"Fracture flow/Leak-off", "filter cake"},
                                       {"Fracture flow/Filter cake coefficient", "1e-12"}};
  }
  SUBCASE("Carter")
  {
    entries = entries + Chain::Entries{{"Fracture flow/Leak-off", "carter"},
                                       {"Fracture flow/Carter coefficient", "1e-6"}};
  }
  SUBCASE("a producer")
  {
    entries = entries + Chain::Entries{{"Wells/Well 2/Control", "pressure"},
                                       {"Wells/Well 2/Pressure", "10 kPa"},
                                       {"Wells/Well 2/Perforations", "3.75, 0"}};
  }
  SUBCASE("segments that are turned against one another and see edges of another width")
  {
    chain.edit = [](auto &segments)
    {
      for (unsigned int i = 0; i < segments.size(); i += 2)
        for (auto &neighbour : segments[i].neighbours)
          neighbour.width = 1.4;
    };
  }
  chain.set_up(entries);
  stockwork::FluidBalance balance;
  for (const double dt : {0.01, 0.02, 0.1, 0.5, 0.5})
  {
    balance = chain.step(dt);
    CHECK(balance.relative_error < 1e-9);
  }
  CHECK(balance.total.injected == Approx(1e-4 * chain.context.time));
  CHECK(balance.total.in_boreholes > 0.);
  // The gain is the volume that is there, but for its compression (c_f p < 1e-3).
  CHECK(balance.total.in_fractures == Approx(balance.fracture_volume).epsilon(1e-3));

  // In the rock's pores is what has leaked.
  double in_pores = 0.;
  for (unsigned int i = chain.n; i < chain.n_bulk(); ++i)
    in_pores += chain.h * chain.pore_storage * chain.bulk[i];
  if (chain.pore_storage > 0.)
  {
    CHECK(in_pores == Approx(balance.total.leaked).epsilon(1e-8));
    CHECK(in_pores > 0.);
  }
  double of_segments = 0.;
  for (const double leaked : chain.network.leaked_volumes())
    of_segments += leaked;
  CHECK(of_segments == Approx(balance.total.leaked));
}

TEST_CASE("Carter leak-off: volume and times of exposure")
{
  const double C = 1e-6;
  Chain chain(4);
  chain.set_up(one_well + Chain::Entries{{"Fracture flow/Leak-off", "carter"},
                                         {"Fracture flow/Carter coefficient", "1e-6"},
                                         {"Wells/Well 1/Rate", "1e-5"}});
  // Open all along: nothing leaks where it is closed.
  chain.bulk.assign(4, 1e-4);
  chain.bulk_reference = chain.bulk;
  chain.extra.assign(4, 1e-4 * chain.stiffness);
  chain.extra_reference = chain.extra;
  chain.context.time = 2.;
  chain.step(1.);
  chain.step(3.);
  CHECK(chain.balance().total.leaked > 0.);
  const auto expected = [&](const double exposed)
  { return 2. * chain.h * 2. * C * std::sqrt(chain.context.time - exposed); };
  for (const double leaked : chain.network.leaked_volumes())
    CHECK(leaked == Approx(expected(2.)).epsilon(1e-12));

  // Growth in two passes within the step from 6 to 10: reached at 7 and at 9.
  chain.begin_step(4.);
  for (unsigned int pass = 0; pass < 2; ++pass)
  {
    ++chain.n;
    chain.bulk.push_back(1e-4);
    chain.bulk_reference.push_back(1e-4);
    chain.update_segments();
    chain.extra.back() = chain.extra_reference.back() = 1e-4 * chain.stiffness;
  }
  chain.solve();
  CHECK(chain.balance().relative_error < 1e-9);
  chain.commit();
  const auto leaked = chain.network.leaked_volumes();
  CHECK(leaked[0] == Approx(expected(2.)).epsilon(1e-12));
  CHECK(leaked[4] == Approx(expected(7.)).epsilon(1e-12));
  // New segments start empty; the fluid has hardly come as far as the second.
  CHECK(leaked[5] < 2e-3 * expected(9.));
}

TEST_CASE("a rejected step leaves nothing behind; neither does a restart")
{
  const auto prepare = [](Chain &chain)
  {
    chain.set_up(one_well + Chain::Entries{{"Fracture flow/Leak-off", "carter"},
                                           {"Fracture flow/Carter coefficient", "1e-6"}});
    chain.step(0.5);
  };
  const auto grow = [](Chain &chain)
  {
    ++chain.n;
    chain.bulk.push_back(0.);
    chain.bulk_reference.push_back(0.);
    chain.update_segments();
  };
  const auto finish = [&](Chain &chain)
  {
    chain.begin_step(0.25);
    grow(chain);
    chain.solve();
    chain.commit();
    return chain.step(0.25);
  };

  Chain straight(4), rejected(4);
  prepare(straight);
  prepare(rejected);
  rejected.begin_step(1.);
  grow(rejected);
  grow(rejected);
  rejected.solve();
  rejected.rollback();
  rejected.n = 4;
  rejected.bulk.resize(4);
  rejected.bulk_reference.resize(4);
  rejected.update_segments();
  rejected.extra = rejected.extra_reference;

  Chain restarted(4);
  prepare(restarted);
  {
    std::stringstream file;
    boost::archive::binary_oarchive out(file);
    restarted.network.save(out);
    restarted.network = stockwork::Network<2>();
    const auto bulk = restarted.bulk, extra = restarted.extra;
    restarted.set_up(one_well + Chain::Entries{{"Fracture flow/Leak-off", "carter"},
                                               {"Fracture flow/Carter coefficient", "1e-6"}});
    restarted.bulk = restarted.bulk_reference = bulk;
    restarted.extra = restarted.extra_reference = extra;
    boost::archive::binary_iarchive in(file);
    restarted.network.load(in);
  }

  const auto expected = finish(straight);
  for (Chain *chain : {&rejected, &restarted})
  {
    const auto balance = finish(*chain);
    CHECK(balance.total.leaked == Approx(expected.total.leaked).epsilon(1e-12));
    CHECK(balance.total.injected == Approx(expected.total.injected).epsilon(1e-12));
    CHECK(balance.total.in_fractures == Approx(expected.total.in_fractures).epsilon(1e-12));
    for (unsigned int i = 0; i < chain->extra.size(); ++i)
      CHECK(chain->extra[i] == Approx(straight.extra[i]).epsilon(1e-12));
  }
}

TEST_CASE("fluid that would have to be pulled cavitates and lags")
{
  // A slot of 0.2 mm in hard rock, of which two segments are full and six open within a step.
  constexpr double slot = 2e-4, least = -3e5, rate = 1e-4; // [m], [Pa], [m^2/s]
  const auto prepare = [&](Chain &chain)
  {
    chain.stiffness = 1e15;
    chain.edit = [&](auto &segments)
    {
      for (auto &segment : segments)
        segment.opening.constant = slot;
    };
    chain.set_up(one_well + Chain::Entries{{"Fracture flow/Vapour pressure", "-0.3 MPa"}});
  };
  const auto grow = [](Chain &chain)
  {
    chain.n = 8;
    chain.bulk.resize(8);
    chain.bulk_reference.resize(8);
    chain.update_segments();
  };
  Chain chain(2);
  prepare(chain);
  double injected = 0.;
  for (unsigned int step = 0; step < 4; ++step)
  {
    // Some steps fill a part of a segment (of 1e-4 m^2), some more than one.
    const double dt = std::vector<double>{0.3, 0.3, 1.6, 2.5}[step];
    chain.begin_step(dt);
    if (step == 0)
      grow(chain);
    chain.solve();
    const auto balance = chain.balance();
    chain.commit();
    // Those behind the front are full; its own has the least pressure. Through an edge goes what
    // those ahead of it gain in the step.
    const double gap = slot * chain.h, before = 2. * gap + injected;
    injected += rate * dt;
    const auto front = static_cast<unsigned int>((2. * gap + injected) / gap);
    double pressure = least;
    for (int i = 7; i >= 0; --i)
    {
      if (i < static_cast<int>(front))
        pressure += (2. * gap + injected - std::max(before, (i + 1) * gap)) / dt * 12. *
                    chain.viscosity * chain.h / std::pow(slot, 3);
      CHECK(std::abs(chain.extra[i] - pressure) < 10.);
    }
    CHECK(balance.relative_error < 1e-10);
    CHECK(balance.step.injected == Approx(rate * dt));
    CHECK(balance.total.in_fractures == Approx(injected));
    CHECK(balance.fracture_volume == Approx(2. * gap + injected).epsilon(1e-5));

    if (step == 1) // what is committed survives a step that is thrown away, and a restart
    {
      chain.begin_step(1.);
      chain.solve();
      chain.rollback();
      std::stringstream file;
      boost::archive::binary_oarchive out(file);
      chain.network.save(out);
      chain.network = stockwork::Network<2>();
      const auto bulk = chain.bulk, extra = chain.extra;
      prepare(chain);
      chain.bulk = chain.bulk_reference = bulk;
      chain.extra = chain.extra_reference = extra;
      boost::archive::binary_iarchive in(file);
      chain.network.load(in);
    }
  }

  // The matrix, where some segments cavitate.
  chain.begin_step(0.1);
  for (unsigned int i = 0; i < 8; ++i)
  {
    chain.bulk[i] = 1e-5 * (i % 3);
    chain.extra[i] = i < 6 ? 1e6 - 1e5 * i * i : least;
  }
  std::vector<double> sizes(16, 1e6);
  std::fill(sizes.begin(), sizes.begin() + 8, 1e-6);
  CHECK(jacobian_error(chain, sizes) < 1e-7);
}

TEST_CASE("perforations share the borehole's pressure and rate")
{
  // Two separate fractures: the chain is cut in the middle, one half is four times stiffer.
  Chain chain(2);
  chain.h = 1.;
  chain.edit = [](auto &segments)
  {
    for (auto &segment : segments)
      segment.neighbours.clear();
    segments[1].opening.bulk_coefficients = {0.5}; // w = u/2: stiffness in w is 4 k
  };
  Chain::Entries entries = one_well + Chain::Entries{{"Wells/Well 1/Perforations", "0.5,0; 1.5,0"}};
  SUBCASE("without friction they are at equal pressure")
  {
    chain.set_up(entries);
    chain.step(1.);
    CHECK(chain.extra[0] == Approx(chain.extra[1]));
    const auto rates = chain.wells()[0].perforation_rates;
    CHECK(rates[0] + rates[1] == Approx(1e-4));
    CHECK(rates[0] == Approx(4. * rates[1]));
    CHECK(chain.wells()[0].borehole_pressure == Approx(chain.extra[0]));
  }
  SUBCASE("friction evens the rates out")
  {
    const double kappa = 1e16;
    chain.set_up(entries + Chain::Entries{{"Wells/Well 1/Perforation friction", "1e16"}});
    chain.step(1.);
    const auto report = chain.wells()[0];
    const auto q = report.perforation_rates;
    CHECK(q[0] + q[1] == Approx(1e-4));
    CHECK(q[0] / q[1] == Approx(1.).epsilon(0.01));
    for (unsigned int k = 0; k < 2; ++k)
      CHECK(report.borehole_pressure == Approx(chain.extra[k] + kappa * q[k] * q[k]));
  }
  SUBCASE("at given pressure")
  {
    chain.set_up(entries + Chain::Entries{{"Wells/Well 1/Control", "pressure"},
                                          {"Wells/Well 1/Rate", ""},
                                          {"Wells/Well 1/Pressure", "0 s: 1 MPa; 1 s: 3 MPa"}});
    chain.step(1.);
    CHECK(chain.extra[1] == Approx(1e6));
    const auto balance = chain.step(1.);
    CHECK(chain.extra[0] == Approx(3e6));
    CHECK(balance.total.injected == Approx(balance.fracture_volume));
    CHECK(balance.total.injected == Approx(3e6 / 1e9 * 1.25));
  }
  SUBCASE("half of the well in the model")
  {
    chain.set_up(entries + Chain::Entries{{"Wells/Well 1/Fraction in model", "0.5"},
                                          {"Wells/Well 1/Perforations", "0.5, 0"}});
    CHECK(chain.step(1.).total.injected == Approx(0.5e-4));
    CHECK(chain.network.unknowns().size() == 2);
  }
  SUBCASE("between two segments")
  {
    chain.set_up(entries + Chain::Entries{{"Wells/Well 1/Perforations", "1, 0"}});
    chain.step(1.);
    CHECK(chain.extra[1] == Approx(4. * chain.extra[0])); // equal volumes
    CHECK(chain.wells()[0].inlet_pressure == Approx(2.5 * chain.extra[0]));
  }
}

TEST_CASE("on a Winkler foundation the fluid spreads as Barenblatt's solution")
{
  // dw/dt = C d/dx (w^3 dw/dx), C = k/(12 mu): the porous medium equation with m = 4. For the
  // symmetric spreading of a volume 2 V (Barenblatt 1952), with xi = x / (C t)^(1/5),
  //   w = (C t)^(-1/5) (3/10 (xi_f^2 - xi^2))^(1/3).
  Chain chain(60);
  const double C = 1e9 / 12e-3, front = 5.8;
  chain.h = 0.1;
  chain.set_up({{"Fracture flow/Minimum aperture", "0.01 um"}});
  const auto exact = [&](const double x, const double t)
  {
    const double spread = std::pow(C * t, 0.2), xi = x / spread,
                 xi_f = 3. / std::pow(C * 1., 0.2); // the front is at 3 m when t = 1 s
    return std::cbrt(std::max(0.3 * (xi_f * xi_f - xi * xi), 0.)) / spread;
  };
  chain.context.time = 1.;
  for (unsigned int i = 0; i < chain.n; ++i)
  {
    chain.bulk[i] = exact((i + 0.5) * chain.h, 1.);
    chain.extra[i] = chain.stiffness * chain.bulk[i];
  }
  chain.bulk_reference = chain.bulk;
  chain.extra_reference = chain.extra;

  const double end = std::pow(front / 3., 5);
  const int n = 200;
  for (int k = 0; k < n; ++k) // equal steps of the front
    chain.step(std::pow(1. + (front / 3. - 1.) * (k + 1) / n, 5) - chain.context.time);
  CHECK(chain.context.time == Approx(end));
  for (unsigned int i = 0; i < 40; ++i)
    CHECK(chain.bulk[i] == Approx(exact((i + 0.5) * chain.h, end)).epsilon(5e-3));
  CHECK(chain.bulk[59] < 0.3 * chain.bulk[0]);
}

TEST_CASE("decks that make no sense")
{
  const auto check = [](const Chain::Entries &entries, const std::string &expected)
  {
    Chain chain(3);
    CHECK_THROWS_WITH_AS(chain.set_up(one_well + entries), doctest::Contains(expected.c_str()),
                         stockwork::InputError);
  };
  CHECK_NOTHROW(Chain(3).set_up(one_well));
  check({{"Wells/Well 1/Perforations", "0.25, 3"}},
        "(0.25 3) is on none; the nearest segment of one is at distance 3");
  check({{"Wells/Well 1/Perforations", "0.25"}},
        "'Wells/Well 1/Perforations' is '0.25'; allowed is one or more points");
  check({{"Wells/Well 1/Perforations", ""}}, "'Wells/Well 1/Perforations' is empty");
  check({{"Wells/Well 1/Rate", "3 MPa"}}, "'Wells/Well 1/Rate' is '3 MPa'");
  check({{"Wells/Well 1/Perforation friction", "3 MPa"}},
        "'Wells/Well 1/Perforation friction' is '3 MPa'");
  check({{"Wells/Well 1/Borehole volume", "-1"}}, "'Wells/Well 1/Borehole volume' is '-1'");
  check({{"Wells/Well 1/Control", "none"}}, "'rate' or 'pressure'");
  check({{"Fracture flow/Leak-off", "resolved"}}, "the rock has no pore pressure");
  check({{"Fracture flow/Leak-off", "carter"}}, "Carter coefficient");
  check({{"Fracture flow/Leak-off", "carter"},
         {"Fracture flow/Carter coefficient", "1e-5"},
         {"Fracture flow/Vapour pressure", "0"}},
        "'Fracture flow/Vapour pressure' is '0'; allowed is -inf with Carter leak-off");
}
} // namespace stockwork::network_mpi_test
