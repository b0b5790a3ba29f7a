// Label: analytic. Vibrations, with and without damping, and creep, in closed form.

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "closed_balances.h"
#include "elastic_body.h"
#include "equal_quantities.h"
#include "run_case.h"

namespace tourmaline::verified {
namespace {

using std::numbers::pi;

constexpr double length = 1, speed = 100;  // m, m/s

// The first mode of a bar held at its lower end, let go from its largest amplitude.
RunCase vibrating_bar(int steps, double periods, const std::string &damping = "",
                      const std::string &more = "", int cells = 64) {
  return run_text(fmt::format(R"toml(
mesh.box = {{ min = [0, 0], max = [0.05, 1], cells = [1, {}], cell = "quadrilateral" }}
{}
material = {{ {}, young = 1e7, density = 1000{} }}
time = {{ end = {:.17g}, steps = {}, regime = "dynamic" }}
boundary = [ {{ on = ["left", "right"], displacement = [0, "free"] }}, {{ on = "bottom", displacement = [0, 0], potential = 0 }} ]
initial = {{ displacement = [0, "1e-3*sin(pi*y/2)"] }}
)toml",
                              cells, more, elastic, damping, periods * 4 * length / speed, steps));
}

double tip(const RunCase &run) {
  return run.nodes().numbers("u_y").back();
}

// Against the same bar with the finest steps, so that the error of the mesh does not count.
TEST(FreeVibration, IsOfSecondOrderInTime) {
  const double exact = 1e-3 * std::cos(2 * pi * 1.125);
  const double error_40 = std::abs(tip(vibrating_bar(40, 1.125)) - exact),
               error_80 = std::abs(tip(vibrating_bar(80, 1.125)) - exact);
  EXPECT_NEAR(std::log2(error_40 / error_80), 2, 0.1);
  EXPECT_LE(error_80, 1e-5);
}

TEST(FreeVibration, KeepsItsEnergy) {
  const Table history = vibrating_bar(200, 5).history();
  expect_closed_balances(history, 1e-9);
  const auto kinetic = history.numbers("kinetic_energy"),
             stored = history.numbers("elastic_energy");
  for (std::size_t i = 0; i < kinetic.size(); ++i)
    EXPECT_NEAR(kinetic[i] + stored[i], kinetic[0] + stored[0], 1e-10 * stored[0]);
  EXPECT_EQ(largest(history, "time_step_loss"), 0);
}

// u'' + (a + b w^2) u' + w^2 u = 0.
TEST(DampedVibration, DecaysByStiffnessAndMassDampingInSecondOrder) {
  constexpr double a = 5, b = 2e-4, w = pi / 2 * speed / length, periods = 1.125;
  constexpr double t = periods * 4 * length / speed, d = (a + b * w * w) / 2;
  const double wd = std::sqrt(w * w - d * d);
  // At rest at the start.
  const double exact = 1e-3 * std::exp(-d * t) * (std::cos(wd * t) + d / wd * std::sin(wd * t));
  const std::string damping = fmt::format(", stiffness_damping = {}, mass_damping = {}", b, a);
  const RunCase fine = vibrating_bar(160, periods, damping);
  expect_closed_balances(fine.history(), 1e-9);
  const double error_80 = std::abs(tip(vibrating_bar(80, periods, damping)) - exact),
               error_160 = std::abs(tip(fine) - exact);
  EXPECT_NEAR(std::log2(error_80 / error_160), 2, 0.15);
  EXPECT_LE(error_160, 3e-6);
  for (const double power : fine.history().numbers("viscous_dissipation"))
    EXPECT_GE(power, 0);
}

TEST(DampedVibration, CellsWithModesAndOfDegreeTwoDecayAlike) {
  const std::string damping = ", stiffness_damping = 2e-4";
  const double plain = tip(vibrating_bar(160, 1.125, damping));
  EXPECT_NEAR(tip(vibrating_bar(160, 1.125, damping, "mesh.modes = 'none'")), plain, 1e-7);
  EXPECT_NEAR(tip(vibrating_bar(160, 1.125, damping, "mesh.degree = 2", 16)), plain, 2e-6);
}

// Backward Euler's own closed form: eps_n = (s/E)(1 - (1 + k E/eta)^-n).
TEST(KelvinVoigt, CreepsAsTheSchemeSays) {
  for (const int dim : {2, 3}) {
    SCOPED_TRACE(dim);
    const std::string box =
        dim == 2 ? "min = [0,0], max = [0.1,0.1], cells = [2,2], cell = 'quadrilateral'"
                 : "min = [0,0,0], max = [0.1,0.1,0.1], cells = [2,2,2], cell = 'hexahedron'";
    const std::string held = dim == 2 ? "[0, 'free']" : "[0, 0, 'free']",
                      base = dim == 2 ? "['free', 0]" : "['free', 'free', 0]",
                      load = dim == 2 ? "[0, -1e6]" : "[0, 0, -1e6]",
                      sides = dim == 2 ? "['left','right']" : "['left','right','front','back']";
    const RunCase run = run_text(fmt::format(R"toml(
mesh.box = {{ {} }}
material = {{ {}, young = 162e9, density = 1, stiffness_damping = 0.01 }}
time = {{ end = 0.01, steps = 10 }}
boundary = [ {{ on = {}, displacement = {} }}, {{ on = "bottom", displacement = {}, potential = 0 }},
             {{ on = "top", traction = {} }} ]
)toml",
                                             box, elastic, sides, held, base, load));
    const Table history = run.history();
    expect_closed_balances(history, 1e-10);
    const std::vector<double> most = history.numbers("max_displacement");
    for (const auto &[n, exact] : {std::pair{1, 5.611672278e-7}, std::pair{10, 3.792942658e-6}})
      EXPECT_NEAR(most[n - 1] / 0.1, exact, 1e-9 * exact) << n;
    const double dissipated = largest(history, "viscous_dissipation");
    EXPECT_GT(dissipated, 0);
  }
}

