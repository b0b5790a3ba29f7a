// Label: analytic. Columns and layers whose contact yields, opens or slips with a bound that
// changes, against the closed forms of docs/exact-solutions.md, section 6; and the published plate
// SSNV128.

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <functional>
#include <numbers>

#include "closed_balances.h"
#include "run_case.h"

namespace tourmaline::verified {
namespace {

constexpr double c33 = 162e9, c44 = 43e9, e33 = 18.6, e15 = 11.6;
constexpr double beta11 = 11.2e-9, beta33 = 12.6e-9;
constexpr double open_stiffness = c33 + e33 * e33 / beta33;  // along the poling, no charge on top

RunCase verification(const std::string &name, const std::vector<std::string> &overrides = {}) {
  return RunCase("cases/verification/" + name + ".toml", overrides);
}

using OfTime = std::function<double(double)>;

/// Every node in every step, measured by the formula's largest value.
void expect_in_time(const Table &contact, const std::string &column, const OfTime &exact,
                    double tolerance = 1e-10) {
  const std::vector<double> values = contact.numbers(column), times = contact.numbers("time");
  std::vector<double> expected;
  for (const double t : times)
    expected.push_back(exact(t));
  ASSERT_GT(largest(expected), 0) << column;
  for (std::size_t i = 0; i < values.size(); ++i)
    ASSERT_NEAR(values[i], expected[i], tolerance * largest(expected)) << column << " " << i;
}

// 1. Normal laws.

constexpr double column_stiffness = open_stiffness / 0.01, gap = 1e-8, compliance = 1e13;

double lowered(double t) {
  return 5e-8 * t * (2 - t);
}

double sunk(double t) {
  const double d = lowered(t);
  return d < gap ? d : (column_stiffness * d + compliance * gap) / (column_stiffness + compliance);
}

TEST(ColumnOnCompliance, SinksInAsTheTwoStiffnessesShareTheWayAndComesOff) {
  const RunCase run = verification("contact-compliance");
  const Table contact = run.contact();
  expect_in_time(contact, "normal_displacement", sunk);
  expect_in_time(contact, "normal_traction",
                 [](double t) { return -compliance * std::max(0., sunk(t) - gap); });
  expect_in_time(contact, "gap", [](double t) { return gap - sunk(t); });
  const std::vector<double> times = contact.numbers("time");
  for (std::size_t i = 0; i < times.size(); ++i)
    EXPECT_EQ(contact.columns.at("status")[i] == "open", lowered(times[i]) < gap) << i;
  expect_closed_balances(run.history());
}

// At its end nothing is left but the round-off of what was.
TEST(ColumnOnCompliance, IsAlsoSolvedWithAllUnknownsAtOnce) {
  const RunCase run = verification("contact-compliance", {"solver.method=monolithic"});
  expect_in_time(run.contact(), "normal_displacement", sunk);
}

TEST(ColumnOnCompliance, TheFoundationHoldsTheEnergyOfASpringAndGivesItBack) {
  const Table history = verification("contact-compliance").history();
  expect_in_time(history, "contact_energy", [](double t) {
    const double d = std::max(0., sunk(t) - gap);
    return 0.001 * compliance * d * d / 2;
  });
  EXPECT_EQ(largest(history, "contact_dissipation"), 0);
}

TEST(ColumnOnDampedFoundation, SinksInAtTheLoadOverTheCoefficient) {
  const RunCase run = verification("contact-damped");
  expect_in_time(run.contact(), "normal_displacement", [](double t) { return 1e6 / 1e13 * t; });
  expect_in_time(run.contact(), "normal_traction", [](double) { return -1e6; });
  expect_in_time(run.history(), "contact_dissipation",
                 [](double) { return 0.001 * 1e6 * 1e6 / 1e13; });
  expect_closed_balances(run.history());
}

TEST(ColumnOnDampedFoundation, IsAlsoSolvedWithAllUnknownsAtOnce) {
  const RunCase run = verification("contact-damped", {"solver.method=monolithic"});
  expect_in_time(run.contact(), "normal_displacement", [](double t) { return 1e6 / 1e13 * t; });
  expect_in_time(run.contact(), "normal_traction", [](double) { return -1e6; });
}

// 2. Friction whose bound changes.

TEST(CappedFriction, SticksThenFollowsThePressureThenTheLimit) {
  const RunCase run = verification("contact-capped-friction");
  const Table contact = run.contact();
  const double stiffness = (c44 + e15 * e15 / beta11) / 0.01;
  const auto shear = [](double t) { return std::min({1.5e6 * t, 3e5 * (1 + t), 5e5}); };
  expect_in_time(contact, "tangential_traction_x", [&](double t) { return -shear(t); });
  expect_in_time(contact, "slip_x", [&](double t) { return (1.5e6 * t - shear(t)) / stiffness; });
  expect_in_time(contact, "normal_traction", [](double t) { return -1e6 * (1 + t); });
  expect_in_time(contact, "friction_bound", [](double t) { return std::min(3e5 * (1 + t), 5e5); });
  const std::vector<double> times = contact.numbers("time");
  for (std::size_t i = 0; i < times.size(); ++i)
    EXPECT_EQ(contact.columns.at("status")[i], times[i] < 0.25 ? "stick" : "slip") << i;
  expect_closed_balances(run.history());
}

// Slip, accumulated slip and shear of the layer after each step.
struct Weakened {
  double slip = 0, accumulated = 0, shear = 0;
};

// The slip increment by bisection.
Weakened weaken(const Weakened &before, double moved) {
  constexpr double stiffness = 43e9 / 0.1, pressure = 1e6;
  const auto bound = [&](double x) {
    return pressure * (0.3 + 0.2 * std::exp(-(before.accumulated + x) / 1e-6));
  };
  const double trial = stiffness * (moved - before.slip);
  if (std::abs(trial) <= bound(0))
    return {before.slip, before.accumulated, trial};
  double low = 0, high = std::abs(trial) / stiffness;
  for (int i = 0; i < 200; ++i) {
    const double x = (low + high) / 2;
    (std::abs(trial) - stiffness * x > bound(x) ? low : high) = x;
  }
  const double slip = before.slip + std::copysign(low, trial);
  return {slip, before.accumulated + low, stiffness * (moved - slip)};
}

TEST(SlipWeakening, TheBoundFallsWithAllTheSlipThatHasBeenForwardAndBack) {
  const RunCase run = verification("contact-slip-weakening");
  std::vector<Weakened> states{{}};
  for (const double moved : {0.5e-6, 1e-6, 1.5e-6, 2e-6, 1.5e-6, 0., -0.5e-6})
    states.push_back(weaken(states.back(), moved));
  EXPECT_NEAR(states[4].slip, 1.1559222791330e-6, 1e-18);
  const auto at = [&](double t) { return states.at(std::lround(t)); };
  const Table contact = run.contact();
  expect_in_time(contact, "slip_x", [&](double t) { return at(t).slip; });
  expect_in_time(contact, "accumulated_slip", [&](double t) { return at(t).accumulated; });
  expect_in_time(contact, "tangential_traction_x", [&](double t) { return -at(t).shear; });
  expect_closed_balances(run.history());
}

int steps_with_jumps(const RunCase &run) {
  return run.summary()["iterations"].value("steps_with_slip_jumps", 0);
}

// Below G/h = p (mu_s - mu_d)/distance nothing quasistatic holds the slip once it has set in.
TEST(SlipWeakening, ThatIsSteeperThanTheLayerUnloadsJumpsAndSaysSo) {
  EXPECT_EQ(steps_with_jumps(verification("contact-slip-weakening")), 0);
  const RunCase steep =
      verification("contact-slip-weakening", {"contact.friction.coefficient.distance=2e-7"});
  EXPECT_GT(steps_with_jumps(steep), 0);
  EXPECT_THAT(steep.summary()["warnings"].dump(), ::testing::HasSubstr("slip jumped in"));
  expect_closed_balances(steep.history());
}

// 3. SSNV128. The third column is another program's (cases/ssnv128/README.md), all its digits.

struct Point {
  double x;         // [m]
  double expected;  // u_x [1e-5 m]
};

constexpr Point points[] = {{0, 2.845943843},
                            {1.25e-3, 2.707923641},
                            {5e-3, 2.274025555},
                            {7.5e-3, 1.972706693},
                            {11.25e-3, 1.536415944}};

std::size_t row_at(const Table &contact, int step, double x) {
  const std::vector<double> steps = contact.numbers("step"), places = contact.numbers("x");
  for (std::size_t i = 0; i < steps.size(); ++i)
    if (steps[i] == step && std::abs(places[i] - x) < 1e-9)
      return i;
  ADD_FAILURE() << "no contact node at " << x;
  return 0;
}

int count_last(const Table &contact, const std::string &status, std::size_t n_nodes) {
  const std::vector<std::string> &all = contact.columns.at("status");
  return static_cast<int>(std::count(all.end() - static_cast<long>(n_nodes), all.end(), status));
}

void expect_ssnv128(const RunCase &run, int steps, std::size_t across, double pressed_breadth) {
  const Table contact = run.contact();
  for (const Point &point : points)
    EXPECT_NEAR(contact.numbers("slip_x")[row_at(contact, steps, point.x)] * 1e5, point.expected,
                1e-9 * point.expected);
  EXPECT_NEAR(
      -contact.numbers("normal_traction")[row_at(contact, steps, 38.75e-3)] * pressed_breadth,
      1.0486376788e5, 1e-9 * 1.0486376788e5);
  // With the corner beside the support, which is none of the published count.
  const int deep = static_cast<int>(across);
  EXPECT_EQ(count_last(contact, "open", 33 * across), 3 * deep);
  EXPECT_EQ(count_last(contact, "slip", 33 * across), 22 * deep);
  EXPECT_EQ(count_last(contact, "stick", 33 * across), 8 * deep);
  expect_closed_balances(run.history());
}

TEST(Ssnv128, HasTheNumbersAndStatusesOfTheIndependentProgram) {
  expect_ssnv128(RunCase("cases/ssnv128/plate.toml"), 1, 1, 1.25e-3);
}

TEST(Ssnv128, TenLoadStepsGiveTheAnswerOfOne) {
  expect_ssnv128(RunCase("cases/ssnv128/plate.toml", {"time.steps=10"}), 10, 1, 1.25e-3);
}

TEST(Ssnv128, OneHexahedronDeepHasTheSameNumbers) {
  expect_ssnv128(RunCase("cases/ssnv128/solid.toml"), 1, 2, 1.25e-3);
}

// 4. Hertz. `reduced`: E* [N/m^2]. The half width from the second moment of the pressure, P a^2/4;
// what is largest from the node in the middle.

struct Hertz {
  double half_width, largest_pressure;  // errors
};

Hertz hertz(const std::string &name, double reduced, int cells,
            const std::vector<std::string> &more = {}) {
  constexpr double force = 1e6, radius = 1;
  std::vector<std::string> overrides{fmt::format("mesh.box.cells=[{0},{0}]", cells)};
  overrides.insert(overrides.end(), more.begin(), more.end());
  const RunCase run("cases/hertz/" + name + ".toml", overrides);
  const Table contact = run.contact();
  const std::vector<double> x = contact.numbers("x"), traction = contact.numbers("normal_traction");
  double sum = 0, second = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double right = i + 1 < x.size() ? x[i + 1] : x[i], left = i > 0 ? x[i - 1] : x[i];
    const double nodal = -traction[i] * (right - left);  // on both halves
    sum += nodal;
    second += nodal * x[i] * x[i];
  }
  EXPECT_NEAR(sum, force, 1e-8 * force);
  // The body leans on its contact alone, and has cells some hundred times as long as wide, in which
  // its way down makes forces of round-off.
  expect_closed_balances(run.history(), 2e-9);
  const double a = std::sqrt(4 * force * radius / (std::numbers::pi * reduced)),
               p0 = std::sqrt(force * reduced / (std::numbers::pi * radius));
  return {2 * std::sqrt(second / sum) / a - 1, -traction[0] / p0 - 1};
}

// The edge of the contact lies between two nodes, wherever these are; so the errors are within what
// falls with the square of the cells' size, and do not follow it.
void expect_hertz(const std::string &name, double reduced) {
  for (const int cells : {32, 64, 128}) {
    const Hertz error = hertz(name, reduced, cells);
    const double square = 64. / cells * 64 / cells;
    EXPECT_LT(std::abs(error.half_width), 1e-2 * square) << cells;
    EXPECT_LT(std::abs(error.largest_pressure), 4e-3 * square) << cells;
  }
}

TEST(HertzLine, HalfWidthAndPressureConverge) {
  expect_hertz("line", 2e11 / 0.91);
}

TEST(HertzLine, OfAPiezoelectricHalfPlaneConvergesToTheStiffenedModulus) {
  expect_hertz("piezoelectric", 1.468047e11);
}

// Charge that crosses where the contact is closed softens: E* falls from that of an insulating
// cylinder to that of a conducting one, 2/[(L^-1)_nn - (L^-1)_nphi^2/(L^-1)_phiphi].
TEST(HertzLine, OfAPiezoelectricHalfPlaneSoftensTheMoreChargeCrosses) {
  constexpr double insulated = 1.468047e11, conducting = 1.291435e11;
  const auto modulus = [&](double coefficient) {
    const double half_width =
        1 + hertz("piezoelectric", insulated, 64,
                  {fmt::format("contact.electric={{law='exchange', coefficient={}, "
                               "foundation_potential=0, ramp=1e-9}}",
                               coefficient)})
                .half_width;
    return insulated / (half_width * half_width);
  };
  double last = modulus(0);
  EXPECT_NEAR(last, insulated, 1e-2 * insulated);
  for (const double coefficient : {1e-7, 1e-6, 1e-5, 1e-3, 1.}) {
    const double now = modulus(coefficient);
    EXPECT_LT(now, last) << coefficient;
    last = now;
  }
  EXPECT_NEAR(last, conducting, 1e-2 * conducting);
}

// In one case, without the other's modulus.
TEST(HertzLine, TheModuliWithAndWithoutCouplingAreToldApart) {
  EXPECT_GT(std::abs(hertz("piezoelectric", 1.261227e11, 64).half_width), 0.05);
}

}  // namespace
}  // namespace tourmaline::verified
