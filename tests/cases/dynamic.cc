// Label: analytic. Bodies with inertia and damping: waves, impacts, vibrations and creep that have
// closed forms, and what holds of every dynamic run: balances, routes, a second order in time.

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <iterator>
#include <map>
#include <numbers>

#include "closed_balances.h"
#include "equal_quantities.h"
#include "run_case.h"
#include "thrown_block.h"
#include "tourmaline/error.h"

namespace tourmaline::testing {
namespace {

using std::numbers::pi;

constexpr const char *elastic =
    "symmetry = 'isotropic', poisson = 0, eps11 = 1, k11 = 1, specific_heat = 1, "
    "reference_temperature = 293";

double at(const Table &table, const char *column, double time) {
  const std::vector<double> t = table.numbers("time"), values = table.numbers(column);
  std::size_t nearest = 0;
  for (std::size_t i = 0; i < t.size(); ++i)
    if (std::abs(t[i] - time) < std::abs(t[nearest] - time))
      nearest = i;
  return values[nearest];
}

// The energy of the bar with that of its weight, over that of its fall, rho g L 5 m times 0.1 m.
std::vector<double> energies_of_bar(const Table &history, double step) {
  const auto elastic_part = history.numbers("elastic_energy"),
             kinetic = history.numbers("kinetic_energy"), power = history.numbers("load_power");
  std::vector<double> all;
  double worked = 0;
  for (std::size_t i = 0; i < power.size(); ++i) {
    worked += power[i] * step;
    all.push_back((elastic_part[i] + kinetic[i] - worked) / 5e4);
  }
  return all;
}

// Contact begins at t = 1 with the pressure rho c V = 300 kPa, which grows by 300 kPa/s until the
// wave is back at 5/3; later fronts of the wave are some steps wide, and left out here.
TEST(BouncingBar, ThePressureOfTheFirstImpactIsTheWavesAndEnergyStays) {
  const RunCase run("cases/impact/bar.toml");
  const Table history = run.history(), contact = run.contact();
  expect_closed_balances(history, 1e-9);
  double squares = 0;
  int count = 0;
  const auto time = contact.numbers("time"), traction = contact.numbers("normal_traction");
  for (std::size_t i = 0; i < time.size(); ++i)
    if (time[i] > 1.02 && time[i] < 1.64) {
      const double exact = 3e5 + 3e5 * (time[i] - 1);
      squares += std::pow((-traction[i] - exact) / exact, 2);
      ++count;
    }
  EXPECT_LE(std::sqrt(squares / count), 0.01);
  for (const double gap : contact.numbers("gap"))
    EXPECT_GE(gap, -1e-12);
  EXPECT_NEAR(at(contact, "gap", 0.5), 3.75, 1e-4);
  EXPECT_NEAR(at(contact, "gap", 2), 5. / 3, 0.02);
  const std::vector<double> energy = energies_of_bar(history, 16. / 3 / 3200);
  EXPECT_NEAR(energy.back(), 0, 1e-3);
  // What is lost, the scheme has lost, and it says so.
  double lost = 0;
  for (const double loss : history.numbers("time_step_loss"))
    lost += loss * 16. / 3 / 3200 / 5e4;
  EXPECT_NEAR(lost, -energy.back(), 1e-6);
}

// With mass at the contact Newmark's scheme chatters and gains energy: why there is none by
// default.
TEST(BouncingBar, WithMassAtTheContactEnergyGrows) {
  const RunCase run("cases/impact/bar.toml",
                    {"time.contact_mass=consistent", "time.end=2", "time.steps=1200"});
  EXPECT_GT(energies_of_bar(run.history(), 1. / 600).back(), 1);
}

TEST(BouncingBar, EveryRouteBouncesAlike) {
  const std::vector<std::string> until{"time.end=1.2", "time.steps=720"};
  const RunCase direct("cases/impact/bar.toml", until);
  for (const char *route : {"solver.method=monolithic", "solver.body=iterative"}) {
    SCOPED_TRACE(route);
    auto overrides = until;
    overrides.emplace_back(route);
    const RunCase other("cases/impact/bar.toml", overrides);
    expect_closed_balances(other.history(), 1e-8);
    expect_equal_quantities(other.nodes(), direct.nodes(), {{"u_x", "u_y"}}, 1e-8);
    expect_equal_quantities(other.history(), direct.history(), {{"kinetic_energy"}}, 1e-8);
  }
}

// How high the front of the plate's wave stands above the middle of its stop: where between two
// nodes of the left side the strain is half of V/c.
double front_of_plate(int steps) {
  constexpr double c = 5000, v = 1;
  const RunCase run("cases/impact/plate.toml", {fmt::format("time.steps={}", steps),
                                                fmt::format("time.end={}", steps * 1.25e-7)});
  expect_closed_balances(run.history(), 1e-9);
  const Table nodes = run.nodes();
  const auto x = nodes.numbers("x"), y = nodes.numbers("y"), u = nodes.numbers("u_y");
  std::map<double, double> column;
  for (std::size_t i = 0; i < x.size(); ++i)
    if (x[i] < 1e-9)
      column[y[i]] = u[i];
  double above = 0, middle_above = 0;
  for (auto upper = std::prev(column.end()); upper != column.begin(); --upper) {
    const auto lower = std::prev(upper);
    const double strain = (lower->second - upper->second) / (upper->first - lower->first) * c / v;
    const double middle = (upper->first + lower->first) / 2;
    if (strain >= 0.5)
      return middle + (middle_above - middle) * (strain - 0.5) / (strain - above);
    above = strain;
    middle_above = middle;
  }
  ADD_FAILURE() << "no front";
  return 0;
}

// c = sqrt(E/rho) = 5000 m/s; the front is some cells of 2 mm wide, which grow.
TEST(PlateThatAStopHits, TheFrontRisesWithTheSpeedOfSound) {
  const double early = front_of_plate(80), late = front_of_plate(160);
  EXPECT_NEAR((late - early) / 1e-5, 5000, 0.01 * 5000);
  EXPECT_NEAR(late, 0.1, 2e-3);
}

// rho c V = 40 MPa, until waves from the stop's end come after 0.06/5000 = 12 us; the first
// microseconds have the overshoot of a jump on cells.
TEST(PlateThatAStopHits, ThePressureInTheMiddleIsTheWavesAndTheRestIsOpen) {
  const RunCase run("cases/impact/plate.toml", {"time.steps=80", "time.end=1e-5"});
  const Table contact = run.contact();
  const auto x = contact.numbers("x"), time = contact.numbers("time"),
             traction = contact.numbers("normal_traction"), gap = contact.numbers("gap");
  int seen = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    EXPECT_GE(gap[i], -1e-15);
    if (x[i] > 0.061) {
      EXPECT_EQ(traction[i], 0);
    }
    if (x[i] < 1e-9 && time[i] > 4e-6) {
      EXPECT_NEAR(-traction[i], 4e7, 0.01 * 4e7) << time[i];
      ++seen;
    }
  }
  EXPECT_GE(seen, 40);
}

// Whoever moves: a plate that falls on the stop at rest feels the same.
TEST(PlateThatAStopHits, OnlyTheRelativeVelocityCounts) {
  const std::vector<std::string> until{"time.steps=80", "time.end=1e-5"};
  auto falls = until;
  falls.emplace_back("contact.foundation_displacement=[0,0]");
  falls.emplace_back("initial.velocity=[0,-1]");
  const RunCase pushed("cases/impact/plate.toml", until), falling("cases/impact/plate.toml", falls);
  EXPECT_LE(difference(falling.contact(), pushed.contact(), "normal_traction"), 1e-9);
  EXPECT_LE(difference(falling.history(), pushed.history(), "elastic_energy"), 1e-9);
}

// SDNV100: a bar of 0.2 m meets a wall at 100 m/s, 2 mm away.
TEST(BarOnAWall, TouchesForFortyMicrosecondsEachWayAndFliesBack) {
  constexpr int steps = 480;
  constexpr double end = 1.2e-4, step = end / steps;
  const RunCase run = run_text(fmt::format(R"toml(
mesh.box = {{ min = [0, 0], max = [0.002, 0.2], cells = [1, 100], cell = "quadrilateral" }}
material = {{ {}, young = 2e11, density = 8000 }}
time = {{ end = {}, steps = {}, regime = "dynamic" }}
boundary = [ {{ on = ["left", "right"], displacement = [0, "free"] }}, {{ on = "top", potential = 0 }} ]
initial = {{ velocity = [0, -100] }}
contact = {{ on = "bottom", gap = 0.002, normal = "unilateral" }}
)toml",
                                           elastic, end, steps));
  const Table history = run.history(), contact = run.contact();
  expect_closed_balances(history, 1e-9);
  double first = 0, last = 0;
  const auto time = contact.numbers("time"), traction = contact.numbers("normal_traction");
  for (std::size_t i = 0; i < time.size(); ++i)
    if (traction[i] < -1e6) {
      first = first == 0 ? time[i] : first;
      last = time[i];
    }
  EXPECT_NEAR(first, 20e-6, 2.01 * step);
  EXPECT_NEAR(last, 100e-6, 2.01 * step);
  for (const double gap : contact.numbers("gap"))
    EXPECT_GE(gap, -1e-15);
  EXPECT_NEAR(-at(contact, "normal_traction", 60e-6), 4e9, 4e7);  // rho c v
  const auto momentum = [&] {
    double impulse = 0;
    for (const double force : history.numbers("contact_force_y"))
      impulse += force * step;
    return impulse;
  }();
  EXPECT_NEAR(momentum, 2 * 8000 * 0.2 * 0.002 * 100, 0.01 * 2 * 8000 * 0.2 * 0.002 * 100);
}

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

