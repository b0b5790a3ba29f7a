// Runs that start from the state of another one: a run cut in two is the run.

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <fstream>

#include "body/discretisation.h"
#include "equal_quantities.h"
#include "run/resumption.h"
#include "run/start_state.h"
#include "run_case.h"
#include "tourmaline/error.h"

namespace tourmaline::verified {
namespace {

// A block that is pressed and warmed, drags along a moving foundation and opens at one end, with an
// electrode behind a resistor. `begin` is the time of its own time 0.
std::string dragged(int dimension, double begin, double end, int steps) {
  const bool solid = dimension == 3;
  const std::string t = fmt::format("(t+{})", begin);
  return fmt::format(R"toml(
mesh.box = {{ min = {0}, max = {1}, cells = {2}, cell = "{8}" }}
material.library = "BaTiO3-Liu2014"
time = {{ end = {3}, steps = {4} }}
electrode = [ {{ name = "earth", on = "right", voltage = 0 }},
              {{ name = "sensor", on = "left", resistor = 1e7, capacitor = 2e-9 }} ]
[[boundary]]
on = "top"
displacement = [{5}"-2e-7*{6}*(1+10*x)"]
temperature = "3*{6}"
[contact]
on = "bottom"
normal = "unilateral"
friction = {{ law = "coulomb", coefficient = 0.3 }}
foundation_displacement = ["1e-6*sin(5*{6})", {7}0]
heat = {{ law = "exchange", coefficient = 40, foundation_temperature = 5 }}
)toml",
                     solid ? "[0, 0, 0]" : "[0, 0]", solid ? "[0.1, 0.05, 0.04]" : "[0.1, 0.05]",
                     solid ? "[4, 3, 2]" : "[8, 4]", end, steps, solid ? "0, 0, " : "0, ", t,
                     solid ? "0, " : "", solid ? "hexahedron" : "triangle");
}

std::string from(const RunCase &first, const std::string &more = "") {
  return fmt::format("[initial]\nfrom = \"{}\"\n{}", first.folder().string(), more);
}

void expect_same_end(const RunCase &cut, const RunCase &whole, double tolerance) {
  expect_equal_quantities(cut.nodes(), whole.nodes(),
                          {{"u_x", "u_y"}, {"potential"}, {"temperature"}}, tolerance);
  const Table found = cut.history(), expected = whole.history();
  for (const char *column : {"electrode_sensor_voltage", "electrode_sensor_charge",
                             "friction_dissipation", "heat_top", "elastic_energy"}) {
    const double value = expected.numbers(column).back();
    EXPECT_NEAR(found.numbers(column).back(), value, tolerance * std::abs(value)) << column;
  }
  for (const char *imbalance : {"energy_imbalance", "charge_imbalance", "heat_imbalance"})
    EXPECT_LT(largest(found, imbalance), 1e-9) << imbalance;
  EXPECT_EQ(found.numbers("stick").back(), expected.numbers("stick").back());
  EXPECT_EQ(found.numbers("open").back(), expected.numbers("open").back());
}

TEST(StartFrom, ARunCutInTwoEndsAsTheWholeOne) {
  for (const int dimension : {2, 3}) {
    SCOPED_TRACE(dimension);
    const RunCase whole = run_text(dragged(dimension, 0, 1, 10)),
                  first = run_text(dragged(dimension, 0, 0.5, 5)),
                  second = run_text(dragged(dimension, 0.5, 0.5, 5) + from(first));
    expect_same_end(second, whole, 1e-10);
  }
}

// What the state does not hold: a volume charge beside an electrode, and the far end of a
// capacitor.
TEST(StartFrom, LoadsAndSourcesGoOn) {
  const auto slab = [](double begin, double end, int steps) {
    const std::string t = fmt::format("(t+{})", begin);
    return fmt::format(R"toml(
mesh.box = {{ min = [0, 0], max = [0.1, 0.05], cells = [6, 6] }}
model.thermal = false
material.library = "PZT-5A"
time = {{ end = {}, steps = {} }}
load.charge = "1e-3*{t}"
electrode = [ {{ name = "earth", on = "bottom", voltage = 0 }},
              {{ name = "driven", on = "top", capacitor = 2e-8, resistor = 1e8, voltage = "100+50*{t}" }},
              {{ name = "open", where = "abs(y - 0.025) < 1e-6" }} ]
[[boundary]]
on = "bottom"
displacement = [0, 0]
)toml",
                       end, steps, fmt::arg("t", t));
  };
  const RunCase whole = run_text(slab(0, 1, 10)), first = run_text(slab(0, 0.5, 5)),
                second = run_text(slab(0.5, 0.5, 5) + from(first));
  expect_equal_quantities(second.nodes(), whole.nodes(), {{"u_x", "u_y"}, {"potential"}}, 1e-10);
  for (const std::string name : {"driven", "open"})
    for (const char *what : {"_voltage", "_charge", "_current"}) {
      const std::vector<double> all = whole.history().numbers("electrode_" + name + what),
                                rest = second.history().numbers("electrode_" + name + what);
      const double size = largest(whole.history(), "electrode_driven" + std::string(what));
      for (std::size_t n = 0; n < rest.size(); ++n)
        EXPECT_NEAR(rest[n], all[n + 5], 1e-10 * size) << name << what << n;
    }
  EXPECT_LT(largest(second.history(), "energy_imbalance"), 1e-10);
}

