// Contact laws on one rank and on several: contacts beside each other, contact that opens, rubs or
// lets go.

#include <fstream>

#include "../cases/contact_status.h"
#include "../cases/rubbed_block.h"
#include "../cases/slipping_block.h"
#include "ranks.h"

namespace tourmaline::verified {
namespace {

// A warmed block of BaTiO3 that a foundation rubs, as it moves along, and leaves.
const char *const rubbed = R"toml(
mesh.box = { min = [0, 0], max = [0.02, 0.01], cells = [12, 6], cell = "quadrilateral" }
material = { library = "BaTiO3-Liu2014", pyroelectric = [0, 1e-4] }
time = { end = 1, steps = 3 }
boundary = [ { on = "top", displacement = ["2e-7*t", "-5e-7*t"], potential = 0, temperature = "2*t" } ]
[contact]
on = "bottom"
gap = "3e-3*(x - 0.008)^2"
foundation_displacement = ["5e-7*sin(4*t)", 0]
normal = "unilateral"
friction = { law = "coulomb", coefficient = { static = 0.35, kinetic = 0.3, distance = 1e-6 } }
heat = { law = "exchange", coefficient = 2e4, foundation_temperature = "20*t" }
)toml";

// Contact that opens, sticks and slips, of so many dimensions.
void expect_same_rubbing(const Results &one, const Results &several, int dim) {
  Quantity u, traction{"normal_traction", "friction_bound"}, slip{"normal_displacement", "gap"};
  for (int c = 0; c < dim; ++c) {
    u.push_back(std::string("u_") + "xyz"[c]);
    traction.push_back(std::string("tangential_traction_") + "xyz"[c]);
    slip.push_back(std::string("slip_") + "xyz"[c]);
  }
  expect_equal_quantities(several.nodes, one.nodes, {u, {"potential"}, {"temperature"}});
  if (one.contact.columns.contains("accumulated_slip"))
    slip.push_back("accumulated_slip");
  expect_equal_quantities(several.contact, one.contact,
                          {traction, slip, {"slip_rate"}, {"potential"}, {"heat_flux"}});
  EXPECT_EQ(several.contact.columns.at("status"), one.contact.columns.at("status"));
  expect_every_status(one.contact);
  expect_equal_quantities(several.history, one.history,
                          {{"friction_dissipation"}, {"foundation_power"}, {"contact_stage"}});
}

TEST_P(Ranks, SeveralContactsOfDifferentLawsAreTheSame) {
  const std::string clamped =
      std::string(TOURMALINE_SOURCE_DIR) + "/cases/clamped-block/block.toml --set time.steps=2 ";
  for (const std::string method : {"condensed", "monolithic"}) {
    SCOPED_TRACE(method);
    ASSERT_NO_FATAL_FAILURE(run_twice(clamped + "--set solver.method=" + method));
    expect_equal_quantities(several_.nodes, one_.nodes,
                            {{"u_x", "u_y"}, {"potential"}, {"temperature"}});
    expect_equal_quantities(several_.contact, one_.contact,
                            {{"normal_traction", "tangential_traction_y", "friction_bound"},
                             {"slip_y"},
                             {"heat_flux"}});
    for (const char *column : {"status", "contact"})
      EXPECT_EQ(several_.contact.columns.at(column), one_.contact.columns.at(column));
    expect_equal_quantities(several_.history, one_.history,
                            {{"contact_force_x_wall", "contact_force_x_jaw"},
                             {"contact_moment_z_wall", "contact_moment_z_jaw"},
                             {"contact_heat_wall", "contact_heat_jaw"},
                             {"slip_wall", "slip_jaw"}});
  }
}

// On every rank the same contact has a node at the edge.
TEST_P(Ranks, ContactsThatMeetAtAnEdgeAreTheSame) {
  const std::string met = file_of(std::string(slipping_block) + R"toml(
[[contact]]
on = "bottom"
friction = { law = "tresca", bound = 0.1 }
[[contact]]
on = "back"
)toml");
  std::string text = output::content_of(met);
  const std::string alone = "[contact]";
  text.replace(text.find(alone), alone.size(), "[[contact]]");
  std::ofstream(met) << text;
  for (const std::string body : {"direct", "iterative --set solver.linear_tolerance=1e-13"}) {
    SCOPED_TRACE(body);
    expect_same(met + " --set solver.body=" + body);
  }
}

TEST_P(Ranks, ARubbedBodyThatComesOffIsTheSame) {
  ASSERT_NO_FATAL_FAILURE(run_twice(file_of(rubbed)));
  expect_same_rubbing(one_, several_, 2);
}

TEST_P(Ranks, ARubbedBlockThatComesOffIsTheSame) {
  ASSERT_NO_FATAL_FAILURE(run_twice(file_of(rubbed_block)));
  expect_same_rubbing(one_, several_, 3);
}

// By 1e7 times what the block deforms, below one half of it.
TEST_P(Ranks, AFoundationThatSlipsFarIsTheSame) {
  const std::string far = file_of(R"toml(
mesh.box = { min = [0, 0, 0], max = [0.02, 0.02, 0.01], cells = [6, 4, 2], cell = "hexahedron" }
material.library = "BaTiO3-Liu2014"
time = { end = 2, steps = 2 }
boundary = [ { on = "top", displacement = [0, 0, "-1e-10*t"], potential = 0, temperature = 0 } ]
[contact]
on = "bottom"
normal = "unilateral"
foundation_displacement = ["x > 0.009 ? 1e-3*t : 0", "2e-4*t*y", 0]
friction = { law = "coulomb", coefficient = 0.3 }
)toml");
  for (const std::string body : {"direct", "iterative --set solver.linear_tolerance=1e-13"}) {
    SCOPED_TRACE(body);
    expect_same(far + " --set solver.body=" + body);
  }
}

// Heat by friction, pressure and gap, charge that leaks.
const char *const crossing =
    " --set contact.heat.pressure='{coefficient=3e4,reference=1e7,exponent=0.95}'"
    " --set contact.heat.ramp=3e-7 --set contact.heat.friction_share=0.5"
    " --set "
    "contact.electric='{law=\"leak\",coefficient=1e-6,foundation_potential=\"50*t\",ramp=2e-7}'";

const char *const iteratively = " --set solver.body=iterative --set solver.linear_tolerance=1e-13";

TEST_P(Ranks, WhatCrossesTheContactByItsStateIsTheSame) {
  for (const std::string route : {"", " --set solver.method=monolithic", iteratively})
    for (const auto &[text, dim] : {std::pair(rubbed, 2), std::pair(rubbed_block, 3)}) {
      if (GetParam() > 2 && dim == 3 && !route.empty())
        continue;  // of minutes where ranks share a core
      SCOPED_TRACE(route);
      ASSERT_NO_FATAL_FAILURE(run_twice(file_of(text) + crossing + route));
      expect_same_rubbing(one_, several_, dim);
      expect_equal_quantities(several_.contact, one_.contact, {{"charge_flux"}});
      expect_equal_quantities(
          several_.history, one_.history,
          {{"friction_heat_body", "friction_heat_foundation"}, {"charge_bottom"}, {"heat_bottom"}});
    }
}

TEST_P(Ranks, TheCircuitOfAFoundationIsTheSame) {
  for (const std::string route : {"", " --set solver.method=monolithic", iteratively})
    for (const char *ramp : {"", "ramp=2e-7,"}) {
      SCOPED_TRACE(route + ramp);
      ASSERT_NO_FATAL_FAILURE(
          run_twice(file_of(rubbed) + " --set contact.electric='{law=\"leak\"," + ramp +
                    "coefficient=1e-6,circuit={resistor=1e8,voltage=50}}'" + route));
      expect_equal_quantities(several_.contact, one_.contact, {{"potential"}, {"charge_flux"}});
      expect_equal_quantities(
          several_.history, one_.history,
          {{"foundation_voltage"}, {"foundation_charge"}, {"foundation_current"}});
    }
}

TEST_P(Ranks, StepsThatTheProgramChoosesAreTheSame) {
  for (const std::string route : {"", " --set solver.method=monolithic", iteratively}) {
    SCOPED_TRACE(route);
    ASSERT_NO_FATAL_FAILURE(run_twice(file_of(rubbed) + " --set time.tolerance=1e-2" + route));
    EXPECT_EQ(one_.history.numbers("time"), several_.history.numbers("time"));
    expect_same_rubbing(one_, several_, 2);
  }
}

TEST_P(Ranks, StepsThatAreHalvedAreTheSame) {
  const std::string hurried = R"toml(
material.library = "BaTiO3-Liu2014"
time = { end = 0.6, steps = 6 }
mesh.box = { min = [0, 0], max = [0.1, 0.1], cells = [10, 10] }
boundary = [ { on = "top", displacement = ["2e-6*sin(9*t)", "-1e-6*t"], potential = 0, temperature = 0 } ]
contact = { on = "bottom", normal = "unilateral", friction = { law = "coulomb", coefficient = 0.9 } }
)toml";
  for (const std::string route : {"method=monolithic --set solver.max_iterations=3",
                                  "body=iterative --set solver.max_iterations=1"}) {
    if (GetParam() > 2 && route.starts_with("body"))
      continue;  // of minutes where ranks share a core
    SCOPED_TRACE(route);
    ASSERT_NO_FATAL_FAILURE(run_twice(file_of(hurried) + " --set solver." + route));
    EXPECT_GT(one_.history.n_rows(), 6);
    expect_equal_quantities(several_.history, one_.history,
                            {{"time"}, {"max_displacement"}, {"friction_dissipation"}, {"slip"}});
  }
}

