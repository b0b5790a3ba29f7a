// Label: analytic. Electrodes in circuits: a capacitor, open and short circuit, discharge over a
// resistor, dividers, reciprocity, and the energy that the circuit brings.

#include <fmt/format.h>

#include <cmath>

#include "closed_balances.h"
#include "run_case.h"
#include "tourmaline/case/case.h"

namespace tourmaline::verified {
namespace {

constexpr double c33 = 162e9, e33 = 18.6, beta33 = 12.6e-9;  // BaTiO3-Liu2014
constexpr double height = 0.01, width = 0.04, depth = 0.03;
constexpr double capacity = beta33 * width / height;  // of one metre of thickness, clamped [F/m]

// A slab between the electrodes top and bottom, held everywhere in the plane if `moves` is empty.
// Without heat: its coupling would add a little to the capacity.
std::string slab(const std::string &electrodes, const std::string &more = "",
                 const std::string &moves = "displacement = [0, 0]", const std::string &time = "") {
  return fmt::format(R"(
mesh.box = {{ min = [0, 0], max = [{}, {}], cells = [4, 3] }}
material = {{ library = "BaTiO3-Liu2014", m11 = 0, m33 = 0, p3 = 0 }}
time = {}
boundary = [ {{ on = ["left", "right", "bottom", "top"], {} }} ]
electrode = [ {} ]
output = {{ fields = false }}
{}
)",
                     width, height, time.empty() ? "{ end = 1, steps = 5 }" : time, moves,
                     electrodes, more);
}

Table history(const std::string &text) {
  return RunCase(casefile::read_text(text, "electrodes")).history();
}

void expect_all(const std::vector<double> &values, double exact, double tolerance) {
  for (const double value : values)
    EXPECT_NEAR(value, exact, tolerance);
}

const std::string ground = R"({ name = "ground", on = "bottom", voltage = 0 })";

// Without piezoelectricity the slab is a plain capacitor.
casefile::Case plain(const std::string &electrodes, const std::vector<std::string> &more = {}) {
  std::vector<std::string> overrides{"material.e31=0", "material.e33=0", "material.e15=0"};
  overrides.insert(overrides.end(), more.begin(), more.end());
  return casefile::read_text(slab(electrodes), "electrodes", overrides);
}

TEST(PlateCapacitor, DrivenItHasTheChargeOfItsCapacityTimesTheVoltage) {
  const Table h =
      RunCase(plain(ground + R"(, { name = "top", on = "top", voltage = "100*t" })")).history();
  const std::vector<double> t = h.numbers("time"), charge = h.numbers("electrode_top_charge"),
                            other = h.numbers("electrode_ground_charge"),
                            current = h.numbers("electrode_top_current");
  for (std::size_t n = 0; n < t.size(); ++n) {
    EXPECT_NEAR(charge[n], capacity * 100 * t[n], 1e-12 * capacity * 100);
    EXPECT_NEAR(other[n], -charge[n], 1e-12 * capacity * 100);
    EXPECT_NEAR(current[n], capacity * 100, 1e-11 * capacity * 100);
  }
}

TEST(PlateCapacitor, FloatingWithAChargeItHasTheVoltageOfTheChargeOverItsCapacity) {
  const Table h =
      RunCase(plain(ground + R"(, { name = "top", on = "top", charge = "1e-6*t" })")).history();
  const std::vector<double> t = h.numbers("time"), voltage = h.numbers("electrode_top_voltage");
  for (std::size_t n = 0; n < t.size(); ++n)
    EXPECT_NEAR(voltage[n], 1e-6 * t[n] / capacity, 1e-11 / capacity * 1e-6);
}

TEST(PlateCapacitor, InSpaceItHasTheCapacityOfItsArea) {
  const Table h = history(fmt::format(R"(
mesh.box = {{ min = [0, 0, 0], max = [{}, {}, {}], cells = [2, 2, 2], cell = "tetrahedron" }}
material = {{ library = "BaTiO3-Liu2014", m11 = 0, m33 = 0, p3 = 0, e31 = 0, e33 = 0, e15 = 0 }}
time = {{ end = 1, steps = 1 }}
boundary = [ {{ on = "bottom", displacement = [0, 0, 0] }} ]
electrode = [ {{ name = "a", on = "bottom", voltage = -3 }}, {{ name = "b", on = "top", charge = 2e-9 }} ]
output = {{ fields = false }}
)",
                                      width, depth, height));
  expect_all(h.numbers("electrode_b_voltage"), -3 + 2e-9 / (capacity * depth), 1e-9);
  expect_all(h.numbers("electrode_b_charge"), 2e-9, 1e-19);
}

