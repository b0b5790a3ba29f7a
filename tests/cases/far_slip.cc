// Label: analytic. A foundation that slips, or is apart, by many powers of ten more than the body
// deforms: what the contact does is then a small difference of displacements.

#include <fmt/format.h>

#include "closed_balances.h"
#include "equal_quantities.h"
#include "run_case.h"

namespace tourmaline::verified {
namespace {

const std::vector<std::string> routes{"solver.method=condensed", "solver.body=iterative",
                                      "solver.method=monolithic"};

// A block that is pressed down by 1e-10 m; where there is friction heat, it would heat up by far.
std::string rubbed(const std::string &laws, const std::string &foundation) {
  return fmt::format(R"(
mesh.box = {{ min = [0, 0], max = [0.02, 0.01], cells = [8, 4], cell = "quadrilateral" }}
material.library = "BaTiO3-Liu2014"
time = {{ end = 2, steps = 2 }}
boundary = [ {{ on = "top", displacement = [0, "-1e-10*t"], potential = 0, temperature = 0 }} ]
[contact]
on = "bottom"
{}
foundation_displacement = {}
)",
                     laws, foundation);
}

void expect_equal_answers(const RunCase &one, const RunCase &other, int dim) {
  std::vector<Quantity> of_nodes{{}, {"potential"}, {"temperature"}},
      of_contact{{"normal_traction"}};
  for (int c = 0; c < dim; ++c) {
    of_nodes[0].push_back(fmt::format("u_{}", "xyz"[c]));
    of_contact[0].push_back(fmt::format("tangential_traction_{}", "xyz"[c]));
  }
  expect_equal_quantities(one.nodes(), other.nodes(), of_nodes, 1e-9);
  expect_equal_quantities(one.contact(), other.contact(), of_contact, 1e-9);
  EXPECT_EQ(one.contact().columns.at("status"), other.contact().columns.at("status"));
}

class FarSlip : public ::testing::TestWithParam<std::string> {};

// How far a body is dragged along does not matter, once all of it slips.
TEST_P(FarSlip, DoesWhatANearOneDoes) {
  const RunCase near = run_text(rubbed(GetParam(), "['1e-7*t', 0]"), {routes[0]});
  for (const std::string &route : routes) {
    SCOPED_TRACE(route);
    for (const char *far : {"['1e-3*t', 0]", "['10*t', 0]"}) {
      SCOPED_TRACE(far);
      const RunCase run = run_text(rubbed(GetParam(), far), {route});
      expect_equal_answers(run, near, 2);
      expect_closed_balances(run.history());
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    OfEveryLaw, FarSlip,
    ::testing::Values(
        "friction = { law = 'tresca', bound = 100 }",
        "friction = { law = 'coulomb', coefficient = 0.3 }",
        "normal = 'unilateral'\nfriction = { law = 'coulomb', coefficient = 0.3 }",
        "normal = { law = 'compliance', coefficient = 1e14 }\n"
        "friction = { law = 'tresca', bound = 100 }",
        "normal = { law = 'damped', coefficient = 1e14 }\n"
        "friction = { law = 'coulomb', coefficient = 0.3, cohesion = 1 }",
        "normal = 'unilateral'\nfriction = { law = 'coulomb', coefficient = 0.3 }\n"
        "heat = { law = 'exchange', coefficient = 1, foundation_temperature = 0, "
        "pressure = { coefficient = 1, reference = 500, exponent = 0.95 } }\n"
        "electric = { law = 'exchange', coefficient = 1e-7, foundation_potential = 0, "
        "ramp = 1e-10 }"));

// A disc that turns below the block: friction has another direction at every node.
TEST(FarSlipInSpace, IsTheSameOnAllRoutes) {
  const std::string text = R"toml(
mesh.box = { min = [0, 0, 0], max = [0.02, 0.02, 0.01], cells = [4, 4, 2], cell = "hexahedron" }
material.library = "BaTiO3-Liu2014"
time = { end = 2, steps = 2 }
boundary = [ { on = "top", displacement = [0, 0, "-1e-10*t"], potential = 0, temperature = 0 } ]
[contact]
on = "bottom"
normal = "unilateral"
foundation_displacement = ["-t*(y-0.009)", "t*(x-0.013)", 0]
friction = { law = "coulomb", coefficient = 0.3 }
)toml";
  const RunCase exact = run_text(text, {routes[2]});
  for (const std::string &route : {routes[0], routes[1]}) {
    SCOPED_TRACE(route);
    const RunCase run = run_text(text, {route});
    expect_equal_answers(run, exact, 3);
    expect_closed_balances(run.history());
  }
}

// A millimetre above its foundation a body is as it would be without one, however little it is
// loaded.
TEST(WideGap, ChangesNothing) {
  const std::string body = R"(
mesh.box = { min = [0, 0], max = [0.02, 0.01], cells = [8, 4], cell = "quadrilateral" }
material.library = "BaTiO3-Liu2014"
time = { end = 2, steps = 2 }
boundary = [ { on = "left", displacement = [0, 0], potential = 0, temperature = 0 },
             { on = "top", traction = [0, "-0.001*t"] } ]
)";
  const RunCase alone = run_text(body);
  for (const char *normal : {"'unilateral'", "{ law = 'compliance', coefficient = 1e14 }"})
    for (const std::string &route : routes) {
      SCOPED_TRACE(normal + route);
      const RunCase run = run_text(body +
                                       "[contact]\non = \"bottom\"\ngap = 1e-3\nfriction = { law "
                                       "= \"coulomb\", coefficient = 0.3 }\nnormal = " +
                                       normal,
                                   {route});
      expect_equal_quantities(run.nodes(), alone.nodes(),
                              {{"u_x", "u_y"}, {"potential"}, {"temperature"}}, 1e-9);
      EXPECT_EQ(run.history().columns.at("open").back(), "9");
    }
}

// Nothing presses it yet: round-off of where it would have to be to stick is no force.
TEST(FarSlip, OfAnUnloadedBodyDoesNothing) {
  const std::string text = R"toml(
mesh.box = { min = [0, 0, 0], max = [0.02, 0.02, 0.01], cells = [3, 3, 2], cell = "hexahedron" }
material.library = "BaTiO3-Liu2014"
time = { end = 4, steps = 4 }
boundary = [ { on = "top", displacement = [0, 0, "-1e-9*max(t - 2, 0)"], potential = 0, temperature = 0 } ]
[contact]
on = "bottom"
foundation_displacement = ["1e-3*t", "5e-4*t", 0]
friction = { law = "coulomb", coefficient = 0.3 }
)toml";
  for (const std::string &route : routes)
    for (const char *law : {"contact.normal='unilateral'", "contact.normal='bilateral'",
                            "contact.normal={law='compliance',coefficient=1e14}",
                            "contact.normal={law='damped',coefficient=1e14}"}) {
      SCOPED_TRACE(route + law);
      const RunCase run = run_text(text, {route, law});
      const Table history = run.history();
      const std::vector<double> u = history.numbers("max_displacement");
      EXPECT_EQ(u[0], 0);
      EXPECT_EQ(u[1], 0);
      EXPECT_GT(u[3], u[2]);
      expect_closed_balances(history);
    }
}

