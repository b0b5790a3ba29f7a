// Contact that opens and friction that follows the pressure, with the body's equations solved
// iteratively: the same states, tractions and statuses as by the factorisation, in every column.

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "closed_balances.h"
#include "contact_status.h"
#include "leaning_body.h"
#include "rubbed_block.h"
#include "run_case.h"
#include "tourmaline/case/case.h"
#include "tourmaline/error.h"

namespace tourmaline::verified {
namespace {

using Overrides = std::vector<std::string>;

// Columns of one kind share their size: a component of a vector may be nothing but round-off.
std::string kind_of(const std::string &column) {
  const auto has = [&](const char *part) { return column.find(part) != std::string::npos; };
  if (has("traction") || has("bound"))
    return "traction";
  if (has("slip_rate"))
    return "rate";
  return has("slip") || has("gap") || has("displacement") || has("u_") ? "length" : column;
}

// What is smaller than this in all rows, in SI units, is round-off beside what these cases do.
constexpr double nothing = 1e-9;

void expect_same(const Table &expected, const Table &found, double tolerance) {
  const std::vector<std::string> not_compared{"step", "time", "x", "y", "z", "status"};
  std::map<std::string, double> sizes;
  for (const auto &[name, cells] : expected.columns)
    if (std::find(not_compared.begin(), not_compared.end(), name) == not_compared.end())
      sizes[kind_of(name)] = std::max(sizes[kind_of(name)], largest(expected, name));
  for (const auto &[name, cells] : expected.columns) {
    if (std::find(not_compared.begin(), not_compared.end(), name) != not_compared.end())
      continue;
    const double size = sizes[kind_of(name)];
    const double least = kind_of(name) == "length" || kind_of(name) == "rate" ? 0 : nothing;
    EXPECT_LE(difference(found, expected, name, std::max(size, least)), tolerance) << name;
  }
}

void expect_same_runs(const RunCase &expected, const RunCase &found, double tolerance = 1e-8) {
  expect_same(expected.nodes(), found.nodes(), tolerance);
  expect_same(expected.contact(), found.contact(), tolerance);
  EXPECT_EQ(expected.contact().columns.at("status"), found.contact().columns.at("status"));
}

struct Asked {
  std::string name;  // of a file, or of what `text` is
  Overrides overrides;
  std::string text;

