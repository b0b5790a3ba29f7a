// Label: analytic. Static cases: nothing has a rate.

#include <fmt/format.h>

#include <cmath>

#include "closed_balances.h"
#include "run_case.h"
#include "tourmaline/case/case.h"
#include "tourmaline/error.h"

namespace tourmaline::verified {
namespace {

// t goes to 2; `of_t` says how the loads have it.
std::string block(const std::string &time, const std::string &of_t) {
  return fmt::format(R"(
mesh.box = {{ min = [0, 0], max = [0.1, 0.1], cells = [8, 8] }}
material.library = "BaTiO3-Liu2014"
time = {{ {0} }}
boundary = [
  {{ on = "right", displacement = [0, 0], potential = 0, temperature = "3*{1}" }},
  {{ on = "top", traction = [0, "-5e6*{1}"], heat_flux = "-100*{1}" }},
  {{ on = "bottom", temperature = "y + 5*x*{1}" }} ]
load.heat = "1e4*{1}*x"
[contact]
on = "left"
friction = {{ law = "tresca", bound = 1e5 }}
heat = {{ law = "exchange", coefficient = 20, foundation_temperature = -4 }}
)",
                     time, of_t);
}
const std::string static_block = block("end = 2, steps = 4, regime = \"static\"", "t");

std::string block_in_space(const std::string &time, const std::string &of_t) {
  return fmt::format(R"(
mesh.box = {{ min = [0, 0, 0], max = [0.1, 0.1, 0.1], cells = [3, 3, 3], cell = "tetrahedron" }}
material.library = "BaTiO3-Liu2014"
time = {{ {0} }}
boundary = [
  {{ on = "right", displacement = [0, 0, 0], potential = 0, temperature = "3*{1}" }},
  {{ on = "top", traction = [0, 0, "-5e6*{1}"] }} ]
[contact]
on = "left"
normal = "unilateral"
gap = "-1e-6"
friction = {{ law = "coulomb", coefficient = 0.3 }}
heat = {{ law = "exchange", coefficient = 20, foundation_temperature = -4 }}
)",
                     time, of_t);
}

void expect_same_nodes(const RunCase &a, const RunCase &b, double tolerance) {
  const Table one = a.nodes(), other = b.nodes();
  for (const char *column : {"u_x", "u_y", "potential", "temperature"}) {
    const std::vector<double> x = one.numbers(column), y = other.numbers(column);
    double size = 0;
    for (const double value : x)
      size = std::max(size, std::abs(value));
    ASSERT_GT(size, 0) << column;
    for (std::size_t i = 0; i < x.size(); ++i)
      EXPECT_NEAR(x[i], y[i], tolerance * size) << column;
  }
}

// Load levels that follow each other so slowly that no heat is left on its way.
TEST(Static, IsWhatQuasistaticRunsTendTo) {
  const std::string slow = "end = 2e13, steps = 4";
  expect_same_nodes(run_text(static_block), run_text(block(slow, "(1e-13*t)")), 1e-9);
  expect_same_nodes(run_text(block_in_space("end = 2, steps = 4, regime = \"static\"", "t")),
                    run_text(block_in_space(slow, "(1e-13*t)")), 1e-9);
}

TEST(Static, IsSolvedAlikeOnAllRoutes) {
  const RunCase direct = run_text(static_block);
  EXPECT_GT(direct.history().numbers("slip").back(), 0);
  EXPECT_EQ(direct.summary()["factorisations"], 1);
  for (const char *route : {"solver.method=monolithic", "solver.body=iterative"})
    expect_same_nodes(direct, run_text(static_block, {route}), 1e-9);
}

TEST(Static, ClosesItsBalances) {
  expect_closed_balances(run_text(static_block).history());
  expect_closed_balances(
      run_text(block_in_space("end = 2, steps = 4, regime = \"static\"", "t")).history());
}

