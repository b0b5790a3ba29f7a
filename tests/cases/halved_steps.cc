// Label: analytic. Steps whose contact is not found, which are taken in halves.

#include <fmt/format.h>

#include "closed_balances.h"
#include "equal_quantities.h"
#include "run_case.h"
#include "tourmaline/error.h"

namespace tourmaline::verified {
namespace {

// Pushed to and fro and pressed more and more.
const std::string rubbed = R"toml(
material.library = "BaTiO3-Liu2014"
mesh.box = { min = [0, 0], max = [0.1, 0.1], cells = [10, 10] }
boundary = [ { on = "top", displacement = ["2e-6*sin(9*t)", "-1e-6*t"], potential = 0, temperature = 0 } ]
contact = { on = "bottom", normal = "unilateral", friction = { law = "coulomb", coefficient = 0.9 } }
)toml";
const std::string ten_steps = "time = { end = 1, steps = 10 }\n" + rubbed;

// So few iterations that the contact of some steps is not found.
std::vector<std::string> hurried(const std::string &route, int iterations) {
  return {"solver." + route, "solver.max_iterations=" + std::to_string(iterations)};
}

// Steps that end at these times.
std::string one_by_one(const std::vector<double> &times) {
  std::string text;
  for (const double time : times)
    text += fmt::format("{}{{ until = {:.17g}, steps = 1 }}", text.empty() ? "" : ", ", time);
  return "time.interval = [" + text + "]\n";
}

struct Hurry {
  const char *route;
  int iterations;
};
void PrintTo(const Hurry &hurry, std::ostream *out) {
  *out << hurry.route << ' ' << hurry.iterations;
}

class HalvedSteps : public ::testing::TestWithParam<Hurry> {};

TEST_P(HalvedSteps, GiveWhatStepsOfTheirSizesGive) {
  const RunCase halved = run_text(ten_steps, hurried(GetParam().route, GetParam().iterations));
  const Table ours = halved.history();
  const auto n_more = static_cast<int>(ours.n_rows()) - 10;
  EXPECT_GT(n_more, 0);
  EXPECT_EQ(halved.summary()["sizes"]["halved_steps"], n_more);
  EXPECT_NE(halved.summary()["warnings"].dump().find("of half the size"), std::string::npos);
  expect_closed_balances(ours);

  const RunCase asked = run_text(one_by_one(ours.numbers("time")) + rubbed);
  EXPECT_FALSE(asked.summary()["sizes"].contains("halved_steps"));
  const Table theirs = asked.history();
  ASSERT_EQ(theirs.n_rows(), ours.n_rows());
  expect_equal_quantities(
      ours, theirs,
      {{"max_displacement"}, {"max_potential"}, {"friction_dissipation"}, {"slip"}, {"stick"}},
      1e-7);
}

INSTANTIATE_TEST_SUITE_P(Routes, HalvedSteps,
                         ::testing::Values(Hurry{"method=\"monolithic\"", 2},
                                           Hurry{"method=\"monolithic\"", 4},
                                           Hurry{"body=\"iterative\"", 1}));

TEST(UnsettledSteps, OfTheLeastSizeEndTheRunAndSayWhatWasTried) {
  try {
    run_text(ten_steps, hurried("method=\"monolithic\"", 1));
    FAIL() << "the contact was found";
  } catch (const SolveError &error) {
    EXPECT_NE(std::string(error.what()).find("steps of down to 0.00625 s were tried"),
              std::string::npos)
        << error.what();
  }
}

// Its solution is that of a convex programme, which shorter steps make no simpler.
TEST(UnsettledSteps, OfTrescasFrictionAreNotHalved) {
  try {
    run_text(ten_steps,
             {"contact.normal.law=\"bilateral\"",
              "contact.friction={ law = \"tresca\", bound = 1e3 }", "solver.max_iterations=1"});
    FAIL() << "the contact was found";
  } catch (const SolveError &error) {
    EXPECT_EQ(std::string(error.what()).find("were tried"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace tourmaline::verified
