// The iterative solution of the body against the factorisation: the same states, tractions and
// statuses, on sides of any direction.

#include <gmock/gmock.h>

#include "partly_held.h"
#include "run_case.h"
#include "tourmaline/case/case.h"
#include "tourmaline/error.h"

namespace tourmaline::verified {
namespace {

// A component is measured by the largest of its vector: it may be nothing but round-off.
void expect_equal(const Table &expected, const Table &found, const std::vector<std::string> &names,
                  double tolerance) {
  const auto vector_of = [](const std::string &name) { return name.substr(0, name.rfind('_')); };
  for (const std::string &name : names) {
    SCOPED_TRACE(name);
    if (!expected.columns.contains(name))
      continue;
    double size = 0;
    for (const std::string &other : names)
      if (expected.columns.contains(other) && vector_of(other) == vector_of(name))
        size = std::max(size, largest(expected, other));
    EXPECT_LE(difference(found, expected, name, size), tolerance);
  }
}

using Overrides = std::vector<std::string>;

struct Asked {
  std::string name;  // of a file, or of what `text` is
  Overrides overrides;
  std::string text;

  casefile::Case with(const std::string &body) const {
    Overrides all = overrides;
    all.push_back("solver.body=\"" + body + "\"");
    all.insert(all.end(), {"output.fields=false", "output.report=false"});
    return text.empty()
               ? casefile::read_file(std::filesystem::path(TOURMALINE_SOURCE_DIR) / name, all)
               : casefile::read_text(text, "case.toml", all);
  }
};

void PrintTo(const Asked &asked, std::ostream *out) {
  *out << asked.name;
}

void expect_equal_runs(const RunCase &expected, const RunCase &found) {
  expect_equal(expected.nodes(), found.nodes(), {"u_x", "u_y", "u_z", "potential", "temperature"},
               1e-9);
  if (!exists(expected.folder() / "contact.csv"))
    return;
  expect_equal(expected.contact(), found.contact(),
               {"normal_traction", "tangential_traction_x", "tangential_traction_y",
                "tangential_traction_z", "slip_x", "slip_y", "slip_z"},
               1e-6);
  EXPECT_EQ(expected.contact().columns.at("status"), found.contact().columns.at("status"));
}

int safe_steps(const RunCase &run) {
  return run.summary()["iterations"]["safe_steps"].get<int>();
}

class Iterative : public ::testing::TestWithParam<Asked> {};

TEST_P(Iterative, SolutionIsThatOfTheFactorisation) {
  expect_equal_runs(RunCase(GetParam().with("direct")), RunCase(GetParam().with("iterative")));
}

INSTANTIATE_TEST_SUITE_P(
    Cases, Iterative,
    ::testing::Values(
        Asked{"cases/ouafik-2020/conductive.toml", {"mesh.box.cells=[16,16]"}, ""},
        Asked{"cases/block-3d/twisted.toml", {"mesh.box.cells=[6,6,6]", "time.steps=4"}, ""},
        Asked{"cases/ring/sleeve.toml", {"time.steps=3"}, ""},
        Asked{"quarter block", {}, quarter_block},
        Asked{"quarter block of tetrahedra", {"mesh.box.cell=tetrahedron"}, quarter_block},
        Asked{"quarter block of degree 2", {"mesh.degree=2", "time.steps=2"}, quarter_block},
        Asked{"rollers", {}, rollers}, Asked{"sleeve with rims", {}, rimmed_sleeve},
        Asked{"plane between rollers", {}, plane_between_rollers},
        Asked{"plane of degree 2 between rollers",
              {"mesh.degree=2", "mesh.box.cell=quadrilateral"},
              plane_between_rollers}));

// What stands in the tables has all digits of what was computed.
void expect_exactly(const Table &nodes, const std::string &at, double place,
                    const std::string &column, double prescribed) {
  const std::vector<double> places = nodes.numbers(at), values = nodes.numbers(column);
  int held = 0;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (std::abs(places[i] - place) < 1e-12) {
      EXPECT_EQ(values[i], prescribed) << column << " at node " << i;
      ++held;
    }
  EXPECT_GT(held, 0);
}

TEST(Iterative, WhatIsPrescribedHoldsToTheLastBitBesideComponentsThatAreFree) {
  const Asked block{"quarter block", {}, quarter_block}, roller{"rollers", {}, rollers},
      plane{"plane", {}, plane_between_rollers}, sleeve{"sleeve", {}, rimmed_sleeve};
  const Table of_block = RunCase(block.with("iterative")).nodes();
  expect_exactly(of_block, "x", 0, "u_x", 0);
  expect_exactly(of_block, "y", 0, "u_y", 0);
  expect_exactly(of_block, "z", 0, "u_z", 0);
  expect_exactly(of_block, "z", 0.04, "potential", 100);
  expect_exactly(RunCase(roller.with("iterative")).nodes(), "x", 0, "u_x", 1e-9);
  const Table of_plane = RunCase(plane.with("iterative")).nodes();
  expect_exactly(of_plane, "x", 0.1, "u_x", -1e-10 * 0.1);
  expect_exactly(of_plane, "y", 0, "u_y", 2e-10 * 0.1);
}

class ThirdProgramIteratively : public ::testing::TestWithParam<std::string> {};

// The programmes of tests/reference/third, in five of which Newton's method alone cycles, with
// their reference numbers. Tractions are measured by the largest of the node's whole traction.
TEST_P(ThirdProgramIteratively, AgreesWithItsReference) {
  const auto folder =
      std::filesystem::path(TOURMALINE_SOURCE_DIR) / "tests" / "reference" / "third" / GetParam();
  const RunCase run(casefile::read_file(
      folder / "case.toml",
      {"output.fields=false", "solver.body=iterative", "solver.linear_tolerance=1e-13"}));
  const Table nodes = run.nodes(), their_nodes = read_table(folder / "nodes.csv");
  for (const auto &[column, cells] : their_nodes.columns)
    EXPECT_LT(difference(nodes, their_nodes, column), 1e-9) << column;
  const Table contact = run.contact(), theirs = read_table(folder / "contact.csv");
  const double displacement = std::max(largest(their_nodes, "u_x"), largest(their_nodes, "u_y"));
  for (const auto &[column, cells] : theirs.columns)
    if (column != "status") {
      const double size = column == "slip_y" ? displacement
                          : column.find("traction") != column.npos
                              ? largest(theirs, "normal_traction")
                              : 0;
      EXPECT_LT(difference(contact, theirs, column, size), 1e-9) << column;
    }
  EXPECT_EQ(contact.columns.at("status"), theirs.columns.at("status"));
}

std::vector<std::string> third_programmes() {
  std::vector<std::string> names;
  for (const auto &entry : std::filesystem::directory_iterator(
           std::filesystem::path(TOURMALINE_SOURCE_DIR) / "tests" / "reference" / "third"))
    if (entry.is_directory())
      names.push_back(entry.path().filename());
  std::sort(names.begin(), names.end());
  return names;
}

INSTANTIATE_TEST_SUITE_P(Variations, ThirdProgramIteratively,
                         ::testing::ValuesIn(third_programmes()));

// The one of seven steps drawn out into space. Here, too, Newton's method alone cycles.
constexpr const char *drawn_out = R"toml(
mesh.box = { min = [0, 0, 0], max = [0.1, 0.1, 0.1], cells = [16, 4, 16], cell = "hexahedron" }
material = { library = "BaTiO3-Liu2014", pyroelectric = [0, 0, 1e-4] }
time = { end = 0.2, steps = 7 }
boundary = [
  { on = "right", displacement = [0, 0, 0], potential = 0, temperature = 0 },
  { on = ["bottom", "top"], temperature = 0 },
  { on = "top", traction = ["sin(30*t)", 0, "-0.2*sin(30*t)"] } ]
contact = { on = "left", friction = { law = "tresca", bound = 0.08 } }
output = { fields = false, report = false }
)toml";

TEST(Iterative, AProgrammeOfThePlaneDrawnOutIntoSpaceIsSolved) {
  for (const char *cells : {"mesh.box.cells=[16,4,16]", "mesh.box.cells=[24,1,24]"}) {
    const Asked asked{cells, {cells}, drawn_out};
    SCOPED_TRACE(cells);
    const RunCase found(asked.with("iterative"));
    EXPECT_GT(safe_steps(found), 0);
    expect_equal_runs(RunCase(asked.with("direct")), found);
  }
}

// A ring, half of it soft, that slides in a hole without friction: nodal forces of the stiff half
// say nothing of the other's.
constexpr const char *half_soft = R"toml(
mesh.annulus = { cell = "quadrilateral", inner = 0.6, outer = 1, cells = [3, 16] }
region = [
  { where = "x > 0.5", material = { symmetry = "isotropic", young = 1e11, poisson = 0.3, density = 3000, eps11 = 10, k11 = 10, specific_heat = 500, reference_temperature = 300, a11 = 1e-5 } },
  { where = "x <= 0.5", material = { symmetry = "isotropic", young = 1e7, poisson = 0.3, density = 3000, eps11 = 10, k11 = 10, specific_heat = 500, reference_temperature = 300, a11 = 1e-5 } } ]
time = { end = 1e-3, steps = 3 }
boundary = [ { on = "inner", displacement = ["1e-6*(1 - 2e3*t)*(1 + x)", "1e-3*t"], temperature = 5, potential = 0 } ]
contact = { on = "outer", friction = "none", heat = { law = "exchange", coefficient = 9e3, foundation_temperature = "(t > 5e-4 ? 100 : 0)*(1 + x)" } }
output = { fields = false, report = false }
)toml";

