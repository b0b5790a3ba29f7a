// The same case on one rank and on several: the same numbers, and one message where it fails.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <future>
#include <iterator>
#include <map>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "../cases/partly_held.h"
#include "../cases/read_table.h"
#include "../output/decode_vtk.h"
#include "../output/temporary_folder.h"
#include "report/field_file.h"

namespace tourmaline::testing {
namespace {

using output::content_of;
using ::testing::HasSubstr;
namespace fs = std::filesystem;

struct Outcome {
  int status;
  std::string said;
};

std::string program() {
  const char *given = std::getenv("TOURMALINE_BINARY");
  return given ? given : TOURMALINE_BINARY;
}

// Runs the program as a user would; more ranks than cores are allowed.
Outcome run(int ranks, const std::string &arguments, const fs::path &folder) {
  const fs::path said = folder.string() + ".stderr";
  const std::string launcher =
      ranks == 1 ? "" : "mpirun --oversubscribe --bind-to none -np " + std::to_string(ranks) + " ";
  const int status = std::system((launcher + program() + " run " + arguments + " -q -o '" +
                                  folder.string() + "' > /dev/null 2> '" + said.string() + "'")
                                     .c_str());
  return {WEXITSTATUS(status), content_of(said)};
}

void expect_equal_tables(const Table &one, const Table &several) {
  ASSERT_FALSE(one.columns.empty());
  for (const auto &[name, values] : one.columns) {
    SCOPED_TRACE(name);
    ASSERT_TRUE(several.columns.contains(name));
    ASSERT_EQ(several.n_rows(), one.n_rows());
    if (name == "status" || name == "contact")
      EXPECT_EQ(several.columns.at(name), values);
    else
      EXPECT_LE(difference(several, one, name), 1e-9);
  }
}

/// Columns that are measured by the largest of them: a component may be nothing but round-off.
using Quantity = std::vector<std::string>;

void expect_equal_quantities(const Table &one, const Table &several,
                             const std::vector<Quantity> &quantities, double tolerance) {
  ASSERT_EQ(several.n_rows(), one.n_rows());
  for (const Quantity &quantity : quantities) {
    double size = 0;
    for (const std::string &name : quantity)
      size = std::max(size, largest(one, name));
    EXPECT_GT(size, 0) << quantity.front();
    for (const std::string &name : quantity)
      EXPECT_LE(difference(several, one, name, size), tolerance) << name;
  }
}

// A block of tetrahedra whose contact slips in different directions.
const char *const block = R"toml(
[mesh]
box = { min = [0, 0, 0], max = [0.1, 0.1, 0.1], cells = [5, 5, 5], cell = "tetrahedron" }
[material]
library = "BaTiO3-Liu2014"
pyroelectric = [0, 0, 1e-4]
[time]
end = 0.2
steps = 4
[[boundary]]
on = "right"
displacement = [0, 0, 0]
potential = "1e-3*t"
temperature = 0
[[boundary]]
on = "top"
traction = [0, "-3*t*(1+x*10)", "-50*t*y"]
[contact]
on = "left"
friction = { law = "tresca", bound = 0.05 }
heat = { law = "exchange", coefficient = 1, foundation_temperature = -27 }
)toml";

// A dielectric between two ceramic layers poled against each other, one electrode in a circuit.
const char *const laminate = R"toml(
mesh.box = { min = [0, 0], max = [0.04, 0.02], cells = [16, 9] }
time = { end = 0.2, steps = 4 }
boundary = [ { on = "right", displacement = [0, 0], temperature = 0 },
             { on = "top", traction = ["30*t", "-2000*t"] } ]
electrode = [ { name = "drive", on = "bottom", voltage = "0.02*sin(20*t)" },
              { name = "sensor", on = "top", resistor = 1e7, capacitor = 2e-8 } ]
contact = { on = "left", friction = { law = "tresca", bound = 200 } }
[[region]]
where = "y < 0.008"
material.library = "BaTiO3-Liu2014"
[[region]]
where = "y >= 0.008 && y < 0.012"
material = { symmetry = "isotropic", young = 200e9, poisson = 0.3, eps11 = 100, k11 = 50, density = 7800, specific_heat = 500, reference_temperature = 293 }
[[region]]
where = "y >= 0.012"
material = { library = "BaTiO3-Liu2014", poling = [0, -1] }
)toml";

