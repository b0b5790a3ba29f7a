// The cases of cases/devices: closed forms where there are any, facts of mechanics otherwise.
#include "closed_balances.h"
#include "run_case.h"
#include "tourmaline/case/case.h"

namespace tourmaline::testing {
namespace {

RunCase device(const std::string &name, const std::vector<std::string> &overrides = {}) {
  return RunCase("cases/devices/" + name + ".toml", overrides);
}

// BaTiO3-Liu2014 in plane strain with no stress through the thickness.
constexpr double c_bar = 166e9 - 78e9 * 78e9 / 162e9;
constexpr double e_bar = -4.4 - 78e9 * 18.6 / 162e9;
constexpr double beta_bar = 12.6e-9 + 18.6 * 18.6 / 162e9;

// The curvature of a free series bimorph of two layers of height h under V
// (cases/devices/README.md).
TEST(Bimorph, WithoutThePadItBendsByTheClosedForm) {
  constexpr double h = 0.5e-3, length = 20e-3, volts = 50;
  const double curvature =
      e_bar * volts / (h * h * (4. / 3 * c_bar + e_bar * e_bar / (3 * beta_bar)));
  casefile::Case asked = casefile::read_file(
      std::filesystem::path(TOURMALINE_SOURCE_DIR) / "cases/devices/bimorph.toml",
      {"output.fields=false"}, mesh::read_mesh_file);
  asked.contacts.clear();
  const RunCase run(asked);
  const Table nodes = run.nodes();
  // Slender beams bend like this but for the ends: 1/20 of the length is as thick as the strip.
  EXPECT_NEAR(largest(nodes, "u_y"), std::abs(curvature) * length * length / 2,
              0.03 * std::abs(curvature) * length * length / 2);
}

// The same with no word of heat: then no temperature changes, and nothing is to be warned of.
TEST(Bimorph, StaticItBendsByTheClosedForm) {
  constexpr double h = 0.5e-3, length = 20e-3, volts = 50;
  const double curvature =
      e_bar * volts / (h * h * (4. / 3 * c_bar + e_bar * e_bar / (3 * beta_bar)));
  const RunCase run = device("bimorph-static");
  EXPECT_NEAR(largest(run.nodes(), "u_y"), std::abs(curvature) * length * length / 2,
              0.01 * std::abs(curvature) * length * length / 2);
  for (const double theta : run.nodes().numbers("temperature"))
    EXPECT_EQ(theta, 0);
  EXPECT_EQ(run.summary()["warnings"].size(), 0U);
  expect_closed_balances(run.history());
}

TEST(Bimorph, ThePadSlipsAndItsFrictionStaysAtTheBound) {
  const RunCase run = device("bimorph");
  EXPECT_GT(run.history().numbers("slip").back(), 0);
  EXPECT_LE(largest(run.contact(), "tangential_traction_x"), 2e3 * (1 + 1e-12));
  for (const double imbalance : run.history().numbers("energy_imbalance"))
    EXPECT_LT(std::abs(imbalance), 1e-9);
}

TEST(Washers, BothSendChargeOfOneSignToTheShim) {
  const RunCase run = device("washers");
  const Table history = run.history();
  const auto shim = history.numbers("charge_rim of the shim"),
             foot = history.numbers("charge_foot"), head = history.numbers("charge_head");
  for (std::size_t i = 0; i < shim.size(); ++i) {
    EXPECT_LT(foot[i] * shim[i], 0);
    EXPECT_LT(head[i] * shim[i], 0);
    EXPECT_NEAR(shim[i] + foot[i] + head[i], 0, 1e-9 * std::abs(shim[i]));
  }
}

// Without friction and before the heat, a washer is a free disc under the force F but for the
// steel, which hinders its widening and with it what d31 adds: each sends a little less than d33 F.
TEST(Washers, WithoutFrictionTheirChargeIsThatOfTheForceAndProportionalToIt) {
  const RunCase run = device("washers", {"contact.friction={law='none'}"});
  const Table history = run.history();
  const auto shim = history.numbers("charge_rim of the shim"), force = history.numbers("load_z");
  constexpr double d33 = 1.914e-10;  // of BaTiO3-Liu2014, `tourmaline materials`
  for (const int step : {0, 1}) {
    EXPECT_GT(shim[step] / (2 * d33 * force[step]), 0.9);
    EXPECT_LT(shim[step] / (2 * d33 * force[step]), 1);
  }
  // But for the heat of pressing, which flows off.
  EXPECT_NEAR(shim[1] / shim[0], 2, 1e-3);
}

// Nothing warms this sensor: what is left of heat in it is round-off, and must not look like a
// fault.
TEST(FrictionSensor, WithoutHeatItsBalancesCloseToo) {
  const RunCase run = device("friction-sensor-loaded");
  expect_closed_balances(run.history(), 1e-9);
}

// Pure shear: gamma h = top - slip, |c44 gamma| <= S, D = e15 gamma on both faces.
TEST(FrictionSensor, ChargeOverSlipIsTheExactLoop) {
  constexpr double c44 = 43e9, e15 = 11.6, bound = 5e4, h = 2e-3, width = 0.01;
  const RunCase run = device("friction-sensor");
  const Table history = run.history();
  const auto charge = history.numbers("charge_top"), time = history.numbers("time");
  double slip = 0;
  for (std::size_t i = 0; i < time.size(); ++i) {
    const double t = time[i], top = 4e-9 * (t < 1 ? t : t < 3 ? 2 - t : t - 4);
    const double shear = std::clamp((top - slip) / h, -bound / c44, bound / c44);
    slip = top - shear * h;
    EXPECT_NEAR(std::abs(charge[i]), e15 * std::abs(shear) * width,
                1e-9 * e15 * bound / c44 * width)
        << "t = " << t;
  }
}

TEST(LShape, ThePotentialStaysBetweenItsElectrodesAndTheBevelSlips) {
  const RunCase run = device("l-shape");
  const Table history = run.history();
  EXPECT_EQ(history.numbers("max_potential").back(), 20);
  EXPECT_EQ(history.numbers("min_potential").back(), 0);
  EXPECT_GT(history.numbers("slip").back(), 0);
  EXPECT_NEAR(history.numbers("charge_0 V").back() + history.numbers("charge_20 V").back(), 0,
              1e-9 * std::abs(history.numbers("charge_20 V").back()));
}

}  // namespace
}  // namespace tourmaline::testing
