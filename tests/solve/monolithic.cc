#include "solve/monolithic_route.h"

#include <gtest/gtest.h>

#include <random>
#include <regex>

#include "../cases/partly_held.h"
#include "../cases/run_case.h"
#include "solve/saddle_system.h"
#include "tourmaline/case/case.h"
#include "tourmaline/error.h"

namespace tourmaline::solve {
namespace {

using contact::AugmentedLagrangian;
using contact::Local;
using contact::LocalMatrix;
using contact::Tresca;
using verified::Table;

// A block clamped on the right and pulled along its contact on the left, where some nodes stick and
// others slip; in 3D in both tangential directions.
constexpr const char *plane = R"toml(
mesh.box = { min = [0, 0], max = [0.1, 0.1], cells = [8, 8] }
material = { library = "BaTiO3-Liu2014", pyroelectric = [0, 1e-4] }
time = { end = 0.1, steps = 5 }
boundary = [
  { on = "right", displacement = [0, 0], potential = 0, temperature = 0 },
  { on = ["bottom", "top"], temperature = 0 },
  { on = "top", traction = ["30*t", "-100*t"] } ]
contact = { on = "left", friction = { law = "tresca", bound = 15 }, heat = { law = "exchange", coefficient = 1, foundation_temperature = -27 } }
output = { fields = false, report = false }
)toml";

constexpr const char *block = R"toml(
mesh.box = { min = [0, 0, 0], max = [0.1, 0.1, 0.1], cells = [3, 3, 3], cell = "tetrahedron" }
material = { library = "BaTiO3-Liu2014", pyroelectric = [0, 0, 1e-4] }
time = { end = 0.1, steps = 5 }
boundary = [
  { on = "right", displacement = [0, 0, 0], potential = 0, temperature = 0 },
  { on = "top", temperature = 0 },
  { on = "top", traction = ["20*t", "80*sin(40*t)", "-100*t"] } ]
contact = { on = "left", friction = { law = "tresca", bound = 100 }, heat = { law = "exchange", coefficient = 1, foundation_temperature = -27 } }
output = { fields = false, report = false }
)toml";

// A ring pressed on a shaft and turned, so that normals and directions of slip go all around.
constexpr const char *ring = R"toml(
mesh.annulus = { inner = 0.02, outer = 0.04, cells = [3, 20] }
material = { library = "BaTiO3-Liu2014", pyroelectric = [0, 1e-4] }
time = { end = 1, steps = 5 }
boundary = [
  { on = "outer", displacement = ["-1e-8*x*t - 4e-8*y*sin(4*t)", "-1e-8*y*t + 4e-8*x*sin(4*t)"] },
  { on = "outer", potential = 0, temperature = 0 } ]
contact = { on = "inner", friction = { law = "tresca", bound = 1000 }, heat = { law = "exchange", coefficient = 1, foundation_temperature = -27 } }
output = { fields = false, report = false }
)toml";

// The same in space, pulled along the shaft as well.
const std::string sleeve =
    std::regex_replace(std::string(ring), std::regex("cells = \\[3, 20\\] \\}"),
                       "height = 0.02, cells = [2, 12, 2], cell = \"tetrahedron\" }");
const std::vector<std::string> pulled{
    "material.pyroelectric=[0,0,1e-4]",
    "boundary[0].displacement=['-1e-8*x*t - 4e-8*y*sin(4*t)', '-1e-8*y*t + 4e-8*x*sin(4*t)', "
    "'1e-9*t']"};

using Overrides = std::vector<std::string>;

casefile::Case asked(const std::string &text, const Overrides &overrides) {
  return casefile::read_text(text, "case.toml", overrides);
}

Overrides with(Overrides overrides, const Overrides &more) {
  overrides.insert(overrides.end(), more.begin(), more.end());
  return overrides;
}

const Overrides monolithic = {"solver.method=monolithic"};
const Overrides piecewise_constant = {"solver.method=monolithic",
                                      "solver.multiplier=piecewise-constant"};

double slip_size(const Table &contact) {
  double size = 0;
  for (const char *column : {"slip_x", "slip_y", "slip_z"})
    if (contact.columns.contains(column))
      size = std::max(size, verified::largest(contact.numbers(column)));
  return size;
}