// A warmed block of BaTiO3 that a foundation rubs, as it moves along, and leaves.
const char *const rubbed = R"toml(
mesh.box = { min = [0, 0], max = [0.02, 0.01], cells = [12, 6], cell = "quadrilateral" }
material = { library = "BaTiO3-Liu2014", pyroelectric = [0, 1e-4] }
time = { end = 1, steps = 4 }
boundary = [ { on = "top", displacement = ["2e-7*t", "-5e-7*t"], potential = 0, temperature = "2*t" } ]
[contact]
on = "bottom"
gap = "3e-3*(x - 0.008)^2"
foundation_displacement = ["5e-7*sin(4*t)", 0]
normal = "unilateral"
friction = { law = "coulomb", coefficient = { static = 0.35, kinetic = 0.3, distance = 1e-6 } }
heat = { law = "exchange", coefficient = 2e4, foundation_temperature = "20*t" }
)toml";

const char *const rubbed_block = R"toml(
mesh.box = { min = [0, 0, 0], max = [0.02, 0.02, 0.01], cells = [6, 5, 3], cell = "hexahedron" }
material = { library = "BaTiO3-Liu2014", pyroelectric = [0, 0, 1e-4] }
time = { end = 1, steps = 4 }
boundary = [ { on = "top", displacement = ["2e-7*t", "3e-7*t^2", "-5e-7*t"], potential = 0, temperature = "2*t" } ]
[contact]
on = "bottom"
gap = "3e-3*((x - 0.008)^2 + (y - 0.011)^2)"
foundation_displacement = ["5e-7*sin(4*t)", "1e-5*x*t", 0]
normal = "unilateral"
friction = { law = "coulomb", coefficient = 0.3 }
heat = { law = "exchange", coefficient = 2e4, foundation_temperature = "20*t" }
)toml";

int count(const std::string &text, const std::string &piece) {
  int found = 0;
  for (std::size_t at = text.find(piece); at != std::string::npos; at = text.find(piece, at + 1))
    ++found;
  return found;
}

class Ranks : public ::testing::TestWithParam<int> {
 protected:
  std::string file_of(const std::string &text) const {
    std::ofstream(folder_ / "case.toml") << text;
    return folder_ / "case.toml";
  }

  // Runs the case on one rank and on several, into folder_ / "one" and folder_ / "several".
  void run_twice(const std::string &arguments) const {
    const Outcome one = run(1, arguments, folder_ / "one");
    ASSERT_EQ(one.status, 0) << one.said;
    const Outcome several = run(GetParam(), arguments, folder_ / "several");
    ASSERT_EQ(several.status, 0) << several.said;
  }
  Table table_of_one(const std::string &name) const { return read_table(folder_ / "one" / name); }
  Table table_of_several(const std::string &name) const {
    return read_table(folder_ / "several" / name);
  }

  void expect_same(const std::string &arguments) const {
    ASSERT_NO_FATAL_FAILURE(run_twice(arguments));
    for (const char *name : {"nodes.csv", "contact.csv"})
      expect_equal_tables(table_of_one(name), table_of_several(name));
  }