// A column that can only change its height, pressed by 1e-9 m.
Table pressed_column(const std::string &electrodes) {
  return history(fmt::format(R"(
mesh.box = {{ min = [0, 0], max = [{}, {}], cells = [4, 3] }}
material = {{ library = "BaTiO3-Liu2014", m11 = 0, m33 = 0, p3 = 0 }}
time = {{ end = 1, steps = 2 }}
boundary = [ {{ on = ["left", "right"], displacement = [0, "free"] }},
             {{ on = "bottom", displacement = [0, 0] }},
             {{ on = "top", displacement = ["free", "-1e-9*t"] }} ]
electrode = [ {} ]
output = {{ fields = false }}
)",
                             width, height, electrodes));
}

TEST(Column, ShortCircuitedAndOpenItHasTheTwoStiffnessesOfThePiezoelectricLaw) {
  const double strain = -1e-9 / height;
  const Table shorted = pressed_column(R"({ name = "both", on = ["bottom", "top"], voltage = 0 })");
  const Table open = pressed_column(ground + R"(, { name = "top", on = "top" })");
  // Reactions at top and bottom cancel; the elastic energy tells them apart: W = stress strain / 2.
  const auto energy = [](const Table &h) {
    return h.numbers("elastic_energy").back() + h.numbers("electric_energy").back();
  };
  const double volume = width * height, stiffened = c33 + e33 * e33 / beta33;
  EXPECT_NEAR(energy(shorted) / (c33 * strain * strain / 2 * volume), 1, 1e-11);
  EXPECT_NEAR(energy(open) / (stiffened * strain * strain / 2 * volume), 1, 1e-11);
  // Open: D = 0, so the field is -e33 strain / beta33 and the voltage its height.
  EXPECT_NEAR(open.numbers("electrode_top_voltage").back() / (e33 * strain / beta33 * height), 1,
              1e-11);
  EXPECT_LT(largest(open.numbers("electrode_top_charge")), 1e-12 * std::abs(e33 * strain * width));
}

// Discharge of the slab, charged to 10 V at the time 0, over a resistor.
std::vector<double> discharge(int steps, double end, double resistance) {
  casefile::Case asked = plain(
      ground + fmt::format(R"(, {{ name = "top", on = "top", resistor = {:.17g} }})", resistance),
      {fmt::format("initial.potential='10*y/{:.17g}'", height), fmt::format("time.steps={}", steps),
       fmt::format("time.end={:.17g}", end)});
  return RunCase(asked).history().numbers("electrode_top_voltage");
}

TEST(Discharge, EveryStepIsTheOneOfBackwardEuler) {
  constexpr double resistance = 1e7;
  const double rc = resistance * capacity, end = 2 * rc;
  constexpr int steps = 25;
  const std::vector<double> voltage = discharge(steps, end, resistance);
  double exact = 10;
  for (const double v : voltage) {
    exact /= 1 + end / steps / rc;
    EXPECT_NEAR(v, exact, 1e-12 * 10);
  }
}

TEST(Discharge, HalvingTheStepsHalvesTheDistanceToTheExponential) {
  constexpr double resistance = 1e7;
  const double rc = resistance * capacity, end = 2 * rc;
  std::vector<double> error;
  for (const int steps : {50, 100, 200})
    error.push_back(discharge(steps, end, resistance).back() - 10 * std::exp(-2));
  EXPECT_NEAR(error[0] / error[1], 2, 0.05);
  EXPECT_NEAR(error[1] / error[2], 2, 0.03);
}

