// Label: analytic. Steps that the program chooses, by time.tolerance.

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

#include "closed_balances.h"
#include "partly_held.h"
#include "run_case.h"
#include "tourmaline/case/case.h"
#include "tourmaline/error.h"

namespace tourmaline::verified {
namespace {

// By linear interpolation between the steps; before the first one the value at its end.
double at(const std::vector<double> &times, const std::vector<double> &values, double time) {
  const auto found = std::lower_bound(times.begin(), times.end(), time * (1 - 1e-12));
  const auto i = static_cast<std::size_t>(found - times.begin());
  if (i == 0 || i == times.size())
    return values[std::min(i, times.size() - 1)];
  const double share = (time - times[i - 1]) / (times[i] - times[i - 1]);
  return values[i - 1] + share * (values[i] - values[i - 1]);
}

// Largest difference in the fields' extremes over all steps, each relative to its largest value.
double error(const RunCase &run, const RunCase &reference) {
  const Table ours = run.history(), theirs = reference.history();
  const std::vector<double> times = theirs.numbers("time");
  double worst = 0;
  for (const char *column : {"max_displacement", "max_potential", "min_temperature"}) {
    const std::vector<double> exact = theirs.numbers(column), values = ours.numbers(column);
    const std::vector<double> at_times = ours.numbers("time");
    for (std::size_t i = 0; i < values.size(); ++i)
      worst = std::max(worst, std::abs(values[i] - at(times, exact, at_times[i])) / largest(exact));
  }
  return worst;
}

std::vector<std::string> with_tolerance(const std::string &tolerance,
                                        std::vector<std::string> others = {}) {
  others.push_back("time.tolerance=" + tolerance);
  return others;
}

// 0.2 s are short beside the times in which heat spreads here: everything is smooth.
TEST(ChosenSteps, OfThePaperErrLessWithTheTolerance) {
  const std::string paper = "cases/ouafik-2020/conductive.toml";
  const std::vector<std::string> coarse{"mesh.box.cells=[12, 12]", "time.steps=10"};
  const RunCase reference(paper, {"mesh.box.cells=[12, 12]", "time.steps=5000"});
  double before = 1;
  std::size_t steps = 0;
  for (const char *tolerance : {"1e-2", "1e-3", "1e-4"}) {
    const RunCase run(paper, with_tolerance(tolerance, coarse));
    const double now = error(run, reference);
    EXPECT_LT(now, before / 2) << tolerance;
    EXPECT_LT(now, 15 * std::stod(tolerance));
    EXPECT_GT(run.history().n_rows(), steps);
    expect_closed_balances(run.history());
    before = now;
    steps = run.history().n_rows();
  }
}

const std::string material = "material.library = \"BaTiO3-Liu2014\"\n";

// Heated from the contact until it is steady, which takes 25000 s; the first cell, 15 s.
const std::string until_steady = material + R"(
time = { end = 2e4, steps = 20 }
mesh.box = { min = [0, 0], max = [0.1, 0.1], cells = [12, 12], cell = "triangle" }
boundary = [ { on = "right", displacement = [0, 0], potential = 0, temperature = 0 },
             { on = ["bottom", "top"], temperature = 0 },
             { on = "top", traction = [0, "-5e-6*t"] } ]
[contact]
on = "left"
friction = { law = "tresca", bound = 15 }
heat = { law = "exchange", coefficient = 1, foundation_temperature = -27 }
)";

// Rubbed to and fro for 8 s, and at rest while it cools.
const std::string reversals = material + R"(
time = { end = 2000, steps = 20 }
mesh.box = { min = [0, 0], max = [0.01, 0.01], cells = [8, 8] }
boundary = [ { on = "top", displacement = [0, 0], potential = 0, temperature = 0 } ]
[contact]
on = "bottom"
normal = "unilateral"
gap = "-1e-7"
foundation_displacement = [ { points = [[0,0],[1,1e-6],[3,-1e-6],[5,1e-6],[7,-1e-6],[8,0],[2000,0]] }, 0 ]
friction = { law = "coulomb", coefficient = 0.3 }
heat = { law = "exchange", coefficient = 500, foundation_temperature = -1, friction_share = 0.5 }
)";

// Warmed through a contact that lasts 1000 s and is taken away within 10.
const std::string opening = material + R"(
time = { end = 2000, steps = 20 }
mesh.box = { min = [0, 0], max = [0.01, 0.01], cells = [8, 8] }
boundary = [ { on = "top", displacement = [0, 0], potential = 0, temperature = 0 } ]
[contact]
on = "bottom"
normal = "unilateral"
foundation_displacement = [ 0, { points = [[0,0],[5,2e-7],[1000,2e-7],[1010,-1e-7],[2000,-1e-7]] } ]
friction = { law = "coulomb", coefficient = 0.3 }
heat = { law = "exchange", coefficient = 0, pressure = { coefficient = 2000, reference = 1e6 }, foundation_temperature = -5 }
)";

