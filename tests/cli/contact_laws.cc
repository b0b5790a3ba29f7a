// Contact that opens or rubs by its pressure where it is not available, and bodies that nothing
// holds but such a contact: a sentence and an exit status.

#include <gmock/gmock.h>

#include <fstream>

#include "program.h"

namespace {

using testing::HasSubstr;
using testing::Not;

/// Exit status and what the program says of `leaning`, changed.
class ContactLaws : public Program {
 protected:
  ContactLaws() { std::ofstream(here() / "leaning.toml") << leaning; }

  void expect_answer(int status, const std::string &changes,
                     const std::vector<std::string> &pieces) {
    SCOPED_TRACE(changes);
    EXPECT_EQ(run("run leaning.toml -q -o results " + changes), status);
    for (const std::string &piece : pieces)
      EXPECT_THAT(complained_, HasSubstr(piece));
    EXPECT_EQ(std::count(complained_.begin(), complained_.end(), '\n'), status == 0 ? 0 : 1)
        << complained_;
  }

  // Nothing but the foundation, on which it is pressed, holds this body.
  static constexpr const char *leaning = R"toml(
mesh.box = { min = [-0.01, 0], max = [0.01, 0.01], cells = [8, 4], cell = "quadrilateral" }
material.library = "BaTiO3-Liu2014"
time = { end = 1, steps = 4 }
boundary = [ { on = "top", traction = [1e5, -1e6], potential = 0, temperature = 0 } ]
contact = { on = "bottom", normal = "unilateral", friction = { law = "coulomb", coefficient = 0.5 } }
output = { fields = false, report = false }
)toml";

  const std::string rollers =
      " --set 'boundary=[{on=\"top\",displacement=[0,0],potential=0,temperature=0}]' ";
  const std::string no_contact_of_state =
      " --set contact.normal=bilateral --set "
      "'contact.friction={law=\"tresca\",bound=1e5}' ";
};

TEST_F(ContactLaws, OfTheStateAreRefusedWithMultipliersOfFacets) {
  for (const std::string law :
       {"normal=unilateral", "normal='{law=\"compliance\",coefficient=1e12}'",
        "normal='{law=\"damped\",coefficient=1e12}'",
        "friction='{law=\"coulomb\",coefficient=0.3}'"}) {
    const std::string asked = rollers + no_contact_of_state + "--set contact." + law;
    expect_answer(0, asked, {});
    expect_answer(2,
                  asked +
                      " --set solver.method=monolithic --set "
                      "solver.multiplier=piecewise-constant",
                  {"is not available with solver.multiplier"});
    expect_answer(0, asked + " --set solver.body=iterative", {});
  }
}

TEST_F(ContactLaws, SeveralContactsOnOneBoundaryAreRefused) {
  expect_answer(2, "--set 'contact=[{on=\"bottom\"},{on=[\"left\",\"bottom\"]}]'",
                {"in contact already", "a boundary can have one contact"});
}

TEST_F(ContactLaws, OfSeveralContactsThatMeetAtAnEdgeCheckTells) {
  std::ofstream(here() / "corner.toml") << leaning;
  EXPECT_EQ(run("check corner.toml --set 'contact=[{on=\"bottom\"},{on=\"left\"}]' " + rollers), 0);
  EXPECT_THAT(said_, HasSubstr("# warning: corner.toml: contacts meet at an edge, at (-0.01, 0"));
  EXPECT_EQ(run("check corner.toml --set 'contact=[{on=\"right\"},{on=\"left\"}]' " + rollers), 0);
  EXPECT_THAT(said_, Not(HasSubstr("warning")));
}

