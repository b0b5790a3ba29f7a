// Runs that are killed or stopped go on with --resume to the same bytes.

#include <random>

#include "interrupted.h"

namespace {

using testing::AllOf;
using testing::HasSubstr;
namespace fs = std::filesystem;
using Seconds = std::chrono::duration<double>;

TEST_F(Interrupted, KilledAtRandomMomentsItGoesOnToTheSameBytes) {
  const std::string all =
      "run " + paper + " --set time.steps=40 --set output.checkpoint=1steps -q -o ";
  Seconds whole(1e9);  // the least of some, as other processes are at work too
  for (int repeat = 0; repeat < 2; ++repeat) {
    const auto started = std::chrono::steady_clock::now();
    ASSERT_EQ(run(all + "one/results"), 0) << complained_;
    whole = std::min<Seconds>(whole, std::chrono::steady_clock::now() - started);
  }
  EXPECT_TRUE(slips(here() / "one/results/contact.csv"));
  std::mt19937 random(1);
  std::uniform_real_distribution<double> share(0.3, 1.05);  // before it the libraries load
  // Of the moments some must be between the first and the last step.
  constexpr int least = 12, most = 60, least_behind_checkpoint = 4;
  int behind_checkpoint = 0;
  for (int kill = 0; kill < least || (kill < most && behind_checkpoint < least_behind_checkpoint);
       ++kill) {
    const auto process = start(all + "other/results --resume");
    std::this_thread::sleep_for(share(random) * whole);
    process->send(SIGKILL);
    const bool ended = process->wait() == 0;
    if (ended) {
      expect_same_files(here() / "one/results", here() / "other/results");
      fs::remove_all(here() / "other");
    }
    const bool behind = fs::exists(here() / "other/results/checkpoint.bin");
    behind_checkpoint += behind;
    whole *= ended ? 0.8 : behind ? 1 : 1.2;  // how busy the machine is changes meanwhile
  }
  ASSERT_EQ(run(all + "other/results --resume"), 0) << complained_;
  expect_same_results(here() / "one/results", here() / "other/results");
  EXPECT_GE(behind_checkpoint, least_behind_checkpoint);
}

TEST_F(Interrupted, ThePapersCaseGoesOn) {
  expect_to_go_on(paper + " --set time.steps=400 --set output.every=70", "150steps");
  expect_same_results(here() / "one/results", here() / "other/results");
}

TEST_F(Interrupted, WhatWasLargestBeforeTheCheckpointIsStillWarnedOf) {
  std::ofstream(here() / "peaks.toml") << R"toml(
mesh.box = { min = [0, 0], max = [0.1, 0.1], cells = [12, 12] }
material.library = "BaTiO3-Liu2014"
time = { end = 0.2, steps = 1600 }
output.every = 700
[[boundary]]
on = "right"
displacement = [0, 0]
potential = 0
temperature = "400*exp(-(t/0.0025 - 2)^2)"
[[boundary]]
on = "top"
traction = [0, "-0.5*t - 4e10*exp(-(t/0.0025 - 2)^2)"]
[contact]
on = "left"
friction = { law = "tresca", bound = 15 }
)toml";
  expect_to_go_on("peaks.toml", "45steps");
  EXPECT_THAT(warnings_, AllOf(HasSubstr("the temperature reaches 400 K (step 40, t = 0.005 s)"),
                               HasSubstr("strains reach"), HasSubstr("(step 40,")));
}

TEST_F(Interrupted, ProbesGoOn) {
  std::ofstream(here() / "probed.toml") << R"toml(
mesh.box = { min = [0, 0], max = [0.1, 0.1], cells = [12, 12] }
material.library = "BaTiO3-Liu2014"
time = { end = 1, steps = 400 }
output.every = 70
boundary = [ { on = "right", displacement = [0, 0], potential = 0, temperature = 0 },
             { on = "top", traction = [0, "-50*t - 200*t*t"] } ]
contact = { on = "left", friction = { law = "tresca", bound = 0.5 } }
probe = [ { name = "tip", at = [0, 0.1] },
          { name = "line", from = [0, 0], to = [0.1, 0.1], points = 3 },
          { name = "rubbed", on = "left" } ]
)toml";
  expect_to_go_on("probed.toml", "150steps");
  expect_same_results(here() / "one/results", here() / "other/results");
  for (const char *name : {"tip", "line", "rubbed"})
    EXPECT_TRUE(fs::exists(here() / "other/results" / ("probe-" + std::string(name) + ".csv")));
}

TEST_F(Interrupted, TheMonolithicRouteGoesOn) {
  expect_to_go_on(paper + " --set solver.method=monolithic --set contact.friction.bound=0.02");
}

