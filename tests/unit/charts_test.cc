#include "model_choice/charts.h"

#include "stockwork/base/error.h"

#include <doctest/doctest.h>

#include <sstream>

using namespace stockwork;

namespace
{
Charts charts_of(const std::string &rows)
{
  std::istringstream in("kind,deck,model,resolution,K_m,leaked,cells,error,seconds,status\n" +
                        rows);
  return Charts(in);
}

Charts::Group all_of(const Charts &charts, const std::string &kind)
{
  const auto groups = charts.groups(kind);
  REQUIRE(groups.size() <= 1);
  return groups.empty() ? Charts::Group{} : groups[0];
}
} // namespace

TEST_CASE("the finest run with no more cells counts")
{
  const Charts charts = charts_of("static,a,damage,coarse,,,10,0.04,1,finished\n"
                                  "static,a,damage,medium,,,20,0.02,3,finished\n");
  CHECK_FALSE(charts.promise(all_of(charts, "static"), "damage", 9.));
  CHECK(charts.promise(all_of(charts, "static"), "damage", 19.)->row.error == 0.04);
  CHECK(charts.promise(all_of(charts, "static"), "damage", 20.)->row.error == 0.02);
  CHECK(charts.promise(all_of(charts, "static"), "damage", 40.)->seconds == doctest::Approx(12.));
  CHECK_FALSE(charts.promise(all_of(charts, "static"), "peridynamics", 20.));
  CHECK_FALSE(charts.promise(all_of(charts, "toughness"), "damage", 20.));
}

TEST_CASE("of several decks the worst, and a lucky run promises nothing")
{
  const Charts charts = charts_of("\"static, turned\",a,damage,coarse,,,10,0.001,1,finished\n"
                                  "\"static, turned\",a,damage,medium,,,20,0.01,3,finished\n"
                                  "\"static, turned\",b,damage,coarse,,,10,0.005,2,finished\n");
  const auto promise = charts.promise(all_of(charts, "static, turned"), "damage", 10.);
  CHECK(promise->row.error == 0.01);
  CHECK(promise->row.deck == "a");
  CHECK(promise->seconds == doctest::Approx(1.5));
}

TEST_CASE("a model that has failed anywhere is none of the models")
{
  const Charts charts = charts_of("viscosity,a,damage,coarse,,,10,0.01,1,finished\n"
                                  "viscosity,a,far off,coarse,,,10,0.5,1,finished\n"
                                  "viscosity,a,stopped,coarse,,,10,,1,failed\n"
                                  "viscosity,a,stopped,medium,,,20,0.01,1,finished\n");
  CHECK(charts.models(all_of(charts, "viscosity")) == std::vector<std::string>{"damage"});
  CHECK(charts.failures(all_of(charts, "viscosity")) ==
        std::vector<std::string>{"far off (a)", "stopped (a)"});
}

TEST_CASE("decks of nearly the same toughness are one group, and groups are in order")
{
  const Charts charts =
    charts_of("growing,tough,damage,coarse,7,,10,0.01,1,finished\n"
              "growing,both,damage,coarse,2,,10,0.02,1,finished\n"
              "growing,viscous,damage,coarse,0.01,0.3,10,0.03,1,finished\n"
              "growing,like it,peridynamics,coarse,2.2,0.1,10,0.02,1,finished\n");
  const auto groups = charts.groups("growing");
  REQUIRE(groups.size() == 3);
  CHECK(groups[0].leaked == 0.3);
  CHECK(groups[1].decks == std::vector<std::string>{"both", "like it"});
  CHECK(groups[1].in_words() == "'growing' with K_m = 2 to 2.2");
  CHECK(groups[2].least == 7.);
  CHECK(charts.promise(groups[2], "damage", 10.)->row.deck == "tough");
  CHECK_FALSE(charts.promise(groups[2], "peridynamics", 10.));
}

TEST_CASE("what is no table is refused")
{
  std::istringstream nothing("");
  CHECK_THROWS_AS(Charts{nothing}, InputError);
  CHECK_THROWS_AS(charts_of("static,a,damage\n"), InputError);
  CHECK_THROWS_AS(charts_of("static,a,damage,coarse,,,many,0.04,1,finished\n"), InputError);
}
