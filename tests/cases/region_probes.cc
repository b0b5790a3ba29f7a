// What regions hold is what the whole body holds, in parts.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "run_case.h"

namespace tourmaline::verified {
namespace {

Table probe(const RunCase &run, const std::string &name) {
  return read_table(run.folder() / ("probe-" + name + ".csv"));
}

// Two ceramic layers poled against each other, warmed and under a voltage.
std::string layers(const std::string &mesh) {
  return "mesh = { " + mesh + R"( }
time = { end = 0.2, steps = 2 }
boundary = [ { on = "left", displacement = [0, 0], temperature = "50*t" },
             { on = "bottom", potential = 0 }, { on = "top", potential = "200*t" },
             { on = "right", traction = [0, "-2000*t"] } ]
[[region]]
name = "lower"
where = "y < 0.008"
material = { library = "BaTiO3-Liu2014", pyroelectric = [0, 1e-4] }
[[region]]
name = "upper"
where = "y >= 0.008"
material = { library = "BaTiO3-Liu2014", pyroelectric = [0, 1e-4], poling = [0, -1] }
[[probe]]
name = "lower"
region = "lower"
[[probe]]
name = "upper"
region = "upper"
[[probe]]
name = "all"
region = ["upper", "lower"]
)";
}

const std::string box = "box = { min = [0, 0], max = [0.04, 0.02], cells = [8, 5], cell = ";

TEST(ProbesOfRegions, AddUpToTheEnergiesOfTheBody) {
  for (const std::string &mesh : {box + "'triangle' }", box + "'quadrilateral' }, degree = 2",
                                  box + "'quadrilateral' }, modes = 'incompatible'"}) {
    const RunCase run = run_text(layers(mesh));
    const Table history = run.history(), lower = probe(run, "lower"), upper = probe(run, "upper"),
                all = probe(run, "all");
    for (const char *column :
         {"elastic_energy", "electric_energy", "thermal_energy", "coupling_energy"}) {
      SCOPED_TRACE(mesh + column);
      EXPECT_LT(difference(all, history, column), 1e-10);
      const std::vector<double> below = lower.numbers(column), above = upper.numbers(column),
                                whole = history.numbers(column);
      for (std::size_t i = 0; i < whole.size(); ++i)
        EXPECT_NEAR(below[i] + above[i], whole[i], 1e-10 * largest(whole));
      EXPECT_GT(largest(below), 0);
    }
    EXPECT_NEAR(lower.numbers("volume")[0], 0.04 * 0.008, 1e-16);
    EXPECT_NEAR(all.numbers("volume")[0], 0.04 * 0.02, 1e-16);
    for (const std::string field : {"potential", "temperature"})
      for (const std::string kind : {"min_", "max_"})
        EXPECT_EQ(all.columns.at(kind + field), history.columns.at(kind + field));
  }
}

// In a glass plate potential and temperature are linear: the mean is the value amid the region.
TEST(ProbesOfRegions, TakeMeansOverTheVolumeAndExtremesOverTheNodes) {
  for (const std::string &mesh :
       {box + "'triangle' }", box + "'triangle' }, degree = 2", box + "'quadrilateral' }"}) {
    const RunCase run = run_text("mesh = { " + mesh + R"( }
time = { end = 1, steps = 1, regime = "static" }
boundary = [ { on = "left", displacement = [0, 0], potential = 0, temperature = 1 },
             { on = "right", potential = 8, temperature = 5 } ]
[[region]]
name = "near"
where = "x < 0.01"
material = { symmetry = "isotropic", young = 70e9, poisson = 0.2, eps11 = 5, k11 = 1, density = 2500, specific_heat = 800, reference_temperature = 293 }
[[region]]
where = "x >= 0.01"
material = { symmetry = "isotropic", young = 70e9, poisson = 0.2, eps11 = 5, k11 = 1, density = 2500, specific_heat = 800, reference_temperature = 293 }
[[probe]]
name = "p"
region = "near"
)");
    const Table table = probe(run, "p");
    EXPECT_NEAR(table.numbers("mean_potential")[0], 1, 1e-11);
    EXPECT_NEAR(table.numbers("min_potential")[0], 0, 1e-11);
    EXPECT_NEAR(table.numbers("max_potential")[0], 2, 1e-11);
    EXPECT_NEAR(table.numbers("mean_temperature")[0], 1.5, 1e-11);
    EXPECT_NEAR(table.numbers("max_temperature")[0], 2, 1e-11);
    EXPECT_EQ(table.numbers("mean_u_x")[0], 0);
  }
}

TEST(ProbesOfRegions, KnowThoseOfAMeshFileByTheirNames) {
  const output::TemporaryFolder folder;
  std::ofstream(folder / "two.geo") << R"(
SetFactory("OpenCASCADE");
Rectangle(1) = {0, 0, 0, 0.1, 0.1}; Rectangle(2) = {0.1, 0, 0, 0.2, 0.1};
Coherence;
Physical Surface("one") = {1}; Physical Surface("two") = {2};
Physical Curve("left") = {4};
)";
  const RunCase run = run_text(R"(
mesh = { file = "two.geo", size = 0.05, unnamed = "natural" }
time = { end = 1, steps = 1 }
boundary = [ { on = "left", displacement = [0, 0], potential = 0, temperature = "3*t" } ]
[[region]]
on = "one"
material = { library = "BaTiO3-Liu2014" }
[[region]]
on = "two"
material = { library = "BaTiO3-Liu2014", poling = [1, 0] }
[[probe]]
name = "two"
region = "two"
)",
                               {}, folder.path());
  EXPECT_NEAR(probe(run, "two").numbers("volume")[0], 0.02, 1e-15);
  EXPECT_GT(probe(run, "two").numbers("elastic_energy")[0], 0);
}

}  // namespace
}  // namespace tourmaline::verified