TEST(Iterative, ABodyHalfSoftSlidesAsThatOfTheFactorisation) {
  for (const char *young : {"1e7", "1e5", "1e4"}) {
    SCOPED_TRACE(young);
    const Asked asked{"half soft", {std::string("region[1].material.young=") + young}, half_soft};
    const RunCase direct(asked.with("direct")), found(asked.with("iterative"));
    expect_equal(direct.nodes(), found.nodes(), {"u_x", "u_y"}, 1e-8);
    expect_equal(direct.contact(), found.contact(), {"slip_x", "slip_y"}, 1e-8);
  }
}

// The iteration leaves each state another last digit of potentials that nothing changes.
TEST(Iterative, PotentialsThatStayWhileTheBodyIsPulledBalance) {
  for (const char *cells : {"mesh.box.cells=[4, 4]", "mesh.box.cells=[6, 3]"}) {
    const Asked asked{"pulled", {cells}, R"toml(
mesh.box = { min = [0, 0], max = [1, 0.3], cells = [4, 4], cell = "quadrilateral" }
model.thermal = false
material = { library = "steel", conductor = false, eps11 = 1 }
time = { end = 1e-3, steps = 3 }
boundary = [ { on = "left", traction = ["1e9*t", 0], potential = 0 },
             { on = "right", displacement = [0, 0], surface_charge = "1e-5*(1 + x)" } ]
)toml"};
    EXPECT_LT(largest(RunCase(asked.with("iterative")).history(), "energy_imbalance"), 1e-10);
  }
}