// In the middle of an interval and across its end; what is kept of the first size serves the third
// interval, and is made again by whoever goes on.
TEST_F(Interrupted, StepsOfSeveralSizesGoOn) {
  std::ofstream(here() / "sizes.toml") << R"toml(
mesh.box = { min = [0, 0], max = [0.1, 0.1], cells = [12, 12] }
material.library = "BaTiO3-Liu2014"
time.interval = [ { until = 0.1, steps = 100 }, { until = 0.2, steps = 50 }, { until = 1, steps = 800 } ]
output.every = 200
boundary = [ { on = "right", displacement = [0, 0], potential = 0, temperature = 0 },
             { on = "top", traction = [0, "-50*t - 200*t*t"] } ]
[contact]
on = "left"
friction = { law = "tresca", bound = 0.5 }
electric = { law = "leak", coefficient = 1e-8, foundation_potential = 3 }
)toml";
  expect_to_go_on("sizes.toml", "130steps");
}

// Its points count, not the file's name.
TEST_F(Interrupted, ATableWhoseValuesHaveChangedIsAnotherCase) {
  const auto write = [&](const char *last) {
    std::ofstream(here() / "load.csv") << "t,F\n0,0\n1," << last << "\n";
  };
  std::ofstream(here() / "table.toml") << R"toml(
mesh.box = { min = [0, 0], max = [0.1, 0.1], cells = [4, 4] }
material.library = "BaTiO3-Liu2014"
time = { end = 1, steps = 2 }
boundary = [ { on = "right", displacement = [0, 0], potential = 0 },
             { on = "top", traction = [0, { table = "load.csv" }] } ]
)toml";
  write("-50");
  ASSERT_EQ(run("run table.toml -q -o results"), 0) << complained_;
  ASSERT_EQ(run("run table.toml -q -o results --resume"), 0) << complained_;
  ASSERT_EQ(run("run results/resolved.toml -q -o again"), 0) << complained_;
  EXPECT_TRUE(content_of(here() / "results/history.csv") ==
              content_of(here() / "again/history.csv"));
  write("-60");
  EXPECT_EQ(run("run table.toml -q -o results --resume"), 2);
  EXPECT_THAT(complained_, HasSubstr("boundary[1].traction was [0, { points = [[0, 0], [1, -50]] "
                                     "}], is [0, { points = [[0, 0], [1, -60]] }]"));
}

// One of which remembers its slip, the other not.
TEST_F(Interrupted, SeveralContactsGoOn) {
  const std::string clamped = std::string(TOURMALINE_SOURCE_DIR) +
                              "/cases/clamped-block/block.toml --set output.every=70 --set "
                              "contact[1].friction.coefficient={static=0.2,kinetic=0.15,"
                              "distance=1e-7} --set time.steps=";
  expect_to_go_on(clamped + "300");
  std::filesystem::remove_all(here() / "one");
  std::filesystem::remove_all(here() / "other");
  expect_to_go_on(clamped + "30 --set output.every=20 --set solver.method=monolithic");
}

TEST_F(Interrupted, PiecewiseConstantMultipliersGoOn) {
  expect_to_go_on(paper +
                  " --set solver.method=monolithic --set solver.multiplier=piecewise-constant");
}

TEST_F(Interrupted, ABlockGoesOn) {
  expect_to_go_on("block.toml --set time.steps=8");
  expect_same_results(here() / "one/results", here() / "other/results");
}

TEST_F(Interrupted, TheIterativeRouteGoesOn) {
  expect_to_go_on("block.toml --set time.steps=8 --set solver.body=iterative");
}

// A bar in stiff thirds, the middle one softer by 1e8, pulled to and fro: where it stands on its
// foundation its breadth changes.
const std::string pulled = R"toml(
mesh.box = { min = [0, 0, 0], max = [3, 1, 1], cells = [6, 2, 2], cell = "hexahedron" }
time = { end = 3, steps = 20 }
boundary = [
  { on = "bottom", displacement = ["free", "free", 0], potential = 0, temperature = 0 },
  { on = "front", displacement = ["free", 0, "free"] },
  { on = "right", traction = ["1e3*sin(4*t)", 0, 0] } ]
contact = { on = "left", friction = { law = "tresca", bound = 100 } }
solver = { body = "iterative", linear_tolerance = 1e-7 }
region = [
  { where = "x < 1 || x > 2", material = { symmetry = "isotropic", young = 1e11, poisson = 0.3, eps11 = 10, k11 = 1, density = 1000, specific_heat = 1000, reference_temperature = 293 } },
  { where = "x > 1 && x < 2", material = { symmetry = "isotropic", young = 1e3, poisson = 0, eps11 = 10, k11 = 1, density = 1000, specific_heat = 1000, reference_temperature = 293 } } ]
)toml";

