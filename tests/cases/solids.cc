// The shipped three-dimensional and curved cases: what Tresca's law promises of every node in every
// step, and the numbers that the cases quote.

#include <array>
#include <cmath>
#include <numbers>

#include "closed_balances.h"
#include "run_case.h"

namespace tourmaline::verified {
namespace {

using Vector = std::array<double, 3>;

double dot(const Vector &a, const Vector &b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

std::vector<Vector> vectors(const Table &table, const std::string &name) {
  std::vector<Vector> all(table.n_rows(), Vector{});
  for (int c = 0; c < 3; ++c)
    if (const std::string column = name + "xyz"[c]; table.columns.contains(column)) {
      const std::vector<double> values = table.numbers(column);
      for (std::size_t i = 0; i < values.size(); ++i)
        all[i][c] = values[i];
    }
  return all;
}

// At each slipping node the traction has the size of the bound and points against the slip of the
// step; at each sticking node it is within the bound, and nothing slips.
void expect_tresca(const Table &contact, double bound) {
  const std::vector<double> step = contact.numbers("step");
  const auto nodes =
      static_cast<std::size_t>(std::count(step.begin(), step.end(), 1.));  // rows go step by step
  const std::vector<Vector> slip = vectors(contact, "slip_"),
                            traction = vectors(contact, "tangential_traction_");
  double largest = 0;
  for (const Vector &s : slip)
    largest = std::max(largest, std::sqrt(dot(s, s)));
  std::size_t slipping = 0;
  for (std::size_t i = 0; i < slip.size(); ++i) {
    Vector d = slip[i];
    for (int c = 0; c < 3 && i >= nodes; ++c)
      d[c] -= slip[i - nodes][c];
    const double size = std::sqrt(dot(d, d)), friction = std::sqrt(dot(traction[i], traction[i]));
    EXPECT_LE(friction, bound * (1 + 1e-9));
    if (contact.columns.at("status")[i] == "stick") {
      EXPECT_LE(size, 1e-12 * largest);
      continue;
    }
    ++slipping;
    EXPECT_NEAR(friction, bound, 1e-9 * bound);
    // The differences of slips that are written with round-off: exact to that over their size.
    EXPECT_NEAR(dot(d, traction[i]), -bound * size, 1e-9 * bound * size + 1e-13 * bound * largest);
  }
  EXPECT_GT(slipping, nodes);
}

TEST(TwistedBlock, TractionOpposesTheSlipAtEverySlippingNodeInEveryStep) {
  const RunCase run("cases/block-3d/twisted.toml", {"mesh.box.cells=[8,8,8]"});
  expect_tresca(run.contact(), 15);
  const Table history = run.history();
  // Newton's method with the exact tangent of the disc, though all directions turn: seen 4.
  EXPECT_LE(largest(history, "newton_iterations"), 6);
  expect_closed_balances(history);
}

TEST(TwistedBlock, InTheMonolithicRouteNewtonTakesFewStepsAsWell) {
  const RunCase run("cases/block-3d/twisted.toml",
                    {"mesh.box.cells=[6,6,6]", "solver.method=monolithic"});
  expect_tresca(run.contact(), 15);
  EXPECT_LE(largest(run.history(), "newton_iterations"), 8);
}

TEST(Ring, SlipsAllAroundAtTheMomentOfTheBound) {
  const RunCase run("cases/ring/ring.toml");
  const Table contact = run.contact(), history = run.history();
  expect_tresca(contact, 1000);
  const std::vector<double> slipping = history.numbers("slip");
  EXPECT_EQ(slipping[11], 0);
  EXPECT_EQ(slipping[12], 96);
  EXPECT_EQ(slipping[27], 38);
  const std::vector<Vector> traction = vectors(contact, "tangential_traction_");
  const std::vector<double> x = contact.numbers("x"), y = contact.numbers("y");
  // Chords of the polygon instead of arcs: 2 r sin(pi/96) each.
  const double weight = 2 * 0.02 * std::sin(std::numbers::pi / 96);
  double moment = 0;
  for (std::size_t i = x.size() - 96; i < x.size(); ++i)
    moment += weight * (x[i] * traction[i][1] - y[i] * traction[i][0]);
  EXPECT_NEAR(moment, 1000 * 96 * weight * 0.02, 1e-6);
}

TEST(Sleeve, SlipTurnsAndTheTractionStaysAgainstIt) {
  const RunCase run("cases/ring/sleeve.toml");
  expect_tresca(run.contact(), 1000);
  EXPECT_LE(largest(run.history(), "newton_iterations"), 5);
  for (const char *balance : {"energy_imbalance", "force_imbalance"})
    EXPECT_LT(largest(run.history(), balance), 1e-10) << balance;
}

}  // namespace
}  // namespace tourmaline::verified