  RunCase run(const Overrides &more) const {
    Overrides all = overrides;
    all.insert(all.end(), more.begin(), more.end());
    all.push_back("output.fields=false");
    return text.empty() ? RunCase(name, all) : RunCase(casefile::read_text(text, "case.toml", all));
  }
  RunCase iteratively() const {
    return run({"solver.body=iterative", "solver.linear_tolerance=1e-13"});
  }
};

void PrintTo(const Asked &asked, std::ostream *out) {
  *out << asked.name << " " << ::testing::PrintToString(asked.overrides);
}

class ContactIteratively : public ::testing::TestWithParam<Asked> {};

TEST_P(ContactIteratively, IsThatOfTheFactorisationInEveryColumn) {
  const RunCase found = GetParam().iteratively();
  expect_same_runs(GetParam().run({}), found);
  expect_closed_balances(found.history(), 1e-9);
}

INSTANTIATE_TEST_SUITE_P(
    ShippedCases, ContactIteratively,
    ::testing::Values(
        // At its end this body is unloaded: nothing is left to compare.
        Asked{"cases/verification/contact-compliance.toml", {"time.end=1.8", "time.steps=9"}, ""},
        Asked{"cases/verification/contact-damped.toml", {}, ""},
        Asked{"cases/verification/contact-capped-friction.toml", {}, ""},
        Asked{"cases/verification/contact-slip-weakening.toml", {}, ""},
        Asked{"cases/ssnv128/plate.toml", {"mesh.box.cells=[32,10]"}, ""},
        Asked{"cases/ssnv128/solid.toml", {"mesh.box.cells=[32,1,10]"}, ""},
        Asked{"cases/hertz/line.toml",
              {"mesh.box.cells=[24,24]", "mesh.box.grading={left=30,bottom=30}"},
              ""}));

// Pressed, pulled, rubbed and warmed; the foundation moves.
const char *const plane = R"toml(
mesh.box = { min = [0, 0], max = [0.02, 0.01], cells = [12, 6] }
material = { library = "BaTiO3-Liu2014", pyroelectric = [0, 1e-4] }
time = { end = 1, steps = 5 }
boundary = [
  { on = "top", displacement = ["3e-7*t", "1e-7*sin(6*t)"], potential = 0, temperature = "20*t" },
  { on = "right", traction = ["2e6*t", 0] } ]
[contact]
on = "bottom"
gap = "5e-8*sin(300*x)"
foundation_displacement = ["3e-7*sin(4*t)", "1e-7*t^2 + 1e-5*x*t"]
normal = "unilateral"
friction = { law = "coulomb", coefficient = 0.4 }
heat = { law = "exchange", coefficient = 2e4, foundation_temperature = "20*t" }
)toml";

const std::string compliance = "contact.normal={law='compliance',coefficient=1e14}";
const std::string damped = "contact.normal={law='damped',coefficient=1e13}";

INSTANTIATE_TEST_SUITE_P(
    Laws, ContactIteratively,
    ::testing::Values(
        Asked{"unilateral", {"contact.friction={law='none'}"}, plane},
        Asked{
            "stiff compliance",
            {"contact.normal={law='compliance',coefficient=1e18}", "contact.friction={law='none'}"},
            plane},
        Asked{"compliance of degree 2",
              {"contact.normal={law='compliance',coefficient=1e22,exponent=2}",
               "contact.friction={law='none'}"},
              plane},
        Asked{"damped", {damped, "contact.friction={law='none'}"}, plane},
        Asked{"Coulomb on a bilateral foundation", {"contact.normal=bilateral"}, plane},
        Asked{"Coulomb on a damped foundation", {damped}, plane},
        // Pressed all over: with cohesion a node that may open has two states of its own.
        Asked{"coefficient of time, cohesion and limit",
              {compliance,
               "contact.friction={law='coulomb',coefficient='0.3+0.2*sin(5*t)+x',cohesion=2e5,"
               "limit=3e7}",
               "contact.gap='-3e-7+5e-8*sin(300*x)'"},
              plane},
        Asked{"slip-rate",
              {"contact.friction={law='coulomb',coefficient={static=0.4,kinetic=0.3,speed=1e-6}}"},
              plane},
        Asked{
            "slip-weakening",
            {"contact.friction={law='coulomb',coefficient={static=0.4,kinetic=0.3,distance=1e-6}}"},
            plane},
        Asked{"quadratic elements", {"mesh.degree=2"}, plane},
        Asked{"partly prescribed side",
              {"boundary=[{on='top',displacement=['3e-7*t','1e-7*sin(6*t)'],potential=0},"
               "{on='left',displacement=['free',0]},{on='right',displacement=['2e-7*t','free']}]"},
              plane}));

// A tube on a shaft that turns and is not quite round: normals in all directions.
const char *const tube = R"toml(
mesh.annulus = { inner = 0.02, outer = 0.03, height = 0.01, cells = [2, 20, 2], cell = "hexahedron" }
material = { library = "BaTiO3-Liu2014" }
time = { end = 1, steps = 3 }
boundary = [ { on = "outer", displacement = ["2e-8*t", 0, 0], potential = 0, temperature = "-20*t" } ]
[contact]
on = "inner"
gap = "1e-8*sin(300*x) + 2e-6*z"
foundation_displacement = ["-1e-5*y*t", "1e-5*x*t", "1e-7*t"]
normal = "unilateral"
friction = { law = "coulomb", coefficient = 0.3 }
)toml";

INSTANTIATE_TEST_SUITE_P(
    Solids, ContactIteratively,
    ::testing::Values(Asked{"block", {}, rubbed_block},
                      Asked{"block of tetrahedra", {"mesh.box.cell=tetrahedron"}, rubbed_block},
                      Asked{"compliance and Tresca",
                            {"contact.normal={law='compliance',coefficient=1e14}",
                             "contact.friction={law='tresca',bound=1e5}"},
                            rubbed_block},
                      Asked{"tube", {}, tube}));

const std::string leaning = leaning_body(R"(time = { regime = "static", end = 2, steps = 8 })");

// In space it may turn about the normal as well.
const char *const leaning_solid = R"toml(
mesh.box = { min = [0, 0, 0], max = [0.1, 0.08, 0.1], cells = [3, 2, 3], cell = "hexahedron" }
material.library = "BaTiO3-Liu2014"
time = { end = 2, steps = 6 }
boundary = [
  { on = "right", traction = ["-2e3*(1 + t)", 0, 0], potential = 0, temperature = 0 },
  { on = "top", traction = ["-300*t", "200*sin(3*t)", "-700*sin(4*t)"] } ]