TEST(StartFrom, OnEveryRoute) {
  const RunCase whole = run_text(dragged(2, 0, 1, 10)), first = run_text(dragged(2, 0, 0.5, 5));
  const std::string second = dragged(2, 0.5, 0.5, 5) + from(first);
  expect_same_end(run_text(second, {"solver.body=\"iterative\""}), whole, 1e-7);
  const std::vector<std::string> given{
      "electrode[1]={name=\"sensor\",on=\"left\",voltage=\"2*t\"}"},
      monolithic{given[0], "solver.method=\"monolithic\""};
  const RunCase third = run_text(second, given);
  expect_same_end(run_text(second, monolithic), third, 1e-8);
}

// The other end of a capacitor is at a voltage, and charge is given in the body.
TEST(StartFrom, CapacitorsAndChargesBeginWhereTheyHadComeTo) {
  const auto sources = [](double begin) {
    return std::vector<std::string>{
        fmt::format(
            "electrode[1]={{name=\"sensor\",on=\"left\",capacitor=2e-9,voltage=\"10*(t+{})\"}}",
            begin),
        fmt::format("load.charge=\"1e-6*(t+{})\"", begin)};
  };
  const RunCase whole = run_text(dragged(2, 0, 1, 10), sources(0)),
                first = run_text(dragged(2, 0, 0.5, 5), sources(0));
  const std::string second = dragged(2, 0.5, 0.5, 5) + from(first);
  expect_same_end(run_text(second, sources(0.5)), whole, 1e-10);
  std::vector<std::string> monolithic = sources(0.5);
  monolithic.push_back("solver.method=\"monolithic\"");
  expect_same_end(run_text(second, monolithic), whole, 1e-7);
}

TEST(StartFrom, AnyStepWithFieldsWillDo) {
  const RunCase whole(casefile::read_text(dragged(2, 0, 1, 10), "case.toml", {}));
  const RunCase second = run_text(dragged(2, 0.4, 0.6, 6) + from(whole, "step = 4\n"));
  expect_same_end(second, whole, 1e-10);
}

// Fields that cells of every shape hold.
const char *const linear = R"toml(
material = { library = "BaTiO3-Liu2014", e31 = 0, e33 = 0, e15 = 0, p3 = 0, m11 = 0, m33 = 0 }
time = { end = 1, steps = 1, regime = "static" }
[[boundary]]
on = ["left", "right", "bottom", "top"]
displacement = ["1e-6*(x + 2*y)", "-1e-6*x"]
potential = "3*x - y"
)toml";

