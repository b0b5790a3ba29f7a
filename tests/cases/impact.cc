// Label: analytic. Bodies that meet a foundation: the pressures of waves, energy, and the same on
// every route.

#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <map>

#include "closed_balances.h"
#include "elastic_body.h"
#include "equal_quantities.h"
#include "run_case.h"
#include "thrown_block.h"

namespace tourmaline::verified {
namespace {

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

// Displaced along its foundation it is the same body. At rest nothing draws a node off the
// foundation, but round-off of the stiffness times where the body stands may seem to.
TEST(SlabOnAFoundation, StartsAlikeWhereverItStands) {
  const auto standing = [](double place, const char *route) {
    return run_text(fmt::format(R"(
mesh = {{ box = {{ min = [0, 0], max = [0.02, 0.01], cells = [5, 4], cell = "quadrilateral" }}, degree = 2 }}
material.library = "steel"
model = {{ thermal = false, electric = false }}
time = {{ end = 3e-6, steps = 3, regime = "dynamic" }}
initial.displacement = [{0}, 0]
boundary = [ {{ on = "top", traction = [0, -3e4] }}, {{ on = "right", traction = [-3e4, 0] }},
             {{ on = "left", displacement = [{0}, "free"] }} ]
[contact]
on = "bottom"
normal = "unilateral"
)",
                                place),
                    {route});
  };
  for (const char *route : {"solver.method=condensed", "solver.method=monolithic"}) {
    SCOPED_TRACE(route);
    const RunCase here = standing(0, route);
    for (const double place : {1e-12, 9.313225746154785e-10, 1e-7}) {
      SCOPED_TRACE(place);
      const RunCase there = standing(place, route);
      expect_equal_quantities(there.contact(), here.contact(), {{"normal_traction"}}, 1e-9);
      expect_equal_quantities(there.history(), here.history(), {{"time_step_loss", "load_power"}},
                              1e-9);
    }
  }
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

}  // namespace
}  // namespace tourmaline::verified
