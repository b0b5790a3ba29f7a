// Label: analytic. Foundations that conduct and whose potential follows from a circuit: the column
// of docs/exact-solutions.md, 7, and what is the same as a potential that is given.

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

// A column of 0.01 m x 0.1 m pressed with 1e6 N/m^2, of which D.nu = pressed - capacity phi leaves
// below.
constexpr double c33 = 162e9, e33 = 18.6, beta33 = 12.6e-9, area = 0.01;
constexpr double capacity = (beta33 + e33 * e33 / c33) / 0.1;  // F/m^2
constexpr double pressed = e33 * 1e6 / c33;                    // C/m^2
constexpr double c = 1e-7, k = 0.25;                           // F/m^2, s

// On every route, and with a law that asks for the contact's state.
const std::vector<Overrides> routes = {{},
                                       {"contact.electric.ramp=1e-6"},
                                       {"solver.method=monolithic"},
                                       {"solver.method=monolithic", "contact.electric.ramp=1e-6"},
                                       {"solver.body=iterative", "solver.linear_tolerance=1e-13"}};

RunCase column(const std::string &circuit, Overrides more) {
  more.insert(
      more.begin(),
      fmt::format("contact.electric={{law='exchange',coefficient={},circuit={}}}", c, circuit));
  return RunCase("cases/verification/charge-exchange.toml", more);
}

void expect_column(const std::vector<double> &values, const std::function<double(int)> &expected) {
  ASSERT_EQ(values.size(), 4U);
  for (int n = 1; n <= 4; ++n)
    EXPECT_NEAR(values[static_cast<std::size_t>(n) - 1], expected(n),
                1e-9 * std::abs(expected(n)) + 1e-18)
        << n;
}

TEST(FoundationCircuit, ThatIsOpenHasThePotentialOfTheColumn) {
  for (const Overrides &route : routes) {
    const RunCase run = column("{}", route);
    for (const double phi : run.contact().numbers("potential"))
      EXPECT_NEAR(phi, pressed / capacity, 1e-7);
    expect_column(run.history().numbers("foundation_voltage"),
                  [](int) { return pressed / capacity; });
    EXPECT_LT(largest(run.history(), "foundation_charge"), 1e-12 * pressed * area);
    expect_closed_balances(run.history());
  }
}

TEST(FoundationCircuit, WithAGivenChargeStandsAboveTheColumnByThatOverItsCapacitance) {
  const auto charge = [](int n) { return 1e-9 * n * k; };
  const auto phi = [&](int n) { return (pressed + charge(n) / area) / capacity; };
  for (const Overrides &route : routes) {
    const Table history = column("{charge='1e-9*t'}", route).history();
    expect_column(history.numbers("foundation_charge"), charge);
    expect_column(history.numbers("foundation_voltage"),
                  [&](int n) { return phi(n) + charge(n) / area / c; });
    expect_column(history.numbers("charge_bottom"), [&](int n) { return -charge(n); });
    expect_closed_balances(history);
  }
}

// Backward Euler for R dQ/dt + V = E, with V of the two lines above.
TEST(FoundationCircuit, BehindAResistorIsChargedAsTheColumnIs) {
  constexpr double ohms = 2e8, emf = 300, gain = k / ohms;
  constexpr double per_charge = (1 / capacity + 1 / c) / area;  // V/C
  const auto charge = [&](int n) {
    double q = 0;
    for (int i = 0; i < n; ++i)
      q = (q + gain * (emf - pressed / capacity)) / (1 + gain * per_charge);
    return q;
  };
  for (const Overrides &route : routes) {
    const Table history = column("{resistor=2e8,voltage=300}", route).history();
    expect_column(history.numbers("foundation_charge"), charge);
    expect_column(history.numbers("foundation_current"),
                  [&](int n) { return (charge(n) - charge(n - 1)) / k; });
    expect_column(history.numbers("foundation_voltage"),
                  [&](int n) { return pressed / capacity + per_charge * charge(n); });
    expect_column(history.numbers("foundation_resistor_power"),
                  [&](int n) { return std::pow((charge(n) - charge(n - 1)) / k, 2) * ohms; });
    expect_closed_balances(history);
  }
}