TEST_F(Interrupted, TheIterativeRouteGoesOnWhereItIsRefined) {
  std::ofstream(here() / "pulled.toml") << pulled;
  expect_to_go_on("pulled.toml");
  EXPECT_EQ(without_times(here() / "other/results/summary.json")["refined"], true);
}

TEST_F(Interrupted, ElectrodesInACircuitGoOn) {
  expect_to_go_on(std::string(TOURMALINE_SOURCE_DIR) +
                      "/cases/devices/friction-sensor-loaded.toml --set time.steps=400"
                      " --set output.every=100 --set electrode[0].capacitor=1e-9",
                  "150steps");
}

// What the friction remembers is state, and so is where the foundation stood.
const std::string weakening = R"toml(
mesh.box = { min = [0, 0], max = [0.02, 0.01], cells = [16, 8], cell = "quadrilateral" }
material = { library = "BaTiO3-Liu2014", pyroelectric = [0, 1e-4] }
time = { end = 1, steps = 40 }
boundary = [ { on = "top", displacement = [0, -1e-6], potential = 0, temperature = 0 } ]
[contact]
on = "bottom"
gap = "2e-3*(x - 0.008)^2"
foundation_displacement = ["2.5e-6*sin(7*t)", "2e-7*sin(20*t)"]
normal = "unilateral"
friction = { law = "coulomb", coefficient = { static = 0.35, kinetic = 0.25, distance = 1e-6 } }
heat = { law = "exchange", coefficient = 2e4, foundation_temperature = "20*t" }
)toml";

TEST_F(Interrupted, FrictionThatRemembersItsSlipOnAFoundationThatMovesGoesOn) {
  std::ofstream(here() / "weakening.toml") << weakening;
  expect_to_go_on("weakening.toml");
  EXPECT_THAT(content_of(here() / "other/results/contact.csv"), HasSubstr("accumulated_slip"));
}

// Charge that has leaked stays.
TEST_F(Interrupted, WhatCrossesTheContactGoesOn) {
  std::ofstream(here() / "crossing.toml") << weakening.substr(0, weakening.find("heat")) << R"toml(
heat = { law = "exchange", coefficient = 2e4, foundation_temperature = "20*t", ramp = 3e-7, friction_share = 0.5 }
electric = { law = "leak", coefficient = 1e-6, foundation_potential = 5, ramp = 2e-7 }
)toml";
  for (const char *route :
       {"", " --set solver.method=monolithic", " --set solver.body=iterative"}) {
    SCOPED_TRACE(route);
    expect_to_go_on(std::string("crossing.toml --set time.end=0.5 --set time.steps=20") + route);
    EXPECT_THAT(content_of(here() / "other/results/history.csv"), HasSubstr("friction_heat_body"));
    fs::remove_all(here() / "one");
    fs::remove_all(here() / "other");
  }
}

TEST_F(Interrupted, TheCircuitOfAFoundationGoesOn) {
  std::ofstream(here() / "circuit.toml") << weakening.substr(0, weakening.find("heat")) << R"toml(
electric = { law = "leak", coefficient = 1e-6, ramp = 2e-7, circuit = { resistor = 1e9, capacitor = 1e-10, voltage = "30*t" } }
)toml";
  for (const char *route :
       {"", " --set solver.method=monolithic", " --set solver.body=iterative"}) {
    SCOPED_TRACE(route);
    expect_to_go_on(std::string("circuit.toml --set time.end=0.5 --set time.steps=20") + route);
    EXPECT_THAT(content_of(here() / "other/results/history.csv"), HasSubstr("foundation_voltage"));
    fs::remove_all(here() / "one");
    fs::remove_all(here() / "other");
  }
}

// Killed in the second interval, whose steps have another size.
TEST_F(Interrupted, TheCircuitOfAFoundationGoesOnInALaterInterval) {
  std::string text = weakening.substr(0, weakening.find("heat"));
  const std::size_t begin = text.find("time = "), end = text.find('\n', begin);
  text.replace(begin, end - begin,
               "time.interval = [{ until = 1e-3, steps = 1 }, { until = 1, steps = 40 }]");
  std::ofstream(here() / "circuit.toml") << text << R"toml(
electric = { law = "leak", coefficient = 1e-6, ramp = 2e-7, circuit = { resistor = 1e9, capacitor = 1e-10, voltage = "30*t" } }
)toml";
  expect_to_go_on("circuit.toml", "10steps");
}