TEST(Discharge, ThroughAResistorASourceChargesTheSlab) {
  constexpr double resistance = 1e7;
  const double k = 0.2, rc = resistance * capacity;
  const Table h =
      RunCase(plain(ground + R"(, { name = "top", on = "top", resistor = 1e7, voltage = "5*t" })"))
          .history();
  double exact = 0;
  for (std::size_t n = 0; n < h.n_rows(); ++n) {
    exact = (exact + k / rc * 5 * h.numbers("time")[n]) / (1 + k / rc);
    EXPECT_NEAR(h.numbers("electrode_top_voltage")[n], exact, 1e-11);
    EXPECT_NEAR(h.numbers("electrode_top_current")[n],
                (5 * h.numbers("time")[n] - exact) / resistance, 1e-11 * 5 / resistance);
    EXPECT_NEAR(h.numbers("electrode_top_resistor_power")[n],
                std::pow(5 * h.numbers("time")[n] - exact, 2) / resistance, 1e-10 / resistance);
  }
}

TEST(Capacitor, InSeriesWithTheSlabItDividesTheVoltageOfASource) {
  const Table h =
      RunCase(plain(ground +
                    fmt::format(
                        R"(, {{ name = "top", on = "top", capacitor = {:.17g}, voltage = "8*t" }})",
                        3 * capacity)))
          .history();
  EXPECT_NEAR(h.numbers("electrode_top_voltage").back(), 8 * 3. / 4, 1e-11);
  EXPECT_NEAR(h.numbers("electrode_top_charge").back(), 6 * capacity, 1e-11 * capacity);
}

TEST(Capacitor, ToGroundItLeavesAnUnchargedElectrodeTheShareOfItsCapacity) {
  // Driven from below; what the top has, its capacitor lacks.
  const Table h =
      RunCase(plain(R"({ name = "drive", on = "bottom", voltage = "8*t" }, )" +
                    fmt::format(R"({{ name = "top", on = "top", capacitor = {:.17g} }})",
                                3 * capacity)))
          .history();
  EXPECT_NEAR(h.numbers("electrode_top_voltage").back(), 8. / 4, 1e-11);
}

// A source that is there at t = 0 is switched on then, whatever it is written as.
TEST(Capacitor, HasOneRuleForSourcesThatAreThereFromTheStart) {
  std::vector<double> last;
  for (const char *regime : {"quasistatic", "static", "dynamic"})
    for (const char *source : {"voltage = 8", "voltage = '8*min(1, 1e9*t)'", "to = 'drive'"}) {
      SCOPED_TRACE(fmt::format("{}, {}", regime, source));
      const Table h =
          RunCase(plain(fmt::format(R"({}, {{ name = "drive", on = "left", voltage = 8 }},
                                       {{ name = "top", on = "top", {}, capacitor = 1e-8 }})",
                                    ground, source),
                        {fmt::format("time.regime={}", regime)}))
              .history();
      last.push_back(h.numbers("electrode_top_voltage").back());
      expect_all(h.numbers("electrode_top_voltage"), last.back(), 1e-11);
      expect_closed_balances(h);
    }
  expect_all(last, last[0], 1e-11);
  EXPECT_GT(last[0], 1);
}

// A volume charge that is there at t = 0 leaves none on an open electrode: over a grounded plane it
// has the voltage q H^2 / (2 eps) on any mesh.
TEST(OpenElectrode, HasNoShareOfAVolumeChargeOnAnyMesh) {
  for (const char *regime : {"quasistatic", "static", "dynamic"})
    for (const int cells : {2, 5}) {
      SCOPED_TRACE(fmt::format("{}, {}", regime, cells));
      const Table h = RunCase(plain(ground + R"(, { name = "top", on = "top" })",
                                    {"load.charge=1e-6", fmt::format("time.regime={}", regime),
                                     fmt::format("mesh.box.cells=[{},{}]", cells, cells)}))
                          .history();
      expect_all(h.numbers("electrode_top_voltage"), 1e-6 * height * height / (2 * beta33),
                 1e-13 / beta33 * height * height);
      EXPECT_LT(largest(h, "electrode_top_charge"), 1e-12 * 1e-6 * height * width);
      expect_closed_balances(h);
    }
}

