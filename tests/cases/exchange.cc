// Label: analytic. Heat and charge that cross the contact by its state, against the closed forms of
// docs/exact-solutions.md, section 7, and against one another.

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>

#include "closed_balances.h"
#include "equal_quantities.h"
#include "run_case.h"
#include "tourmaline/error.h"

namespace tourmaline::verified {
namespace {

using Overrides = std::vector<std::string>;

RunCase verification(const std::string &name, const Overrides &overrides = {}) {
  return RunCase("cases/verification/" + name + ".toml", overrides);
}

void expect_all(const std::vector<double> &values, double expected, double tolerance = 1e-9) {
  for (const double value : values)
    EXPECT_NEAR(value, expected, tolerance * std::abs(expected));
}

std::vector<double> last_step(const Table &contact, const std::string &column) {
  const std::vector<double> values = contact.numbers(column), steps = contact.numbers("step");
  std::vector<double> last;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (steps[i] == steps.back())
      last.push_back(values[i]);
  return last;
}

// 1. Heat of friction.

constexpr double pressed = 1e7, mu = 0.3, speed = 1e-4, k33 = 75, height = 0.01, width = 0.02;
constexpr double made = mu * pressed * speed;  // W/m^2

double warmed(double share, double k_c, double theta_f) {
  return (share * made + k_c * theta_f) / (k33 / height + k_c);
}

TEST(FrictionHeat, WarmsASlidingLayerAsConductionAndExchangeTakeIt) {
  const RunCase run = verification("friction-heat");
  const double theta = warmed(0.5, 2e4, -2);
  expect_all(last_step(run.contact(), "temperature"), theta);
  expect_all(last_step(run.contact(), "heat_flux"), 2e4 * (theta + 2) - 0.5 * made);
  expect_closed_balances(run.history());
}

TEST(FrictionHeat, OnAnInsulatingFoundationAllOfTheShareGoesThroughTheLayer) {
  const RunCase run =
      verification("friction-heat", {"contact.heat={law='insulated',friction_share=0.25}"});
  expect_all(last_step(run.contact(), "temperature"), warmed(0.25, 0, 0));
  // In the first step a part of the way shears the layer.
  std::vector<double> body = run.history().numbers("friction_heat_body"),
                      foundation = run.history().numbers("friction_heat_foundation");
  EXPECT_LT(body.front(), 0.25 * made * width);
  body.erase(body.begin());
  foundation.erase(foundation.begin());
  expect_all(body, 0.25 * made * width);
  expect_all(foundation, 0.75 * made * width);
  expect_closed_balances(run.history());
}

TEST(FrictionHeat, IsThatOfTrescasBoundOnBilateralContact) {
  const RunCase run = verification(
      "friction-heat", {"contact.normal='bilateral'", "contact.friction={law='tresca',bound=3e6}"});
  expect_all(last_step(run.contact(), "temperature"), warmed(0.5, 2e4, -2));
  expect_closed_balances(run.history());
}

TEST(FrictionHeat, OfNothingIsTheExchangeAlone) {
  const RunCase run = verification("friction-heat", {"contact.heat.friction_share=0"});
  expect_all(last_step(run.contact(), "temperature"), warmed(0, 2e4, -2));
}

// Of a body with all couplings, in which heat, pressure and slip depend on one another.
const Overrides coupled{"material={library='BaTiO3-Liu2014'}", "time={end=2,steps=8}",
                        "contact.friction.coefficient={static=0.4,kinetic=0.25,speed=5e-5}",
                        "contact.gap='-2e-7*x/0.02'"};

void expect_halves(const Table &history) {
  const std::vector<double> power = history.numbers("friction_dissipation"),
                            body = history.numbers("friction_heat_body"),
                            foundation = history.numbers("friction_heat_foundation");
  for (std::size_t n = 0; n < power.size(); ++n) {
    EXPECT_GT(power[n], 0);
    EXPECT_NEAR(body[n], 0.5 * power[n], 1e-10 * power[n]);
    EXPECT_NEAR(body[n] + foundation[n], power[n], 1e-10 * power[n]);
  }
}

TEST(FrictionHeat, IsThePowerOfFrictionInACoupledBodyToo) {
  const RunCase run = verification("friction-heat", coupled);
  expect_closed_balances(run.history());
  expect_halves(run.history());
}

// At the corner, whose temperature is held, the support takes what friction brings.
TEST(FrictionHeat, WarmsTheBodyWhereATemperatureIsPrescribedToo) {
  for (const char *heat :
       {"contact.heat={law='insulated',friction_share=0.5}",
        "contact.heat={law='exchange',coefficient=2e4,foundation_temperature=-2,friction_share=0.5,"
        "ramp=1e-6}"}) {
    Overrides cooled = coupled;
    cooled.insert(cooled.end(), {"boundary[1].temperature=0", heat});
    const RunCase run = verification("friction-heat", cooled);
    expect_closed_balances(run.history());
    expect_halves(run.history());
  }
}

// 2. Exchange by pressure and gap: Barber's rod.

// Its tiny reference temperature makes every run warn, which no case of the repository's may.
const std::string barber = "tests/cases/exchange/barber-rod.toml";

double end_of_rod(const std::string &initial, const Overrides &more = {}) {
  Overrides overrides{"initial.temperature='" + initial + "'"};
  overrides.insert(overrides.end(), more.begin(), more.end());
  const RunCase run(barber, overrides);
  expect_closed_balances(run.history());
  return run.contact().numbers("temperature").back();
}

constexpr double cold = 24.33981132056604, between = 41.55506063346715, hot = 91.44493936653284;

TEST(BarbersRod, HasThreeSteadyStates) {
  EXPECT_NEAR(end_of_rod("0", {"time={end=8000,steps=100}"}), cold, 1e-8);
  EXPECT_NEAR(end_of_rod("100*x/0.1"), hot, 1e-8);
  // Left alone as long as nothing disturbs it.
  EXPECT_NEAR(end_of_rod("41.55506063346715*x/0.1", {"time={end=5,steps=5}"}), between, 1e-8);
}

// theta ~ sinh(q x) exp(a t), a = k q^2/(rho c): 1 % where steps and cells are small.
TEST(BarbersRod, LeavesTheMiddleOneByEitherSideAtTheRateOfItsMode) {
  for (const int side : {-1, 1}) {
    const RunCase run(
        barber,
        {fmt::format("initial.temperature='41.55506063346715*x/0.1 + {}*1e-6*sinh(44.352305*x)/{}'",
                     side, std::sinh(4.4352305)),
         "time={end=60,steps=300}"});
    const Table contact = run.contact();
    const std::vector<double> theta = contact.numbers("temperature"),
                              time = contact.numbers("time");
    const auto at = [&](double t) {
      for (std::size_t i = 0; i < time.size(); ++i)
        if (std::abs(time[i] - t) < 1e-6)
          return theta[i] - between;
      return 0.;
    };
    EXPECT_GT(side * at(60), 0);
    EXPECT_NEAR(std::log(at(60) / at(20)) / 40, 0.042578505729, 0.01 * 0.0426) << side;
  }
}

// Steps that are long for the mode that grows would jump to the other side.
TEST(BarbersRod, GoesFromTheMiddleOneToThatOfTheSideOfADisturbance) {
  const Overrides steps{"time={end=6000,steps=1200}"};
  EXPECT_NEAR(end_of_rod("(41.55506063346715 - 1e-6)*x/0.1", steps), cold, 1e-7);
  EXPECT_NEAR(end_of_rod("(41.55506063346715 + 1e-6)*x/0.1", steps), hot, 1e-7);
}

// 3. Charge.

constexpr double c33 = 162e9, e33 = 18.6, beta33 = 12.6e-9, column = 0.1;
constexpr double capacity = (beta33 + e33 * e33 / c33) / column;  // F/m^2

double charged(double c, double phi_f = 0) {
  return (c * phi_f + e33 * 1e6 / c33) / (c + capacity);
}

TEST(ChargeExchange, DividesTheVoltageOfAColumnAsCapacitorsDo) {
  EXPECT_NEAR(charged(1e-7), 464.169137244, 1e-8);
  for (const char *more : {"contact.electric.foundation_potential=0", "contact.electric.ramp=1e-6",
                           "solver.method=monolithic"}) {
    const RunCase run = verification("charge-exchange", {more});
    expect_all(run.contact().numbers("potential"), charged(1e-7));
    expect_all(run.contact().numbers("charge_flux"), 1e-7 * charged(1e-7));
    expect_all(run.history().numbers("charge_bottom"), 1e-7 * charged(1e-7) * 0.01);
    expect_closed_balances(run.history());
  }
  const RunCase other = verification(
      "charge-exchange",
      {"contact.electric.coefficient=1e-6", "contact.electric.foundation_potential=50"});
  expect_all(other.contact().numbers("potential"), charged(1e-6, 50));
  expect_closed_balances(other.history());
}

TEST(ChargeExchange, OfALeakGoesOnUntilThePotentialIsThatOfTheFoundation) {
  for (const char *more : {"contact.electric.foundation_potential=0", "contact.electric.ramp=1e-6",
                           "solver.method=monolithic", "solver.body=iterative"}) {
    const RunCase run =
        verification("charge-exchange",
                     {"contact.electric.law=leak", "contact.electric.coefficient=5e-7", more});
    const Table contact = run.contact();
    const std::vector<double> phi = contact.numbers("potential"), step = contact.numbers("step"),
                              flux = contact.numbers("charge_flux");
    for (std::size_t i = 0; i < phi.size(); ++i) {
      const double expected = charged(0) * std::pow(capacity / (capacity + 0.25 * 5e-7), step[i]);
      EXPECT_NEAR(phi[i], expected, 1e-9 * charged(0)) << more;
      EXPECT_NEAR(flux[i], capacity * (charged(0) - expected), 1e-9 * capacity * charged(0))
          << more;
    }
    expect_closed_balances(run.history());
  }
}

// 4. Where it may fail.

void expect_refused(const std::string &file, const Overrides &overrides, const std::string &words) {
  try {
    RunCase(file, overrides);
    ADD_FAILURE() << "was not refused: " << words;
  } catch (const CaseError &error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr(words));
  }
}

TEST(Exchange, IsRefusedOnMultipliersOfFacets) {
  expect_refused("cases/verification/friction-heat.toml",
                 {"solver.method=monolithic", "solver.multiplier=piecewise-constant",
                  "contact.normal=bilateral", "contact.friction={law='tresca',bound=1e6}"},
                 "contact with heat.friction_share is not available with solver.multiplier");
}

// 5. Every route. Contact that rubs, warms and lets go, with nodes that symmetry holds partly.

const char *const rubbed = R"toml(
mesh.box = { min = [0, 0], max = [0.02, 0.01], cells = [10, 5] }
material = { library = "BaTiO3-Liu2014", pyroelectric = [0, 1e-4] }
time = { end = 1, steps = 4 }
boundary = [ { on = "left", displacement = [0, "free"] },
             { on = "top", displacement = ["free", "-2e-7*t + 3e-5*(x - 0.01)*t^2"], potential = 0, temperature = 0 } ]
[contact]
on = "bottom"
normal = "unilateral"
foundation_displacement = ["1e-6*sin(4*t)", 0]
friction = { law = "coulomb", coefficient = 0.4 }
heat = { law = "exchange", coefficient = 2e4, foundation_temperature = "20*t", friction_share = 0.5, ramp = 3e-7, pressure = { coefficient = 3e4, reference = 1e7, exponent = 0.95 } }
electric = { law = "leak", coefficient = 1e-6, foundation_potential = "50*t", ramp = 2e-7 }
)toml";

