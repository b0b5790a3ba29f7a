// What goes through boundaries is what acts on them, and together what the balances say.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "run_case.h"

namespace tourmaline::verified {
namespace {

Table probe(const RunCase &run, const std::string &name) {
  return read_table(run.folder() / ("probe-" + name + ".csv"));
}

// One probe for each boundary, of its name.
std::string probes_of(const std::vector<std::string> &boundaries) {
  std::string text = "probe=[";
  for (const std::string &name : boundaries)
    text += "{name='" + name + "', on='" + name + "'},";
  return text + "]";
}

std::vector<double> sum(const RunCase &run, const std::vector<std::string> &boundaries,
                        const std::string &column) {
  std::vector<double> total;
  for (const std::string &name : boundaries) {
    const std::vector<double> values = probe(run, name).numbers(column);
    total.resize(values.size(), 0.);
    for (std::size_t i = 0; i < values.size(); ++i)
      total[i] += values[i];
  }
  return total;
}

double size(const RunCase &run, const std::vector<std::string> &boundaries,
            const std::string &column) {
  double most = 0;
  for (const std::string &name : boundaries)
    most = std::max(most, largest(probe(run, name), column));
  return most;
}

void expect_near(const std::vector<double> &found, const std::vector<double> &wanted,
                 double tolerance, const std::string &what = "") {
  ASSERT_EQ(found.size(), wanted.size()) << what;
  for (std::size_t i = 0; i < found.size(); ++i)
    EXPECT_NEAR(found[i], wanted[i], tolerance) << what << " in row " << i;
}

std::vector<double> minus(std::vector<double> values) {
  for (double &value : values)
    value = -value;
  return values;
}

const std::vector<std::string> square{"left", "right", "bottom", "top"};
const std::vector<std::string> cube{"left", "right", "front", "back", "bottom", "top"};

// Clamped, loaded, in contact and held at a corner that three of these share; a volume force, too.
const std::string block = R"(
material.library = "BaTiO3-Liu2014"
time = { end = 0.2, steps = 2 }
boundary = [ { on = "right", displacement = [0, 0], potential = 0, temperature = 0 },
             { on = "bottom", displacement = ["free", 0], temperature = 1 },
             { on = "top", traction = ["30*t", "-500*t*x"], surface_charge = "1e-9*x", heat_flux = "2 - 10*t" } ]
contact.on = "left"
contact.friction = { law = "tresca", bound = 1 }
contact.heat = { law = "exchange", coefficient = "1 + 10*y", foundation_temperature = "-27 + 100*y*t" }
load = { force = [100, "300*t"], charge = 1e-7, heat = 5 }
)";

class BoundaryProbes : public ::testing::TestWithParam<std::pair<const char *, int>> {
 protected:
  static RunCase run_block() {
    const auto [cell, degree] = GetParam();
    return run_text("mesh = { degree = " + std::to_string(degree) +
                        ", box = { min = [0, 0], max = [0.2, 0.1], cells = [8, 6], cell = \"" +
                        cell + "\" } }" + block,
                    {probes_of(square)});
  }
};

// What is warmed between held faces needs reactions of 5e3 N/m, whose round-off this is.
TEST_P(BoundaryProbes, AllTogetherBalanceTheVolume) {
  const RunCase run = run_block();
  const double volume = 0.02, round_off = 1e-12 * 5e3;
  expect_near(sum(run, square, "force_x"), {-100 * volume, -100 * volume}, round_off);
  expect_near(sum(run, square, "force_y"), {-30 * volume, -60 * volume}, round_off);
  // Of a force that is uniform about the centre of the body (0.1, 0.05).
  expect_near(sum(run, square, "moment_z"),
              {-0.1 * 30 * volume + 0.05 * 100 * volume, -0.1 * 60 * volume + 0.05 * 100 * volume},
              0.1 * round_off);
  expect_near(sum(run, square, "charge"), {1e-7 * volume, 1e-7 * volume}, 1e-10 * 1e-7 * volume);
  const Table history = run.history();
  std::vector<double> lost = history.numbers("heat_source");
  for (std::size_t i = 0; i < lost.size(); ++i)
    lost[i] -= history.numbers("stored_heat_rate")[i];
  expect_near(sum(run, square, "heat"), lost, 1e-10 * size(run, square, "heat"));
}

TEST_P(BoundaryProbes, HaveTheChargesAndHeatsOfTheHistory) {
  const RunCase run = run_block();
  const Table history = run.history();
  for (const std::string &name : square)
    expect_near(probe(run, name).numbers("heat"), history.numbers("heat_" + name),
                1e-12 * size(run, square, "heat"), name);
  for (const std::string name : {"right", "top"})
    expect_near(probe(run, name).numbers("charge"), history.numbers("charge_" + name),
                1e-12 * size(run, square, "charge"), name);
}

TEST_P(BoundaryProbes, OfAFreeBoundaryHaveWhatIsAppliedToIt) {
  const RunCase run = run_block();
  const Table top = probe(run, "top");
  for (std::size_t i = 0; i < 2; ++i) {
    const double t = 0.1 * static_cast<double>(i + 1);
    EXPECT_NEAR(top.numbers("force_x")[i], 30 * t * 0.2, 1e-13);
    EXPECT_NEAR(top.numbers("force_y")[i], -500 * t * 0.02, 1e-13);
    EXPECT_NEAR(top.numbers("moment_z")[i], -500 * t * 0.008 / 3 - 0.1 * 30 * t * 0.2, 1e-13);
    EXPECT_NEAR(top.numbers("charge")[i], 1e-9 * 0.02, 1e-24);
    EXPECT_NEAR(top.numbers("heat")[i], (2 - 10 * t) * 0.2, 1e-13);
    EXPECT_NEAR(top.numbers("area")[i], 0.2, 1e-15);
  }
}

TEST_P(BoundaryProbes, OfAContactHaveItsForces) {
  const RunCase run = run_block();
  const Table history = run.history(), left = probe(run, "left");
  for (const std::string axis : {"x", "y"})
    expect_near(left.numbers("force_" + axis), history.numbers("contact_force_" + axis),
                1e-13 * size(run, square, "force_y"));
}

INSTANTIATE_TEST_SUITE_P(Cells, BoundaryProbes,
                         ::testing::Values(std::pair{"triangle", 1}, std::pair{"quadrilateral", 1},
                                           std::pair{"triangle", 2},
                                           std::pair{"quadrilateral", 2}));

// In the monolithic route, with friction that follows the pressure, in motion.
TEST(BoundaryProbes, OnOtherRoutesAreTheSameAndBalanceInertiaToo) {
  const std::string asked = "mesh.box = { min = [0, 0], max = [0.2, 0.1], cells = [8, 6] }" + block;
  const RunCase condensed = run_text(asked, {probes_of(square)}),
                monolithic = run_text(asked, {probes_of(square), "solver.method=monolithic"});
  for (const std::string &name : square)
    for (const char *column : {"force_x", "force_y", "moment_z", "charge", "heat"})
      expect_near(probe(monolithic, name).numbers(column), probe(condensed, name).numbers(column),
                  1e-9 * size(condensed, square, column), name);
  const RunCase moving = run_text(
      asked, {probes_of(square), "time.regime=dynamic", "time.end=1e-4",
              "contact.normal=unilateral", "contact.friction={law='coulomb',coefficient=0.3}"});
  std::vector<double> wanted = moving.history().numbers("inertia_x");
  for (double &inertia : wanted)
    inertia = -inertia - 100 * 0.02;
  expect_near(sum(moving, square, "force_x"), wanted, 1e-9 * size(moving, square, "force_x"));
}

TEST(AProbeOnElectrodes, HasTheirChargeWithTheSignOfDNu) {
  const RunCase run = run_text(R"toml(
mesh.box = { min = [0, 0], max = [0.04, 0.02], cells = [8, 5] }
material.library = "BaTiO3-Liu2014"
time = { end = 0.2, steps = 4 }
boundary = [ { on = "right", displacement = [0, 0], temperature = 0 },
             { on = "left", traction = ["30*t", "-2000*t"] } ]
electrode = [ { name = "top", on = "bottom", voltage = "0.02*sin(20*t)" },
              { name = "sensor", on = ["top", "left"], resistor = 1e7, capacitor = 2e-8 } ]
probe = [ { name = "drive", on = "bottom" }, { name = "sensor", on = ["top", "left"] },
          { name = "part", on = "top" }, { name = "rest", on = "left" } ]
)toml");
  const Table history = run.history();
  const double tolerance = 1e-13 * largest(history, "electrode_top_charge");
  expect_near(probe(run, "drive").numbers("charge"), minus(history.numbers("electrode_top_charge")),
              tolerance);
  expect_near(probe(run, "sensor").numbers("charge"),
              minus(history.numbers("electrode_sensor_charge")), tolerance);
  expect_near(sum(run, {"part", "rest"}, "charge"),
              minus(history.numbers("electrode_sensor_charge")), tolerance);
  EXPECT_GT(largest(probe(run, "rest"), "charge"), 0);
}

// A cube under its own weight on two springy faces.
TEST(BoundaryProbes, OfASolidBalanceItsWeightAndTheMomentOfIt) {
  for (const char *cell : {"tetrahedron", "hexahedron"})
    for (const int degree : {1, 2}) {
      const RunCase run = run_text(
          "mesh = { degree = " + std::to_string(degree) +
              ", box = { min = [0, 0, 0], max = [0.1, 0.2, 0.3], cells = [2, 3, 3], cell = \"" +
              cell + R"toml(" } }
material.library = "BaTiO3-Liu2014"
time = { end = 1, steps = 1, regime = "static" }
boundary = [ { on = "bottom", displacement = ["free", 0, 0], potential = 0, temperature = 0 },
             { on = "left", displacement = [0, "free", "free"] },
             { on = "top", traction = [0, "1e3*x", "-2e3*y"] } ]
load.force = [0, 0, -7e4]
)toml",
          {probes_of(cube)});
      const double weight = 7e4 * 0.006, top_y = 1e3 * 0.05 * 0.02, top_z = -2e3 * 0.1 * 0.02;
      expect_near(sum(run, cube, "force_z"), {weight}, 1e-10 * weight);
      expect_near(sum(run, cube, "force_x"), {0}, 1e-10 * weight);
      expect_near(sum(run, cube, "moment_x"), {0.1 * weight}, 1e-10 * weight);
      expect_near(sum(run, cube, "moment_y"), {-0.05 * weight}, 1e-10 * weight);
      expect_near(sum(run, cube, "moment_z"), {0}, 1e-10 * weight);
      expect_near(probe(run, "top").numbers("force_y"), {top_y}, 1e-12);
      expect_near(probe(run, "top").numbers("force_z"), {top_z}, 1e-12);
      expect_near(probe(run, "top").numbers("moment_x"), {-2e3 * 0.1 * 0.008 / 3 - 0.3 * top_y},
                  1e-12);
    }
}