// Piezoelectric, bent and in contact, with every kind of electrode.
const char *const device = R"toml(
mesh.box = { min = [0, 0], max = [0.04, 0.02], cells = [8, 5] }
material = { library = "BaTiO3-Liu2014", pyroelectric = [0, 1e-4] }
time = { end = 0.2, steps = 8 }
boundary = [ { on = "right", displacement = [0, 0], temperature = 0 },
             { on = "top", traction = ["30*t", "-2000*t"] } ]
electrode = [ { name = "drive", on = "right", voltage = "0.02*sin(20*t)" },
              { name = "sensor", on = "top", resistor = 1e7, capacitor = 2e-8 },
              { name = "film", on = "bottom", resistor = 3e7, to = "sensor" } ]
contact = { on = "left", friction = { law = "tresca", bound = 200 }, heat = { law = "exchange", coefficient = 1, foundation_temperature = -10 } }
output = { fields = false }
)toml";

TEST(Device, EnergyForcesChargeAndHeatBalanceAndTheElectrodesBringTheElectricPower) {
  const Table h = history(device);
  expect_closed_balances(h, 1e-11);
  const std::vector<double> power = h.numbers("electric_power");
  const double size = largest(power);
  EXPECT_GT(size, 0);
  for (std::size_t n = 0; n < h.n_rows(); ++n) {
    double sum = 0;
    for (const std::string name : {"drive", "sensor", "film"})
      sum += h.numbers("electrode_" + name + "_voltage")[n] *
             h.numbers("electrode_" + name + "_current")[n];
    EXPECT_NEAR(sum, power[n], 1e-11 * size) << n;
  }
  EXPECT_GT(largest(h.numbers("slip")), 0);
  EXPECT_GT(largest(h.numbers("stick")), 0);
}

TEST(Device, CurrentsObeyKirchhoffAndOhm) {
  const Table h = history(device);
  const std::vector<double> sensor = h.numbers("electrode_sensor_voltage"),
                            film = h.numbers("electrode_film_voltage"),
                            to_sensor = h.numbers("electrode_sensor_current"),
                            to_film = h.numbers("electrode_film_current");
  const double k = 0.2 / 8, size = largest(to_film) + largest(to_sensor);
  const std::vector<double> between = h.numbers("electrode_film_resistor_power"),
                            to_ground = h.numbers("electrode_sensor_resistor_power");
  EXPECT_THROW(h.numbers("electrode_drive_resistor_power"), std::out_of_range);
  for (std::size_t n = 0; n < sensor.size(); ++n) {
    const double before = n == 0 ? 0 : sensor[n - 1];
    EXPECT_NEAR(to_film[n], (sensor[n] - film[n]) / 3e7, 1e-9 * size) << n;
    EXPECT_NEAR(to_sensor[n], -sensor[n] / 1e7 - 2e-8 * (sensor[n] - before) / k - to_film[n],
                1e-9 * size)
        << n;
    EXPECT_NEAR(between[n], std::pow(sensor[n] - film[n], 2) / 3e7, 1e-12 * largest(between)) << n;
    EXPECT_NEAR(to_ground[n], std::pow(sensor[n], 2) / 1e7, 1e-12 * largest(to_ground)) << n;
  }
}

// The same voltages, given: neither charges nor anything else can tell who holds them.
std::vector<std::string> driven_as_in(const Table &h, const std::string &method) {
  std::vector<std::string> overrides{"solver.method=" + method};
  std::string list = "{ name = \"drive\", on = \"right\", voltage = \"0.02*sin(20*t)\" }";
  for (const auto &[name, on] : {std::pair{"sensor", "top"}, std::pair{"film", "bottom"}}) {
    const std::vector<double> t = h.numbers("time"),
                              v = h.numbers(fmt::format("electrode_{}_voltage", name));
    std::string formula = fmt::format("{:.17g}", v.back());
    for (std::size_t n = v.size() - 1; n-- > 0;)
      formula = fmt::format("if(t < {:.17g}, {:.17g}, {})", (t[n] + t[n + 1]) / 2, v[n], formula);
    list += fmt::format(R"(, {{ name = "{}", on = "{}", voltage = "{}" }})", name, on, formula);
  }
  overrides.push_back("electrode=[" + list + "]");
  return overrides;
}

