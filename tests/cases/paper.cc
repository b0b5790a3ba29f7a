// What the paper claims of its example (section 4), and what design and notes make of it
// (docs/paper-notes.md).

#include <fmt/format.h>

#include "body/derived.h"
#include "run_case.h"
#include "solve/model.h"
#include "tourmaline/case/case.h"
#include "tourmaline/error.h"

namespace tourmaline::verified {
namespace {

class Paper : public ::testing::TestWithParam<int> {
 protected:
  static std::vector<std::string> cells() {
    return {fmt::format("mesh.box.cells=[{0},{0}]", GetParam())};
  }
  static std::vector<std::string> cells_and(std::string more) {
    auto overrides = cells();
    overrides.push_back(std::move(more));
    return overrides;
  }
};

const char *const conductive = "cases/ouafik-2020/conductive.toml";
const char *const insulated = "cases/ouafik-2020/insulated.toml";

std::size_t count(const Table &contact, const std::string &status, int step) {
  std::size_t n = 0;
  for (std::size_t i = 0; i < contact.n_rows(); ++i)
    n += contact.columns.at("status")[i] == status &&
         contact.columns.at("step")[i] == std::to_string(step);
  return n;
}

// Node with the largest value of a column: its place.
std::pair<double, double> place_of_largest(const Table &nodes, const std::string &column,
                                           double sign = 1) {
  const std::vector<double> values = nodes.numbers(column);
  std::size_t best = 0;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (sign * values[i] > sign * values[best])
      best = i;
  return {nodes.numbers("x")[best], nodes.numbers("y")[best]};
}

TEST_P(Paper, OnAnInsulatedFoundationEveryNodeSticksInEveryStep) {
  const Table contact = RunCase(insulated, cells()).contact();
  for (const std::string &status : contact.columns.at("status"))
    ASSERT_EQ(status, "stick");
}

TEST_P(Paper, OnAnInsulatedFoundationTheLargestPotentialIsNegativeOnTopAndOnTheContactAtItsTopEnd) {
  const Table nodes = RunCase(insulated, cells()).nodes();
  const auto [x, y] = place_of_largest(nodes, "potential", -1);
  EXPECT_DOUBLE_EQ(y, 0.1);
  EXPECT_NEAR(x, 0.05, 0.02);
  const std::vector<double> potential = nodes.numbers("potential"), at = nodes.numbers("x");
  EXPECT_NEAR(*std::min_element(potential.begin(), potential.end()), -4.3e-5, 0.1e-5);
  // Not negative everywhere: 0.38e-5 V on the lower third of the contact.
  EXPECT_LT(*std::max_element(potential.begin(), potential.end()), 0.5e-5);
  // The figure's claim concerns the contact boundary: its nodes come first, from bottom to top.
  double largest_size = 0;
  std::size_t where = 0;
  for (std::size_t i = 0; at[i] == 0; ++i)
    if (std::abs(potential[i]) > largest_size) {
      largest_size = std::abs(potential[i]);
      where = i;
    }
  EXPECT_EQ(where, static_cast<std::size_t>(GetParam()));
}

TEST_P(Paper, OnAConductiveFoundationNearlyAllNodesSlipAtTheEnd) {
  const Table contact = RunCase(conductive, cells()).contact();
  EXPECT_GE(count(contact, "slip", 20), 0.95 * (GetParam() + 1));
  EXPECT_GE(count(contact, "stick", 20), 1u);  // where the slip changes its direction
}

TEST_P(Paper, OnAConductiveFoundationTheHighestPotentialIsAtTheBottomEndOfTheContact) {
  const Table nodes = RunCase(conductive, cells()).nodes();
  const auto [x, y] = place_of_largest(nodes, "potential");
  EXPECT_EQ(x, 0);
  EXPECT_LE(y, 0.0032);  // the corner itself or the nodes next to it
  const std::vector<double> potential = nodes.numbers("potential");
  EXPECT_NEAR(*std::max_element(potential.begin(), potential.end()), 0.068, 0.002);
}

TEST_P(Paper, WithTheOtherPyroelectricSignThePotentialIsNineTimesSmallerAndLargestInTheMiddle) {
  const Table nodes = RunCase(conductive, cells_and("material.pyroelectric=[0,-1e-4]")).nodes();
  EXPECT_NEAR(largest(nodes.numbers("potential")), 0.00755, 0.0001);
  for (const auto &[sign, side] : {std::pair{1., 0.}, std::pair{-1., 0.1}}) {
    const auto [x, y] = place_of_largest(nodes, "potential", sign);
    EXPECT_NEAR(x, 0.056, 0.004);
    EXPECT_DOUBLE_EQ(y, side);
  }
}

TEST_P(Paper, ColdEntersFromTheContactAndNotHeat) {
  const RunCase run(conductive, cells());
  const Table nodes = run.nodes();
  const auto [x, y] = place_of_largest(nodes, "temperature", -1);
  EXPECT_EQ(x, 0);
  EXPECT_NEAR(y, 0.05, 0.03);
  const std::vector<double> temperature = nodes.numbers("temperature");
  EXPECT_NEAR(*std::min_element(temperature.begin(), temperature.end()), -1.25e-3, 0.03e-3);
  for (const double flux : run.contact().numbers("heat_flux"))
    EXPECT_GT(flux, 0);  // leaves the body
}

TEST_P(Paper, TheHighestVonMisesStressOutsideTheSingularCornersIsInTheContactZone) {
  std::vector<std::string> overrides = cells();
  const casefile::Case asked =
      casefile::read_file(std::filesystem::path(TOURMALINE_SOURCE_DIR) / conductive, overrides);
  const Table nodes = RunCase(conductive, overrides).nodes();
  const solve::Model<2> model(asked);
  std::vector<double> state(model.n_unknowns());
  const std::vector<std::string> columns{"u_x", "u_y", "potential", "temperature"};
  for (std::size_t c = 0; c < columns.size(); ++c) {
    const std::vector<double> values = nodes.numbers(columns[c]);
    for (std::size_t i = 0; i < values.size(); ++i)
      state[4 * i + c] = values[i];
  }
  const output::CellFields fields = body::derived_fields(model.body, model.composition, state);
  const output::Grid grid = model.body.grid();
  double best = 0, best_x = 1;
  for (std::size_t cell = 0; cell < grid.n_cells(); ++cell) {
    bool at_corner = false;
    double x = 0;
    for (std::size_t a = 0; a < 3; ++a) {
      const Vector3 &p = grid.points[grid.connectivity[3 * cell + a]];
      at_corner |= (p[0] < 1e-12 || p[0] > 0.1 - 1e-12) && (p[1] < 1e-12 || p[1] > 0.1 - 1e-12);
      x += p[0] / 3;
    }
    if (!at_corner && fields.von_mises[cell] > best) {
      best = fields.von_mises[cell];
      best_x = x;
    }
  }
  EXPECT_LT(best_x, 0.005);
}

// The debug build, ten times slower, takes the coarser mesh only.
#ifdef NDEBUG
INSTANTIATE_TEST_SUITE_P(Cells, Paper, ::testing::Values(64, 128));
#else
INSTANTIATE_TEST_SUITE_P(Cells, Paper, ::testing::Values(64));
#endif

TEST(Run, OneFactorisationServesAllStepsAndTheSummarySaysWhereTheTimeWent) {
  const nlohmann::json summary = RunCase(conductive, {"mesh.box.cells=[16,16]"}).summary();
  EXPECT_EQ(summary["factorisations"], 1);
  EXPECT_EQ(summary["negative_pivots"], summary["sizes"]["electric_and_thermal_unknowns"]);
  EXPECT_LT(summary["backward_error"], 1e-12);
  for (const char *stage : {"mesh", "assemble", "analyse", "factorise", "condense", "output"})
    EXPECT_TRUE(summary["seconds"][stage].is_number()) << stage;
  EXPECT_TRUE(summary["seconds"]["step"]["per_step"].is_number());
}

TEST(Run, TheResolvedCaseReproducesTheRunToTheByte) {
  const RunCase first(conductive, {"mesh.box.cells=[12,12]"});
  const RunCase again(casefile::read_file(first.folder() / "resolved.toml"));
  for (const char *file : {"nodes.csv", "contact.csv", "history.csv", "resolved.toml"})
    EXPECT_EQ(output::content_of(first.folder() / file), output::content_of(again.folder() / file))
        << file;
}

TEST(Run, AFailedSolveSaysWhereAndWhyAndKeepsTheStepsBefore) {
  const casefile::Case asked = casefile::read_file(
      std::filesystem::path(TOURMALINE_SOURCE_DIR) / conductive,
      {"mesh.box.cells=[12,12]", "solver.max_iterations=1", "output.fields=false",
       "boundary[2].traction=[0,\"if(t>0.155, -300*sin(100*t), -0.5*t)\"]"});
  const auto folder = std::filesystem::temp_directory_path() / "tourmaline-failed-solve";
  try {
    run::simulate(asked, folder, {.quiet = true});
    FAIL() << "one iteration sufficed";
  } catch (const SolveError &error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("did not converge at t = "), std::string::npos) << text;
    EXPECT_NE(text.find("solver.max_iterations"), std::string::npos) << text;
  }
  EXPECT_GE(read_table(folder / "history.csv").n_rows(), 1u);
  EXPECT_FALSE(std::filesystem::exists(folder / "summary.json"));
  std::filesystem::remove_all(folder);
}

TEST(ThreeDimensions, AnExtrudedBodyHeldInPlaneStrainGivesTheAnswerOfTwoDimensions) {
  const std::string material = R"(
[material]
library = "BaTiO3-Liu2014"
pyroelectric = )";
  const std::string conditions = R"(
[time]
end = 0.2
steps = 5
[[boundary]]
on = "right"
displacement = DISPLACEMENT
potential = 0
temperature = 0
[[boundary]]
on = ["bottom", "top"]
temperature = 0
[[boundary]]
on = "top"
traction = TRACTION
[contact]
on = "left"
friction = { law = "tresca", bound = 5 }
heat = { law = "exchange", coefficient = 1, foundation_temperature = -27 }
[output]
fields = false
)";
  const auto with = [](std::string text, const std::string &displacement,
                       const std::string &traction) {
    text.replace(text.find("DISPLACEMENT"), 12, displacement);
    text.replace(text.find("TRACTION"), 8, traction);
    return text;
  };
  const RunCase plane(casefile::read_text(
      "[mesh]\nbox = { min = [0,0], max = [0.1,0.1], cells = [6,6], cell = \"quadrilateral\" }" +
          material + "[0, 1e-4]" + with(conditions, "[0,0]", "[0, \"-0.5*t\"]"),
      "plane"));
  const RunCase solid(casefile::read_text(
      "[mesh]\nbox = { min = [0,0,0], max = [0.1,0.03,0.1], cells = [6,2,6], cell = \"hexahedron\" "
      "}" +
          material + "[0, 0, 1e-4]" + with(conditions, "[0,0,0]", "[0, 0, \"-0.5*t\"]") +
          "[[boundary]]\non = [\"front\", \"back\"]\ndisplacement = [\"free\", 0, \"free\"]\n",
      "solid"));
  const Table flat = plane.nodes(), thick = solid.nodes();
  std::map<std::pair<long, long>, std::size_t> at;
  const auto key = [](double x, double y) {
    return std::make_pair(std::lround(x * 1e6), std::lround(y * 1e6));
  };
  for (std::size_t i = 0; i < flat.n_rows(); ++i)
    at[key(flat.numbers("x")[i], flat.numbers("y")[i])] = i;
  const std::vector<std::pair<std::string, std::string>> columns{
      {"u_x", "u_x"}, {"u_y", "u_z"}, {"potential", "potential"}, {"temperature", "temperature"}};
  const std::vector<double> x = thick.numbers("x"), z = thick.numbers("z");
  for (const auto &[two, three] : columns) {
    const std::vector<double> a = flat.numbers(two), b = thick.numbers(three);
    for (std::size_t i = 0; i < b.size(); ++i)
      ASSERT_NEAR(b[i], a[at.at(key(x[i], z[i]))], 1e-10 * largest(a)) << two;
  }
  EXPECT_LT(largest(thick.numbers("u_y")), 1e-10 * largest(thick.numbers("u_x")));
}