TEST_F(Interrupted, StepsThatTheProgramChoosesGoOn) {
  for (const char *route :
       {"1e-4", "1e-4 --set solver.method=monolithic", "1e-4 --set solver.body=iterative"}) {
    SCOPED_TRACE(route);
    expect_to_go_on(paper + " --set time.steps=10 --set time.tolerance=" + route, "40steps");
    fs::remove_all(here() / "one");
    fs::remove_all(here() / "other");
  }
}

TEST_F(Interrupted, StepsThatAreHalvedGoOn) {
  std::ofstream(here() / "hurried.toml") << R"toml(
material.library = "BaTiO3-Liu2014"
time = { end = 4, steps = 40 }
output.every = 70
mesh.box = { min = [0, 0], max = [0.1, 0.1], cells = [14, 14] }
boundary = [ { on = "top", displacement = ["2e-6*sin(9*t)", "-1e-6*t"], potential = 0, temperature = 0 } ]
contact = { on = "bottom", normal = "unilateral", friction = { law = "coulomb", coefficient = 0.9 } }
solver = { method = "monolithic", max_iterations = 3 }
)toml";
  expect_to_go_on("hurried.toml", "8steps");
  EXPECT_THAT(warnings_, HasSubstr("two steps of half the size were taken"));
}

TEST_F(Interrupted, FrictionThatRemembersItsSlipGoesOnIteratively) {
  std::ofstream(here() / "weakening.toml") << weakening;
  expect_to_go_on("weakening.toml --set solver.body=iterative");
  EXPECT_THAT(content_of(here() / "other/results/contact.csv"), HasSubstr("accumulated_slip"));
}

// Several preconditioners, each of which depends on its own matrix alone.
TEST_F(Interrupted, SlipsThatSetInOneAfterTheOtherGoOnIteratively) {
  std::ofstream(here() / "rubbed.toml") << R"toml(
mesh.box = { min = [0, 0], max = [0.02, 0.01], cells = [24, 12], cell = "quadrilateral" }
material = { library = "BaTiO3-Liu2014", pyroelectric = [0, 1e-4] }
time = { end = 2, steps = 60 }
boundary = [ { on = "top", displacement = ["1e-6*sin(t)", "-3e-7*t"], temperature = 0, potential = 0 } ]
[contact]
on = "bottom"
gap = "1e-5*(x - 0.005)"
foundation_displacement = ["-1e-5*t", 0]
friction = { law = "tresca", bound = 1e6 }
)toml";
  expect_to_go_on("rubbed.toml --set solver.body=iterative");
}

TEST_F(Interrupted, ADampedFoundationGoesOn) {
  std::string text = weakening;
  const std::string normal = "normal = \"unilateral\"";
  text.replace(text.find(normal), normal.size(),
               "normal = { law = \"damped\", coefficient = 1e12 }");
  std::ofstream(here() / "damped.toml") << text;
  expect_to_go_on("damped.toml");
}

TEST_F(Interrupted, AFoundationThatSlipsFarGoesOn) {
  std::ofstream(here() / "far.toml") << R"toml(
mesh.box = { min = [0, 0], max = [0.02, 0.01], cells = [12, 6], cell = "quadrilateral" }
material.library = "BaTiO3-Liu2014"
time = { end = 2, steps = 200 }
boundary = [ { on = "top", displacement = ["1e-9*sin(t)", "-1e-10*t"], temperature = 0, potential = 0 } ]
[contact]
on = "bottom"
normal = "unilateral"
gap = "1e-8*x"
foundation_displacement = ["sin(9*t)", 0]
friction = { law = "coulomb", coefficient = { static = 0.4, kinetic = 0.2, distance = 1 } }
)toml";
  for (const char *route : {"", " --set solver.body=iterative"}) {
    SCOPED_TRACE(route);
    expect_to_go_on(std::string("far.toml") + route);
    fs::remove_all(here() / "one");
    fs::remove_all(here() / "other");
  }
}

// What the contact's linear systems are preconditioned with is part of what the next bytes depend
// on.
TEST_F(Interrupted, AContactOfAThousandNodesGoesOn) {
  std::string text = weakening;
  const auto put = [&](const std::string &key, const std::string &value) {
    const std::size_t at = text.find(key + " = ");
    text.replace(at, text.find('\n', at) - at, key + " = " + value);
  };
  put("mesh.box",
      R"({ min = [0, 0], max = [0.2, 0.002], cells = [1100, 2], cell = "quadrilateral" })");
  put("gap", "\"1e-7*sin(300*x)\"");
  put("friction", "{ law = \"coulomb\", coefficient = 0.3 }");
  std::ofstream(here() / "large.toml") << text;
  expect_to_go_on("large.toml --set time.end=0.5 --set time.steps=6");
}