// A quarter of a tube whose lower rim is held along one axis.
TEST_F(ContactLaws, ANormalObliqueToPrescribedComponentsIsRefused) {
  std::ofstream(here() / "sleeve.toml") << R"toml(
mesh.annulus = { inner = 0.02, outer = 0.04, height = 0.02, cells = [2, 12, 2], cell = "hexahedron" }
material.library = "BaTiO3-Liu2014"
time = { end = 1, steps = 1 }
boundary = [ { on = "outer", displacement = [0, 0, 0], potential = 0, temperature = 0 },
             { on = "bottom", displacement = [0, "free", "free"] } ]
contact = { on = "inner", normal = "unilateral", friction = { law = "coulomb", coefficient = 0.3 } }
)toml";
  EXPECT_EQ(run("run sleeve.toml -q -o results"), 2);
  EXPECT_THAT(complained_, HasSubstr("is oblique to them"));
  EXPECT_THAT(complained_, HasSubstr("is not available there"));
  EXPECT_EQ(std::count(complained_.begin(), complained_.end(), '\n'), 1) << complained_;
}

TEST_F(ContactLaws, MayHoldABodyThatIsPressed) {
  expect_answer(0, "", {});
  expect_answer(0, "--set contact.gap=1e-6", {});
  expect_answer(0, "--set 'contact.normal={law=\"damped\",coefficient=1e13}'", {});
}

TEST_F(ContactLaws, LetABodyGoThatIsNotPressed) {
  const std::string all =
      "nothing keeps the body from a translation along x, a translation along y and a rotation in "
      "the plane";
  expect_answer(3, "--set 'boundary[0].traction=[0,1e6]'",
                {"no solution of the contact problem at t = 0.25 s was found", all});
  for (const std::string law : {"compliance", "damped"})
    expect_answer(3,
                  "--set 'boundary[0].traction=[0,1e6]' --set 'contact.normal={law=\"" + law +
                      "\",coefficient=1e12}'",
                  {all});
}

TEST_F(ContactLaws, LetABodyGoThatIsPushedHarderThanItRubs) {
  const std::string along = "nothing keeps the body from a translation along x";
  const std::string pushed = "--set 'boundary[0].traction=[2e6,-1e6]' --set ";
  expect_answer(3, pushed + "contact.normal=bilateral", {along});
  expect_answer(3, pushed + "'contact.friction={law=\"tresca\",bound=1e5}'", {along});
  expect_answer(3, "--set 'boundary[0].traction=[0,\"-1e6*(1+4*x/0.01)\"]'",
                {"from a rotation in the plane,"});
}

// One iteration does not find what holds a block that heat bends, which does not prove that nothing
// does.
TEST_F(ContactLaws, SayThatABodyIsLetGoOnlyWhereIterationsSufficed) {
  std::ofstream(here() / "leaning.toml") << R"toml(
mesh.box = { min = [0, 0, 0], max = [1, 1, 0.5], cells = [3, 3, 2], cell = "hexahedron" }
material.library = "BaTiO3-Liu2014"
time = { end = 1, steps = 3 }
boundary = [
  { on = "top", traction = ["1e6*t", 0, "-3e6*t"], potential = "100*t", temperature = "10*t" },
  { on = "bottom", potential = 0 } ]
output = { fields = false, report = false }
[contact]
on = "bottom"
normal = "unilateral"
friction = { law = "coulomb", coefficient = 0.5 }
heat = { law = "exchange", coefficient = 100, foundation_temperature = 0 }
)toml";
  for (const std::string body : {"direct", "iterative"}) {
    const std::string by = "--set solver.body=" + body;
    expect_answer(0, by, {});
    expect_answer(3, by + " --set solver.max_iterations=1",
                  {"has no solution that was found", "raise solver.max_iterations"});
  }
}

TEST_F(ContactLaws, LetABodyGoInTheStepInWhichItIsPressedNoMore) {
  expect_answer(3, "--set 'boundary[0].traction=[0,\"-1e6*(0.6-t)\"]'",
                {"t = 0.75 s", "the results of steps 1 to 2 of 4 are in results"});
}

TEST_F(ContactLaws, HoldABodyOfWhichNothingIsWanted) {
  expect_answer(0, "--set 'boundary[0].traction=[0,0]'", {});
}

TEST_F(ContactLaws, WithoutFrictionHoldNothingAlongTheFoundation) {
  expect_answer(2, "--set contact.friction.law=none --set contact.friction.coefficient=0",
                {"only used with"});
  expect_answer(2, "--set 'contact.friction={law=\"none\"}'",
                {"nothing holds the body against a translation along x;"});
}

}  // namespace