[contact]
on = "left"
foundation_displacement = ["2e-10*min(4*t, 1)", "6e-10*sin(2*t)", "3e-10*sin(3*t)"]
normal = "unilateral"
friction = { law = "coulomb", coefficient = 0.8 }
heat = { law = "exchange", coefficient = 100, foundation_temperature = -27 }
)toml";

// In such long steps its inertia holds the body by a part in 1e10 of its stiffness, and neighbours
// differ in size.
const char *const hardly_held = R"toml(
mesh.box = { min = [0, 0], max = [0.1, 0.1], cells = [3, 2], cell = "quadrilateral" }
material.library = "BaTiO3-Liu2014"
time = { regime = "dynamic", interval = [ { until = 0.7, steps = 3 }, { until = 2, steps = 3 } ] }
boundary = [
  { on = "right", traction = ["-2e3*(1 + t)", 0], potential = 0, temperature = 0 },
  { on = "top", traction = ["-500*t", "-700*sin(4*t)"] } ]
[contact]
on = "left"
foundation_displacement = ["5e-9*min(4*t, 1)*(1 - 1.2*max(t - 1.5, 0))", "1.5e-8*sin(2*t)"]
normal = { law = "compliance", coefficient = 1e13, exponent = 1.5 }
friction = { law = "coulomb", coefficient = 0.8 }
electric = { law = "exchange", coefficient = 1e-7, foundation_potential = 0 }
)toml";

INSTANTIATE_TEST_SUITE_P(
    HeldByTheirContact, ContactIteratively,
    ::testing::Values(
        Asked{"leaning", {}, leaning},
        Asked{"leaning, finer", {"mesh.box.cells=[10, 10]"}, leaning},
        Asked{"leaning, of degree 2", {"mesh.degree=2"}, leaning},
        Asked{"leaning on a foundation that yields",
              {"mesh.box.cells=[10, 10]", "contact.normal={law='compliance',coefficient=1e13}"},
              leaning},
        Asked{"leaning, with electrodes",
              {"electrode=[{name='e',on='bottom',resistor=1e8}]", "time.regime=quasistatic"},
              leaning},
        Asked{"leaning solid", {}, leaning_solid}, Asked{"hardly held", {}, hardly_held}));

TEST(EveryRoute, AgreesOnABodyThatIsWarmedRubbedAndLiftedOff) {
  for (const Asked &asked : {Asked{"plane", {}, plane}, Asked{"solid", {}, rubbed_block}}) {
    SCOPED_TRACE(asked.name);
    const RunCase condensed = asked.run({});
    expect_every_status(condensed.contact());
    expect_same_runs(condensed, asked.run({"solver.method=monolithic", "solver.tolerance=1e-12"}));
    expect_same_runs(condensed, asked.iteratively());
  }
}

// Nothing touches at first, so that the first tangent of the monolithic route is singular.
constexpr const char *above = R"toml(
mesh.box = {{ min = [0, 0], max = [0.02, 0.01], cells = [{}, 4], cell = "quadrilateral" }}
material = {{ library = "BaTiO3-Liu2014" }}
time = {{ end = 1, steps = 3 }}
boundary = [ {{ on = "top", traction = ["2.7e5*t", "-2.3e6*t"], potential = 0, temperature = 0 }}{} ]
[contact]
on = "bottom"
gap = "1.4e-3*(x - 0.01)^2 + 3.2e-8"
normal = "unilateral"
friction = {{ law = "{}" }}
)toml";

TEST(Monolithically, ContactThatIsOpenAtFirstIsFound) {
  const std::string slides = ", { on = \"left\", displacement = [0, \"free\"] }";
  for (const auto &[name, text] :
       {std::pair(std::string("frictionless"), fmt::format(above, 2, slides, "none")),
        std::pair(std::string("frictionless, fine"), fmt::format(above, 12, slides, "none")),
        std::pair(std::string("rubbed"), fmt::format(above, 8, "", "tresca\", bound = \"3e5"))}) {
    SCOPED_TRACE(name);
    const Asked asked{name, {}, text};
    expect_same_runs(asked.run({}), asked.run({"solver.method=monolithic"}));
  }
}

TEST(Monolithically, WhatLetsTheBodyGoIsNamed) {
  const Asked pulled{"pulled",
                     {"boundary.0.traction=[0,'1e5*t']"},
                     fmt::format(above, 4, "", "tresca\", bound = \"3e5")};
  EXPECT_THAT([&] { pulled.run({"solver.method=monolithic"}); },
              ::testing::ThrowsMessage<SolveError>(
                  ::testing::HasSubstr("nothing keeps the body from a translation along x")));
}

