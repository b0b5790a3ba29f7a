// Label: analytic. The cases of cases/verification against their closed forms; the derivations are
// in docs/exact-solutions.md, with the same numbers. Nothing of the program is used to evaluate
// them.

#include <fmt/format.h>

#include <functional>

#include "run_case.h"

namespace tourmaline::verified {
namespace {

// BaTiO3-Liu2014.
constexpr double c11 = 166e9, c13 = 78e9, c33 = 162e9, c44 = 43e9;
constexpr double e33 = 18.6, e15 = 11.6;
constexpr double beta11 = 11.2e-9, beta33 = 12.6e-9;
constexpr double m33 = 1.89e6, p3 = -1e-4;
constexpr double k11 = 50, rho_c = 5500. * 420., theta_ref = 293;

// Of sums of a few thousand terms in double precision.
constexpr double round_off = 1e-11;

RunCase verification(const std::string &name, const std::vector<std::string> &overrides = {}) {
  return RunCase("cases/verification/" + name + ".toml", overrides);
}

std::vector<double> at_step(const Table &table, const std::string &column, int step) {
  const std::vector<double> values = table.numbers(column), steps = table.numbers("step");
  std::vector<double> all;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (steps[i] == step)
      all.push_back(values[i]);
  EXPECT_FALSE(all.empty()) << column;
  return all;
}

void expect_all(const std::vector<double> &values, double expected, double tolerance) {
  for (const double value : values)
    ASSERT_NEAR(value, expected, tolerance);
}

void expect_relative(const std::vector<double> &values, double expected) {
  expect_all(values, expected, round_off * std::abs(expected));
}

using Field = std::function<double(double x, double y, double z)>;

// Every node against a formula, measured by the formula's largest value.
void expect_field(const Table &nodes, const std::string &column, const Field &exact) {
  const std::vector<double> values = nodes.numbers(column), x = nodes.numbers("x"),
                            y = nodes.numbers("y");
  const std::vector<double> z = nodes.columns.contains("z") ? nodes.numbers("z") : x;
  std::vector<double> expected;
  for (std::size_t i = 0; i < x.size(); ++i)
    expected.push_back(exact(x[i], y[i], z[i]));
  for (std::size_t i = 0; i < x.size(); ++i)
    ASSERT_NEAR(values[i], expected[i], round_off * largest(expected)) << column << " " << i;
}

// 1. The column.

constexpr double strain = -1e-6, height = 0.01, warming = 0.1;

TEST(Column, ShortCircuitedItHasTheStiffnessAtConstantFieldAndIsPressedByWarming) {
  const RunCase run = verification("column-short-circuit");
  expect_relative(at_step(run.contact(), "normal_traction", 1), c33 * strain);
  expect_relative(at_step(run.contact(), "normal_traction", 2), c33 * strain - m33 * warming);
  expect_all(run.nodes().numbers("potential"), 0, round_off * 14.76);
}

TEST(Column, OpenItIsStiffenedByTheFieldThatItsOwnChargeMakes) {
  const RunCase run = verification("column-open-circuit");
  const double stiffness = c33 + e33 * e33 / beta33;
  expect_relative(at_step(run.contact(), "normal_traction", 1), stiffness * strain);
  expect_relative(at_step(run.history(), "min_potential", 1), e33 * strain / beta33 * height);
}

TEST(Column, OpenItsPyroelectricChargeAddsToThePotentialAndToTheStress) {
  const RunCase run = verification("column-open-circuit");
  const double field = -(e33 * strain + p3 * warming) / beta33;
  expect_relative(at_step(run.contact(), "normal_traction", 2),
                  c33 * strain - e33 * field - m33 * warming);
  expect_field(run.nodes(), "potential", [&](double, double y, double) { return -field * y; });
  expect_field(run.nodes(), "u_y", [](double, double y, double) { return strain * y; });
}

TEST(Column, InsulatedItWarmsUnderPressureAndIsStifferStill) {
  const RunCase run = verification("column-adiabatic");
  const double alpha = rho_c / theta_ref;
  const double theta = -(m33 - p3 * e33 / beta33) * strain / (alpha - p3 * p3 / beta33);
  const double field = -(e33 * strain + p3 * theta) / beta33;
  const double stress = c33 * strain - e33 * field - m33 * theta;
  EXPECT_LT(stress, (c33 + e33 * e33 / beta33) * strain);
  expect_relative(at_step(run.contact(), "normal_traction", 4), stress);
  expect_relative(run.nodes().numbers("temperature"), theta);
  expect_field(run.nodes(), "potential", [&](double, double y, double) { return -field * y; });
}

// 2. The half-space.

constexpr double k_c = 1e4, theta_f = -27;
const double effusivity = std::sqrt(k11 * rho_c);

double surface_temperature(double t) {
  const double b = k_c * std::sqrt(t) / effusivity;
  return theta_f * (1 - std::exp(b * b) * std::erfc(b));
}

// The half-space solved exactly in space but by backward Euler in time: its surface temperature
// obeys a convolution with the coefficients of (1 - z)^(1/2).
std::vector<double> surface_temperature_of_the_time_steps(int steps, double end) {
  std::vector<double> weight{1}, theta{0};
  for (int j = 1; j <= steps; ++j)
    weight.push_back(weight.back() * (j - 1.5) / j);
  const double conductance = effusivity / std::sqrt(end / steps);
  for (int n = 1; n <= steps; ++n) {
    double past = 0;
    for (int j = 1; j < n; ++j)
      past += weight[n - j] * theta[j];
    theta.push_back((k_c * theta_f - conductance * past) / (conductance + k_c));
  }
  return theta;
}

std::vector<double> computed_surface_temperature(int cells, int steps) {
  const Table contact =
      verification("cooled-half-space", {fmt::format("mesh.box.cells=[{},1]", cells),
                                         fmt::format("time.steps={}", steps)})
          .contact();
  std::vector<double> all{0};
  for (std::size_t i = 0; i < contact.n_rows(); i += 2)  // two nodes on the surface, alike
    all.push_back(contact.numbers("temperature")[i]);
  return all;
}

TEST(CooledHalfSpace, FollowsTheClosedFormOverAllOfTheTime) {
  const std::vector<double> theta = computed_surface_temperature(160, 200);
  // The cooling begins abruptly; backward Euler then errs by about k/(7 t) of the value.
  for (int n = 1; n <= 200; ++n)
    EXPECT_NEAR(theta[n], surface_temperature(n / 200.), 0.15 / n * std::abs(theta[n])) << n;
  EXPECT_NEAR(theta[200], surface_temperature(1), 0.01);
}

TEST(CooledHalfSpace, HalvingTheTimeStepHalvesTheError) {
  double before = 0;
  for (const int steps : {25, 50, 100, 200}) {
    const double error = computed_surface_temperature(160, steps)[steps] - surface_temperature(1);
    if (before != 0) {
      EXPECT_NEAR(before / error, 2, 0.02) << steps;
    }
    before = error;
  }
}

TEST(CooledHalfSpace, HalvingTheCellsQuartersTheErrorInSpaceAtEveryTime) {
  constexpr int steps = 50;
  const std::vector<double> exact = surface_temperature_of_the_time_steps(steps, 1);
  std::vector<double> before;
  for (const int cells : {40, 80, 160}) {
    const std::vector<double> theta = computed_surface_temperature(cells, steps);
    for (int n = 1; n <= steps && !before.empty(); ++n)
      EXPECT_NEAR((before[n] - exact[n]) / (theta[n] - exact[n]), 4, 0.1) << cells << " " << n;
    before = theta;
  }
}

// 3. Shear between plate and foundation.

struct Sliding {
  double plate, slip, traction;  // traction: on the body, against the slip
};

constexpr double G = c44 + e15 * e15 / beta11;
constexpr double bound = G * 1e-9, width = 0.02, first_slip = 1e-11;

// Turning points of the plate are at odd seconds, 3e-11 m to each side.
double plate(double t) {
  const double phase = std::fmod(t + 3, 4);
  return 3e-11 * (std::abs(phase - 2) - 1);
}

// The elastic part of the plate's displacement cannot pass +-S h/G; the rest is slip.
std::vector<Sliding> hysteresis(int steps, double end) {
  std::vector<Sliding> all{{0, 0, 0}};
  for (int n = 1; n <= steps; ++n) {
    const double at = plate(end * n / steps), before = all.back().slip;
    const double slip = std::clamp(before, at - first_slip, at + first_slip);
    all.push_back({at, slip, -G * (at - slip) / height});
  }
  return all;
}

TEST(ShearHysteresis, StickSlipAndReversalAreExactInEveryStepAtEveryNode) {
  const Table contact = verification("shear-hysteresis").contact();
  const std::vector<Sliding> exact = hysteresis(90, 9);
  for (int n = 1; n <= 90; ++n) {
    expect_all(at_step(contact, "tangential_traction_x", n), exact[n].traction, 1e-11 * bound);
    expect_all(at_step(contact, "slip_x", n), exact[n].slip, 1e-11 * first_slip);
    expect_all(at_step(contact, "normal_traction", n), 0, 1e-11 * bound);
  }
}

TEST(ShearHysteresis, StatusIsSlipWhileThePlateDragsTheBlockAndStickElsewhere) {
  const Table contact = verification("shear-hysteresis").contact();
  const std::vector<Sliding> exact = hysteresis(90, 9);
  for (std::size_t i = 0; i < contact.n_rows(); ++i) {
    const auto n = static_cast<std::size_t>(std::stoi(contact.columns.at("step")[i]));
    // Slip stops and begins between the ends of steps, never on them.
    const bool slips = std::abs(exact[n].slip - exact[n - 1].slip) > 1e-6 * first_slip;
    EXPECT_EQ(contact.columns.at("status")[i], slips ? "slip" : "stick") << n;
  }
}

// Work of the friction in the steps up to the end of each cycle, from what the run wrote.
std::vector<double> dissipated_in_cycles(const Table &contact) {
  std::vector<double> cycles{0, 0, 0};
  const std::size_t nodes = at_step(contact, "slip_x", 1).size();
  std::vector<double> slip(nodes, 0), x = at_step(contact, "x", 1);
  for (int n = 1; n <= 90; ++n) {
    const std::vector<double> traction = at_step(contact, "tangential_traction_x", n),
                              now = at_step(contact, "slip_x", n);
    for (std::size_t i = 0; i < nodes; ++i) {
      const double weight = (x[std::min(i + 1, nodes - 1)] - x[i == 0 ? 0 : i - 1]) / 2;
      cycles[n <= 10 ? 0 : n <= 50 ? 1 : 2] -= weight * traction[i] * (now[i] - slip[i]);
    }
    slip = now;
  }
  return cycles;
}

TEST(ShearHysteresis, EachCycleDissipatesTheBoundTimesTheAreaTimesTheSlip) {
  const std::vector<double> cycles =
      dissipated_in_cycles(verification("shear-hysteresis").contact());
  EXPECT_NEAR(cycles[0] / (bound * width), 2e-11, 1e-21);  // first loading: 3e-11 less 1e-11
  EXPECT_NEAR(cycles[1] / (bound * width), 8e-11, 1e-21);  // twice the travel of 6e-11 less 2e-11
  EXPECT_NEAR(cycles[2] / (bound * width), 8e-11, 1e-21);
}

TEST(ShearHysteresis, TheLoopOfTractionAgainstPlateDisplacementHasTheSameArea) {
  const Table contact = verification("shear-hysteresis").contact();
  double area = 0, before = 0;
  for (int n = 1; n <= 90; ++n) {
    const double traction = -at_step(contact, "tangential_traction_x", n)[3];
    const double travel = plate(n / 10.) - plate((n - 1) / 10.);
    if (n > 50)
      area += (traction + before) / 2 * travel;
    before = traction;
  }
  // The trapezoidal rule cuts the corner where slip begins within a step, twice a cycle: there the
  // traction grows during 2/3 of the step of 3e-12 m only.
  const double cut = 2 * bound * (2. / 3 * 3e-12) * (1. / 3 * 3e-12) / (2 * first_slip);
  EXPECT_NEAR(area / bound, 8e-11 - cut / bound, 1e-9 * 8e-11);
}

TEST(ShearHysteresis, TheShearedBlockChargesItselfAcrossThePlate) {
  const double shear = (plate(9) - hysteresis(90, 9).back().slip) / height;
  expect_field(verification("shear-hysteresis").nodes(), "potential",
               [&](double x, double, double) { return e15 / beta11 * shear * x; });
}

// 4. The limits of the friction bound.

TEST(FrictionlessLimit, TheBlockWidensOnTheFoundationWithoutTangentialTraction) {
  const RunCase run = verification("frictionless");
  const Table contact = run.contact();
  const double stress = -(c33 - c13 * c13 / c11) * 1e-6;
  expect_relative(at_step(contact, "normal_traction", 4), stress);
  expect_field(run.nodes(), "u_x", [](double x, double, double) { return c13 / c11 * 1e-6 * x; });
  const std::vector<double> traction = at_step(contact, "tangential_traction_x", 4);
  expect_all({traction.begin() + 1, traction.end()}, 0, 0);  // the first node is held at x = 0
  expect_all(run.nodes().numbers("temperature"), 0, 1e-16);
}

TEST(FrictionlessLimit, OfThePapersExampleIsTheCaseWithoutFriction) {
  const std::vector<std::string> cells{"mesh.box.cells=[24,24]"};
  std::vector<std::string> zero = cells, none = cells;
  zero.emplace_back("contact.friction.bound=0");
  none.emplace_back("contact.friction={law='none'}");
  const RunCase bound_zero("cases/ouafik-2020/conductive.toml", zero),
      law_none("cases/ouafik-2020/conductive.toml", none);
  for (const char *column : {"u_x", "u_y", "potential", "temperature"})
    EXPECT_LT(difference(bound_zero.nodes(), law_none.nodes(), column), 1e-12) << column;
  EXPECT_EQ(largest(bound_zero.contact().numbers("tangential_traction_y")), 0);
}

TEST(PerfectStick, IsTheSameAsASideThatIsClamped) {
  const RunCase stuck = verification("perfect-stick"),
                clamped = verification("perfect-stick-clamped");
  for (const char *column : {"u_x", "u_y", "potential", "temperature"})
    EXPECT_LT(difference(stuck.nodes(), clamped.nodes(), column), 1e-12) << column;
  EXPECT_EQ(largest(stuck.contact().numbers("slip_y")), 0);
  EXPECT_GT(largest(stuck.contact().numbers("tangential_traction_y")), 100);
}

// 5. Patch tests.

struct Plane {
  const char *cell;
  int degree;
};

void PrintTo(const Plane &plane, std::ostream *out) {
  *out << plane.cell << " " << plane.degree;
}

class PatchTest : public ::testing::TestWithParam<Plane> {
 protected:
  static std::vector<std::string> overrides() {
    return {fmt::format("mesh.box.cell={}", GetParam().cell),
            fmt::format("mesh.degree={}", GetParam().degree)};
  }
};

TEST_P(PatchTest, LinearFieldsAreReproducedOnAGradedMesh) {
  const Table nodes = verification("patch-test", overrides()).nodes();
  expect_field(nodes, "u_x", [](double x, double y, double) { return 2e-6 * x - 1e-6 * y; });
  expect_field(nodes, "u_y", [](double x, double y, double) { return 5e-7 * x + 3e-6 * y; });
  expect_field(nodes, "potential", [](double x, double y, double) { return 1000 * x - 500 * y; });
  expect_field(nodes, "temperature", [](double, double, double) { return 0.25; });
}

TEST_P(PatchTest, AContactThatSlipsEverywhereCarriesItsUniformTractions) {
  const RunCase run = verification("patch-contact", overrides());
  const Table nodes = run.nodes(), contact = run.contact();
  expect_field(nodes, "u_x", [](double x, double y, double) { return 2e-6 * x + 1e-6 * y; });
  expect_field(nodes, "u_y", [](double, double y, double) { return 3e-6 * y; });
  expect_field(nodes, "potential", [](double x, double y, double) { return 1000 * x - 500 * y; });
  expect_field(nodes, "temperature", [](double, double, double) { return 0.25; });
  const std::vector<double> normal = at_step(contact, "normal_traction", 3),
                            tangential = at_step(contact, "tangential_traction_x", 3);
  // The first node is held by the left side.
  expect_relative({normal.begin() + 1, normal.end()}, 160200);
  expect_relative({tangential.begin() + 1, tangential.end()}, -54600);
}

INSTANTIATE_TEST_SUITE_P(Planes, PatchTest,
                         ::testing::Values(Plane{"triangle", 1}, Plane{"quadrilateral", 1},
                                           Plane{"triangle", 2}, Plane{"quadrilateral", 2}));

class SolidPatchTest : public ::testing::TestWithParam<std::string> {};

TEST_P(SolidPatchTest, LinearFieldsAreReproducedOnAGradedMesh) {
  const Table nodes = verification("patch-test-3d", {"mesh.box.cell=" + GetParam()}).nodes();
  expect_field(nodes, "u_x", [](double x, double y, double z) { return 1e-6 * (2 * x - y + z); });
  expect_field(nodes, "u_y",
               [](double x, double y, double z) { return 1e-6 * (x / 2 + 3 * y - 2 * z); });
  expect_field(nodes, "u_z", [](double x, double y, double z) { return 1e-6 * (-x + y + z / 2); });
  expect_field(nodes, "potential",
               [](double x, double y, double z) { return 1000 * x - 500 * y + 200 * z; });
  expect_field(nodes, "temperature", [](double, double, double) { return 0.25; });
}

INSTANTIATE_TEST_SUITE_P(Solids, SolidPatchTest, ::testing::Values("tetrahedron", "hexahedron"));

}  // namespace
}  // namespace tourmaline::verified