void expect_equal_columns(const Table &ours, const Table &theirs, double tolerance) {
  for (const auto &[column, cells] : theirs.columns)
    if (column != "status") {
      // On a curved side u_nu, and the gap, is the round-off of u.nu, and nothing that it could be
      // measured by.
      const bool is_normal = column == "normal_displacement" || column == "gap";
      const double size = is_normal ? slip_size(theirs) : 0;
      EXPECT_LT(difference(ours, theirs, column, size), tolerance) << column;
    }
}

void expect_equal_runs(const verified::RunCase &ours, const verified::RunCase &theirs) {
  // 1e-9: two solutions of one system by different eliminations, whose condition is about 1e4.
  expect_equal_columns(ours.nodes(), theirs.nodes(), 1e-9);
  ASSERT_EQ(exists(ours.folder() / "contact.csv"), exists(theirs.folder() / "contact.csv"));
  if (!exists(theirs.folder() / "contact.csv"))
    return;
  expect_equal_columns(ours.contact(), theirs.contact(), 1e-9);
  EXPECT_EQ(ours.contact().columns.at("status"), theirs.contact().columns.at("status"));
}

struct Variant {
  std::string name, text;
  Overrides overrides;
};

void PrintTo(const Variant &variant, std::ostream *out) {
  *out << variant.name;
}

class BothRoutes : public ::testing::TestWithParam<Variant> {};

TEST_P(BothRoutes, GiveTheSameFieldsTractionsAndStatuses) {
  const auto &[name, text, overrides] = GetParam();
  const verified::RunCase newton(asked(text, with(overrides, monolithic)));
  const verified::RunCase condensed(asked(text, overrides));
  expect_equal_runs(newton, condensed);
  // What supports bear at prescribed components is no error of the solution.
  for (const verified::RunCase *run : {&newton, &condensed})
    EXPECT_LT(run->summary()["backward_error"], 1e-12);
}

const std::string bottom_moves_along = "boundary[1].displacement=['free','-1e-10*t']";
const std::string bottom_moves_across = "boundary[1].displacement=['1e-10*t','free']";
const std::string bottom_only = "boundary[1].on='bottom'";
const std::string insulated = "contact.heat={law='insulated'}";

// Nodes of the bore that the top holds at rest stand off their foundation by the gap.
constexpr const char *sleeve_with_gap = R"toml(
mesh.annulus = { inner = 0.5, outer = 1, height = 0.8, cells = [3, 12, 2], cell = "hexahedron" }
model = { thermal = false, electric = false }
material.library = "steel"
time = { end = 1, steps = 1 }
boundary = [ { on = "outer", traction = [1e9, 0, 0] }, { on = "top", displacement = [0, 0, 0] } ]
contact = { on = "inner", gap = 1e-6, friction = { law = "tresca", bound = 1e6 } }
output = { fields = false, report = false }
)toml";

const std::string without_contact = std::regex_replace(plane, std::regex("\ncontact = [^\n]*"), "");

INSTANTIATE_TEST_SUITE_P(
    Cases, BothRoutes,
    ::testing::Values(
        Variant{"Plane", plane, {}}, Variant{"Insulated", plane, {insulated}},
        Variant{"SmallBound", plane, {"contact.friction.bound=0.02"}},
        Variant{"Frictionless", plane, {"contact.friction={law='none'}"}},
        Variant{"WithoutContact", without_contact, {}},
        Variant{"QuadraticQuadrilaterals", plane, {"mesh.box.cell=quadrilateral", "mesh.degree=2"}},
        Variant{"EndHeldAlongTheContact", plane, {bottom_only, bottom_moves_along}},
        Variant{"EndHeldAcrossTheContact", plane, {bottom_only, bottom_moves_across}},
        Variant{"EndHeldAcrossAndLoadedThere",
                plane,
                {bottom_only, bottom_moves_across, "load.force=['1e4*t', 0]"}},
        Variant{"Tetrahedra", block, {}}, Variant{"Hexahedra", block, {"mesh.box.cell=hexahedron"}},
        Variant{"PlaneBetweenRollers", verified::plane_between_rollers, {}},
        Variant{"QuarterBlock", verified::quarter_block, {}},
        Variant{"Rollers", verified::rollers, {}}, Variant{"SleeveWithGap", sleeve_with_gap, {}},
        Variant{"SleeveWithRims", verified::rimmed_sleeve, {}}, Variant{"Ring", ring, {}},
        Variant{"RingOfQuadraticQuadrilaterals",
                ring,
                {"mesh.annulus.cell=quadrilateral", "mesh.degree=2"}},
        Variant{"SleeveOfTetrahedra", sleeve, pulled},
        Variant{"SleeveOfHexahedra", sleeve, with(pulled, {"mesh.annulus.cell=hexahedron"})}),
    [](const auto &variant) { return variant.param.name; });