// With the bounds that the first step begins with, none, nothing holds it.
const char *const held_by_friction = R"toml(
mesh.box = { min = [0, 0], max = [0.1, 0.09], cells = [4, 4], cell = "quadrilateral" }
model = { thermal = false, electric = false }
material.library = "steel"
time = { regime = "static", end = 1, steps = 1 }
boundary = [ { on = "right", traction = ["-5e5", 0] }, { on = "top", traction = [0, "8e4*t"] } ]
[contact]
on = "left"
gap = 7e-7
normal = "unilateral"
friction = { law = "coulomb", coefficient = 0.3 }
)toml";

TEST(EveryRoute, FindsCoulombsFrictionThatAloneHoldsABody) {
  const Asked asked{"pressed and pulled", {}, held_by_friction};
  const RunCase condensed = asked.run({});
  expect_same_runs(condensed, asked.run({"solver.method=monolithic"}));
  expect_same_runs(condensed, asked.iteratively());
}

// Of the contact's five nodes each has a penetration and a slip.
TEST(ContactIteratively, ColumnsOfTheContactsMatrixAreCountedWhereItWasMade) {
  const auto columns = [](const RunCase &run) {
    return run.summary()["iterations"]["contact_columns"].get<int>();
  };
  const Asked asked{"pressed and pulled", {}, held_by_friction};
  EXPECT_EQ(columns(asked.iteratively()), 10);
  // One that is made serves all steps.
  EXPECT_EQ(columns(asked.run({"solver.body=iterative", "time.steps=2"})), 10);
  const Asked capped{"cases/verification/contact-capped-friction.toml", {}, ""};
  EXPECT_EQ(columns(capped.iteratively()), 0);
  EXPECT_FALSE(capped.run({}).summary()["iterations"].contains("contact_columns"));
}

// What crosses by the contact's state takes several rounds a step.
TEST(ContactIteratively, AStepThatNeededTheSafeStageIsCountedOnce) {
  const Asked asked{"leaning", {"contact.heat.ramp=1e-9", "time.regime=quasistatic"}, leaning};
  const auto summary = asked.iteratively().summary();
  EXPECT_GT(summary["iterations"]["safe_steps"], 0);
  EXPECT_LE(summary["iterations"]["safe_steps"], summary["sizes"]["steps"]);
}

TEST(ContactIteratively, WithoutAnyLoadItCountsTheSame) {
  const Asked asked{
      "unloaded",
      {"boundary=[{on='right',displacement=[0,0],potential=0,temperature=0}]",
       "contact.heat.foundation_temperature=0", "contact.foundation_displacement=[0,0]"},
      leaning};
  const auto iterations = asked.iteratively().summary()["iterations"];
  for (const char *count : {"krylov_total", "preconditioners", "safe_steps", "contact_columns"})
    EXPECT_TRUE(iterations.contains(count)) << count;
}

// So little of the pressure that the body's round-off may carry more, if it is moved far. Forces
// are known to 1e-13 of those that press.
TEST(ContactIteratively, FrictionThatIsABillionthOfThePressureHoldsTheBody) {
  const Asked asked{"hardly rubbed", {}, R"toml(
mesh.box = { min = [0, 0, 0], max = [0.02, 0.02, 0.01], cells = [3, 3, 2], cell = "hexahedron" }
material.library = "BaTiO3-Liu2014"
time = { end = 1, steps = 3 }
boundary = [ { on = "top", traction = ["2e-4*t", "1e-4*t", -1e6], potential = 0, temperature = 0 } ]
contact = { on = "bottom", normal = "unilateral", friction = { law = "coulomb", coefficient = 1e-9 } }
)toml"};
  expect_same(asked.run({}).nodes(), asked.iteratively().nodes(), 1e-4);
}

// Bilateral contact that is pulled has no friction, whatever it would have if all points stuck.
TEST(EveryRoute, LetsABodySlideAwayThatIsPulled) {
  const Asked asked{"pulled and pushed aside", {}, R"toml(
mesh.box = { min = [0, 0], max = [0.02, 0.1], cells = [2, 6], cell = "quadrilateral" }
model = { thermal = false, electric = false }
material.library = "steel"
time = { regime = "static", end = 1, steps = 1 }
boundary = [ { on = "right", traction = [5e5, 1e5] } ]
[contact]
on = "left"
friction = { law = "coulomb", coefficient = 0.3 }
)toml"};
  for (const Overrides &route :
       {Overrides{}, Overrides{"solver.method=monolithic"}, Overrides{"solver.body=iterative"}})
    EXPECT_THAT([&] { asked.run(route); },
                ::testing::ThrowsMessage<SolveError>(
                    ::testing::HasSubstr("nothing keeps the body from a translation along y")));
}