TEST(StartFrom, AnotherMeshOfTheBodyHasTheFieldInterpolated) {
  for (const char *cell : {"triangle", "quadrilateral"})
    for (const int degree : {1, 2}) {
      const auto box = [&](const char *cells, const char *shape, int p) {
        return fmt::format(
            "mesh = {{ degree = {}, box = {{ min = [0, 0], max = [0.2, 0.1], cells = {}, cell = "
            "\"{}\" }} }}\n",
            p, cells, shape);
      };
      const RunCase first = run_text(box("[4, 3]", cell, degree) + linear);
      solve::Model<2> model(casefile::read_text(box("[7, 5]", "triangle", 2) + linear + from(first),
                                                "case.toml", {}));
      const std::vector<double> state = run::start_state(model);
      for (body::Node node = 0; node < model.body.n_nodes(); ++node) {
        const Vector3 &at = model.body.points()[node];
        EXPECT_NEAR(state[4 * node], 1e-6 * (at[0] + 2 * at[1]), 1e-19);
        EXPECT_NEAR(state[4 * node + 1], -1e-6 * at[0], 1e-19);
        EXPECT_NEAR(state[4 * node + 2], 3 * at[0] - at[1], 1e-13);
      }
    }
}

// Electrodes stay at one potential, and a finer mesh goes on near where the coarse one stood.
TEST(StartFrom, AnotherMeshGoesOnWithItsElectrodes) {
  for (const int dimension : {2, 3}) {
    const std::string finer = dimension == 2 ? "mesh.box.cells=[12,6]" : "mesh.box.cells=[6,4,3]";
    const RunCase whole = run_text(dragged(dimension, 0, 1, 10), {finer}),
                  first = run_text(dragged(dimension, 0, 0.5, 5)),
                  second = run_text(dragged(dimension, 0.5, 0.5, 5) + from(first), {finer});
    const double expected = whole.history().numbers("electrode_sensor_voltage").back();
    EXPECT_NEAR(second.history().numbers("electrode_sensor_voltage").back(), expected,
                0.05 * std::abs(expected));
    EXPECT_LT(largest(second.history(), "charge_imbalance"), 1e-9);
  }
}

// What stays is its charge, not the field by which a mesh approximates that.
TEST(StartFrom, AnOpenElectrodeKeepsItsChargeOnEveryMesh) {
  const RunCase first = run_text(dragged(2, 0, 0.5, 5));
  const double charge = first.history().numbers("electrode_sensor_charge").back();
  ASSERT_NE(charge, 0);
  for (const char *other : {"mesh.degree=2", "mesh.box.cells=[12,6]",
                            "mesh.box.cell=\"quadrilateral\"", "time.steps=3"}) {
    const RunCase open = run_text(dragged(2, 0.5, 0.5, 2) + from(first),
                                  {other, "electrode[1]={name=\"sensor\",on=\"left\"}"});
    for (const double kept : open.history().numbers("electrode_sensor_charge"))
      EXPECT_NEAR(kept, charge, 1e-9 * std::abs(charge)) << other;
    for (const double current : open.history().numbers("electrode_sensor_current"))
      EXPECT_NEAR(current, 0, 1e-9 * std::abs(charge)) << other;
    EXPECT_LT(largest(open.history(), "charge_imbalance"), 1e-9) << other;
  }
}