TEST(Device, DrivenByTheVoltagesOfTheCircuitTheBodyDoesTheSameInBothRoutes) {
  const RunCase circuit(casefile::read_text(device, "device"));
  for (const std::string method : {"condensed", "monolithic"}) {
    const RunCase driven(
        casefile::read_text(device, "driven", driven_as_in(circuit.history(), method)));
    for (const char *column : {"u_x", "u_y", "potential", "temperature"})
      EXPECT_LT(difference(driven.nodes(), circuit.nodes(), column), 1e-9) << method << column;
    for (const char *column : {"normal_traction", "tangential_traction_y", "slip_y"})
      EXPECT_LT(difference(driven.contact(), circuit.contact(), column), 1e-9) << method << column;
    EXPECT_EQ(driven.contact().columns.at("status"), circuit.contact().columns.at("status"));
    for (const char *column : {"electrode_sensor_charge", "electrode_film_charge"})
      EXPECT_LT(difference(driven.history(), circuit.history(), column), 1e-9) << method << column;
  }
}

void expect_same_circuit(const RunCase &found, const RunCase &expected, double tolerance) {
  for (const char *column : {"u_x", "u_y", "potential", "temperature"})
    EXPECT_LT(difference(found.nodes(), expected.nodes(), column), tolerance) << column;
  for (const char *electrode : {"electrode_sensor_", "electrode_film_"})
    for (const char *quantity : {"voltage", "charge", "current"}) {
      const std::string column = std::string(electrode) + quantity;
      EXPECT_GT(largest(expected.history(), column), 0) << column;
      EXPECT_LT(difference(found.history(), expected.history(), column), tolerance) << column;
    }
  EXPECT_EQ(found.contact().columns.at("status"), expected.contact().columns.at("status"));
  for (const char *imbalance : {"energy_imbalance", "charge_imbalance"})
    EXPECT_LT(largest(found.history(), imbalance), 1e-9) << imbalance;
}

TEST(Device, EveryRouteFindsTheVoltagesOfTheCircuit) {
  const RunCase direct(casefile::read_text(device, "device"));
  for (const char *route :
       {"solver={method=\"monolithic\"}", "solver={body=\"iterative\", linear_tolerance=1e-13}"}) {
    SCOPED_TRACE(route);
    expect_same_circuit(RunCase(casefile::read_text(device, "device", {route})), direct, 1e-8);
  }
}

TEST(Device, EveryRouteFindsThemInStepsThatTheProgramChooses) {
  const std::string chosen = "time.tolerance=0.01";
  const RunCase direct(casefile::read_text(device, "device", {chosen}));
  for (const char *route :
       {"solver={method=\"monolithic\"}", "solver={body=\"iterative\", linear_tolerance=1e-13}"}) {
    SCOPED_TRACE(route);
    const RunCase found(casefile::read_text(device, "device", {chosen, route}));
    ASSERT_EQ(found.history().n_rows(), direct.history().n_rows());
    expect_same_circuit(found, direct, 1e-7);
  }
}

// Two loads on one body, linear without contact: the work that the first would do on the answer to
// the second is that of the second on the answer to the first.
Table bent(const std::string &voltage_top, const std::string &voltage_bottom,
           const std::string &pushed) {
  return history(fmt::format(R"(
mesh.box = {{ min = [0, 0], max = [0.04, 0.02], cells = [8, 5] }}
material = {{ library = "BaTiO3-Liu2014", m11 = 0, m33 = 0, p3 = 0 }}
time = {{ end = 1, steps = 1 }}
boundary = [ {{ on = "right", displacement = [0, 0], potential = 0 }},
             {{ on = "left", displacement = ["{}", "free"] }} ]
electrode = [ {{ name = "top", on = "top", {} }}, {{ name = "bottom", on = "bottom", {} }} ]
output = {{ fields = false }}
)",
                             pushed, voltage_top, voltage_bottom));
}