  // Contact that opens, sticks and slips, of so many dimensions.
  void expect_same_rubbing(const std::string &arguments, int dim) const {
    ASSERT_NO_FATAL_FAILURE(run_twice(arguments));
    Quantity u, traction{"normal_traction", "friction_bound"}, slip{"normal_displacement", "gap"};
    for (int c = 0; c < dim; ++c) {
      u.push_back(std::string("u_") + "xyz"[c]);
      traction.push_back(std::string("tangential_traction_") + "xyz"[c]);
      slip.push_back(std::string("slip_") + "xyz"[c]);
    }
    expect_equal_quantities(table_of_one("nodes.csv"), table_of_several("nodes.csv"),
                            {u, {"potential"}, {"temperature"}}, 1e-9);
    const Table contact = table_of_one("contact.csv"), same = table_of_several("contact.csv");
    if (contact.columns.contains("accumulated_slip"))
      slip.push_back("accumulated_slip");
    expect_equal_quantities(contact, same,
                            {traction, slip, {"slip_rate"}, {"potential"}, {"heat_flux"}}, 1e-9);
    EXPECT_EQ(same.columns.at("status"), contact.columns.at("status"));
    for (const char *status : {"stick", "slip", "open"})
      EXPECT_NE(std::count(contact.columns.at("status").begin(), contact.columns.at("status").end(),
                           status),
                0)
          << status;
    expect_equal_quantities(table_of_one("history.csv"), table_of_several("history.csv"),
                            {{"friction_dissipation"}, {"foundation_power"}, {"contact_stage"}},
                            1e-9);
  }

  // A plane device that slips somewhere, between two electrodes.
  void expect_same_device(const std::string &arguments, const std::string &one_electrode,
                          const std::string &other_electrode, double tolerance = 1e-9) const {
    ASSERT_NO_FATAL_FAILURE(run_twice(arguments));
    expect_equal_quantities(table_of_one("nodes.csv"), table_of_several("nodes.csv"),
                            {{"u_x", "u_y"}, {"potential"}, {"temperature"}}, tolerance);
    const Table contact = table_of_one("contact.csv"), same = table_of_several("contact.csv");
    expect_equal_quantities(contact, same,
                            {{"normal_traction", "tangential_traction_x", "tangential_traction_y"},
                             {"slip_x", "slip_y"}},
                            tolerance);
    EXPECT_EQ(same.columns.at("status"), contact.columns.at("status"));
    std::vector<Quantity> electric;
    for (const char *quantity : {"_voltage", "_charge", "_current"})
      electric.push_back(
          {"electrode_" + one_electrode + quantity, "electrode_" + other_electrode + quantity});
    expect_equal_quantities(table_of_one("history.csv"), table_of_several("history.csv"), electric,
                            tolerance);
  }

  void expect_told_once(const std::string &arguments, int status, const std::string &piece) const {
    const Outcome outcome = run(GetParam(), arguments, folder_ / "several");
    EXPECT_EQ(outcome.status, status);
    EXPECT_EQ(count(outcome.said, "tourmaline: "), 1) << outcome.said;
    EXPECT_THAT(outcome.said, HasSubstr(piece));
  }

  const output::TemporaryFolder folder_;
  const std::string paper_ = std::string(TOURMALINE_SOURCE_DIR) +
                             "/cases/ouafik-2020/conductive.toml --set mesh.box.cells=[16,16] ";
  // Coarse, with electrodes instead of its prescribed potentials.
  const std::string bimorph_ = std::string(TOURMALINE_SOURCE_DIR) +
                               "/cases/devices/bimorph.toml --set mesh.size=5e-4 --set time.steps=2"
                               " --set 'boundary[2]={on=\"lower face\",temperature=0}'"
                               " --set 'boundary[3]={on=\"upper face\",temperature=0}'"
                               " --set 'electrode=[{name=\"lower\",on=\"lower face\",voltage=0},"
                               "{name=\"upper\",on=\"upper face\",voltage=\"50*t\",resistor=1e6}]'";
};

TEST_P(Ranks, ThePaperSExampleIsTheSame) {
  expect_same(paper_);
}