// A body that was pressed slowly is let go: it vibrates with the energy that it had.
TEST(StartFrom, AVibrationBeginsWithWhatAPreloadHasStored) {
  const std::string bar = R"toml(
mesh.box = { min = [0, 0], max = [0.1, 0.01], cells = [20, 2] }
material = { symmetry = "isotropic", young = 1e9, poisson = 0, density = 1000 }
model = { thermal = false, electric = false, plane = "stress" }
[[boundary]]
on = "left"
displacement = [0, "free"]
[[boundary]]
on = "bottom"
displacement = ["free", 0]
)toml";
  const RunCase pressed = run_text(bar + "[[boundary]]\non = \"right\"\ntraction = [1e6, 0]\n",
                                   {"time={end=1,steps=1,regime=\"static\"}"});
  const double stored = pressed.history().numbers("elastic_energy").back();
  EXPECT_NEAR(stored, 0.5 * 1e6 * 1e6 / 1e9 * 0.1 * 0.01, 1e-9);
  const Table free =
      run_text(bar + from(pressed), {"time={end=1e-4,steps=100,regime=\"dynamic\"}"}).history();
  const std::vector<double> elastic = free.numbers("elastic_energy"),
                            kinetic = free.numbers("kinetic_energy");
  for (std::size_t i = 0; i < elastic.size(); ++i)
    EXPECT_LE(elastic[i] + kinetic[i], stored * (1 + 1e-9));
  EXPECT_GT(elastic[0] + kinetic[0], 0.99 * stored);
}

class StartFromComplaint : public ::testing::Test {
 protected:
  const RunCase first_ = run_text(dragged(2, 0, 0.5, 2));

  std::string complaint(const std::vector<std::string> &overrides,
                        const std::string &more = "") const {
    try {
      run_text(dragged(2, 0.5, 0.5, 2) + from(first_, more), overrides);
    } catch (const CaseError &error) {
      return error.what();
    }
    return "";
  }
};

TEST_F(StartFromComplaint, NamesWhatIsNotThere) {
  using ::testing::HasSubstr;
  EXPECT_THAT(complaint({"initial.from=\"nowhere\""}), HasSubstr("there is no such folder"));
  EXPECT_THAT(complaint({"initial.from=\"\""}), HasSubstr("names nothing"));
  EXPECT_THAT(complaint({"initial.from=\"/\""}), HasSubstr("holds no run"));
  EXPECT_THAT(complaint({}, "step = 1"), HasSubstr("has no fields of step 1 (result_0001.vtu)"));
  std::filesystem::remove(first_.folder() / "nodes.csv");
  EXPECT_THAT(complaint({}), HasSubstr("has no nodes.csv, as that run has not been completed"));
}

TEST_F(StartFromComplaint, SaysWhereTwoBodiesAreNotOne) {
  using ::testing::HasSubstr;
  EXPECT_THAT(complaint({"mesh.box.max=[0.1,0.06]"}), HasSubstr("does not reach ["));
  EXPECT_THAT(
      complaint({"mesh.box.max=[0.05,0.05]", "mesh.box.cells=[4,4]"}),
      HasSubstr("the body of this case does not reach [0.0625, 0] m, a place of that run's"));
  EXPECT_THAT(complaint({"mesh.box.max=[0.1,0.048]"}), HasSubstr("of this case does not reach ["));
  EXPECT_THAT(complaint({"model.plane=\"stress\""}),
              HasSubstr("model.plane = \"strain\", this one"));
  EXPECT_THAT(complaint({"material.reference_temperature=290"}), HasSubstr("differences to"));
  EXPECT_THAT(complaint({}, "potential = 3"), HasSubstr("without `from`"));
  EXPECT_THAT(complaint({"electrode[1].on=\"top\""}), HasSubstr("must have the same electrodes"));
}

// A thousandth of its length is a tenth of its thickness.
TEST(StartFrom, AThickerSheetIsAnotherBody) {
  const std::string sheet =
      std::string("mesh.box = { min = [0, 0], max = [0.1, 1e-3], cells = [10, 2] }\n") + linear;
  const RunCase first = run_text(sheet);
  EXPECT_THROW(run_text(sheet + from(first), {"mesh.box.max=[0.1,1.09e-3]"}), CaseError);
}

TEST_F(StartFromComplaint, SaysWhatFilesDoNotHold) {
  using ::testing::HasSubstr;
  EXPECT_THAT(complaint({"contact.friction.coefficient={static=0.5,kinetic=0.3,distance=1e-6}"}),
              HasSubstr("weakens with the accumulated slip"));
  EXPECT_THAT(
      complaint({"contact.electric={law=\"leak\",coefficient=1e-9,foundation_potential=0}"}),
      HasSubstr("through which charge leaks"));
  EXPECT_THAT(complaint({"time.regime=\"static\"", "contact.heat=\"insulated\"",
                         "electrode[1]={name=\"sensor\",on=\"left\"}"}),
              HasSubstr("take time.regime = \"quasistatic\""));
}

