// Label: analytic. What is there at t = 0 in runs with inertia, and supports that move.

#include <fmt/format.h>

#include <cmath>

#include "closed_balances.h"
#include "elastic_body.h"
#include "equal_quantities.h"
#include "run_case.h"

namespace tourmaline::verified {
namespace {

// A load, a voltage and a weight that are there at t = 0 accelerate from there on: no step knows
// more of them than the others, and the first acceleration is that of the equations.
TEST(StartOfMotion, ConstantLoadsAccelerateFromTheStart) {
  const RunCase run = run_text(fmt::format(R"toml(
mesh.box = {{ min = [0, 0], max = [0.1, 0.1], cells = [4, 4], cell = "quadrilateral" }}
material = {{ {}, young = 1e9, density = 1000 }}
time = {{ end = 1, steps = 4, regime = "dynamic" }}
boundary = [ {{ on = "top", potential = 0 }} ]
load = {{ force = [0, -5000] }}
contact = {{ on = "bottom", gap = 10, normal = "unilateral" }}
)toml",
                                           elastic));
  expect_closed_balances(run.history(), 1e-7);
  for (const double u : run.nodes().numbers("u_y"))
    EXPECT_NEAR(u, -2.5, 1e-5);
}

// A slab under 5 V above, below an electrode, or a foundation across 1e-6 F/m^2, that is not
// connected to anything.
RunCase floating_slab(const std::string &below, const std::string &regime) {
  return run_text(fmt::format(R"toml(
mesh.box = {{ min = [0, 0], max = [0.1, 0.02], cells = [3, 4], cell = "quadrilateral" }}
material = {{ {}, young = 1e6, density = 1000 }}
time = {{ end = 1, steps = 4, regime = "{}" }}
boundary = [ {{ on = "top", displacement = [0, 0], potential = 5 }} ]
{}
)toml",
                              elastic, regime, below));
}

std::string exchange_to(const std::string &foundation) {
  return "contact = { on = 'bottom', electric = { law = 'exchange', coefficient = 1e-6, " +
         foundation + " } }";
}

TEST(StartOfMotion, WhatIsOpenKeepsItsChargeAndHasNoCurrent) {
  for (const char *regime : {"quasistatic", "dynamic"})
    for (const auto &[name, below] : std::vector<std::pair<std::string, std::string>>{
             {"electrode_e", "electrode = [ { name = 'e', on = 'bottom' } ]"},
             {"foundation", exchange_to("circuit = {}")},
             {"foundation", exchange_to("ramp = 1e-3, circuit = {}")}}) {
      SCOPED_TRACE(fmt::format("{}, {}", regime, below));
      const Table history = floating_slab(below, regime).history();
      for (const double voltage : history.numbers(name + "_voltage"))
        EXPECT_NEAR(voltage, 5, 1e-9);
      EXPECT_LT(largest(history, name + "_charge"), 1e-17);   // 5e-7 C at 0 V
      EXPECT_LT(largest(history, name + "_current"), 1e-16);  // in steps of 0.25 s
      expect_closed_balances(history);
    }
}

// Backward Euler of the charge on the slab's capacitance and that of the exchange in series.
TEST(StartOfMotion, AResistorHasAllOfTheVoltageAtFirst) {
  constexpr double slab = 8.8541878188e-12 * 0.1 / 0.02, exchange = 1e-6 * 0.1,
                   series = 1 / (1 / slab + 1 / exchange);
  for (const char *regime : {"quasistatic", "dynamic"})
    for (const char *ramp : {"", "ramp = 1e-3, "}) {
      SCOPED_TRACE(fmt::format("{}, {}", regime, ramp));
      const Table history =
          floating_slab(
              exchange_to(fmt::format("{}circuit = {{ resistor = {:.17g} }}", ramp, 0.5 / series)),
              regime)
              .history();
      const std::vector<double> voltage = history.numbers("foundation_voltage");
      for (std::size_t n = 0; n < 4; ++n)
        EXPECT_NEAR(voltage[n], 5 / std::pow(1.5, n + 1), 1e-7) << n;
    }
}