// A block whose bound jumps by a factor of ten: all points that slid stick at once.
constexpr const char *jump = R"toml(
mesh.box = { min = [0, 0, 0], max = [0.04, 0.04, 0.04], cells = [8, 8, 8], cell = "hexahedron" }
material.library = "BaTiO3-Liu2014"
time = { end = 1, steps = 4 }
boundary = [
  { on = "right", displacement = [0, 0, 0], potential = 0, temperature = 0 },
  { on = "top", traction = ["-200", "3000*t", "2500*t"] } ]
contact = { on = "left", friction = { law = "tresca", bound = "if(t<0.6, 300, 3000)" } }
output = { fields = false, report = false }
)toml";

TEST(Iterative, WhereTheFastStageCyclesTheDescentFindsTheAnswer) {
  const Asked asked{"jump", {}, jump};
  const RunCase found(asked.with("iterative"));
  EXPECT_GT(safe_steps(found), 0);
  expect_equal_runs(RunCase(asked.with("direct")), found);
}

TEST(Iterative, SoItDoesForItsNeighboursInBoundLoadAndStep) {
  for (const char *bound : {"if(t<0.6, 30, 3000)", "if(t<0.6, 3000, 300)", "if(t<0.6, 300, 1000)"})
    for (const char *steps : {"3", "7"})
      for (const char *load :
           {"['-200', '3000*t', '2500*t']", "['0', '-4000*t', '3000*sin(9*t)']"}) {
        const Asked asked{"neighbour",
                          {"mesh.box.cells=[5,5,5]", std::string("time.steps=") + steps,
                           std::string("contact.friction.bound='") + bound + "'",
                           std::string("boundary[1].traction=") + load},
                          jump};
        SCOPED_TRACE(std::string(bound) + " " + steps + " " + load);
        expect_equal_runs(RunCase(asked.with("direct")), RunCase(asked.with("iterative")));
      }
}