// A layer that moves at V along its foundation, pressed with p: friction sends a shear wave into
// it, behind which it moves slower by mu p/(rho c_s), until that is back after 2 H/c_s. Far from
// the edges, of which the middle does not know yet.
TEST(ShearImpact, TheLayerSlipsAtTheSpeedThatItsWaveLeaves) {
  const RunCase run = run_text(fmt::format(R"toml(
mesh.box = {{ min = [0, 0], max = [0.12, 0.02], cells = [24, 40], cell = "quadrilateral" }}
material = {{ {}, young = 86e9, density = 5500 }}
time = {{ end = 1.43e-5, steps = 160, regime = "dynamic" }}
boundary = [ {{ on = "top", displacement = ["free", "-1e7/86e9*0.02"], potential = 0 }} ]
initial = {{ velocity = [1, 0], displacement = [0, "-1e7/86e9*y"] }}
contact = {{ on = "bottom", normal = "unilateral", friction = {{ law = "coulomb", coefficient = 0.3 }} }}
)toml",
                                           elastic));
  expect_closed_balances(run.history(), 1e-10);
  const Table contact = run.contact();
  const auto x = contact.numbers("x"), time = contact.numbers("time"),
             rate = contact.numbers("slip_rate");
  double worst = 0;
  for (std::size_t i = 0; i < x.size(); ++i)
    if (std::abs(x[i] - 0.06) < 1e-9 && time[i] > 1.5e-6 && time[i] < 1.25e-5)
      worst = std::max(worst, std::abs(rate[i] / 0.804923173 - 1));
  EXPECT_LE(worst, 0.01);
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

