// The iterative solution of the body against the factorisation: the same states, tractions and
// statuses, on sides of any direction.

#include <gmock/gmock.h>

#include "run_case.h"

namespace tourmaline::testing {
namespace {

void expect_equal(const Table &expected, const Table &found, const std::vector<std::string> &names,
                  double tolerance) {
  for (const std::string &name : names) {
    SCOPED_TRACE(name);
    if (!expected.columns.contains(name))
      continue;
    EXPECT_LE(difference(found, expected, name), tolerance);
  }
}

struct Asked {
  std::string file;
  std::vector<std::string> overrides;
};

void PrintTo(const Asked &asked, std::ostream *out) {
  *out << asked.file;
}

class Iterative : public ::testing::TestWithParam<Asked> {};

TEST_P(Iterative, SolutionIsThatOfTheFactorisation) {
  auto direct = GetParam().overrides, iterative = direct;
  direct.push_back("solver.body=\"direct\"");
  iterative.push_back("solver.body=\"iterative\"");
  const RunCase expected(GetParam().file, direct), found(GetParam().file, iterative);
  expect_equal(expected.nodes(), found.nodes(), {"u_x", "u_y", "u_z", "potential", "temperature"},
               1e-9);
  expect_equal(expected.contact(), found.contact(),
               {"normal_traction", "tangential_traction_x", "tangential_traction_y",
                "tangential_traction_z", "slip_x", "slip_y", "slip_z"},
               1e-6);
  EXPECT_EQ(expected.contact().columns.at("status"), found.contact().columns.at("status"));
}

INSTANTIATE_TEST_SUITE_P(Cases, Iterative,
                         ::testing::Values(Asked{"cases/ouafik-2020/conductive.toml",
                                                 {"mesh.box.cells=[16,16]"}},
                                           Asked{"cases/block-3d/twisted.toml",
                                                 {"mesh.box.cells=[6,6,6]", "time.steps=4"}},
                                           Asked{"cases/ring/sleeve.toml", {"time.steps=3"}}));

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
  asked.contact.reset();
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
}  // namespace tourmaline::testing