// C (V - E) = -Q with nothing on both at the beginning.
TEST(FoundationCircuit, BehindACapacitorSharesTheVoltage) {
  const double charge = -pressed / capacity / (1 / 1e-9 + (1 / capacity + 1 / c) / area);
  for (const Overrides &route : routes)
    expect_column(column("{capacitor=1e-9}", route).history().numbers("foundation_charge"),
                  [&](int) { return charge; });
}

// What has leaked through the contact is on an open foundation as charge; and its own is 0.
TEST(FoundationCircuit, ThatIsOpenTakesNoChargeFromALeak) {
  for (const char *ramp : {"", ",ramp=1e-6"})
    for (const char *route : {"solver.method=condensed", "solver.method=monolithic"}) {
      const Table history =
          RunCase(
              "cases/verification/charge-exchange.toml",
              {fmt::format("contact.electric={{law='leak',coefficient=5e-7,circuit={{}}{}}}", ramp),
               route})
              .history();
      expect_column(history.numbers("foundation_voltage"), [](int) { return pressed / capacity; });
    }
}

// Two contacts that open, one of which charges what the other floats on.
const char *const two = R"toml(
mesh.box = { min = [0, 0], max = [0.02, 0.01], cells = [10, 5] }
material = { library = "BaTiO3-Liu2014", pyroelectric = [0, 1e-4] }
time = { end = 1, steps = 4 }
boundary = [ { on = "left", displacement = [0, "free"], temperature = "3*t", potential = "20*t" } ]
[[contact]]
on = "bottom"
normal = "unilateral"
foundation_displacement = ["1e-6*sin(4*t)", 0]
friction = { law = "coulomb", coefficient = 0.4 }
electric = { law = "leak", coefficient = 1e-6, ramp = 2e-7, circuit = { resistor = 1e9, capacitor = 1e-10, voltage = "30*t" } }
[[contact]]
on = "top"
normal = "unilateral"
gap = "1e-6*(x-0.01)"
foundation_displacement = [0, "-3e-7*t"]
friction = { law = "tresca", bound = 1e5 }
electric = { law = "exchange", coefficient = 1e-7, ramp = 2e-7, circuit = {} }
)toml";

TEST(FoundationCircuit, OfTwoContactsIsTheSameOnEveryRoute) {
  const RunCase condensed = run_text(two);
  expect_closed_balances(condensed.history());
  EXPECT_GT(largest(condensed.history(), "foundation_voltage_top"), 1);
  EXPECT_LT(largest(condensed.history(), "foundation_charge_top"), 1e-20);
  for (const Overrides &route :
       {Overrides{"solver.method=monolithic"},
        Overrides{"solver.body=iterative", "solver.linear_tolerance=1e-13"}}) {
    const RunCase other = run_text(two, route);
    EXPECT_EQ(other.contact().columns.at("status"), condensed.contact().columns.at("status"));
    expect_equal_quantities(other.contact(), condensed.contact(),
                            {{"potential"}, {"charge_flux"}, {"normal_traction"}});
    expect_equal_quantities(
        other.history(), condensed.history(),
        {{"foundation_voltage_bottom", "foundation_voltage_top"}, {"foundation_charge_bottom"}});
  }
}

// The potentials that were found, given to the same contacts, leave everything as it is.
TEST(FoundationCircuit, FindsThePotentialThatGivenToTheSameContactHasItsCharge) {
  const std::string text = R"toml(
mesh.box = { min = [0, 0, 0], max = [0.02, 0.01, 0.01], cells = [4, 2, 2], cell = "hexahedron" }
mesh.degree = 2
material = { library = "BaTiO3-Liu2014", pyroelectric = [0, 0, 1e-4] }
time = { end = 1, steps = 1 }
boundary = [ { on = "left", displacement = [0, "free", "free"], temperature = 0 },
             { on = "front", displacement = ["free", 0, "free"] } ]
electrode = [ { name = "lid", on = "top", resistor = 1e8, voltage = 40 } ]
[[contact]]
on = "bottom"
friction = { law = "tresca", bound = 1e5 }
foundation_displacement = ["1e-6*t", 0, 0]
)toml";
  const RunCase found = run_text(
      text +
      "electric={law='exchange',coefficient='1e-7*(1+50*x)',circuit={resistor=3e8,voltage=7}}");
  const double volts = found.history().numbers("foundation_voltage").back();
  EXPECT_GT(std::abs(volts - 7), 1e-3);
  const RunCase given = run_text(
      text +
      fmt::format(
          "electric={{law='exchange',coefficient='1e-7*(1+50*x)',foundation_potential={:.17g}}}",
          volts));
  expect_equal_quantities(found.contact(), given.contact(),
                          {{"potential"}, {"charge_flux"}, {"tangential_traction_x"}});
  expect_equal_quantities(found.history(), given.history(),
                          {{"charge_bottom"}, {"electrode_lid_charge"}, {"electrode_lid_voltage"}});
  expect_closed_balances(found.history());
}