// Nothing touches, so whatever the foundation does is nothing to the body and to what works on it.
TEST(FarSlip, OfAFoundationThatNothingTouchesLeavesTheWorkOfLoadsAlone) {
  const auto beside = [](const std::string &foundation, const std::string &route) {
    return run_text(fmt::format(R"(
mesh.box = {{ min = [0, 0], max = [0.02, 0.01], cells = [4, 2], cell = "quadrilateral" }}
material.library = "steel"
model = {{ thermal = false, electric = false }}
time = {{ end = 2, steps = 2 }}
boundary = [ {{ on = "top", displacement = ["t < 1.5 ? 0 : 1e-9", 0] }},
             {{ on = "right", traction = ["1e3*t", 0] }} ]
[contact]
on = "bottom"
gap = 1e-8
normal = "unilateral"
foundation_displacement = {}
)",
                                foundation),
                    {route})
        .history();
  };
  for (const std::string &route : routes) {
    SCOPED_TRACE(route);
    const std::vector<double> works = beside("[0, 0]", route).numbers("load_power");
    for (const char *foundation : {"['t < 1.5 ? 0 : 1e-4', 0]", "['t', 0]", "['1e4*t', 0]"}) {
      const Table history = beside(foundation, route);
      expect_closed_balances(history);
      for (std::size_t n = 0; n < works.size(); ++n)
        EXPECT_NEAR(history.numbers("load_power")[n], works[n], 1e-10 * works.back()) << foundation;
      EXPECT_EQ(history.numbers("foundation_power"), (std::vector<double>{0, 0}));
    }
  }
}

// Where it stops, the slip of the step before is no beginning for a step in which nothing acts.
TEST(FarSlip, ToAndFroOfAnUnloadedBodyLeavesNoForces) {
  for (const std::string &route : routes) {
    SCOPED_TRACE(route);
    const RunCase run = run_text(R"toml(
mesh.box = { min = [0, 0], max = [0.01, 0.01], cells = [2, 1], cell = "quadrilateral" }
material.library = "steel"
model = { thermal = false, electric = false, plane = "stress" }
time = { end = 100, steps = 9 }
boundary = [ { on = "top", displacement = [0, 0] } ]
[contact]
on = "bottom"
normal = { law = "damped", coefficient = 1e12 }
friction = { law = "coulomb", coefficient = 0.6 }
foundation_displacement = ["-4e-11*(sin(2*pi*t/100+0.1) > 0 ? 1 : -1)", 0]
)toml",
                                 {route});
    EXPECT_EQ(run.history().n_rows(), 9u);
    for (const char *force : {"contact_force_x", "contact_force_y"})
      EXPECT_EQ(largest(run.history(), force), 0);
  }
}

}  // namespace
}  // namespace tourmaline::verified