TEST(Iterative, WhereTheFastStageSufficesTheSafeOneIsNotTaken) {
  const Asked asked{"cases/block-3d/twisted.toml", {"mesh.box.cells=[6,6,6]", "time.steps=4"}, ""};
  EXPECT_EQ(safe_steps(RunCase(asked.with("iterative"))), 0);
}

// A pad between electrodes that is sheared to and fro: directions of slip turn as it comes to rest.
constexpr const char *pad = R"toml(
mesh.box = { min = [0, 0, 0], max = [0.02, 0.015, 0.006], cells = [7, 5, 3], cell = "tetrahedron" }
material = { library = "PZT-5A", a11 = 0, a33 = 0, p3 = 0, k11 = 1.5, k33 = 1.5, specific_heat = 420, poling = [1, 0, 0] }
time = { end = 4, steps = 10 }
boundary = [ { on = "top", displacement = ["2e-8*sin(pi*t/2)", "1e-8*sin(pi*t)", "-2e-9*min(t,1)"] } ]
electrode = [ { name = "top", on = "top", voltage = "10*t" }, { name = "bottom", on = "bottom", voltage = 0 } ]
contact = { on = "bottom", friction = { law = "tresca", bound = 3e4 } }
output = { fields = false, report = false }
)toml";

TEST(Iterative, APadShearedToAndFroBetweenElectrodesIsThatOfTheFactorisation) {
  const Asked asked{"pad", {}, pad};
  expect_equal_runs(RunCase(asked.with("direct")), RunCase(asked.with("iterative")));
}

// Where it turns, many of its points stick at their bound.
TEST(Iterative, APadOfFinerCellsThatTurnsIsThatOfTheFactorisation) {
  const Asked asked{"pad", {"mesh.box.cells=[14,11,6]", "time.end=2", "time.steps=5"}, pad};
  expect_equal_runs(RunCase(asked.with("direct")), RunCase(asked.with("iterative")));
}

// n24-sin-7 of tests/reference/third as a solid between planes of symmetry, as coarse as a mesh may
// be on which Newton's method still fails in one step.
constexpr const char *extruded = R"toml(
mesh.box = { min = [0, 0, 0], max = [0.1, 0.025, 0.1], cells = [12, 2, 12], cell = "hexahedron" }
material = { library = "BaTiO3-Liu2014", pyroelectric = [0, 0, 1e-4] }
time = { end = 0.2, steps = 7 }
boundary = [
  { on = "right", displacement = [0, 0, 0], potential = 0, temperature = 0 },
  { on = ["bottom", "top"], temperature = 0 },
  { on = ["front", "back"], displacement = ["free", 0, "free"] },
  { on = "top", traction = ["sin(30*t)", 0, "-0.2*sin(30*t)"] } ]