// Regions of their own damping in a row: the stress is the same, each strain its own.
TEST(KelvinVoigt, RegionsCreepByTheirOwnDamping) {
  const RunCase run = run_text(fmt::format(R"toml(
mesh.box = {{ min = [0,0], max = [0.1,0.2], cells = [1,4], cell = "quadrilateral" }}
time = {{ end = 0.01, steps = 10 }}
boundary = [ {{ on = ["left", "right"], displacement = [0, "free"] }},
             {{ on = "bottom", displacement = ["free", 0], potential = 0 }}, {{ on = "top", traction = [0, -1e6] }} ]
region = [ {{ where = "y < 0.1", material = {{ {0}, young = 162e9, density = 1, stiffness_damping = 0.01 }} }},
           {{ where = "y > 0.1", material = {{ {0}, young = 162e9, density = 1 }} }} ]
)toml",
                                           elastic));
  expect_closed_balances(run.history(), 1e-10);
  const double exact = 0.1 * (3.792942658e-6 + 1e6 / 162e9);
  EXPECT_NEAR(-run.nodes().numbers("u_y").back(), exact, 1e-9 * exact);
}

// Force a rho v alone: v_n = b/(a rho) at once.
TEST(MassDamping, MovesABodyAtTheSpeedThatItsWeightDrives) {
  for (const char *degree : {"mesh.degree=1", "mesh.degree=2"}) {
    const RunCase run = run_text(fmt::format(R"toml(
mesh.box = {{ min = [0,0], max = [0.1,0.1], cells = [2,2], cell = "triangle" }}
material = {{ {}, young = 1e4, density = 2000, mass_damping = 4 }}
time = {{ end = 1, steps = 4, regime = "dynamic" }}
boundary = [ {{ on = "top", potential = 0 }} ]
initial = {{ velocity = [0, -2.4525] }}
load = {{ base_acceleration = [0, 9.81] }}
)toml",
                                             elastic),
                                 {degree});
    const Table history = run.history();
    expect_closed_balances(history, 1e-9);
    for (const double u : run.nodes().numbers("u_y"))
      EXPECT_NEAR(u, -2.4525, 1e-9);
    EXPECT_NEAR(history.numbers("damping_force_y").back(), 2000 * 0.01 * 9.81, 1e-8);
  }
}

// A base that shakes is a force that shakes: the same displacements.
TEST(BaseAcceleration, IsTheInertiaThatItsMotionWouldCause) {
  const auto shaken = [](const std::string &load) {
    return run_text(fmt::format(R"toml(
mesh.box = {{ min = [0, 0], max = [0.1, 1], cells = [2, 20], cell = "quadrilateral" }}
material = {{ {}, young = 1e7, density = 1000 }}
time = {{ end = 0.1, steps = 100, regime = "dynamic" }}
boundary = [ {{ on = "bottom", displacement = [0, 0], potential = 0 }} ]
load = {{ {} }}
)toml",
                                elastic, load));
  };
  const RunCase base = shaken("base_acceleration = ['sin(100*t)', 2]"),
                force = shaken("force = ['-1000*sin(100*t)', -2000]");
  expect_closed_balances(base.history(), 1e-9);
  expect_equal_quantities(base.nodes(), force.nodes(), {{"u_x", "u_y"}}, 1e-10);
}