// Two foundations, of which one lets go after a third of the time, or is reached in the second half
// of it, while a current comes from the other; a hundred thousand times as much conducts there.
const char *const one_apart = R"toml(
time = { end = 1, steps = 12 }
mesh.box = { min = [0, 0], max = [0.1, 0.02], cells = [4, 3] }
material = { symmetry = "isotropic", young = 1e9, poisson = 0.2, eps11 = 1000, k11 = 1, density = 1000, specific_heat = 1, reference_temperature = 293 }
boundary = [ { on = "top", displacement = [0, "-1e-6+3e-6*t"], potential = "5*t" } ]
[[contact]]
on = "left"
electric = { law = "exchange", coefficient = 1e-1, circuit = { resistor = 1e8, voltage = 3 } }
[[contact]]
on = "bottom"
normal = "unilateral"
electric = { law = "exchange", coefficient = 1e-6, ramp = 1e-7, circuit = {} }
)toml";

TEST(FoundationCircuit, ThatNothingTouchesLeavesTheOtherAlone) {
  for (const Overrides &moved :
       {Overrides{}, Overrides{"boundary[0].displacement=[0,'2e-6-3e-6*t']"},
        Overrides{"contact[1].electric.circuit={capacitor=1e-12}"}})
    for (const char *route :
         {"solver.method=condensed", "solver.method=monolithic", "solver.body=iterative"}) {
      Overrides all = moved;
      all.insert(all.end(), {route, "solver.linear_tolerance=1e-13"});
      const RunCase run = run_text(one_apart, all);
      const Table history = run.history();
      expect_closed_balances(history);
      const std::vector<double> charge = history.numbers("foundation_charge_left"),
                                current = history.numbers("foundation_current_left"),
                                voltage = history.numbers("foundation_voltage_left");
      for (std::size_t n = 0; n < charge.size(); ++n)
        EXPECT_NEAR(current[n], (3 - voltage[n]) / 1e8, 1e-9 * 3e-8) << route << n;
      EXPECT_GT(std::abs(charge.back()), 1e-9) << route;
    }
}

void expect_refused(const std::string &electric, const std::string &words) {
  try {
    RunCase("cases/verification/charge-exchange.toml", {"contact.electric=" + electric});
    ADD_FAILURE() << "was not refused: " << words;
  } catch (const CaseError &error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr(words));
  }
}

// The charge that comes through a good conductor is a small difference of large numbers.
TEST(FoundationCircuit, OfGoodConductorsKeepsItsDigitsOrSaysThatItLostThem) {
  const auto with = [](double coefficient, const Overrides &more) {
    Overrides all{fmt::format("contact.electric={{law='exchange',coefficient={},circuit={{}}}}",
                              coefficient)};
    all.insert(all.end(), more.begin(), more.end());
    return RunCase("cases/verification/charge-exchange.toml", all);
  };
  for (const double coefficient : {1e-7, 1e-3, 1.})
    for (const Overrides &route : routes)
      for (const double voltage : with(coefficient, route).history().numbers("foundation_voltage"))
        EXPECT_NEAR(voltage, pressed / capacity, 1e-6 * pressed / capacity) << coefficient;
  try {
    with(1e8, {});
    FAIL() << "found a potential that nobody can know";
  } catch (const SolveError &error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("electric.coefficient is so large"));
  }
}