TEST_F(Interrupted, ARunWithCheckpointsLeavesTheBytesOfOneWithout) {
  for (const std::string often : {"never", "1steps"})
    ASSERT_EQ(run("run " + paper + " -q --set output.checkpoint=" + often + " -o " + often), 0);
  fs::copy_file(here() / "never/resolved.toml", here() / "1steps/resolved.toml",
                fs::copy_options::overwrite_existing);
  fs::remove(here() / "never/report.html");  // which names its folder
  fs::remove(here() / "1steps/report.html");
  ASSERT_EQ(files_below(here() / "never"), files_below(here() / "1steps"));
  for (const std::string &name : files_below(here() / "never"))
    if (name != "summary.json") {
      EXPECT_TRUE(content_of(here() / "never" / name) == content_of(here() / "1steps" / name))
          << name;
    }
}

class Signal : public Interrupted, public testing::WithParamInterface<int> {};

TEST_P(Signal, FinishesTheStepAndSaysHowToGoOn) {
  const auto process = start(slow + " -q -o results");
  ASSERT_TRUE(process->leaves(here() / "results/checkpoint.bin"));
  process->send(GetParam());
  EXPECT_EQ(process->wait(), 128 + GetParam());
  complained_ = content_of(folder_ / "stderr");
  EXPECT_THAT(complained_, AllOf(HasSubstr("stopped by"), HasSubstr("of 100000;"),
                                 HasSubstr("-o results --resume\n")));
  EXPECT_EQ(std::count(complained_.begin(), complained_.end(), '\n'), 1) << complained_;
  for (const char *name :
       {"history.csv", "contact.csv", "nodes.csv", "report.html", "checkpoint.bin"})
    EXPECT_TRUE(fs::exists(here() / "results" / name)) << name;
  EXPECT_FALSE(fs::exists(here() / "results" / "run.lock"));
}

INSTANTIATE_TEST_SUITE_P(Each, Signal, testing::Values(SIGINT, SIGTERM, SIGHUP));

TEST_F(Interrupted, AStoppedRunGoesOnToTheSameBytes) {
  const std::string all = "run " + paper +
                          " --set time.steps=200 --set output.every=50 "
                          "--set output.checkpoint=2steps -q -o ";
  ASSERT_EQ(run(all + "one/results"), 0) << complained_;
  const auto process = start(all + "other/results");
  ASSERT_TRUE(process->leaves(here() / "other/results/checkpoint.bin"));
  process->send(SIGTERM);
  ASSERT_EQ(process->wait(), 128 + SIGTERM);
  ASSERT_EQ(run(all + "other/results --resume"), 0) << complained_;
  expect_same_results(here() / "one/results", here() / "other/results");
}

// Step 6 is not among the hundred that are tried before.
TEST_F(Interrupted, AFailedRunSaysWhatItLeaves) {
  EXPECT_EQ(run("run " + paper +
                " --set time.steps=200 --set 'contact.friction.bound=\"if(abs(t - 0.006) < 1e-4, "
                "-1, 15)\"' -q -o "
                "results"),
            2);
  EXPECT_THAT(complained_, HasSubstr("; the results of steps 1 to 5 of 200 are in results\n"));
  EXPECT_EQ(std::count(complained_.begin(), complained_.end(), '\n'), 1) << complained_;
}

// The step takes longer than the test.
TEST_F(Interrupted, TheSecondSignalEndsItAtOnce) {
  const auto process = start(slow +
                             " --set solver.method=monolithic --set mesh.box.cells=[100,100] "
                             "--set output.checkpoint=1steps --set output.every=1 -q -o results");
  ASSERT_TRUE(process->leaves(here() / "results/checkpoint.bin"));
  process->send(SIGINT);
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  process->send(SIGINT);
  EXPECT_EQ(process->wait(), -SIGINT);
  EXPECT_TRUE(fs::exists(here() / "results/checkpoint.bin"));
}

TEST_F(Interrupted, WithoutACheckpointItStartsFromTheBeginningAndSaysSo) {
  ASSERT_EQ(run("run " + paper + " --set time.steps=2 -o results --resume"), 0);
  EXPECT_THAT(complained_, HasSubstr("no checkpoint in results; starting from the beginning"));
  EXPECT_TRUE(fs::exists(here() / "results/summary.json"));
}

}  // namespace