TEST(Reciprocity, TheChargeOnOneElectrodeByTheOthersVoltageIsTheSameTheOtherWayRound) {
  const double
      there = bent("voltage = 1", "voltage = 0", "0").numbers("electrode_bottom_charge").back(),
      back = bent("voltage = 0", "voltage = 1", "0").numbers("electrode_top_charge").back();
  EXPECT_LT(there, 0);
  EXPECT_NEAR(there / back, 1, 1e-10);
}

// The force that holds the left side and the charge are both reactions: the force by a unit voltage
// is the charge by a unit push, with the sign of Maxwell's relation.
TEST(Reciprocity, TheForceByAVoltageIsMinusTheChargeByADisplacement) {
  const Table driven = bent("voltage = 1", "voltage = 0", "0"),
              pushed = bent("voltage = 0", "voltage = 0", "1e-9");
  // Reactions of left and right cancel, so the force on the left comes from the work of a small
  // push under the voltage: load_power holds it.
  const double work = bent("voltage = 1", "voltage = 0", "1e-9").numbers("load_power").back() -
                      bent("voltage = 0", "voltage = 0", "1e-9").numbers("load_power").back();
  const double charge = pushed.numbers("electrode_top_charge").back();
  EXPECT_NEAR(work / (charge * 1), -1, 1e-9);
  EXPECT_NE(driven.numbers("electrode_top_charge").back(), 0);
}

// cases/devices/README.md: one point decides, as the pad shears alike everywhere.
TEST(FrictionSensor, OnAnAmplifierItFollowsTheRecurrenceInEveryStep) {
  const RunCase run("cases/devices/friction-sensor-loaded.toml");
  const Table h = run.history(), contact = run.contact();
  constexpr double c44 = 43e9, e15 = 11.6, beta11 = 11.2e-9, w = 0.01, thickness = 0.002;
  constexpr double k = 0.1, resistance = 1e7, cable = 1e-7, bound = 5e4;
  constexpr double own = beta11 * w / thickness, all = own + k / resistance + cable;
  // tau = a gamma + b (charge left from before), from the circuit's V = (e15 w gamma + left) / all
  constexpr double a = c44 + e15 * e15 * w / (thickness * all), b = e15 / (thickness * all);
  const std::vector<double> voltage = h.numbers("electrode_sensor_voltage"),
                            charge = h.numbers("electrode_sensor_charge"),
                            slip = contact.numbers("slip_x");
  const std::size_t nodes = slip.size() / voltage.size();
  double s = 0, q = 0, v = 0;
  int slips = 0;
  for (std::size_t n = 0; n < voltage.size(); ++n) {
    const double u = 4e-9 * (1 - std::abs(std::fmod(k * double(n + 1) + 3, 4) - 2));
    const double left = q + cable * v;
    double gamma = (u - s) / thickness;
    if (const double tau = a * gamma + b * left; std::abs(tau) > bound) {
      gamma = (std::copysign(bound, tau) - b * left) / a;
      s = u - gamma * thickness;
      ++slips;
    }
    v = (e15 * w * gamma + left) / all;
    q = own * v - e15 * w * gamma;
    EXPECT_NEAR(voltage[n], v, 1e-12) << n;
    EXPECT_NEAR(charge[n], q, 1e-18) << n;
    for (std::size_t i = n * nodes; i < (n + 1) * nodes; ++i)
      EXPECT_NEAR(slip[i], s, 1e-20) << n;
  }
  EXPECT_GT(slips, 20);
  EXPECT_LT(slips, 60);
  EXPECT_NEAR(largest(voltage), 0.852, 1e-3);
  EXPECT_LT(largest(h.numbers("energy_imbalance")), 1e-12);
}