TEST(Monolithic, TheAnswerDoesNotDependOnROverSixDecades) {
  const verified::RunCase condensed(asked(plane, {}));
  // Around c / L = 1.6e11 / 0.1 N/m^3, and that times the step of 0.02 s.
  for (const char *decade : {"e9", "e10", "e11", "e12", "e13", "e14", "e15"}) {
    SCOPED_TRACE(decade);
    const std::string r = std::string("1.6") + decade, r_tau = std::string("0.032") + decade;
    const verified::RunCase run(asked(plane, {"solver.method=monolithic", "solver.r_normal=" + r,
                                              "solver.r_tangential=" + r_tau}));
    expect_equal_runs(run, condensed);
  }
}

// In these two Newton's method alone does not converge whatever r is (docs/monolithic.md).
TEST(Monolithic, WhereNewtonAloneCyclesTheMethodOfMultipliersLeadsToTheAnswer) {
  for (const char *folder : {"box-offset-13x24-xload", "n20x28-initial-all"}) {
    SCOPED_TRACE(folder);
    const auto file = std::filesystem::path(TOURMALINE_SOURCE_DIR) / "tests" / "reference" /
                      "third" / folder / "case.toml";
    // The first three steps; it is the second in which Newton cycles.
    const Overrides start = {"output.fields=false", "time.end=0.03", "time.steps=3"};
    expect_equal_runs(verified::RunCase(casefile::read_file(file, with(start, monolithic))),
                      verified::RunCase(casefile::read_file(file, start)));
  }
}

TEST(Monolithic, WhatSticksIsExactlyWhereItWas) {
  for (const char *text : {plane, block}) {
    const verified::RunCase run(asked(text, with(monolithic, {"contact.friction.bound=1e6"})));
    EXPECT_EQ(slip_size(run.contact()), 0);
    EXPECT_EQ(verified::largest(run.contact(), "normal_displacement"), 0);
  }
}

TEST(Monolithic, EveryIterationFactorisesOnce) {
  const verified::RunCase run(asked(plane, monolithic));
  const nlohmann::json summary = run.summary();
  EXPECT_GT(summary["iterations"]["newton_total"], 5);
  EXPECT_EQ(summary["factorisations"], summary["iterations"]["newton_total"]);
}

TEST(Monolithic, WithoutEnoughIterationsItSaysWhenWhereAndWhatToTry) {
  const casefile::Case c = asked(plane, with(monolithic, {"solver.max_iterations=1"}));
  try {
    const verified::RunCase run(c);
    FAIL() << "converged";
  } catch (const SolveError &error) {
    for (const char *part : {"t = 0.02 s", "after 1 iterations", "contact points are unsettled",
                             "solver.max_iterations"})
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
  }
}

TEST(PiecewiseConstantMultipliers, LeaveNoMeanNormalDisplacementOnAnyFacet) {
  const verified::RunCase run(asked(plane, piecewise_constant));
  const Table contact = run.contact();
  const std::vector<double> normal = contact.numbers("normal_displacement");
  const double size = verified::largest(run.nodes().numbers("u_x"));
  constexpr std::size_t nodes = 9;
  for (std::size_t i = 0; i + 1 < normal.size(); ++i)
    if (i % nodes + 1 < nodes) {  // two ends of one facet, in one step
      EXPECT_LT(std::abs(normal[i] + normal[i + 1]) / 2, 1e-12 * size);
    }
  // Only the means vanish; docs/monolithic.md.
  EXPECT_GT(verified::largest(normal), 1e-3 * size);
}

TEST(PiecewiseConstantMultipliers, WorkOnTheSquareFacetsOfHexahedra) {
  const verified::RunCase run(asked(block, with(piecewise_constant, {"mesh.box.cell=hexahedron"})));
  const verified::RunCase nodal(asked(block, {"mesh.box.cell=hexahedron"}));
  // Two discretisations of one problem on three cells: the same potential within a fifth.
  EXPECT_LT(difference(run.nodes(), nodal.nodes(), "potential"), 0.2);
}

