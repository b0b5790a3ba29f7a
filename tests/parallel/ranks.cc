// The same case on one rank and on several: the same numbers, and one message where it fails.

#include "ranks.h"

#include <vector>

#include "../cases/partly_held.h"
#include "../cases/slipping_block.h"

namespace tourmaline::verified {
namespace {

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

// Coarse, with electrodes instead of its prescribed potentials.
const std::string bimorph = std::string(TOURMALINE_SOURCE_DIR) +
                            "/cases/devices/bimorph.toml --set mesh.size=5e-4 --set time.steps=2"
                            " --set 'boundary[2]={on=\"lower face\",temperature=0}'"
                            " --set 'boundary[3]={on=\"upper face\",temperature=0}'"
                            " --set 'electrode=[{name=\"lower\",on=\"lower face\",voltage=0},"
                            "{name=\"upper\",on=\"upper face\",voltage=\"50*t\",resistor=1e6}]'";

// A plane device that slips somewhere, between two electrodes.
void expect_same_device(const Results &one, const Results &several,
                        const std::string &one_electrode, const std::string &other_electrode,
                        double tolerance = 1e-9) {
  expect_equal_quantities(several.nodes, one.nodes,
                          {{"u_x", "u_y"}, {"potential"}, {"temperature"}}, tolerance);
  expect_equal_quantities(
      several.contact, one.contact,
      {{"normal_traction", "tangential_traction_x", "tangential_traction_y"}, {"slip_x", "slip_y"}},
      tolerance);
  EXPECT_EQ(several.contact.columns.at("status"), one.contact.columns.at("status"));
  std::vector<Quantity> electric;
  for (const char *quantity : {"_voltage", "_charge", "_current"})
    electric.push_back(
        {"electrode_" + one_electrode + quantity, "electrode_" + other_electrode + quantity});
  expect_equal_quantities(several.history, one.history, electric, tolerance);
}

INSTANTIATE_TEST_SUITE_P(Two, Ranks, ::testing::Values(2));
INSTANTIATE_TEST_SUITE_P(Four, Ranks, ::testing::Values(4));

TEST_P(Ranks, ThePaperSExampleIsTheSame) {
  expect_same(paper_);
}

TEST_P(Ranks, TheMonolithicRouteIsTheSame) {
  expect_same(paper_ + "--set 'solver.method=\"monolithic\"'");
}

TEST_P(Ranks, QuadraticElementsAreTheSame) {
  expect_same(paper_ + "--set mesh.degree=2 --set 'mesh.box.cell=\"quadrilateral\"'");
}

TEST_P(Ranks, ABlockOfTetrahedraIsTheSame) {
  expect_same(file_of(slipping_block));
}

TEST_P(Ranks, ABlockOfHexahedraIsTheSame) {
  expect_same(file_of(slipping_block) + " --set 'mesh.box.cell=\"hexahedron\"'");
}

TEST_P(Ranks, ABlockBetweenPlanesOfSymmetryIsTheSame) {
  expect_same(file_of(quarter_block));
}

// Both stop at a residual of 1e-13, on different ways.
TEST_P(Ranks, ABlockBetweenPlanesOfSymmetryIsTheSameIteratively) {
  ASSERT_NO_FATAL_FAILURE(run_twice(
      file_of(quarter_block) + " --set solver.body=iterative --set solver.linear_tolerance=1e-13"));
  expect_equal_quantities(several_.nodes, one_.nodes,
                          {{"u_x", "u_y", "u_z"}, {"potential"}, {"temperature"}});
  expect_equal_quantities(several_.contact, one_.contact,
                          {{"normal_traction", "tangential_traction_x", "tangential_traction_y"},
                           {"slip_x", "slip_y"}});
  EXPECT_EQ(several_.contact.columns.at("status"), one_.contact.columns.at("status"));
}

TEST_P(Ranks, LoadsThatDependOnPlaceAndTimeAreTheSame) {
  expect_same(file_of(slipping_block) +
              " --set 'load.force=[\"1e3*x*t\",\"1e3*y*t*t\",0]' --set 'load.heat=\"1e2*z*t\"'"
              " --set 'contact.heat.coefficient=\"1+10*y\"'");
}

TEST_P(Ranks, LayersGivenByFormulasAndAnElectrodeInACircuitAreTheSame) {
  ASSERT_NO_FATAL_FAILURE(run_twice(file_of(laminate)));
  expect_same_device(one_, several_, "drive", "sensor");
}

// A conductor is a dielectric of a millionfold permittivity. Seen: 1.4e-9 in the current, where the
// dielectric has 7e-14.
TEST_P(Ranks, AConductorBetweenLayersCostsTheDigitsOfItsPermittivityAndNoMore) {
  ASSERT_NO_FATAL_FAILURE(run_twice(file_of(laminate) +
                                    " --set 'region[1]={where=\"y >= 0.008 && y < 0.012\","
                                    "material={library=\"steel\"}}'"));
  expect_same_device(one_, several_, "drive", "sensor", 1e6 * 1e-14);
}

TEST_P(Ranks, RegionsOfAMeshFileAndElectrodesOnItsCurvesAreTheSame) {
  ASSERT_NO_FATAL_FAILURE(run_twice(bimorph));
  expect_same_device(one_, several_, "lower", "upper");
}

// Of commands but `run` one process does all.
TEST_P(Ranks, CheckSaysWhatItSaysOnOne) {
  const std::string file = std::string(TOURMALINE_SOURCE_DIR) + "/cases/devices/bimorph.toml";
  const auto check = [&](const std::string &launcher) {
    const std::filesystem::path said = folder_ / "said";
    const std::string command =
        launcher + TOURMALINE_BINARY + " check " + file + " > '" + said.string() + "'";
    EXPECT_EQ(std::system(command.c_str()), 0);
    const std::string all = output::content_of(said);
    return std::pair(all.substr(0, all.find("# Expected")), count(all, "# Expected on"));
  };
  const auto one = check("");
  EXPECT_EQ(one.second, 1);
  EXPECT_EQ(check("mpirun --oversubscribe -np " + std::to_string(GetParam()) + " "), one);
}

// Each place belongs to the cells of one rank, those on edges between cells to one of several.
TEST_P(Ranks, ProbesAreTheSame) {
  ASSERT_NO_FATAL_FAILURE(run_twice(file_of(slipping_block) +
                                    " --set 'probe=[{name=\"p\",at=[0.031,0.047,0.053]},"
                                    "{name=\"l\",from=[0,0,0],to=[0.1,0.1,0.1],points=9}]'"));
  for (const char *file : {"probe-p.csv", "probe-l.csv"}) {
    const Table one = read_table(folder_ / "one" / file),
                several = read_table(folder_ / "several" / file);
    for (const char *column : {"x", "y", "z"})
      EXPECT_EQ(several.columns.at(column), one.columns.at(column));
    expect_equal_quantities(several, one, {{"u_x", "u_y", "u_z"}, {"potential"}, {"temperature"}});
  }
}

// Of loads by place and time, whose shares stay with the ranks, too.
TEST_P(Ranks, ProbesOfBoundariesAreTheSame) {
  const std::vector<std::string> sides{"left", "right", "front", "back", "bottom", "top"};
  std::string probes;
  for (const std::string &side : sides)
    probes += "\n[[probe]]\nname = '" + side + "'\non = '" + side + "'";
  ASSERT_NO_FATAL_FAILURE(run_twice(file_of(slipping_block + probes) +
                                    " --set 'contact.heat.coefficient=\"1+10*y\"'"
                                    " --set 'contact.heat.foundation_temperature=\"-27+y*t\"'"));
  const auto tables = [&](const char *run, const std::string &side) {
    return read_table(folder_ / run / ("probe-" + side + ".csv"));
  };
  const double force = largest(tables("one", "right"), "force_x"), size = 0.1;
  EXPECT_GT(force, 0);
  for (const std::string &side : sides) {
    const Table one = tables("one", side), several = tables("several", side);
    for (const std::string axis : {"x", "y", "z"}) {
      EXPECT_LE(difference(several, one, "force_" + axis, force), 1e-9);
      EXPECT_LE(difference(several, one, "moment_" + axis, size * force), 1e-9);
    }
    EXPECT_LE(difference(several, one, "area", size * size), 1e-14);
    EXPECT_LE(difference(several, one, "heat"), 1e-9);
  }
}

TEST_P(Ranks, ProbesOfRegionsAreTheSame) {
  ASSERT_NO_FATAL_FAILURE(run_twice(file_of(laminate) +
                                    " --set 'region[0].name=\"layer\"'"
                                    " --set 'probe=[{name=\"p\",region=\"layer\"}]'"));
  const Table one = read_table(folder_ / "one" / "probe-p.csv"),
              several = read_table(folder_ / "several" / "probe-p.csv");
  expect_equal_quantities(several, one,
                          {{"volume"},
                           {"elastic_energy", "electric_energy", "thermal_energy"},
                           {"mean_u_x", "mean_u_y", "min_u_x", "max_u_y"},
                           {"mean_potential", "min_potential", "max_potential"}});
}

TEST_P(Ranks, AProbeOutsideIsToldOnce) {
  expect_told_once(paper_ + "--set 'probe=[{name=\"p\",at=[0.05,0.2]}]'", 2,
                   "the nearest place in it is [0.05, 0.1]");
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

}  // namespace
}  // namespace tourmaline::verified
