// The files that several ranks write: together they hold what the file of one rank does.

#include <cmath>
#include <iterator>
#include <vector>

#include "../output/decode_vtk.h"
#include "ranks.h"
#include "report/field_file.h"

namespace tourmaline::verified {
namespace {

using output::content_of;
using ::testing::HasSubstr;
namespace fs = std::filesystem;

TEST_P(Ranks, EveryRankLeavesItsCellsAndOneFileJoinsThem) {
  ASSERT_EQ(run_on(GetParam(), paper_ + "--set time.steps=1", folder_ / "several").status, 0);
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
  ASSERT_EQ(run_on(1, opening, folder_ / "one").status, 0);
  ASSERT_EQ(run_on(GetParam(), opening, folder_ / "several").status, 0);
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
  for (const std::string how :
       {"mesh.degree=1", "mesh.degree=2",
        "mesh.degree=1 --set solver.body=iterative --set solver.linear_tolerance=1e-13",
        "mesh.degree=2 --set solver.body=iterative --set solver.linear_tolerance=1e-13"}) {
    const auto fields = [&](int ranks) {
      const fs::path out = folder / ("on" + std::to_string(ranks));
      EXPECT_EQ(run_on(ranks, "'" + file.string() + "' --set output.report=false --set " + how, out)
                    .status,
                0);
      return report::read_field_file(out / (ranks == 1 ? "result_0001.vtu" : "result_0001.pvtu"));
    };
    const report::FieldFile one = fields(1);
    for (const int ranks : {2, 4}) {
      SCOPED_TRACE(std::to_string(ranks) + " ranks, " + how);
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
    const Outcome outcome = run_on(ranks, "'" + file.string() + "'", out);
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

// Whether there is damping, or charge that crosses, ranks without cells do not see from theirs.
TEST(MoreRanksThanCells, AgreeOnWhatTheOnlyCellHas) {
  const output::TemporaryFolder folder;
  const fs::path file = folder / "case.toml";
  std::ofstream(file) << R"(
mesh.box = { min = [0, 0], max = [1, 1], cells = [1, 1], cell = "quadrilateral" }
material = { library = "BaTiO3-Liu2014", stiffness_damping = 0.1 }
model.thermal = false
time = { end = 1, steps = 2 }
boundary = [ { on = "left", displacement = [0, 0], potential = 0 },
             { on = "right", traction = [0, "1e3*t"] } ]
contact = { on = "bottom", electric = { law = "exchange", coefficient = 1e-9, foundation_potential = 1 } }
output = { fields = false, report = false }
)";
  for (const std::string body : {"direct", "iterative"}) {
    for (const int ranks : {1, 2}) {
      const Outcome outcome = run_on(ranks, "'" + file.string() + "' --set solver.body=" + body,
                                     folder / (body + std::to_string(ranks)));
      EXPECT_EQ(outcome.status, 0) << outcome.said;
    }
    expect_equal_results(results_in(folder / (body + "1")), results_in(folder / (body + "2")));
  }
}

}  // namespace
}  // namespace tourmaline::verified