TEST_P(Ranks, SeveralContactsOfDifferentLawsAreTheSame) {
  const std::string clamped =
      std::string(TOURMALINE_SOURCE_DIR) + "/cases/clamped-block/block.toml --set time.steps=4 ";
  for (const std::string method : {"condensed", "monolithic"}) {
    SCOPED_TRACE(method);
    ASSERT_NO_FATAL_FAILURE(run_twice(clamped + "--set solver.method=" + method));
    expect_equal_quantities(table_of_one("nodes.csv"), table_of_several("nodes.csv"),
                            {{"u_x", "u_y"}, {"potential"}, {"temperature"}}, 1e-9);
    const Table contact = table_of_one("contact.csv"), same = table_of_several("contact.csv");
    expect_equal_quantities(
        contact, same,
        {{"normal_traction", "tangential_traction_y", "friction_bound"}, {"slip_y"}, {"heat_flux"}},
        1e-9);
    for (const char *column : {"status", "contact"})
      EXPECT_EQ(same.columns.at(column), contact.columns.at(column));
    expect_equal_quantities(table_of_one("history.csv"), table_of_several("history.csv"),
                            {{"contact_force_x_wall", "contact_force_x_jaw"},
                             {"contact_moment_z_wall", "contact_moment_z_jaw"},
                             {"contact_heat_wall", "contact_heat_jaw"},
                             {"slip_wall", "slip_jaw"}},
                            1e-9);
  }
}

// On every rank the same contact has a node at the edge.
TEST_P(Ranks, ContactsThatMeetAtAnEdgeAreTheSame) {
  const std::string met = file_of(std::string(block) + R"toml(
[[contact]]
on = "bottom"
friction = { law = "tresca", bound = 0.1 }
[[contact]]
on = "back"
)toml");
  std::string text = output::content_of(met);
  const std::string alone = "[contact]";
  text.replace(text.find(alone), alone.size(), "[[contact]]");
  std::ofstream(met) << text;
  for (const std::string body : {"direct", "iterative"}) {
    SCOPED_TRACE(body);
    expect_same(met + " --set solver.body=" + body);
  }
}

TEST_P(Ranks, TheMonolithicRouteIsTheSame) {
  expect_same(paper_ + "--set 'solver.method=\"monolithic\"' --set time.steps=4");
}

TEST_P(Ranks, QuadraticElementsAreTheSame) {
  expect_same(paper_ + "--set mesh.degree=2 --set 'mesh.box.cell=\"quadrilateral\"'");
}

TEST_P(Ranks, ABlockOfTetrahedraIsTheSame) {
  expect_same(file_of(block));
}

TEST_P(Ranks, ABlockOfHexahedraIsTheSame) {
  expect_same(file_of(block) + " --set 'mesh.box.cell=\"hexahedron\"'");
}

TEST_P(Ranks, ABlockBetweenPlanesOfSymmetryIsTheSame) {
  expect_same(file_of(quarter_block));
}

TEST_P(Ranks, ARubbedBodyThatComesOffIsTheSame) {
  expect_same_rubbing(file_of(rubbed), 2);
}

TEST_P(Ranks, ARubbedBlockThatComesOffIsTheSame) {
  expect_same_rubbing(file_of(rubbed_block), 3);
}

const char *const iteratively = " --set solver.body=iterative --set solver.linear_tolerance=1e-13";

TEST_P(Ranks, ARubbedBodyThatComesOffIsTheSameIteratively) {
  expect_same_rubbing(file_of(rubbed) + iteratively, 2);
}

TEST_P(Ranks, ARubbedBlockThatComesOffIsTheSameIteratively) {
  expect_same_rubbing(file_of(rubbed_block) + iteratively, 3);
}

TEST_P(Ranks, ABodyThatItsContactLetsGoIsToldOnce) {
  expect_told_once(
      file_of(rubbed) + " --set 'boundary=[{on=\"top\",traction=[0,1e5],potential=0}]'", 3,
      "nothing keeps the body from");
}

// Both stop at a residual of 1e-13, on different ways.
TEST_P(Ranks, ABlockBetweenPlanesOfSymmetryIsTheSameIteratively) {
  ASSERT_NO_FATAL_FAILURE(run_twice(
      file_of(quarter_block) + " --set solver.body=iterative --set solver.linear_tolerance=1e-13"));
  expect_equal_quantities(table_of_one("nodes.csv"), table_of_several("nodes.csv"),
                          {{"u_x", "u_y", "u_z"}, {"potential"}, {"temperature"}}, 1e-9);
  const Table contact = table_of_one("contact.csv"), same = table_of_several("contact.csv");
  expect_equal_quantities(
      contact, same,
      {{"normal_traction", "tangential_traction_x", "tangential_traction_y"}, {"slip_x", "slip_y"}},
      1e-9);
  EXPECT_EQ(same.columns.at("status"), contact.columns.at("status"));
}