// Moved along the foundation far beyond the bound everything slips, and bears the bound.
TEST(PiecewiseConstantMultipliers, BearTheBoundAsFrictionWhereAllSlips) {
  const verified::RunCase run(
      asked(plane, with(piecewise_constant, {"boundary[0].displacement=[0,'1e-6*t']"})));
  const Table contact = run.contact();
  for (const std::string &status : contact.columns.at("status"))
    EXPECT_EQ(status, "slip");
  for (const double traction : contact.numbers("tangential_traction_y"))
    EXPECT_NEAR(std::abs(traction), 15, 1e-8);
  EXPECT_NEAR(std::abs(run.history().numbers("contact_force_y").back()), 15 * 0.1, 1e-9);
  // All slip to the same side, so the work is the bound's on the mean slip: nodes of 8 equal
  // facets.
  const std::vector<double> rates = contact.numbers("slip_rate");
  double work = 0;  // of the last step's 9 nodes
  for (std::size_t i = rates.size() - 9; i < rates.size(); ++i)
    work += 15 * 0.1 / 8 * rates[i] * (i == rates.size() - 9 || i + 1 == rates.size() ? 0.5 : 1);
  EXPECT_NEAR(run.history().numbers("friction_dissipation").back(), work, 1e-9 * work);
}

TEST(PiecewiseConstantMultipliers, AreRefusedWhereThereAreMoreThanDisplacements) {
  // 18 triangles share 16 nodes.
  EXPECT_THROW(verified::RunCase(asked(block, piecewise_constant)), CaseError);
}

TEST(PiecewiseConstantMultipliers, AreAnOptionOfThisRouteOnly) {
  EXPECT_THROW(asked(plane, {"solver.multiplier=piecewise-constant"}), CaseError);
}

// The contact operator at one point with a normal and two slips.
AugmentedLagrangian point(double bound) {
  AugmentedLagrangian law;
  law.r_normal = 5;
  law.r_slip = 2;
  law.friction = Tresca{bound};
  return law;
}

LocalMatrix joined(const Local &a, const Local &b) {
  LocalMatrix both(3, 2);
  both << a, b;
  return both;
}

// Columns: the derivatives of (traction, condition) in direction `e` of y, then of lambda.
void expect_hessian_is_the_derivative(const AugmentedLagrangian &law, const Local &y,
                                      const Local &lambda) {
  const auto h = law.hessian(y, lambda);
  constexpr double epsilon = 1e-6;
  for (int k = 0; k < 3; ++k) {
    const Local e = epsilon * Local::Unit(3, k);
    const auto up = law.gradient(y + e, lambda), down = law.gradient(y - e, lambda);
    const auto more = law.gradient(y, lambda + e), less = law.gradient(y, lambda - e);
    const LocalMatrix in_y = joined(up.traction - down.traction, up.condition - down.condition);
    const LocalMatrix in_lambda =
        joined(more.traction - less.traction, more.condition - less.condition);
    // 1e-8: the central difference's error is epsilon^2, its round-off 1e-16 / epsilon.
    EXPECT_LT((in_y / (2 * epsilon) - joined(h.displacement.col(k), h.mixed.row(k))).norm(), 1e-8);
    EXPECT_LT((in_lambda / (2 * epsilon) - joined(h.mixed.col(k), h.multiplier.col(k))).norm(),
              1e-8);
  }
}

TEST(AugmentedLagrangian, ItsHessianIsTheDerivativeOfItsGradientWhereThePointSticks) {
  const Local y(Eigen::Vector3d(0.1, 0.2, -0.3)), lambda(Eigen::Vector3d(4, 1, 2));
  ASSERT_EQ(point(3).status(y, lambda), ContactStatus::stick);
  expect_hessian_is_the_derivative(point(3), y, lambda);
}

TEST(AugmentedLagrangian, ItsHessianIsTheDerivativeOfItsGradientWhereThePointSlips) {
  const Local y(Eigen::Vector3d(0.1, 0.2, -0.3)), lambda(Eigen::Vector3d(4, 1, 2));
  ASSERT_EQ(point(0.5).status(y, lambda), ContactStatus::slip);
  expect_hessian_is_the_derivative(point(0.5), y, lambda);
}