const char *const rubbed_block = R"toml(
mesh.box = { min = [0, 0, 0], max = [0.02, 0.015, 0.01], cells = [4, 3, 3], cell = "hexahedron" }
mesh.degree = 2
time = { end = 1, steps = 3 }
region = [ { where = "z < 0.005", material = { library = "BaTiO3-Liu2014", pyroelectric = [0, 0, 1e-4] } },
           { where = "z >= 0.005", material.library = "BaTiO3-Liu2014" } ]
boundary = [ { on = "left", displacement = [0, "free", "free"] },
             { on = "top", displacement = [0, 0, "-2e-7*t + 2e-5*(x - 0.01)*t"], temperature = 0 } ]
electrode = [ { name = "top", on = "top", voltage = "20*t" } ]
[contact]
on = "bottom"
normal = { law = "compliance", coefficient = 1e14, exponent = 1 }
foundation_displacement = ["2e-7*t", "3e-7*sin(4*t)", 0]
friction = { law = "coulomb", coefficient = 0.4 }
heat = { law = "exchange", coefficient = 2e4, foundation_temperature = "20*t", friction_share = 0.5, ramp = 3e-7 }
electric = { law = "exchange", coefficient = 1e-8, foundation_potential = "5*t", ramp = 2e-7 }
)toml";