TEST_P(Ranks, LoadsThatDependOnPlaceAndTimeAreTheSame) {
  expect_same(file_of(block) +
              " --set 'load.force=[\"1e3*x*t\",\"1e3*y*t*t\",0]' --set 'load.heat=\"1e2*z*t\"'"
              " --set 'contact.heat.coefficient=\"1+10*y\"'");
}

TEST_P(Ranks, LayersGivenByFormulasAndAnElectrodeInACircuitAreTheSame) {
  expect_same_device(file_of(laminate), "drive", "sensor");
}

// A conductor is a dielectric of a millionfold permittivity. Seen: 1.4e-9 in the current, where the
// dielectric has 7e-14.
TEST_P(Ranks, AConductorBetweenLayersCostsTheDigitsOfItsPermittivityAndNoMore) {
  expect_same_device(file_of(laminate) +
                         " --set 'region[1]={where=\"y >= 0.008 && y < 0.012\","
                         "material={library=\"steel\"}}'",
                     "drive", "sensor", 1e6 * 1e-14);
}

TEST_P(Ranks, RegionsOfAMeshFileAndElectrodesOnItsCurvesAreTheSame) {
  expect_same_device(bimorph_, "lower", "upper");
}

TEST_P(Ranks, EveryRankLeavesItsCellsAndOneFileJoinsThem) {
  ASSERT_EQ(run(GetParam(), paper_ + "--set time.steps=1", folder_ / "several").status, 0);
  const std::string joined = content_of(folder_ / "several" / "result_0001.pvtu");
  for (int rank = 0; rank < GetParam(); ++rank) {
    const std::string piece = "result_0001_" + std::to_string(rank) + ".vtu";
    EXPECT_THAT(joined, HasSubstr("Source=\"" + piece + "\""));
    EXPECT_TRUE(fs::exists(folder_ / "several" / piece));
  }
  EXPECT_THAT(content_of(folder_ / "several" / "result.pvd"), HasSubstr("result_0001.pvtu"));
}

TEST_P(Ranks, TheContactIsOneFileWithTheFacetsOfAllRanks) {
  const std::string opening =
      std::string("'") + TOURMALINE_SOURCE_DIR +
      "/tests/reference/contact_laws/cases/coulomb-warmed.toml' --set output.fields=true "
      "--set time.steps=2 ";
  ASSERT_EQ(run(1, opening, folder_ / "one").status, 0);
  ASSERT_EQ(run(GetParam(), opening, folder_ / "several").status, 0);
  EXPECT_EQ(content_of(folder_ / "several" / "contact.pvd"),
            content_of(folder_ / "one" / "contact.pvd"));
  const std::string one = content_of(folder_ / "one" / "contact_0002.vtu"),
                    several = content_of(folder_ / "several" / "contact_0002.vtu");
  EXPECT_EQ(output::array_in<std::int64_t>(several, "connectivity"),
            output::array_in<std::int64_t>(one, "connectivity"));
  EXPECT_EQ(output::array_in<std::uint8_t>(several, "status"),
            output::array_in<std::uint8_t>(one, "status"));
  for (const char *name : {"Points", "normal_traction", "slip", "friction_bound"}) {
    const auto wanted = output::array_in<double>(one, name);
    const auto found = output::array_in<double>(several, name);
    ASSERT_EQ(found.size(), wanted.size()) << name;
    for (std::size_t i = 0; i < wanted.size(); ++i)
      EXPECT_NEAR(found[i], wanted[i], 1e-9 * largest(wanted)) << name;
  }
}

TEST_P(Ranks, AWrongCaseIsToldOnce) {
  expect_told_once(paper_ + "--set time.stps=3", 2, "stps");
}

TEST_P(Ranks, WhatOnlyOneRankSeesEndsAllWithOneMessage) {
  expect_told_once(paper_ + "--set 'contact.heat.coefficient=\"if(y<0.01,-1,1)\"'", 2,
                   "must be >= 0");
}