// The body leaves its foundation after 1/3 of the time; an open one has had no charge to keep.
TEST(FoundationCircuit, ThatNothingTouchesAndThatHasAChargeIsAnError) {
  const std::string lifted = R"(
time = { end = 1, steps = 6 }
mesh.box = { min = [0, 0], max = [0.1, 0.02], cells = [3, 4] }
material = { symmetry = "isotropic", young = 1e9, poisson = 0.2, eps11 = 1000, k11 = 1, density = 1000, specific_heat = 1, reference_temperature = 293 }
boundary = [ { on = "top", displacement = [0, "-1e-6+3e-6*t"], potential = "5*t" } ]
contact = { on = "bottom", normal = "unilateral", electric = { law = "exchange", coefficient = 1e-6, ramp = 1e-7, circuit = {} } }
)";
  const RunCase open = run_text(lifted);
  expect_closed_balances(open.history());
  EXPECT_LT(largest(open.history(), "foundation_charge"), 1e-20);
  try {
    run_text(lifted, {"contact.electric.circuit={charge='1e-9*t'}"});
    FAIL() << "found a potential that does not exist";
  } catch (const SolveError &error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("nothing touches the foundation"));
  }
}

TEST(FoundationCircuit, ThatNoChargeComesToIsRefused) {
  try {
    RunCase("cases/verification/charge-exchange.toml",
            {"contact.electric={law='exchange',coefficient='0*x',circuit={}}"});
    FAIL() << "was not refused";
  } catch (const CaseError &error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("is 0 all over contact"));
  }
}

// In a static case time is a parameter: what is written as constant is what a ramp ends at.
TEST(FoundationCircuit, BehindACapacitorASourceIsSwitchedOnAtTheStart) {
  for (const Overrides &route : routes) {
    const auto last = [&](const char *voltage) {
      return column(fmt::format("{{capacitor=1e-9,voltage={}}}", voltage), route)
          .history()
          .numbers("foundation_voltage")
          .back();
    };
    const double constant = last("300"), ramp = last("'300*t'");
    EXPECT_NEAR(constant, ramp, 1e-9 * std::abs(ramp));
  }
}

// From 100 V to nothing, and on to 1000 V.
TEST(FoundationCircuit, ThatComesToZeroIsFoundOnEveryRoute) {
  for (const char *route :
       {"solver.method=condensed", "solver.method=monolithic", "solver.body=iterative"}) {
    SCOPED_TRACE(route);
    const Table history = run_text(R"toml(
mesh.box = { min = [0, 0], max = [100, 40], cells = [5, 4] }
model.thermal = false
material = { symmetry = "isotropic", young = 2.8e10, poisson = 0.3, density = 7570, eps11 = 715 }
time = { end = 0.01, steps = 2, regime = "dynamic" }
boundary = [ { on = "left", potential = "(t > 0.005 ? 1000 : 0)" },
             { on = "bottom", displacement = [0, "100*t^2*(1 + x/100)"], potential = "100 - 2e4*t" } ]
contact = { on = "top", friction = { law = "tresca", bound = "3e5*(1 + sin(600*t))" }, electric = { law = "exchange", coefficient = 3e-9, circuit = {} } }
)toml",
                                   {route})
                              .history();
    EXPECT_NEAR(history.numbers("foundation_voltage").front(), 0, 1e-9);
    EXPECT_NEAR(history.numbers("foundation_voltage").back(), 632.7588909799, 1e-6);
    EXPECT_LT(largest(history, "energy_imbalance"), 1e-10);
  }
}

TEST(FoundationCircuit, ThatContradictsItselfIsRefused) {
  const std::string law = "{law='exchange',coefficient=1e-7,";
  expect_refused(law + "circuit={},foundation_potential=1}",
                 "both `foundation_potential` and `circuit`");
  expect_refused(law + "circuit={charge=1e-9,resistor=1}}", "charge is given");
  expect_refused(law + "circuit={voltage=3}}", "foundation_potential instead");
  expect_refused(law + "circuit={charge='x'}}", "depends on the place");
  expect_refused(law + "circuit={resistor=0}}", "resistor");
}

}  // namespace
}  // namespace tourmaline::verified