TEST_F(StartFromComplaint, SaysWhereChargesWouldJump) {
  using ::testing::HasSubstr;
  const std::string sensor = "electrode[1]={name=\"sensor\",on=\"left\",capacitor=2e-9,voltage=";
  EXPECT_THAT(complaint({sensor + "\"7+t\"}"}),
              HasSubstr("was at 0 V in that run, and is at 7 V here at t = 0"));
  EXPECT_EQ(complaint({sensor + "\"7*(t > 0)\"}"}), "");
  EXPECT_THAT(complaint({"load.charge=1e-6"}), HasSubstr("\"sensor\" had the charge"));
  EXPECT_THAT(complaint({"material.beta11=2e-8"}), HasSubstr("\"sensor\" had the charge"));
  EXPECT_EQ(complaint({"load.charge=\"1e-6*(t > 0)\""}), "");
}

// It has a nodes.csv, of the step at which it was stopped.
TEST_F(StartFromComplaint, ARunThatWasStoppedIsNotTakenForItsEnd) {
  std::ofstream(first_.folder() / "unfinished.txt") << "stopped by SIGTERM after step 1 of 2\n";
  EXPECT_THAT(complaint({}),
              ::testing::HasSubstr("has not been completed (stopped by SIGTERM after "
                                   "step 1 of 2); let it end with --resume"));
}

TEST_F(StartFromComplaint, FieldFilesWithoutAFieldAreRefused) {
  const RunCase whole(casefile::read_text(dragged(2, 0, 0.5, 2), "case.toml", {}));
  const auto file = whole.folder() / "result_0001.vtu";
  std::string text = [&] {
    std::ifstream in(file);
    return std::string{std::istreambuf_iterator<char>(in), {}};
  }();
  const std::string name = "Name=\"displacement\"";
  text.replace(text.find(name), name.size(), "Name=\"deformation\"");
  std::ofstream(file) << text;
  EXPECT_THAT(complaint({"initial.from=\"" + whole.folder().string() + "\""}, "step = 1"),
              ::testing::HasSubstr("has no array displacement with 3 components"));
}

TEST_F(StartFromComplaint, DamagedTablesAreRefused) {
  const auto file = first_.folder() / "nodes.csv";
  std::ofstream(file) << "x,y,u_x,u_y,potential,temperature\n0,0,nan,0,0,0\n";
  EXPECT_THAT(complaint({}), ::testing::HasSubstr("holds what is no number"));
  std::ofstream(file) << "x,u_x\n0,0\n";
  EXPECT_THAT(complaint({}), ::testing::HasSubstr("has no column y"));
}

TEST_F(StartFromComplaint, ItsOwnFolderIsNoStart) {
  const casefile::Case asked =
      casefile::read_text(dragged(2, 0.5, 0.5, 2) + from(first_), "case.toml", {});
  EXPECT_THROW(run::simulate(asked, first_.folder(), {.quiet = true}), CaseError);
  EXPECT_TRUE(std::filesystem::exists(first_.folder() / "nodes.csv"));
}

TEST_F(StartFromComplaint, ARunThatGoesOnKnowsTheFilesItBeganWith) {
  const casefile::Case asked =
      casefile::read_text(dragged(2, 0.5, 0.5, 2) + from(first_), "case.toml", {});
  const auto before = run::contents_of(asked);
  EXPECT_THAT(before, ::testing::Contains(::testing::Key(::testing::EndsWith("nodes.csv"))));
  std::ofstream(first_.folder() / "nodes.csv", std::ios::app) << "\n";
  EXPECT_NE(run::contents_of(asked), before);
}

}  // namespace
}  // namespace tourmaline::verified