TEST_P(Ranks, AFailedSolveIsToldOnce) {
  expect_told_once(paper_ + "--set solver.tolerance=1e-30 --set solver.max_iterations=3", 3,
                   "solver.max_iterations");
}

// The first rank's number stands in the lock of the folder.
bool send_behind_a_checkpoint(int signal, const fs::path &folder) {
  for (int tries = 0; tries < 20000; ++tries) {
    if (fs::exists(folder / "checkpoint.bin"))
      return kill(std::stoi(content_of(folder / "run.lock")), signal) == 0;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return false;
}

class Interrupted : public Ranks {
 protected:
  // Ends with the signal behind its first checkpoint, and goes on.
  void interrupt(const std::string &arguments, int signal) {
    auto interrupted = std::async(std::launch::async,
                                  [&] { return run(GetParam(), arguments, folder_ / "other"); });
    ASSERT_TRUE(send_behind_a_checkpoint(signal, folder_ / "other"));
    before_ = interrupted.get();
    ASSERT_NE(before_.status, 0) << "too fast to be interrupted";
    const Outcome resumed = run(GetParam(), arguments + " --resume", folder_ / "other");
    ASSERT_EQ(resumed.status, 0) << resumed.said;
    const Outcome whole = run(GetParam(), arguments, folder_ / "one");
    ASSERT_EQ(whole.status, 0) << whole.said;
  }
  // But for the page and the summary, which hold times.
  void expect_same_bytes() const {
    for (const auto &entry : fs::directory_iterator(folder_ / "one")) {
      const std::string name = entry.path().filename().string();
      if (name != "summary.json" && name != "report.html") {
        EXPECT_TRUE(content_of(entry.path()) == content_of(folder_ / "other" / name)) << name;
      }
    }
  }
  void expect_same_numbers() const {
    for (const char *name : {"nodes.csv", "contact.csv"})
      expect_equal_tables(read_table(folder_ / "one" / name), read_table(folder_ / "other" / name));
  }

  Outcome before_{};
};

TEST_P(Interrupted, KilledItGoesOnToTheSameBytesWhereTheSolutionIsIterative) {
  interrupt(file_of(block) +
                " --set time.steps=12 --set output.every=5 --set solver.body=iterative "
                "--set output.checkpoint=2steps",
            SIGKILL);
  expect_same_bytes();
}

// MUMPS on several ranks adds in the order in which messages arrive: no two runs have the same last
// bits.
TEST_P(Interrupted, KilledItGoesOnToTheSameNumbersWithAFactorisation) {
  interrupt(paper_ + "--set time.steps=40 --set output.every=10 --set output.checkpoint=2steps",
            SIGKILL);
  expect_same_numbers();
}

TEST_P(Interrupted, StoppedItSaysSoOnceAndGoesOn) {
  interrupt(paper_ + "--set solver.method=monolithic --set output.checkpoint=2steps", SIGTERM);
  EXPECT_EQ(before_.status, 128 + SIGTERM) << before_.said;
  EXPECT_EQ(count(before_.said, "tourmaline: stopped by SIGTERM after step "), 1) << before_.said;
  EXPECT_EQ(count(before_.said, "mpirun -np " + std::to_string(GetParam())), 1) << before_.said;
  expect_same_numbers();
}

TEST_P(Interrupted, AnotherNumberOfRanksIsRefused) {
  const std::string arguments =
      paper_ + "--set time.steps=1000 --set output.fields=false --set output.checkpoint=2steps";
  auto stopped =
      std::async(std::launch::async, [&] { return run(GetParam(), arguments, folder_ / "other"); });
  ASSERT_TRUE(send_behind_a_checkpoint(SIGTERM, folder_ / "other"));
  ASSERT_EQ(stopped.get().status, 128 + SIGTERM);
  const Outcome alone = run(1, arguments + " --resume", folder_ / "other");
  EXPECT_EQ(alone.status, 2);
  EXPECT_THAT(alone.said, HasSubstr("mpirun -np " + std::to_string(GetParam())));
  EXPECT_TRUE(fs::exists(folder_ / "other" / "checkpoint.bin"));
}

INSTANTIATE_TEST_SUITE_P(Two, Interrupted, ::testing::Values(2));

INSTANTIATE_TEST_SUITE_P(Two, Ranks, ::testing::Values(2));
INSTANTIATE_TEST_SUITE_P(Four, Ranks, ::testing::Values(4));

// Of each rank's cells, joined, with a point for each region that a node belongs to.
TEST(RecoveredStress, IsTheSameOnOneRankAndSeveral) {
  const output::TemporaryFolder folder;
  const fs::path file = folder / "column.toml";
  std::ofstream(file) << R"(
mesh.box = { min = [0, 0], max = [0.01, 0.02], cells = [6, 12] }
time = { end = 1, steps = 1 }
boundary = [ { on = "bottom", displacement = [0, 0], potential = 0, temperature = 0 },
             { on = "top", traction = ["100*y", -1000], temperature = 0 } ]
[[region]]
where = "y < 0.01"
material.library = "BaTiO3-Liu2014"
[[region]]
where = "y >= 0.01"
material.library = "silicon"
)";
  for (const std::string degree : {"1", "2"}) {
    const auto fields = [&](int ranks) {
      const fs::path out = folder / ("on" + std::to_string(ranks) + "-" + degree);
      EXPECT_EQ(run(ranks, "'" + file.string() + "' --set mesh.degree=" + degree, out).status, 0);
      return report::read_field_file(out / (ranks == 1 ? "result_0001.vtu" : "result_0001.pvtu"));
    };
    const report::FieldFile one = fields(1);
    for (const int ranks : {2, 4}) {
      SCOPED_TRACE(std::to_string(ranks) + " ranks, degree " + degree);
      const report::FieldFile several = fields(ranks);
      ASSERT_EQ(several.grid.points, one.grid.points);
      ASSERT_EQ(several.arrays.size(), one.arrays.size());
      for (std::size_t a = 0; a < one.arrays.size(); ++a) {
        const report::FieldArray &wanted = one.arrays[a], &found = several.arrays[a];
        if (!wanted.on_points)
          continue;  // cells stand in the order of the ranks
        double size = 0, difference = 0;
        ASSERT_EQ(found.values.size(), wanted.values.size()) << wanted.name;
        for (std::size_t i = 0; i < wanted.values.size(); ++i) {
          size = std::max(size, std::abs(wanted.values[i]));
          difference = std::max(difference, std::abs(found.values[i] - wanted.values[i]));
        }
        EXPECT_LE(difference, 1e-9 * size) << wanted.name;
      }
    }
  }
}