void expect_one_answer(const char *text) {
  const RunCase condensed = run_text(text);
  expect_closed_balances(condensed.history());
  EXPECT_GT(largest(condensed.history(), "friction_heat_body"), 0);
  EXPECT_GT(largest(condensed.contact(), "charge_flux"), 0);
  for (const Overrides &route :
       {Overrides{"solver.method=monolithic", "solver.tolerance=1e-12"},
        Overrides{"solver.body=iterative", "solver.linear_tolerance=1e-13"}}) {
    SCOPED_TRACE(route.front());
    const RunCase other = run_text(text, route);
    EXPECT_EQ(other.contact().columns.at("status"), condensed.contact().columns.at("status"));
    expect_equal_quantities(other.contact(), condensed.contact(),
                            {{"temperature"},
                             {"potential"},
                             {"heat_flux"},
                             {"charge_flux"},
                             {"normal_traction"},
                             {"tangential_traction_x"},
                             {"gap"}});
    expect_equal_quantities(
        other.history(), condensed.history(),
        {{"friction_heat_body", "friction_heat_foundation"}, {"charge_bottom"}, {"heat_bottom"}});
    expect_closed_balances(other.history(), 1e-9);
  }
}

TEST(EveryRoute, LetsHeatAndChargeCrossAPlaneContactByItsState) {
  expect_one_answer(rubbed);
}

TEST(EveryRoute, LetsHeatAndChargeCrossAContactOfASolidByItsState) {
  expect_one_answer(rubbed_block);
}

}  // namespace
}  // namespace tourmaline::verified