// What flows out is what is supplied, in watts: nothing is stored, whatever the load levels are.
TEST(Static, HeatFlowsSteadily) {
  const Table h = run_text(static_block).history();
  const std::vector<double> stored = h.numbers("stored_heat_rate"),
                            source = h.numbers("heat_source"), top = h.numbers("heat_top"),
                            right = h.numbers("heat_right"), bottom = h.numbers("heat_bottom"),
                            left = h.numbers("heat_left"), lost = h.numbers("conduction_loss");
  for (std::size_t n = 0; n < stored.size(); ++n) {
    EXPECT_EQ(stored[n], 0);
    EXPECT_EQ(lost[n], 0);
    EXPECT_NEAR(source[n], 1e4 * 0.5 * double(n + 1) * 0.1 * 0.1 * 0.1 / 2, 1e-10);
    EXPECT_NEAR(top[n] + right[n] + bottom[n] + left[n], source[n], 1e-9 * std::abs(right[n]));
  }
}

// The step between two load levels decides no state where everything sticks: it is elastic.
TEST(Static, LoadLevelsBetweenDoNotMatterWhereNothingSlips) {
  const std::vector<std::string> sticks{"contact.friction.bound=1e12"};
  std::vector<std::string> at_once = sticks;
  at_once.emplace_back("time.steps=1");
  expect_same_nodes(run_text(static_block, sticks), run_text(static_block, at_once), 1e-10);
}

// A layer that a foundation drags along: friction works by bound times slip, whatever t is.
TEST(Static, FrictionWorksByIncrement) {
  for (const double end : {1., 1000.}) {
    const RunCase run = run_text(fmt::format(R"(
mesh.box = {{ min = [0, 0], max = [0.1, 0.1], cells = [4, 4] }}
material.library = "BaTiO3-Liu2014"
time = {{ end = {0}, steps = 5, regime = "static" }}
boundary = [ {{ on = "right", displacement = [0, 0], potential = 0 }} ]
[contact]
on = "left"
foundation_displacement = [0, "1e-3*t/{0}"]
friction = {{ law = "tresca", bound = 15 }}
)",
                                             end));
    const std::vector<double> power = run.history().numbers("friction_dissipation"),
                              rate = run.contact().numbers("slip_rate");
    EXPECT_NEAR(power.back() * end / 5, 15 * 0.1 * 1e-3 / 5, 1e-6 * 15 * 0.1 * 1e-3);
    EXPECT_NEAR(rate.back() * end / 5, 1e-3 / 5, 1e-8);
  }
}

TEST(Static, WhatHasARateIsNotAvailable) {
  for (const char *with :
       {"contact.normal={law='damped',coefficient=1e9}",
        "contact.electric={law='leak',coefficient=1e-9,foundation_potential=0}",
        "contact.heat={law='insulated',friction_share=0.5}",
        "contact.friction={law='coulomb',coefficient={static=0.3,kinetic=0.2,speed=1}}",
        "electrode=[{name='a',on='bottom',resistor=1}]",
        "contact.heat={law='exchange',coefficient=1,foundation_temperature=0,ramp=1e-6}"}) {
    try {
      run_text(static_block, {with});
      FAIL() << with;
    } catch (const CaseError &error) {
      EXPECT_NE(std::string(error.what()).find("not available with time.regime = \"static\""),
                std::string::npos)
          << error.what();
    }
  }
}

// Of a body whose temperature nothing holds: it stays at 0, without a warning.
TEST(Static, MayHaveLoadLevelsOfSeveralSizes) {
  const RunCase run = run_text(R"(
mesh.box = { min = [0, 0], max = [0.1, 0.1], cells = [4, 4] }
material.library = "BaTiO3-Liu2014"
time = { regime = "static", interval = [{ until = 1, steps = 2 }, { until = 4, steps = 3 }] }
boundary = [ { on = "right", displacement = [0, 0], potential = 0 },
             { on = "left", traction = ["1e6*t", 0] } ]
)");
  const std::vector<double> t = run.history().numbers("time"),
                            load = run.history().numbers("load_x");
  for (std::size_t n = 0; n < t.size(); ++n)
    EXPECT_NEAR(load[n], 1e5 * t[n], 1e-6);
  for (const double theta : run.nodes().numbers("temperature"))
    EXPECT_EQ(theta, 0);
  EXPECT_EQ(run.summary()["warnings"].size(), 0U);
}

}  // namespace
}  // namespace tourmaline::verified