// A piezoelectric body jumps at t = 0 to the voltage of its open electrode without a current.
TEST(StartOfMotion, AnOpenElectrodeOfAPiezoelectricBodyHasItsVoltageAtOnce) {
  const RunCase run = run_text(R"toml(
mesh.box = { min = [0, 0], max = [0.01, 0.01], cells = [4, 4], cell = "quadrilateral" }
material = { library = "BaTiO3-Liu2014" }
time = { end = 1e-7, steps = 10, regime = "dynamic" }
boundary = [ { on = "bottom", displacement = [0, 0] } ]
electrode = [ { name = "low", on = "bottom", voltage = 0 }, { name = "drive", on = "left", voltage = 100 },
              { name = "open", on = "top" } ]
)toml");
  const Table history = run.history();
  const auto voltage = history.numbers("electrode_open_voltage"),
             current = history.numbers("electrode_open_current"),
             driven = history.numbers("electrode_drive_charge");
  EXPECT_LT(largest(current), 1e-10 * driven[0] / 1e-8);
  EXPECT_GT(voltage[0], 10);
  EXPECT_NEAR(voltage[1], voltage[0], 0.01 * voltage[0]);
  expect_closed_balances(history, 1e-9);
}

// Written as an exchange by the contact's state it is lumped, and else the same.
TEST(StartOfMotion, ARampThatNeverActsChangesNothing) {
  const auto energies = [](const char *ramp) {
    return run_text(fmt::format(R"toml(
mesh.box = {{ min = [0, 0], max = [0.01, 0.01], cells = [4, 4], cell = "quadrilateral" }}
material = {{ library = "BaTiO3-Liu2014" }}
time = {{ end = 1e-5, steps = 20, regime = "dynamic" }}
boundary = [ {{ on = "top", displacement = [0, 0], potential = 0 }} ]
contact = {{ on = "bottom", electric = {{ law = "exchange", coefficient = 1e-2, {}foundation_potential = 1000 }} }}
)toml",
                                ramp))
        .history()
        .numbers("kinetic_energy");
  };
  const std::vector<double> integrated = energies(""), lumped = energies("ramp = 1e-2, ");
  for (std::size_t n = 0; n < integrated.size(); ++n)
    EXPECT_NEAR(lumped[n] / integrated[n], 1, 1e-3) << n;
}

RunCase moved_bar(const std::string &support, int steps,
                  const std::vector<std::string> &more = {}) {
  return run_text(fmt::format(R"toml(
mesh.box = {{ min = [0, 0], max = [0.1, 1], cells = [1, 10], cell = "quadrilateral" }}
material = {{ {}, young = 1e6, density = 1000 }}
time = {{ end = 0.2, steps = {}, regime = "dynamic" }}
boundary = [ {{ on = ["left", "right"], displacement = [0, "free"] }}, {{ on = "top", potential = 0 }},
             {{ on = "bottom", displacement = ["free", {}] }} ]
)toml",
                              elastic, steps, support),
                  more);
}

// A support that moves at 0.01 m/s and stops sends waves of rho c V = 316 N/m^2, which are back at
// it twice in the run: up to four times that.
TEST(MovingSupport, ThatStopsDoesNotRing) {
  for (const int degree : {1, 2})
    for (const int steps : {50, 800}) {
      SCOPED_TRACE(fmt::format("{}, {}", degree, steps));
      const Table history = moved_bar("{ points = [[0, 0], [0.1, 1e-3], [0.2, 1e-3]] }", steps,
                                      {fmt::format("mesh.degree={}", degree)})
                                .history();
      const std::vector<double> reaction = history.numbers("reaction_y");
      for (std::size_t n = reaction.size() / 2 + 2; n < reaction.size(); ++n)
        EXPECT_LT(std::abs(reaction[n]), 4 * 31.6) << n;
      EXPECT_LT(largest(history, "energy_imbalance"), 1e-10);
    }
}

