// Bodies whose equations round-off decides: the right number, or none.

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "equal_quantities.h"
#include "run_case.h"
#include "tourmaline/case/case.h"
#include "tourmaline/error.h"

namespace tourmaline::verified {
namespace {

const std::string beam = "tests/cases/ill_conditioned/beam.toml";

double tip(const RunCase &run) {
  const Table nodes = run.nodes();
  return nodes.numbers("u_y").front();
}

// u_y at the end of a beam of length L = 1 m and height h: -4 q h L^3 / (E h^3) by bending, 3/5 h^2
// more by shear. Of that 40 quadratic cells of length l lack 1/(4 40^2) where they cannot shear: in
// them the moment is constant then. What they shear by gives 1/(1 + l^2/(12 h^2)) of it back.
double deflection(double thickness) {
  const double square = thickness * thickness, lacks = 1. / 6400 / (1 + 12 * 1600 * square);
  return -4 * 1e-6 / (1e9 * square) * (1 + 0.6 * square - lacks);
}

std::string thick(double thickness) {
  return "mesh.box.max=[1," + std::to_string(thickness * 1e6) + "e-6]";
}

/// What the run says when it fails; empty when it does not.
std::string failure(const std::string &file, const std::vector<std::string> &overrides) {
  try {
    RunCase(file, overrides);
  } catch (const SolveError &error) {
    return error.what();
  }
  return "";
}

class Thickness : public ::testing::TestWithParam<double> {};

TEST_P(Thickness, RefinedCantileverBendsAsItShould) {
  const RunCase run(beam, {thick(GetParam())});
  // Not tighter than 2 % of the shear: two quadratic cells in the height see its parabola as a
  // broken line.
  const nlohmann::json summary = run.summary();
  const double error = summary["forward_error"];
  EXPECT_NEAR(tip(run) / deflection(GetParam()), 1,
              1e-8 + 10 * error + 0.06 * GetParam() * GetParam());
  EXPECT_TRUE(summary["refined"]);
  // Of the thinnest it depends on MUMPS and on the processor on which side of a warning it is.
  EXPECT_LT(error, GetParam() > 1e-5 ? 1e-8 : 3e-6);
  EXPECT_EQ(error > 1e-6, !summary["warnings"].empty());
  EXPECT_LT(std::abs(run.history().numbers("energy_imbalance").back()), 1e-6);
}

TEST_P(Thickness, WithoutRefinementNoWrongNumberPassesInSilence) {
  const std::vector<std::string> overrides{thick(GetParam()), "solver.method=\"monolithic\""};
  if (!failure(beam, overrides).empty()) {
    EXPECT_LE(GetParam(), 1e-3);
    EXPECT_THAT(failure(beam, overrides), ::testing::HasSubstr("forward error"));
    return;
  }
  const RunCase run(beam, overrides);
  const double error = std::abs(tip(run) / deflection(GetParam()) - 1);
  const nlohmann::json summary = run.summary();
  EXPECT_LT(error, std::max(1e-6, 10 * summary["forward_error"].get<double>()));
  EXPECT_EQ(summary["forward_error"] > 1e-6, !summary["warnings"].empty());
}

INSTANTIATE_TEST_SUITE_P(OfABeamOfOneMetre, Thickness,
                         ::testing::Values(1. / 300, 1e-3, 3e-4, 1e-4, 1e-5));

const std::string held_beam = "tests/cases/ill_conditioned/held_beam.toml";

double largest_tip(const RunCase &run) {
  const std::vector<double> all = run.nodes().numbers("u_y");
  return *std::max_element(all.begin(), all.end());
}

// What is warm first says nothing of what bends later.
TEST(LateLoad, BendsARefinedBeamAsItDoesFromTheStart) {
  const RunCase first(held_beam, {"time.steps=1"});
  const RunCase late(held_beam, {"time.steps=2", "boundary[0].temperature=\"t\"",
                                 "boundary[1].traction=[0, \"if(t > 0.6, 1, 0)\"]"});
  EXPECT_TRUE(late.summary()["refined"]);
  EXPECT_THAT(late.summary()["warnings"], ::testing::IsEmpty());
  EXPECT_NEAR(largest_tip(late) / largest_tip(first), 1, 1e-9);
}

class HeldLoad : public ::testing::TestWithParam<const char *> {};

// From the second step on nothing moves but round-off.
TEST_P(HeldLoad, LacksNoEnergyOnAThinBeam) {
  const std::string thickness = std::string("mesh.box.max=[1, ") + GetParam() + "]";
  const RunCase once(held_beam, {thickness, "time.steps=1"}), held(held_beam, {thickness});
  EXPECT_THAT(held.summary()["warnings"], ::testing::IsEmpty());
  EXPECT_NEAR(largest_tip(held) / largest_tip(once), 1, 1e-9);
}

INSTANTIATE_TEST_SUITE_P(OfManyThicknesses, HeldLoad,
                         ::testing::Values("2e-3", "1.3e-3", "1e-3", "7e-4", "3e-4", "1e-4"));

TEST(WellConditioned, BodyThatOnlyMovesLacksNothing) {
  for (const char *method : {"solver.method=\"condensed\"", "solver.method=\"monolithic\""})
    EXPECT_TRUE(
        RunCase("tests/cases/ill_conditioned/moved.toml", {method}).summary()["warnings"].empty())
        << method;
}

TEST(IllConditioned, FrictionalEndOfAThinPlateFailsWithTheReason) {
  EXPECT_THAT(failure("tests/cases/ill_conditioned/contact.toml", {}),
              ::testing::HasSubstr("very thin"));
}

// Of the body alone the error is 1e-12. Thinner by ten, nothing is left of the slips.
TEST(IllConditioned, FrictionalEndOfAPlateTellsTheErrorOfItsSlips) {
  const RunCase run("tests/cases/ill_conditioned/contact.toml", {"mesh.box.max=[1,1e-3]"});
  const nlohmann::json summary = run.summary();
  EXPECT_GT(summary["forward_error"], 1e-6);
  EXPECT_LT(summary["forward_error"], 1e-3);
}

/// A bar of three equal parts, pulled by 1000 N; the middle one is softer by 1e11. Its temperature,
/// nothing is coupled to, stores 1e5 times the energy of the deformation.
casefile::Case hot_bar(const std::vector<std::string> &overrides) {
  const auto part = [](const char *where, const char *young) {
    return std::string("[[region]]\nwhere = \"") + where +
           "\"\nmaterial = { symmetry = \"isotropic\", young = " + young +
           ", poisson = 0, eps11 = 10, k11 = 1, density = 1000, specific_heat = 1000, "
           "reference_temperature = 293 }\n";
  };
  return casefile::read_text(R"(
mesh.box = { min = [0, 0, 0], max = [3, 1, 1], cells = [6, 2, 2], cell = "hexahedron" }
time = { end = 1, steps = 2 }
output = { fields = false, report = false }
boundary = [
  { on = "left", displacement = [0, 0, 0], potential = 0, temperature = 1e4 },
  { on = "right", traction = ["1e3*t", 0, 0] },
]
)" + part("x < 1", "1e11") + part("x > 1 && x < 2", "1") +
                                 part("x > 2", "1e11"),
                             "bar.toml", overrides);
}

/// A plane bar of three equal squares, the middle one stiffer or more permittive by a factor,
/// pulled or under a voltage. There is nothing of the other fields.
casefile::Case uneven_bar(const std::string &factors, const std::string &right) {
  const auto part = [](const std::string &where, const std::string &constants) {
    return "[[region]]\nwhere = \"" + where + "\"\nmaterial = { symmetry = \"isotropic\", " +
           constants +
           ", poisson = 0, k11 = 1, density = 1000, specific_heat = 1000, reference_temperature = "
           "293 }\n";
  };
  return casefile::read_text(
      "mesh.box = { min = [0, 0], max = [3, 1], cells = [6, 2], cell = \"quadrilateral\" }\n"
      "time = { end = 1, steps = 1 }\noutput = { fields = false, report = false }\nboundary = [\n"
      "  { on = \"left\", displacement = [0, 0], potential = 0, temperature = 0 },\n"
      "  { on = \"right\", " +
          right + " },\n]\n" + part("x < 1", "young = 1e3, beta11 = 1e-10") +
          part("x > 1 && x < 2", factors) + part("x > 2", "young = 1e3, beta11 = 1e-10"),
      "bar.toml", {});
}

std::vector<std::string> warnings_of_accuracy(const RunCase &run) {
  std::vector<std::string> found;
  const nlohmann::json summary = run.summary();
  for (const auto &text : summary["warnings"].get<std::vector<std::string>>())
    if (text.find("certain") != std::string::npos)
      found.push_back(text);
  return found;
}

class PowerOfTen : public ::testing::TestWithParam<int> {};

TEST_P(PowerOfTen, StiffThirdOfABarIsRefinedAndItsMissingChargesLackNothing) {
  const std::string young = "young = 1e" + std::to_string(3 + GetParam());
  const RunCase run(uneven_bar(young + ", beta11 = 1e-10", "traction = [\"1e-6*t\", 0]"));
  EXPECT_NEAR(run.nodes().numbers("u_x").back() / (1e-9 * (2 + std::pow(10., -GetParam()))), 1,
              1e-12);
  EXPECT_THAT(warnings_of_accuracy(run), ::testing::IsEmpty());
}

TEST_P(PowerOfTen, PermittiveThirdOfABarIsRefinedAndItsMissingForcesLackNothing) {
  const std::string beta = "beta11 = 1e" + std::to_string(-10 + GetParam());
  const RunCase run(uneven_bar("young = 1e3, " + beta, "potential = 1"));
  const double charge = std::abs(run.history().numbers("charge_right").back());
  EXPECT_NEAR(charge / (1e-10 / (2 + std::pow(10., -GetParam()))), 1, 1e-12);
  EXPECT_THAT(warnings_of_accuracy(run), ::testing::IsEmpty());
}

INSTANTIATE_TEST_SUITE_P(OfUnevenBars, PowerOfTen, ::testing::Values(8, 10, 12, 14, 15));

TEST(IllConditioned, SoftThirdOfAHotBarIsRefinedIteratively) {
  const RunCase run(hot_bar({"solver.body=\"iterative\""}));
  EXPECT_NEAR(run.nodes().numbers("u_x").back(), 1e3 * (1 + 2e-11), 1e3 * 1e-12);
  for (const char *lateral : {"u_y", "u_z"})
    EXPECT_LT(largest(run.nodes(), lateral), 1e3 * 1e-11);
  const nlohmann::json summary = run.summary();
  EXPECT_TRUE(summary["refined"]);
  EXPECT_LT(summary["forward_error"], 1e-10);
  EXPECT_THAT(summary["warnings"].dump(), ::testing::Not(::testing::HasSubstr("certain")));
}

TEST(IllConditioned, HeatHidesNoLackOfMechanicalEnergy) {
  const nlohmann::json summary = RunCase(hot_bar({"solver.method=\"monolithic\""})).summary();
  EXPECT_THAT(summary["warnings"].dump(), ::testing::HasSubstr("the balance of energy lacks"));
}

TEST(WellConditioned, BodyOfThePaperIsSolvedIterativelyWithoutRefinement) {
  const nlohmann::json summary = RunCase("cases/ouafik-2020/conductive.toml",
                                         {"mesh.box.cells=[8,8]", "solver.body=\"iterative\""})
                                     .summary();
  EXPECT_FALSE(summary["refined"]);
  EXPECT_LT(summary["forward_error"], 1e-9);
  EXPECT_TRUE(summary["warnings"].empty());
}

TEST(WellConditioned, BodyOfThePaperIsNotRefinedAndSaysNothing) {
  const nlohmann::json summary =
      RunCase("cases/ouafik-2020/conductive.toml", {"mesh.box.cells=[8,8]"}).summary();
  EXPECT_FALSE(summary["refined"]);
  EXPECT_LT(summary["forward_error"], 1e-10);
  EXPECT_TRUE(summary["warnings"].empty());
}

// Forces around the contact are far below those inside the body; Coulomb's law settles by its own.
TEST(StiffnessContrast, CoulombContactOfTheSofterPartsIsThatOfTheCondensedRoute) {
  const auto run = [](const char *solver) {
    return run_text(R"toml(
mesh.box = { min = [0, 0], max = [0.3, 0.1], cells = [9, 3], cell = "quadrilateral" }
time = { end = 1, steps = 3 }
boundary = [ { on = "left", displacement = [0, 0], potential = 0, temperature = 0 },
             { on = "right", traction = ["1e3*t", "-1e3*t"] } ]
contact = { on = "bottom", normal = "unilateral", friction = { law = "coulomb", coefficient = 0.3 } }
[[region]]
where = "x > 0.1 && x < 0.2"
material = { symmetry = "isotropic", young = 1e11, poisson = 0.3, eps11 = 10, k11 = 1, density = 1000, specific_heat = 1000, reference_temperature = 293 }
[[region]]
where = "x <= 0.1 || x >= 0.2"
material = { symmetry = "isotropic", young = 1e3, poisson = 0.3, eps11 = 10, k11 = 1, density = 1000, specific_heat = 1000, reference_temperature = 293 }
)toml",
                    {solver});
  };
  const RunCase condensed = run("solver.method=condensed"),
                monolithic = run("solver.method=monolithic");
  EXPECT_GT(condensed.history().numbers("slip").back(), 0);
  // The contrast takes eight of sixteen digits.
  expect_equal_quantities(
      monolithic.contact(), condensed.contact(),
      {{"normal_displacement"}, {"slip_x"}, {"normal_traction"}, {"tangential_traction_x"}}, 1e-6);
}

class NotFinite : public ::testing::TestWithParam<std::string> {};

TEST_P(NotFinite, StepFailsAndNothingOfItIsWritten) {
  const output::TemporaryFolder folder;
  const std::filesystem::path file =
      std::filesystem::path(TOURMALINE_SOURCE_DIR) / "tests/cases/ill_conditioned/overflow.toml";
  casefile::Case asked = casefile::read_file(file, {GetParam()}, mesh::read_mesh_file);
  // More than a case file may ask for.
  asked.boundaries[1].traction =
      casefile::FormulaVector{casefile::Formula(0.), casefile::Formula("-1e308*t")};
  EXPECT_THROW(run::simulate(asked, folder.path(), {.quiet = true}), SolveError);
  EXPECT_FALSE(std::filesystem::exists(folder / "summary.json"));
  EXPECT_FALSE(std::filesystem::exists(folder / "result_0001.vtu"));
}

INSTANTIATE_TEST_SUITE_P(Routes, NotFinite,
                         ::testing::Values("solver.method=\"condensed\"",
                                           "solver.method=\"monolithic\"",
                                           "solver.body=\"iterative\""));

}  // namespace
}  // namespace tourmaline::verified