contact = { on = "left", friction = { law = "tresca", bound = 0.08 } }
output = { fields = false, report = false }
)toml";

TEST(Iterative, ASolidBetweenPlanesOfSymmetryThatSlipsToAndFroIsThatOfTheFactorisation) {
  const Asked asked{"extruded", {}, extruded};
  const RunCase found(asked.with("iterative"));
  EXPECT_GT(safe_steps(found), 0);
  expect_equal_runs(RunCase(asked.with("direct")), found);
}

// A cantilever without contact.
const std::string beam = "tests/cases/ill_conditioned/beam.toml";

TEST(Iterative, OfASlenderBodyTheResidualIsTakenDownToRoundOff) {
  const Asked asked{beam, {"mesh.box.max=[1e-2,1e-4]"}, ""};
  const RunCase direct(asked.with("direct")), found(asked.with("iterative"));
  // Of a condition of some 1e9; the residual's round-off is what the factorisation leaves, too.
  EXPECT_LT(difference(found.nodes(), direct.nodes(), "u_y"), 1e-5);
}

TEST(Iterative, WhereTheBodyCannotBeSolvedItIsTheBodyThatIsNamed) {
  const Asked asked{beam, {}, ""};
  try {
    const RunCase run(asked.with("iterative"));
    FAIL() << "converged";
  } catch (const SolveError &error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("the body's equations did not converge"));
    EXPECT_THAT(error.what(), ::testing::HasSubstr("displacement"));
    EXPECT_THAT(error.what(), ::testing::Not(::testing::HasSubstr("contact")));
  }
}

TEST(Iterative, LinearIterationsHardlyGrowWithTheMesh) {
  std::vector<double> all;
  for (const char *cells : {"[4,4,4]", "[8,8,8]", "[12,12,12]"}) {
    const RunCase run("cases/block-3d/twisted.toml", {std::string("mesh.box.cells=") + cells,
                                                      "time.steps=1", "solver.body=\"iterative\""});
    all.push_back(run.summary()["iterations"]["krylov_total"].get<double>());
  }
  EXPECT_LE(all[2], 1.5 * all[1]);
}

TEST(Iterative, OnePreconditionerServesAsLongAsNothingSlips) {
  const RunCase run("cases/block-3d/twisted.toml",
                    {"mesh.box.cells=[6,6,6]", "time.steps=3", "contact.friction.bound=1e6",
                     "solver.body=\"iterative\""});
  EXPECT_EQ(run.summary()["iterations"]["preconditioners"], 1);
}

TEST(Iterative, ABodyWithoutContactIsSolvedToo) {
  casefile::Case asked = casefile::read_file(
      std::filesystem::path(TOURMALINE_SOURCE_DIR) / "cases/block-3d/twisted.toml",
      {"mesh.box.cells=[5,5,5]", "time.steps=2"}, mesh::read_mesh_file);
  asked.contacts.clear();
  asked.solver.body = "direct";
  const RunCase expected(asked);
  asked.solver.body = "iterative";
  expect_equal(expected.nodes(), RunCase(asked).nodes(),
               {"u_x", "u_y", "u_z", "potential", "temperature"}, 1e-9);
}

TEST(Iterative, TheBackwardErrorIsMeasured) {
  const RunCase run("cases/block-3d/twisted.toml",
                    {"mesh.box.cells=[6,6,6]", "time.steps=2", "solver.body=\"iterative\""});
  const double error = run.summary()["backward_error"];
  EXPECT_GT(error, 0);
  EXPECT_LT(error, 1e-9);
}

}  // namespace
}  // namespace tourmaline::verified
