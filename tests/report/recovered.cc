// A column of two layers under its own weight, whose stresses are known: what the field files hold
// at the interface, and what of it is shown.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "../output/temporary_folder.h"
#include "report/field_file.h"
#include "report/result.h"
#include "tourmaline/case/reader.h"
#include "tourmaline/run/simulation.h"

namespace tourmaline::report {
namespace {

constexpr const char *column = R"(
mesh.box = { min = [0, 0], max = [0.01, 0.02], cells = [2, 4], cell = "quadrilateral" }
mesh.degree = 2
time = { end = 1e9, steps = 1 }
load.force = [0, -1e5]
boundary = [ { on = "bottom", displacement = [0, 0], potential = 0, temperature = 0 },
             { on = ["left", "right"], displacement = [0, "free"], temperature = 0 },
             { on = "top", temperature = 0 } ]
[[region]]
where = "y < 0.01"
material.library = "steel"
[[region]]
where = "y >= 0.01"
material.library = "silicon"
)";

const FieldArray &array_of(const FieldFile &file, std::string_view name) {
  for (const FieldArray &array : file.arrays)
    if (array.name == name)
      return array;
  throw std::runtime_error("there is no array " + std::string(name));
}

class Column : public ::testing::Test {
 protected:
  Column() {
    const auto file = folder_ / "column.toml";
    std::ofstream(file) << column;
    run::simulate(casefile::read_file(file, {}), results(), {.quiet = true});
  }
  std::filesystem::path results() const { return folder_ / "results"; }

 private:
  output::TemporaryFolder folder_;
};

// Both sides carry what lies above, 1000 N/m^2; across the column each material presses with
// c12/c11 of that (steel: 0.3/0.7); the mean of the cell below is 1250 N/m^2.
TEST_F(Column, HasTheStressOfEachSideAtTheInterface) {
  const FieldFile file = read_field_file(results() / "result_0001.vtu");
  const FieldArray &stress = array_of(file, "recovered_stress");
  std::vector<double> across;
  for (std::size_t i = 0; i < file.grid.points.size(); ++i) {
    const double y = file.grid.points[i][1];
    EXPECT_NEAR(stress.values[6 * i + 1], -1e5 * (0.02 - y), 1e-3) << "y = " << y;
    if (std::abs(y - 0.01) < 1e-9 && std::abs(file.grid.points[i][0] - 0.005) < 1e-9)
      across.push_back(stress.values[6 * i]);
  }
  ASSERT_EQ(across.size(), 2U);
  EXPECT_NEAR(across[0], -1000 * 0.3 / 0.7, 0.01);
  EXPECT_NEAR(across[1], -1000 * 63.94 / 165.64, 0.01);
  const FieldArray &means = array_of(file, "stress");
  for (std::size_t i = 1; i < means.values.size(); i += 6)
    EXPECT_GT(std::abs(means.values[i] + 1000), 200);
}

TEST_F(Column, PointsOfASecondRegionStandBehindTheNodesAndBelongToThem) {
  const Result result = read_result(results(), {1'000'000, {}});
  const std::size_t nodes = 5 * 9, copies = 5;
  ASSERT_EQ(result.skin.nodes.size(), nodes + copies);
  for (std::size_t i = 0; i < nodes; ++i)
    EXPECT_EQ(result.skin.names[i], i);
  for (std::size_t i = nodes; i < nodes + copies; ++i)
    EXPECT_EQ(result.points[i], result.points[result.skin.names[i]]);
}

TEST_F(Column, TheNodesStressTakesThePlaceOfTheMeansUnlessBothAreWanted) {
  const Result page = read_result(results(), {1'000'000, {}}),
               all = read_result(results(), {1'000'000, {}, true});
  EXPECT_FALSE(page.field("von_mises"));
  ASSERT_TRUE(page.field("recovered_von_mises"));
  EXPECT_EQ(page.field("recovered_von_mises")->origin(), "recovered at the nodes");
  ASSERT_TRUE(all.field("von_mises"));
  EXPECT_EQ(all.field("von_mises")->origin(), "mean of each cell");
}

}  // namespace
}  // namespace tourmaline::report
