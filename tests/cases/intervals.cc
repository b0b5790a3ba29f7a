// Label: analytic. Steps of several sizes: what has a rate has that of its own step.

#include <cmath>

#include "closed_balances.h"
#include "run_case.h"
#include "tourmaline/case/case.h"

namespace tourmaline::verified {
namespace {

const std::string three_sizes =
    "time.interval = [{ until = 0.1, steps = 4 }, { until = 0.2, steps = 10 }, { until = 0.4, "
    "steps = 8 }, { until = 1, steps = 6 }]\n";

// Sizes are 1/40, 1/100, 1/40 again and 1/10 of a second.
double size_of_step(std::size_t n) {
  return n < 4 ? 0.025 : n < 14 ? 0.01 : n < 22 ? 0.025 : 0.1;
}

// A capacitor that discharges over a resistor: backward Euler takes V_n = V_(n-1) / (1 + k/(R C)).
TEST(Intervals, AResistorDischargesAtTheRateOfEachStep) {
  constexpr double resistance = 1e6, capacity = 12.6e-9 * 0.04 / 0.01;
  const Table h = run_text(three_sizes + R"(
mesh.box = { min = [0, 0], max = [0.04, 0.01], cells = [4, 3] }
material = { library = "BaTiO3-Liu2014", m11 = 0, m33 = 0, p3 = 0, e31 = 0, e33 = 0, e15 = 0 }
boundary = [ { on = ["left", "right", "bottom", "top"], displacement = [0, 0] } ]
initial.potential = "1e4*y"
electrode = [ { name = "ground", on = "bottom", voltage = 0 },
              { name = "top", on = "top", resistor = 1e6 } ]
)")
                      .history();
  const std::vector<double> voltage = h.numbers("electrode_top_voltage"),
                            current = h.numbers("electrode_top_current");
  double exact = 100;
  for (std::size_t n = 0; n < voltage.size(); ++n) {
    exact /= 1 + size_of_step(n) / (resistance * capacity);
    EXPECT_NEAR(voltage[n], exact, 1e-9 * exact) << n;
    EXPECT_NEAR(current[n], -exact / resistance, 1e-8 * exact / resistance) << n;
  }
  expect_closed_balances(h);
}

// Without stiffness to stop it the layer gives way at p0/c; the load is dead.
TEST(Intervals, ADampedFoundationGivesWayAtOneSpeed) {
  const Table h = run_text(three_sizes + R"(
mesh.box = { min = [0, 0], max = [1, 1], cells = [2, 2], cell = "quadrilateral" }
material = { symmetry = "isotropic", young = 1e11, poisson = 0, eps11 = 10, k11 = 1, density = 1000, specific_heat = 1000, reference_temperature = 293 }
boundary = [ { on = "top", traction = [0, -1e3], potential = 0, temperature = 0 },
             { on = ["left", "right"], displacement = [0, "free"] } ]
[contact]
on = "bottom"
normal = { law = "damped", coefficient = 1e9 }
)")
                      .contact();
  const std::vector<double> t = h.numbers("time"), u = h.numbers("normal_displacement");
  for (std::size_t i = 0; i < t.size(); ++i)
    EXPECT_NEAR(u[i], 1e3 / 1e9 * t[i], 1e-9 * 1e-6 * t[i] + 1e-20);
}

// The foundation moves at one speed under a body that is held: the slip rate is that speed.
TEST(Intervals, TheSlipRateIsThatOfEachStep) {
  const Table c = run_text(three_sizes + R"(
mesh.box = { min = [0, 0], max = [0.1, 0.1], cells = [4, 4] }
material.library = "BaTiO3-Liu2014"
boundary = [ { on = "right", displacement = [0, 0], potential = 0, temperature = 0 } ]
[contact]
on = "left"
foundation_displacement = [0, "1e-3*t"]
friction = { law = "tresca", bound = 15 }
heat = { law = "insulated", friction_share = 0.5 }
)")
                      .contact();
  const std::vector<double> rate = c.numbers("slip_rate");
  for (std::size_t i = 0; i < rate.size(); ++i)
    EXPECT_NEAR(rate[i], 1e-3, 1e-3 * 2e-2);
}

const std::string block = R"(
mesh.box = { min = [0, 0], max = [0.1, 0.1], cells = [8, 8] }
material.library = "BaTiO3-Liu2014"
boundary = [ { on = "right", displacement = [0, 0], potential = 0, temperature = 0 },
             { on = "top", traction = [0, "-50*t"] } ]
[contact]
on = "left"
friction = { law = "tresca", bound = 15 }
heat = { law = "exchange", coefficient = 100, foundation_temperature = -4 }
electric = { law = "leak", coefficient = 1e-8, foundation_potential = 3 }
)";

void expect_near(const RunCase &a, const RunCase &b, double tolerance) {
  for (const char *column : {"u_x", "u_y", "potential", "temperature"}) {
    const std::vector<double> x = a.nodes().numbers(column), y = b.nodes().numbers(column);
    double size = 0;
    for (const double value : x)
      size = std::max(size, std::abs(value));
    for (std::size_t i = 0; i < x.size(); ++i)
      EXPECT_NEAR(x[i], y[i], tolerance * size) << column;
  }
}

TEST(Intervals, OfOneSizeAreASingleOne) {
  const RunCase one = run_text("time = { end = 1, steps = 10 }\n" + block),
                several = run_text(
                    "time.interval = [{ until = 0.3, steps = 3 }, { until = 1, steps = 7 }]\n" +
                    block);
  expect_near(one, several, 1e-11);
  EXPECT_EQ(several.summary()["factorisations"], 1);
  EXPECT_EQ(several.summary()["sizes"]["step_sizes"], 1);
  EXPECT_FALSE(one.summary()["sizes"].contains("step_sizes"));
}

TEST(Intervals, AreSolvedAlikeOnAllRoutes) {
  const RunCase direct = run_text(three_sizes + block);
  EXPECT_EQ(direct.summary()["factorisations"], 3);
  EXPECT_EQ(direct.summary()["sizes"]["step_sizes"], 3);
  EXPECT_EQ(direct.summary()["sizes"]["steps"], 28);
  expect_closed_balances(direct.history());
  for (const char *route : {"solver.method=monolithic", "solver.body=iterative"}) {
    const RunCase other = run_text(three_sizes + block, {route});
    expect_near(direct, other, 1e-8);
    expect_closed_balances(other.history(), 1e-8);
  }
}

TEST(Intervals, InSpaceCloseTheirBalances) {
  const RunCase run = run_text(three_sizes + R"(
mesh.box = { min = [0, 0, 0], max = [0.1, 0.1, 0.1], cells = [3, 3, 3], cell = "tetrahedron" }
material.library = "BaTiO3-Liu2014"
boundary = [ { on = "right", displacement = [0, 0, 0], potential = 0, temperature = "20*t" },
             { on = "top", traction = [0, 0, "-50*t"] } ]
[contact]
on = "left"
normal = "unilateral"
gap = "-1e-9"
friction = { law = "coulomb", coefficient = 0.3 }
heat = { law = "insulated", friction_share = 1 }
)");
  expect_closed_balances(run.history(), 1e-9);
}

}  // namespace
}  // namespace tourmaline::verified