TEST_P(Ranks, ARubbedBodyThatComesOffIsTheSameIteratively) {
  ASSERT_NO_FATAL_FAILURE(run_twice(file_of(rubbed) + iteratively));
  expect_same_rubbing(one_, several_, 2);
}

TEST_P(Ranks, ARubbedBlockThatComesOffIsTheSameIteratively) {
  ASSERT_NO_FATAL_FAILURE(run_twice(file_of(rubbed_block) + iteratively));
  expect_same_rubbing(one_, several_, 3);
}

TEST_P(Ranks, AMeshOfWhichNothingIsFreeBesideItsContactIsRefused) {
  expect_told_once(file_of(R"toml(
mesh.box = { min = [0, 0, 0], max = [0.01, 0.01, 0.01], cells = [3, 1, 1], cell = "tetrahedron" }
material.library = "BaTiO3-Liu2014"
time = { end = 1, steps = 2 }
boundary = [ { on = ["bottom", "top"], displacement = [0, 0, 0], potential = 0, temperature = 0 } ]
contact.on = "right"
)toml"),
                   2, "no unknown of the body is free beside those of its contact");
}

TEST_P(Ranks, ABodyThatItsContactLetsGoIsToldOnce) {
  expect_told_once(
      file_of(rubbed) + " --set 'boundary=[{on=\"top\",traction=[0,1e5],potential=0}]'", 3,
      "nothing keeps the body from");
}

}  // namespace
}  // namespace tourmaline::verified