TEST(MovingSupport, ThatMovesSmoothlyIsOfSecondOrder) {
  std::vector<double> energy, reaction;
  for (const int steps : {50, 100, 200, 1600}) {
    const Table history =
        moved_bar("'1e-3*sin(20*t)^2 + 1e-3*t'", steps, {"material.stiffness_damping=2e-3"})
            .history();
    energy.push_back(history.numbers("elastic_energy").back());
    reaction.push_back(history.numbers("reaction_y")[static_cast<std::size_t>(steps) / 2 - 1]);
    EXPECT_LT(largest(history, "energy_imbalance"), 1e-10);
  }
  for (const std::vector<double> &of : {energy, reaction}) {
    EXPECT_NEAR((of[0] - of[3]) / (of[1] - of[3]), 4, 0.6);
    EXPECT_NEAR((of[1] - of[3]) / (of[2] - of[3]), 4, 0.3);
  }
}

// Its formula need not be there outside of the run.
TEST(MovingSupport, IsAskedOnlyInsideTheRun) {
  for (const int steps : {1, 2, 3})
    EXPECT_NO_THROW(moved_bar("'1e-3*sqrt(0.2 - t)'", steps)) << steps;
}

// Charges inside the body, from the first moment on, are no charge of the electrode that they
// raise.
TEST(StartOfMotion, AnElectrodeBesideChargesInsideHasNoneBeforeItsFirstCurrent) {
  for (const char *route :
       {"solver.method=condensed", "solver.method=monolithic", "solver.body=iterative"}) {
    SCOPED_TRACE(route);
    const RunCase run = run_text(R"toml(
material.library = "BaTiO3-Liu2014"
mesh.box = { min = [0, 0], max = [0.01, 0.01], cells = [4, 4] }
time = { regime = "dynamic", end = 1e-6, steps = 4 }
load.charge = 1e-2
boundary = [ { on = "bottom", displacement = [0, 0], temperature = 0 } ]
electrode = [ { name = "ground", on = "bottom", voltage = 0 }, { name = "plate", on = "top", resistor = 1e6 } ]
)toml",
                                 {route});
    const double charge = run.history().numbers("electrode_plate_charge").front(),
                 current = run.history().numbers("electrode_plate_current").front();
    EXPECT_LT(current, 0);
    EXPECT_NEAR(charge, current * 2.5e-7, 1e-9 * std::abs(charge));
  }
}

// Round-off of the conductor's rows is more than what an iteration leaves elsewhere.
TEST(StartOfMotion, OfABodyWithAConductorIsFoundByIterationToo) {
  const auto run = [](const std::string &body) {
    return run_text(R"toml(
mesh.box = { min = [0, 0, 0], max = [0.1, 0.1, 0.05], cells = [2, 4, 3], cell = "hexahedron" }
mesh.degree = 2
model.thermal = false
region = [
  { where = "z <= 0.025", material = { library = "BaTiO3-Liu2014", mass_damping = 3e4 } },
  { where = "z > 0.025", material = { library = "aluminium" } } ]
time = { regime = "dynamic", end = 7.5e-5, steps = 4 }
boundary = [ { on = "top", potential = "100.0*sin(40000.0*t)" } ]
electrode = [ { name = "back", on = "back", voltage = "100.0*sin(40000.0*t)" } ]
[contact]
on = "bottom"
gap = "1e-6*x"
normal = { law = "compliance", coefficient = 1e12 }
friction = { law = "coulomb", coefficient = 0.3 }
electric = { law = "exchange", coefficient = 1e-7, circuit = { charge = 1e-8 } }
)toml",
                    {"solver.body=" + body});
  };
  expect_equal_quantities(run("iterative").nodes(), run("direct").nodes(),
                          {{"u_x", "u_y", "u_z"}, {"potential"}}, 1e-7);
}

}  // namespace
}  // namespace tourmaline::verified