// Ranks without cells write field files without points, which the page reads back.
TEST(MoreRanksThanCells, GiveTheSameFieldsAndAPage) {
  const output::TemporaryFolder folder;
  const fs::path file = folder / "case.toml";
  std::ofstream(file) << R"(
mesh.box = { min = [0, 0], max = [1, 1], cells = [1, 1], cell = "quadrilateral" }
material.library = "BaTiO3-Liu2014"
time = { end = 1, steps = 1 }
boundary = [ { on = "right", displacement = [0, 0], potential = 0, temperature = 0 },
             { on = "top", traction = [0, -50] } ]
contact = { on = "left", friction = { law = "tresca", bound = 15 } }
)";
  for (const int ranks : {1, 2, 4}) {
    const fs::path out = folder / ("on" + std::to_string(ranks));
    const Outcome outcome = run(ranks, "'" + file.string() + "'", out);
    EXPECT_EQ(outcome.status, 0) << outcome.said;
    EXPECT_TRUE(fs::exists(out / "report.html"));
    const report::FieldFile fields =
        report::read_field_file(out / (ranks == 1 ? "result_0001.vtu" : "result_0001.pvtu"));
    EXPECT_EQ(fields.grid.points.size(), 4U);
    EXPECT_EQ(fields.grid.n_cells(), 1U);
  }
  expect_equal_tables(read_table(folder / "on1" / "nodes.csv"),
                      read_table(folder / "on4" / "nodes.csv"));
}

}  // namespace
}  // namespace tourmaline::testing