// The first guess of Newton's method on contact and temperatures has the body away from the
// foundation that holds it.
TEST(EveryRoute, FindsTheContactThatHoldsABodyWhereHeatCrosses) {
  for (const std::string other :
       {"law = \"compliance\", exponent = 1.5, coefficient = 2e14", "law = \"unilateral\""}) {
    SCOPED_TRACE(other);
    const Asked asked{"between two foundations",
                      {},
                      fmt::format(R"toml(
mesh.box = {{ min = [0, 0], max = [0.1, 0.1], cells = [2, 2], cell = "quadrilateral" }}
model.electric = false
material.library = "aluminium"
time = {{ end = 1, steps = 1 }}
boundary = [ {{ on = "top", traction = [0, "-1e6*t"], temperature = 0 }},
             {{ on = "right", traction = ["-1e5*t", 0] }} ]
[[contact]]
on = "bottom"
foundation_displacement = ["1e-6*t", 0]
heat = {{ law = "exchange", coefficient = 6e3, foundation_temperature = 2, ramp = 2e-6 }}
[[contact]]
on = "left"
gap = 1e-6
normal = {{ {} }}
)toml",
                                  other)};
    const RunCase condensed = asked.run({});
    expect_same_runs(condensed, asked.run({"solver.method=monolithic"}));
    expect_same_runs(condensed, asked.iteratively());
  }
}

// Nodes that close without friction and open with it: they just touch, with a share of it.
TEST(EveryRoute, FindsNodesThatJustTouch) {
  const auto body = [](const char *size, const char *boundary, const char *bound) {
    return fmt::format(R"toml(
mesh.box = {{ min = [0, 0], {}, cell = "quadrilateral" }}
material = {{ library = "BaTiO3-Liu2014", pyroelectric = [0, 1e-4] }}
time = {{ end = 1, steps = 4 }}
boundary = [ {} ]
[contact]
on = "bottom"
normal = "unilateral"
friction = {{ law = "tresca", bound = {} }}
)toml",
                       size, boundary, bound);
  };
  const char *const thin = "max = [0.001, 0.01], cells = [6, 4]";
  std::ptrdiff_t n_shares = 0;
  for (const Asked &asked :
       {Asked{"bent aside",
              {},
              body(thin,
                   R"({ on = "top", traction = ["-8.314e4*sin(1.19*t)*x/0.001", "-4.985e5*t"], )"
                   R"(potential = 0, temperature = 0 }, { on = "left", displacement = [0, 0] })",
                   "3.062e4")},
        Asked{
            "pressed and tilted",
            {"time.steps=1"},
            body(thin,
                 R"({ on = "top", displacement = ["-1.445e-7*t", "-2.283e-7*sin(1.3*t)*x/0.001"], )"
                 R"(potential = 0, temperature = "0.7007*sin(2.83*t)*x/0.001" })",
                 "2.023e6")},
        // The bounds answer to one another more strongly than mixing rounds can follow.
        Asked{"sheared and tilted",
              {"time.steps=1"},
              body(thin,
                   R"({ on = "top", displacement = ["-1.2e-7*t", "-2.406e-7*sin(1.3*t)*x/0.001"], )"
                   R"(potential = 0, temperature = "-0.1638*sin(2.83*t)*x/0.001" })",
                   "1.797e6")}}) {
    SCOPED_TRACE(asked.name);
    const RunCase condensed = asked.run({});
    const Table contact = condensed.contact();
    const auto &bounds = contact.numbers("friction_bound");
    n_shares += std::count_if(bounds.begin(), bounds.end(), [&](double bound) {
      return bound > 0 && bound < 0.99 * largest(contact, "friction_bound");
    });
    expect_same_runs(condensed, asked.run({"solver.method=monolithic"}));
    expect_same_runs(condensed, asked.iteratively());
  }
  EXPECT_GT(n_shares, 1);
}

TEST(ContactIteratively, WhatLetsTheBodyGoIsNamed) {
  const Asked plate{"cases/ssnv128/plate.toml", {"mesh.box.cells=[8,4]"}, ""};
  try {
    plate.run({"solver.body=iterative", "boundary.1.traction=[0,'5e7*t']"});
    FAIL() << "a body that is pulled away was solved";
  } catch (const SolveError &error) {
    EXPECT_THAT(error.what(),
                ::testing::HasSubstr("nothing keeps the body from a translation along y"));
  }
}

}  // namespace
}  // namespace tourmaline::verified