TEST(ThrownBlock, EveryRouteRubsAndBouncesAlikeInTwoAndThreeDimensions) {
  for (const int dim : {2, 3}) {
    SCOPED_TRACE(dim);
    const RunCase direct = run_text(thrown_block(dim));
    expect_closed_balances(direct.history(), 1e-9);
    EXPECT_GT(largest(direct.history(), "friction_dissipation"), 0);
    EXPECT_GT(largest(direct.history(), "viscous_dissipation"), 0);
    for (const char *route : {"solver.method=monolithic", "solver.body=iterative"}) {
      SCOPED_TRACE(route);
      const RunCase other = run_text(thrown_block(dim), {route});
      expect_closed_balances(other.history(), 1e-7);
      std::vector<Quantity> quantities{{"u_x", "u_y"}, {"potential"}, {"temperature"}};
      expect_equal_quantities(other.nodes(), direct.nodes(), quantities, 1e-7);
    }
  }
}

// Each response of the contact: nothing penetrates that should not, balances close.
TEST(ThrownBlock, EveryNormalLawCloses) {
  for (const char *law :
       {"{law='compliance',coefficient=1e14}", "{law='damped',coefficient=1e7}"}) {
    SCOPED_TRACE(law);
    const RunCase run = run_text(thrown_block(2), {std::string("contact.normal=") + law});
    expect_closed_balances(run.history(), 1e-9);
    EXPECT_LT(largest(run.history(), "max_opening"), 2e-5);
    EXPECT_GT(largest(run.history(), "max_pressure"), 1e5);
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

// Four cells in contact on all sides leave one node to take their mass, about which the body turns.
TEST(DynamicCases, MassThatDoesNotHoldTheBodyIsRefused) {
  std::string all = "contact = [ ";
  for (const char *side : {"bottom", "top", "left", "right"})
    all += fmt::format("{{ on = '{}', gap = 10, normal = 'unilateral' }}, ", side);
  const auto flying = [&](const std::string &override) {
    return run_text(fmt::format(R"toml(
mesh.box = {{ min = [0, 0], max = [0.1, 0.1], cells = [2, 2], cell = "quadrilateral" }}
material = {{ {}, young = 1e6, density = 1000 }}
time = {{ end = 0.1, steps = 2, regime = "dynamic" }}
boundary = [ {{ on = "left", potential = 0 }} ]
initial = {{ velocity = [1, 0] }}
{}
)toml",
                                elastic, all + "]"),
                    {override});
  };
  try {
    flying("title=flying");
    ADD_FAILURE();
  } catch (const CaseError &error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("[time] contact_mass: "));
    EXPECT_THAT(error.what(), ::testing::HasSubstr("a rotation in the plane"));
  }
  EXPECT_NO_THROW(flying("time.contact_mass=consistent"));
  EXPECT_NO_THROW(flying("mesh.box.cells=[3,2]"));
}