// A free bar poled along its length: its lowest frequency with open and with joined electrodes.
double lowest_frequency(const std::string &electrode, const char *column) {
  const RunCase run = run_text(fmt::format(R"toml(
mesh.box = {{ min = [0, 0], max = [0.01, 1], cells = [1, 100], cell = "quadrilateral" }}
material = {{ c11 = 1.2e11, c12 = 0, c13 = 0, c33 = 1.2e11, c44 = 6e10, e31 = 0, e33 = 23, e15 = 0, beta11 = 1e-8, beta33 = 1e-8, k11 = 1, k33 = 1, density = 7500, specific_heat = 400, reference_temperature = 293 }}
time = {{ end = 0.012, steps = 5000, regime = "dynamic" }}
initial = {{ velocity = [0, "1e-3*cos(pi*y)"] }}
electrode = [ {{ name = "base", on = "bottom", voltage = 0 }}, {{ name = "top", on = "top", {} }} ]
)toml",
                                           electrode));
  const Table history = run.history();
  expect_closed_balances(history, 1e-9);
  const auto t = history.numbers("time"), q = history.numbers(column);
  std::vector<double> zeros;
  for (std::size_t i = 0; i + 1 < q.size(); ++i)
    if (q[i] < 0 && q[i + 1] >= 0)
      zeros.push_back(t[i] - q[i] * (t[i + 1] - t[i]) / (q[i + 1] - q[i]));
  // The slope of a straight line through all of them.
  const double mean = (static_cast<double>(zeros.size()) - 1) / 2;
  double squares = 0, moment = 0;
  for (std::size_t i = 0; i < zeros.size(); ++i) {
    const double from_mean = static_cast<double>(i) - mean;
    squares += from_mean * from_mean;
    moment += from_mean * zeros[i];
  }
  return squares / moment;
}

TEST(PiezoelectricBar, ItsResonancesGiveTheCouplingFactor) {
  const double open = lowest_frequency("charge = 0", "electrode_top_voltage"),
               joined = lowest_frequency("voltage = 0", "electrode_top_charge");
  const double stiffened = 1.2e11 + 23 * 23 / 1e-8;
  EXPECT_NEAR(open / (std::sqrt(stiffened / 7500) / 2), 1, 1e-3);
  const double ratio = pi / 2 * joined / open;
  const double coupling = std::sqrt(ratio * std::tan(pi / 2 * (open - joined) / open));
  EXPECT_NEAR(coupling / std::sqrt(23 * 23 / 1e-8 / stiffened), 1, 1e-3);
}

// Through a resistor that matches its capacitance the bar gives its energy away, and what has left
// through the electrodes is what it lacks.
TEST(PiezoelectricBar, AResistorTakesItsEnergy) {
  const RunCase run = run_text(R"toml(
mesh.box = { min = [0, 0], max = [0.01, 1], cells = [1, 40], cell = "quadrilateral" }
material = { c11 = 1.2e11, c12 = 0, c13 = 0, c33 = 1.2e11, c44 = 6e10, e31 = 0, e33 = 23, e15 = 0, beta11 = 1e-8, beta33 = 1e-8, k11 = 1, k33 = 1, density = 7500, specific_heat = 400, reference_temperature = 293 }
time = { end = 0.012, steps = 2000, regime = "dynamic" }
initial = { velocity = [0, "1e-3*cos(pi*y)"] }
electrode = [ { name = "base", on = "bottom", voltage = 0 }, { name = "top", on = "top", resistor = 7e5 } ]
)toml");
  const Table history = run.history();
  expect_closed_balances(history, 1e-9);
  double given = 0;
  for (const double power : history.numbers("electric_power"))
    given -= power * 0.012 / 2000;
  const auto whole = [&](std::size_t i) {
    return history.numbers("kinetic_energy")[i] + history.numbers("elastic_energy")[i] +
           history.numbers("electric_energy")[i];
  };
  const double start = 0.01 * 7500 * 1e-6 / 4;  // rho v^2/2, mean of cos^2
  EXPECT_NEAR((start - whole(1999)) / given, 1, 1e-3);
  EXPECT_LT(whole(1999), 0.1 * start);
}

}  // namespace
}  // namespace tourmaline::verified