TEST(AProbeOnABoundary, TakesTheMomentAboutThePlaceThatItSays) {
  const RunCase run = run_text(R"toml(
mesh.box = { min = [0, 0], max = [0.2, 0.1], cells = [4, 2] }
material.library = "BaTiO3-Liu2014"
time = { end = 1, steps = 1 }
boundary = [ { on = "left", displacement = [0, 0], potential = 0 },
             { on = "right", traction = [0, -50] } ]
probe = [ { name = "origin", on = "left" }, { name = "end", on = "left", about = [0.2, 0.05] } ]
)toml");
  const double force = 50 * 0.1;
  EXPECT_NEAR(probe(run, "origin").numbers("force_y")[0], force, 1e-10);
  EXPECT_NEAR(probe(run, "origin").numbers("moment_z")[0], 0.2 * force, 1e-11);
  EXPECT_NEAR(probe(run, "end").numbers("moment_z")[0], 0, 1e-11);
}

// The condition stands on "clamp", whose parts have names of their own.
TEST(AProbeOnAPartOfABoundary, HasItsShareOfWhatTheWholeHas) {
  const output::TemporaryFolder folder;
  std::ofstream(folder / "square.geo") << R"(
Point(1) = {0, 0, 0}; Point(2) = {0.1, 0, 0}; Point(3) = {0.1, 0.04, 0}; Point(4) = {0.1, 0.1, 0};
Point(5) = {0, 0.1, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 5}; Line(5) = {5, 1};
Curve Loop(1) = {1, 2, 3, 4, 5}; Plane Surface(1) = {1};
Physical Curve("clamp") = {2, 3}; Physical Curve("lower") = {2}; Physical Curve("upper") = {3};
Physical Curve("pull") = {5}; Physical Curve("others") = {1, 4};
Physical Surface("body") = {1};
)";
  const RunCase run =
      run_text(R"toml(
mesh = { file = "square.geo", size = 0.02 }
material.library = "BaTiO3-Liu2014"
time = { end = 1, steps = 1 }
boundary = [ { on = "clamp", displacement = [0, 0], potential = 0, temperature = 0 },
             { on = "pull", traction = [-30, 20], heat_flux = -5, surface_charge = 1e-9 } ]
)toml",
               {probes_of({"clamp", "lower", "upper", "pull", "others"})}, folder.path());
  for (const char *column : {"force_x", "force_y", "moment_z", "charge", "heat", "area"}) {
    const double tolerance = 1e-12 * size(run, {"clamp", "pull"}, column);
    expect_near(sum(run, {"lower", "upper"}, column), probe(run, "clamp").numbers(column),
                tolerance, column);
    if (std::string(column) != "area")
      expect_near(probe(run, "others").numbers(column), {0}, tolerance, column);
  }
  EXPECT_NEAR(probe(run, "clamp").numbers("force_x")[0], 3, 1e-10);
  EXPECT_NEAR(probe(run, "lower").numbers("area")[0], 0.04, 1e-15);
  EXPECT_GT(probe(run, "lower").numbers("force_x")[0], 0.5);
}

}  // namespace
}  // namespace tourmaline::verified