class ChosenStepsOf : public ::testing::TestWithParam<std::string> {};

TEST_P(ChosenStepsOf, CostLessThanHalfOfEqualOnes) {
  const RunCase reference = run_text(GetParam(), with_tolerance("3e-5")),
                run = run_text(GetParam(), with_tolerance("1e-2"));
  const int work = run.summary()["sizes"]["computed_steps"];
  const RunCase equal = run_text(GetParam(), {"time.steps=" + std::to_string(2 * work)});
  EXPECT_LT(error(run, reference), error(equal, reference));
  EXPECT_LT(error(run, reference), 0.1);
  EXPECT_LT(error(run_text(GetParam(), with_tolerance("1e-3")), reference),
            error(run, reference) / 1.5);
}

TEST_P(ChosenStepsOf, EndAtTheBendsOfTheLoads) {
  const RunCase run = run_text(GetParam(), with_tolerance("1e-2"));
  const std::vector<double> times = run.history().numbers("time");
  const std::set<double> ends(times.begin(), times.end());
  EXPECT_EQ(times.back(), GetParam() == until_steady ? 2e4 : 2000);
  std::vector<double> bends;
  if (GetParam() == reversals)
    bends = {1, 3, 5, 7, 8};
  if (GetParam() == opening)
    bends = {5, 1000, 1010};
  for (const double bend : bends)
    EXPECT_EQ(ends.count(bend), 1) << bend;
}

TEST_P(ChosenStepsOf, FactoriseEachSizeOnce) {
  const auto summary = run_text(GetParam(), with_tolerance("1e-2")).summary();
  EXPECT_EQ(summary["factorisations"], summary["sizes"]["step_sizes"]);
  EXPECT_LT(summary["sizes"]["step_sizes"], 30);
  EXPECT_GT(summary["sizes"]["rejected_steps"], 0);
  EXPECT_GE(summary["sizes"]["computed_steps"], 1.5 * summary["sizes"]["steps"].get<double>());
}

void expect_same_on_all_routes(const std::string &text, const std::vector<std::string> &with) {
  const RunCase direct = run_text(text, with);
  for (const char *route : {"solver.method=monolithic", "solver.body=iterative"}) {
    std::vector<std::string> all = with;
    all.emplace_back(route);
    const RunCase other = run_text(text, all);
    EXPECT_EQ(direct.history().numbers("time"), other.history().numbers("time")) << route;
    for (const char *column : {"max_displacement", "max_potential", "min_temperature"})
      EXPECT_LT(difference(other.history(), direct.history(), column), 1e-8) << route << column;
  }
}

TEST_P(ChosenStepsOf, AreTheSameOnAllRoutes) {
  expect_same_on_all_routes(GetParam(), with_tolerance("3e-2"));
}

std::string name(const ::testing::TestParamInfo<std::string> &info) {
  return std::array{"HeatedUntilSteady", "Reversals", "Opening"}.at(info.index);
}

INSTANTIATE_TEST_SUITE_P(Cases, ChosenStepsOf, ::testing::Values(until_steady, reversals, opening),
                         name);

// Two materials between electrodes, above a contact that opens.
const std::string regions = R"toml(
time = { end = 1, steps = 4 }
mesh.box = { min = [0, 0], max = [0.02, 0.01], cells = [6, 6], cell = "triangle" }
region = [ { where = "y < 0.005", material = { library = "BaTiO3-Liu2014", pyroelectric = [0, 1e-4] } },
           { where = "y > 0.005", material = { library = "silicon" } } ]
boundary = [ { on = "left", displacement = [0, "free"] },
             { on = "top", displacement = ["free", "3e-8*sin(5*t)"], temperature = "5*t" } ]
electrode = [ { name = "lid", on = "top", voltage = "20*t" }, { name = "ground", on = "right", voltage = 0 } ]
[contact]
on = "bottom"
normal = "unilateral"
friction = { law = "coulomb", coefficient = 0.2 }
)toml";

// In two and three dimensions, with symmetry planes, tilted normals, cells of degree 2, regions and
// electrodes.
TEST(ChosenSteps, AreTheSameOnAllRoutesOfEveryBody) {
  for (const auto &[text, degree] :
       std::vector<std::pair<std::string, std::string>>{{quarter_block, "1"},
                                                        {rimmed_sleeve, "1"},
                                                        {plane_between_rollers, "1"},
                                                        {plane_between_rollers, "2"},
                                                        {regions, "1"},
                                                        {regions, "2"}}) {
    SCOPED_TRACE(text + degree);
    const std::vector<std::string> others{"mesh.degree=" + degree, "solver.linear_tolerance=1e-13"};
    expect_same_on_all_routes(text, with_tolerance("3e-2", others));
    const RunCase run = run_text(text, with_tolerance("3e-2", others));
    expect_closed_balances(run.history());
    EXPECT_LT(error(run, run_text(text, with_tolerance("3e-4", others))), 0.3);
  }
}