TEST(DynamicCases, WhatHasNoMeaningIsToldInOneSentence) {
  const std::string plain = fmt::format(
      "mesh.box = {{ min = [0,0], max = [1,1], cells = [2,2] }}\n"
      "material = {{ {}, young = 1, density = 1 }}\ntime = {{ end = 1, steps = 1 }}\n"
      "boundary = [ {{ on = 'top', potential = 0, displacement = [0, 0] }} ]\n",
      elastic);
  const auto error = [&](const std::string &override) {
    try {
      run_text(plain, {override});
    } catch (const CaseError &e) {
      return std::string(e.what());
    }
    return std::string();
  };
  EXPECT_THAT(error("time.regime=hypersonic"), ::testing::HasSubstr("\"dynamic\""));
  EXPECT_THAT(error("time.contact_mass=consistent"), ::testing::HasSubstr("regime = \"dynamic\""));
  EXPECT_THAT(error("initial.velocity=[1,0]"), ::testing::HasSubstr("regime = \"dynamic\""));
  EXPECT_THAT(error("load.base_acceleration=['x',0]"), ::testing::HasSubstr("depends on place"));
  EXPECT_THAT(error("material.stiffness_damping=-1"), ::testing::HasSubstr("stiffness_damping"));
}

}  // namespace
}  // namespace tourmaline::testing