TEST(Joined, TwoSidesOfOneElectrodeAreTwoElectrodesWithAWireBetweenThem) {
  const std::string driven = ground + R"(, { name = "top", on = "top", voltage = 5 })";
  const Table joined = history(slab(driven + R"(, { name = "sides", on = ["left", "right"] })"));
  // The wire's charge decays 4000 times in a step.
  const Table wired = history(slab(
      driven +
      R"(, { name = "left", on = "left", resistor = 1e3, to = "right" }, { name = "right", on = "right" })"));
  const double voltage = joined.numbers("electrode_sides_voltage").back();
  EXPECT_GT(std::abs(voltage), 1);
  EXPECT_NEAR(wired.numbers("electrode_left_voltage").back(), voltage, 1e-9);
  EXPECT_NEAR(wired.numbers("electrode_right_voltage").back(), voltage, 1e-9);
  const double charge = wired.numbers("electrode_left_charge").back();
  EXPECT_GT(std::abs(charge), 1e-12);
  // Two small charges beside that of the driven electrode, whose round-off they have.
  EXPECT_NEAR(wired.numbers("electrode_right_charge").back(), -charge,
              1e-12 * largest(wired.numbers("electrode_top_charge")));
  EXPECT_LT(largest(joined.numbers("electrode_sides_charge")), 1e-9 * std::abs(charge));
}

const char *beside_a_contact = R"(
mesh.box = { min = [0, 0], max = [1, 1], cells = [2, 2], cell = "quadrilateral" }
material = { symmetry = "isotropic", young = 1e9, poisson = 0.3, eps11 = 1000 }
model.thermal = false
)";

// All is at one potential: nothing leaks, and an open electrode keeps its voltage, however long the
// first step is.
TEST(Electrode, BesideALeakStartsWithoutItsCharge) {
  const std::string text = std::string(beside_a_contact) + R"(
boundary = [ { on = "right", displacement = [0, 0], potential = 0.1 } ]
electrode = [ { name = "e", on = "bottom" } ]
initial.potential = 0.1
[contact]
on = "left"
electric = { law = "leak", coefficient = 1e-9, foundation_potential = 0.1 }
)";
  for (const char *route :
       {"solver.method=condensed", "solver.body=iterative", "solver.method=monolithic"})
    for (const char *circuit :
         {"output.report=false", "electrode[0].resistor=1e9", "electrode[0].voltage=0.1"}) {
      SCOPED_TRACE(std::string(route) + " " + circuit);
      const std::string source = std::string(circuit).find("resistor") == std::string::npos
                                     ? "output.fields=false"
                                     : "electrode[0].voltage=0.1";
      const Table history =
          run_text(text, {route, circuit, source, "time={end=100,steps=1}"}).history();
      EXPECT_NEAR(history.numbers("electrode_e_voltage")[0], 0.1, 1e-12);
      EXPECT_NEAR(history.numbers("electrode_e_charge")[0], 0, 1e-20);
      EXPECT_NEAR(history.numbers("electrode_e_current")[0], 0, 1e-22);
    }
}

// Gauss's law: what the electrode has comes out at the contact, whose corner node they share.
TEST(Electrode, HasNothingOfWhatCrossesTheContact) {
  const std::string text = std::string(beside_a_contact) + R"(
boundary = [ { on = "right", displacement = [0, 0] } ]
electrode = [ { name = "e", on = "bottom", voltage = "t" } ]
time = { end = 2, steps = 2 }
[contact]
on = "left"
electric = { law = "exchange", coefficient = 1e-8, foundation_potential = 0 }
)";
  for (const char *route :
       {"solver.method=condensed", "solver.body=iterative", "solver.method=monolithic"})
    for (const char *law : {"contact.electric.law=exchange", "contact.electric.ramp=1",
                            "contact.electric={law='leak',coefficient=1e-8,"
                            "foundation_potential=0,ramp=1}"}) {
      SCOPED_TRACE(std::string(route) + " " + law);
      const Table history = run_text(text, {route, law}).history();
      const std::vector<double> on = history.numbers("electrode_e_charge"),
                                out = history.numbers("charge_left"),
                                current = history.numbers("electrode_e_current");
      for (std::size_t n = 0; n < 2; ++n)
        EXPECT_NEAR(on[n], out[n], 1e-9 * out[n]);
      EXPECT_NEAR(current[0], on[0], 1e-9 * on[0]);
      EXPECT_NEAR(current[1], on[1] - on[0], 1e-9 * on[1]);
    }
}

}  // namespace
}  // namespace tourmaline::verified