TEST(AugmentedLagrangian, OnTheBoundItsHessianIsThatOfSticking) {
  const Local y(Eigen::Vector3d(0, 0, 0)), lambda(Eigen::Vector3d(4, 3, 4));
  const auto h = point(5).hessian(y, lambda);
  EXPECT_TRUE(h.mixed.isIdentity(0));
  EXPECT_TRUE(h.multiplier.isZero(0));
}

TEST(AugmentedLagrangian, VanishingConditionsAreTheContactConditionsWhateverR) {
  // Slip along (3, 4) / 5 at the bound 5: lambda_tau = S d / |d| and u_nu = 0.
  const Local y(Eigen::Vector3d(0, 0.6, 0.8)), lambda(Eigen::Vector3d(-7, 3, 4));
  for (const double r : {1e-3, 1., 1e3}) {
    AugmentedLagrangian law = point(5);
    law.r_slip = law.r_normal = r;
    const auto gradient = law.gradient(y, lambda);
    EXPECT_LT(gradient.condition.norm() * r, 1e-14 * (lambda.norm() + r));
    EXPECT_LT((gradient.traction - lambda).norm(), 1e-14 * (lambda.norm() + r));
  }
}

// The whole tangent, through its inverse: the residual changes by -r along the increment that
// belongs to r.
template <int dim>
void expect_tangent_is_the_derivative(const char *text, bool facets) {
  const Model<dim> model(asked(text, {}));
  const contact::IsPrescribed nothing(model.n_unknowns(), false);
  SaddleSystem<dim> system(model.op, model.step, model.prescribed,
                           facets ? contact::facet_multipliers(model.body, {"left"}, nothing)
                                  : contact::nodal_multipliers(model.interface, nothing),
                           {}, 1);
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  // Displacements (or forces) and multipliers (or displacements times area); potential and
  // temperature follow by the coupling.
  const auto draw = [&](double mechanical, double multiplier) {
    SaddlePoint x{std::vector<double>(model.n_unknowns()),
                  Eigen::VectorXd(static_cast<Eigen::Index>(system.n_multipliers()))};
    for (std::size_t i = 0; i < x.body.size(); ++i)
      if (system.is_free(i) && i % body::Fields<dim>::count < dim)
        x.body[i] = mechanical * normal(random);
    for (double &value : x.multipliers)
      value = multiplier * normal(random);
    return x;
  };
  const std::vector<double> zero(model.n_unknowns(), 0.);
  std::vector<AugmentedLagrangian> laws(system.points().size(), point(3));
  for (AugmentedLagrangian &law : laws)
    law.r_normal = law.r_slip = 1e12;
  const StepData data{zero, zero, zero, laws};
  const SaddlePoint x = draw(1e-12, 2);
  system.factorise(data, x);
  const double force = 1e-4, condition = 1e-17;
  const SaddlePoint r = draw(force, condition);
  const SaddlePoint step = system.increment(r);
  const auto moved = [&](double factor) {
    SaddlePoint y = x;
    for (std::size_t i = 0; i < y.body.size(); ++i)
      y.body[i] += factor * step.body[i];
    y.multipliers += factor * step.multipliers;
    return system.residual(data, y);
  };
  constexpr double epsilon = 1e-3;
  const SaddlePoint up = moved(epsilon), down = moved(-epsilon);
  double worst = 0;
  for (std::size_t i = 0; i < r.body.size(); ++i)
    worst = std::max(worst, std::abs((up.body[i] - down.body[i]) / (2 * epsilon) + r.body[i]));
  EXPECT_LT(worst, 1e-6 * force);
  const Eigen::VectorXd conditions = (up.multipliers - down.multipliers) / (2 * epsilon);
  EXPECT_LT((conditions + r.multipliers).cwiseAbs().maxCoeff(), 1e-6 * condition);
}

TEST(SaddleSystem, ItsTangentIsTheDerivativeOfItsResidual) {
  expect_tangent_is_the_derivative<2>(plane, false);
  expect_tangent_is_the_derivative<2>(plane, true);
  expect_tangent_is_the_derivative<3>(block, false);
}

}  // namespace
}  // namespace tourmaline::solve