TEST(ChosenSteps, OfAConstantLoadAreTheLongest) {
  const RunCase run = run_text(material + R"(
time = { end = 3, steps = 6, tolerance = 1e-3 }
mesh.box = { min = [0, 0], max = [0.01, 0.01], cells = [2, 2] }
boundary = [ { on = "top", displacement = [0, 0], potential = 0, temperature = 0 } ]
)");
  EXPECT_EQ(run.history().n_rows(), 6);
  EXPECT_EQ(run.summary()["sizes"]["rejected_steps"], 0);
}

TEST(ChosenSteps, OfACircuitFollowItsTimeConstant) {
  constexpr double resistance = 1e6, capacity = 12.6e-9 * 0.04 / 0.01;
  const RunCase run = run_text(R"(
time = { end = 5, steps = 10, tolerance = 1e-4 }
mesh.box = { min = [0, 0], max = [0.04, 0.01], cells = [4, 3] }
material = { library = "BaTiO3-Liu2014", m11 = 0, m33 = 0, p3 = 0, e31 = 0, e33 = 0, e15 = 0 }
boundary = [ { on = ["left", "right", "bottom", "top"], displacement = [0, 0] } ]
initial.potential = "1e4*y"
electrode = [ { name = "ground", on = "bottom", voltage = 0 },
              { name = "top", on = "top", resistor = 1e6 } ]
)");
  const Table h = run.history();
  const std::vector<double> t = h.numbers("time"), voltage = h.numbers("electrode_top_voltage");
  for (std::size_t i = 0; i < t.size(); ++i)
    EXPECT_NEAR(voltage[i], 100 * std::exp(-t[i] / (resistance * capacity)), 100 * 2e-2);
  EXPECT_LT(2 * t[0], t[t.size() - 1] - t[t.size() - 2]);
}

// Both steps of a pair are taken before either is written, each with its own potential.
TEST(ChosenSteps, OfAFoundationsCircuitBookWhatEachHasCrossed) {
  for (const char *exchange :
       {"law = 'exchange', coefficient = 1e-3, circuit = { resistor = 1e4, voltage = 100 }",
        "law = 'exchange', coefficient = 1e-3, circuit = { capacitor = 1e-9, voltage = '1e5*t' }",
        "law = 'leak', coefficient = 10, circuit = { resistor = 1e4, voltage = 100 }",
        "law = 'exchange', coefficient = 1e-3, circuit = { charge = '1e-6*t' }"})
    for (const char *route : {"solver.method=condensed", "solver.method=monolithic"}) {
      SCOPED_TRACE(std::string(exchange) + route);
      const RunCase run = run_text(material + R"toml(
time = { end = 5e-4, steps = 20, tolerance = 1e-2 }
mesh.box = { min = [0, 0], max = [0.01, 0.002], cells = [4, 2], cell = "quadrilateral" }
boundary = [ { on = "top", displacement = [0, 0], potential = 0 } ]
contact = { on = "bottom", electric = { )toml" +
                                       exchange + " } }\n",
                                   {route});
      const Table history = run.history();
      expect_closed_balances(history, 1e-9);
      const std::vector<double> crossed = history.numbers("charge_bottom"),
                                foundation = history.numbers("foundation_charge");
      for (std::size_t n = 0; n < crossed.size(); ++n)
        EXPECT_NEAR(crossed[n], -foundation[n], 1e-9 * std::abs(foundation.back())) << n;
    }
}

TEST(ChosenSteps, AreRefusedWhereTheyAreNotAvailable) {
  const std::string rest = R"(
mesh.box = { min = [0, 0], max = [0.01, 0.01], cells = [2, 2] }
boundary = [ { on = "top", displacement = [0, 0], potential = 0, temperature = 0 } ]
)" + material;
  for (const char *time : {"time = { end = 1, steps = 2, tolerance = 1e-3, regime = \"static\" }",
                           "time = { end = 1, steps = 2, tolerance = 1e-3, regime = \"dynamic\" }",
                           "time = { tolerance = 1e-3, interval = [{ until = 1, steps = 4 }] }",
                           "time = { end = 1, steps = 2, tolerance = 0 }",
                           "time = { end = 1, steps = 2, tolerance = 0.5 }"})
    EXPECT_THROW(run_text(time + rest), CaseError) << time;
}

}  // namespace
}  // namespace tourmaline::verified