TEST(ThreeDimensions, TetrahedraSlideOnABlockWithTheRightInertia) {
  const RunCase run(casefile::read_text(R"(
[mesh]
box = { min = [0,0,0], max = [0.1,0.1,0.1], cells = [4,4,4], cell = "tetrahedron" }
[material]
library = "BaTiO3-Liu2014"
[time]
end = 0.1
steps = 3
[[boundary]]
on = "top"
displacement = ["1e-9*t", "2e-9*t", "-1e-9*t"]
potential = 0
temperature = 0
[contact]
on = "bottom"
friction = { law = "tresca", bound = 10 }
[output]
fields = false
)",
                                        "block"));
  const nlohmann::json summary = run.summary();
  EXPECT_EQ(summary["negative_pivots"], summary["sizes"]["electric_and_thermal_unknowns"]);
  const Table contact = run.contact();
  const std::vector<double> tx = contact.numbers("tangential_traction_x"),
                            ty = contact.numbers("tangential_traction_y"),
                            normal = contact.numbers("normal_displacement"),
                            rate = contact.numbers("slip_rate");
  std::size_t slipping = 0;
  for (std::size_t i = 0; i < tx.size(); ++i) {
    const double size = std::hypot(tx[i], ty[i]);
    EXPECT_LE(size, 10 * (1 + 1e-9));
    EXPECT_EQ(normal[i], 0);
    if (contact.columns.at("status")[i] == "slip") {
      EXPECT_NEAR(size, 10, 1e-8);
      ++slipping;
    } else {
      EXPECT_EQ(rate[i], 0);
    }
  }
  EXPECT_GT(slipping, 0u);
}

}  // namespace
}  // namespace tourmaline::verified
