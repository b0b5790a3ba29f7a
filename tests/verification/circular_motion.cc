// Label: analytic. A sheared block between its foundation and a plate that moves on a circle: slip
// and traction turn their direction all the time, and have closed forms.

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>

#include "../cases/run_case.h"

namespace tourmaline::verified {
namespace {

using std::numbers::pi;

constexpr double c44 = 43e9;  // BaTiO3-Liu2014 [Pa]
constexpr double height = 0.01, radius = 4e-11, first_slip = 1.5e-11;
constexpr double shear_bound = c44 * first_slip / height;  // [N/m^2]

using Plane = std::array<double, 2>;

Plane plate(double t) {
  return {radius * (std::cos(2 * pi * t) - 1), radius * std::sin(2 * pi * t)};
}
Plane velocity(double t) {
  return {-2 * pi * radius * std::sin(2 * pi * t), 2 * pi * radius * std::cos(2 * pi * t)};
}

// All of the block shears alike, so that one point decides: its elastic displacement follows the
// plate and cannot leave the disc of radius S h / G; the rest is slip.
std::vector<Plane> elastic_part(int steps, double end) {
  std::vector<Plane> all{{0, 0}};
  for (int n = 1; n <= steps; ++n) {
    const Plane now = plate(end * n / steps), before = plate(end * (n - 1) / steps);
    Plane e{all.back()[0] + now[0] - before[0], all.back()[1] + now[1] - before[1]};
    if (const double size = std::hypot(e[0], e[1]); size > first_slip)
      e = {e[0] / size * first_slip, e[1] / size * first_slip};
    all.push_back(e);
  }
  return all;
}

// The solution in continuous time, e' = v - (e.v) e / |e|^2 from the time of first slip on, by the
// classical Runge-Kutta method with steps so small that its error does not count.
Plane elastic_part_in_continuous_time(double end) {
  const double start = std::asin(first_slip / (2 * radius)) / pi;  // |plate| = first_slip
  constexpr int steps = 20000;
  const double h = (end - start) / steps;
  const auto rate = [](double t, const Plane &e) {
    const Plane v = velocity(t);
    const double along = (e[0] * v[0] + e[1] * v[1]) / (first_slip * first_slip);
    EXPECT_GT(along, 0);  // slips all the time
    return Plane{v[0] - along * e[0], v[1] - along * e[1]};
  };
  const auto moved = [](const Plane &e, double by, const Plane &r) {
    return Plane{e[0] + by * r[0], e[1] + by * r[1]};
  };
  Plane e = plate(start);
  for (int k = 0; k < steps; ++k) {
    const double t = start + k * h;
    const Plane k1 = rate(t, e), k2 = rate(t + h / 2, moved(e, h / 2, k1)),
                k3 = rate(t + h / 2, moved(e, h / 2, k2)), k4 = rate(t + h, moved(e, h, k3));
    for (int c = 0; c < 2; ++c)
      e[c] += h / 6 * (k1[c] + 2 * k2[c] + 2 * k3[c] + k4[c]);
  }
  return e;
}

// No piezoelectricity, which would make the shear uneven; the sides cannot move up or down.
RunCase sheared_block(const std::string &cell, int steps, double end) {
  return RunCase(casefile::read_text(
      fmt::format(R"toml(
mesh.box = {{ min = [0,0,0], max = [0.02,0.015,{height}], cells = [2,2,2], cell = "{cell}" }}
material = {{ library = "BaTiO3-Liu2014", e31 = 0, e33 = 0, e15 = 0 }}
time = {{ end = {end}, steps = {steps} }}
boundary = [ {{ on = "top", displacement = ["{r}*(cos(2*pi*t) - 1)", "{r}*sin(2*pi*t)", 0], potential = 0 }},
             {{ on = ["left", "right", "front", "back"], displacement = ["free", "free", 0] }} ]
contact = {{ on = "bottom", friction = {{ law = "tresca", bound = {bound:.17g} }} }}
output = {{ fields = false }}
)toml",
                  fmt::arg("height", height), fmt::arg("cell", cell), fmt::arg("end", end),
                  fmt::arg("steps", steps), fmt::arg("r", radius), fmt::arg("bound", shear_bound)),
      "sheared"));
}

class CircularMotion : public ::testing::TestWithParam<const char *> {};

TEST_P(CircularMotion, SlipAndTractionAreExactInEveryStepAtEveryNode) {
  constexpr int steps = 60;
  constexpr double end = 2;
  const Table contact = sheared_block(GetParam(), steps, end).contact();
  const std::vector<Plane> exact = elastic_part(steps, end);
  const std::vector<double> step = contact.numbers("step");
  const std::vector<double> slip[] = {contact.numbers("slip_x"), contact.numbers("slip_y")},
                            traction[] = {contact.numbers("tangential_traction_x"),
                                          contact.numbers("tangential_traction_y")};
  for (std::size_t i = 0; i < step.size(); ++i) {
    const auto n = static_cast<std::size_t>(step[i]);
    const Plane top = plate(end * double(n) / steps);
    for (int c = 0; c < 2; ++c) {
      EXPECT_NEAR(slip[c][i], top[c] - exact[n][c], 1e-10 * first_slip) << n;
      EXPECT_NEAR(traction[c][i], -c44 * exact[n][c] / height, 1e-10 * shear_bound) << n;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Cells, CircularMotion, ::testing::Values("hexahedron", "tetrahedron"));

Plane slip_at_the_end(int steps, double end) {
  const Table contact = sheared_block("hexahedron", steps, end).contact();
  return {contact.numbers("slip_x").back(), contact.numbers("slip_y").back()};
}

TEST(CircularMotion, AsTheStepsShrinkTheSlipTendsToTheSolutionInContinuousTime) {
  constexpr double end = 0.4;  // before the lag has settled, after which steps do not matter
  const Plane top = plate(end), e = elastic_part_in_continuous_time(end);
  std::vector<double> error;
  for (const int steps : {40, 80, 160, 320}) {
    const Plane slip = slip_at_the_end(steps, end);
    error.push_back(std::hypot(slip[0] - top[0] + e[0], slip[1] - top[1] + e[1]) / radius);
  }
  for (std::size_t k = 0; k + 1 < error.size(); ++k)
    EXPECT_NEAR(error[k] / error[k + 1], 2, 0.2) << k << ": " << error[k] << " " << error[k + 1];
  EXPECT_LT(error.back(), 1e-2);
}

// In the long run the slip is a circle as well, behind the plate by the angle whose sine is the
// ratio of first slip to the plate's radius.
TEST(CircularMotion, SlipLagsBehindThePlateByTheAngleOfTheClosedForm) {
  constexpr double end = 3;
  const Plane e = elastic_part_in_continuous_time(end), v = velocity(end);
  const double lag = std::atan2(v[1], v[0]) - std::atan2(e[1], e[0]);
  EXPECT_NEAR(std::sin(lag), first_slip / radius, 1e-9);
  constexpr int steps = 1200;
  const Table contact = sheared_block("hexahedron", steps, end).contact();
  const std::vector<double> x = contact.numbers("slip_x"), y = contact.numbers("slip_y");
  const std::size_t last = x.size() - 1, before = last - x.size() / steps;
  const Plane middle = velocity(end - end / steps / 2);
  const double seen =
      std::atan2(middle[1], middle[0]) - std::atan2(y[last] - y[before], x[last] - x[before]);
  EXPECT_NEAR(std::sin(seen), first_slip / radius, 0.01);
}

}  // namespace
}  // namespace tourmaline::verified
