// Strips and plates that bend far more easily than a node of theirs is moved alone: where points
// are let go and closed one by one, each of them bends the whole body.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <regex>

#include "closed_balances.h"
#include "elastic_body.h"
#include "run_case.h"
#include "tourmaline/error.h"

namespace tourmaline::verified {
namespace {

constexpr const char *monolithic = "solver.method='monolithic'";

/// A strip of length 1 m, clamped on the left, over a foundation below it.
std::string clamped_strip(double height, int cells, const std::string &material,
                          const std::string &loads, const std::string &more_of_contact = "") {
  return fmt::format(R"toml(
mesh.box = {{ min = [0, 0], max = [1, {}], cells = [{}, 1], cell = "quadrilateral" }}
mesh.modes = "incompatible"
material = {{ {} }}
time = {{ end = 1, steps = 2 }}
boundary = [ {{ on = "left", displacement = [0, 0], potential = 0, temperature = 0 }}, {} ]
[contact]
on = "bottom"
normal = "unilateral"
{}
)toml",
                     height, cells, material, loads, more_of_contact);
}

// An elastic strip that lies on a flat foundation, with weight q on its upper side, is lifted by
// the force P at its end.
std::string lifted_strip(double height, double lift) {
  return clamped_strip(height, 100, elastic + std::string(", young = 1e11, density = 1"),
                       fmt::format("{{ on = 'top', traction = [0, -100] }}, "
                                   "{{ on = 'right', traction = [0, '{}*t'] }}",
                                   lift / height));
}

double opening_at(const Table &contact, double x) {
  const std::vector<double> places = contact.numbers("x"), gaps = contact.numbers("gap");
  for (std::size_t i = 0; i < places.size(); ++i)
    if (places.size() - i <= 101 && std::abs(places[i] - x) < 1e-9)
      return gaps[i];
  ADD_FAILURE() << "no node at " << x;
  return 0;
}

// Of a beam l = 2 P/q is off the foundation, without moment or slope where it leaves it; its end
// stands at q l^4 / (24 E I). The strip holds to that up to a cell and the share of its height.
TEST(SlenderBodies, ALiftedStripLeavesTheFoundationWhereTheBeamDoes) {
  constexpr double weight = 100, lift = 25, cell = 0.01, off = 2 * lift / weight;
  for (const double height : {0.02, 0.003})
    for (const auto &route : {std::vector<std::string>{}, {monolithic}}) {
      const RunCase run = run_text(lifted_strip(height, lift), route);
      const Table contact = run.contact();
      const double bending = 1e11 * std::pow(height, 3) / 12;
      const double open = cell * run.history().numbers("open").back();
      EXPECT_NEAR(open, off, 2 * cell + 2 * height) << height;
      EXPECT_NEAR(opening_at(contact, 1) / (weight * std::pow(off, 4) / (24 * bending)), 1,
                  2 * height + 0.02)
          << height;
      expect_closed_balances(run.history(), 1e-9);
    }
}

/// A static load that grows in two equal steps, on a plate or strip of steel.
std::string growing_load(const std::string &box, const std::string &boundary,
                         const std::string &normal) {
  return fmt::format(R"toml(
model = {{ thermal = false, electric = false }}
material = {{ symmetry = "cubic", c11 = 2.2435897435897433e11, c12 = 9.615384615384616e10, c44 = 6.410256410256410e10, density = 7800 }}
mesh = {{ {} }}
time = {{ regime = "static", end = 1, steps = 2 }}
boundary = [ {} ]
contact = {{ on = "bottom", normal = {} }}
)toml",
                     box, boundary, normal);
}

// The load of the second step is less than 1e-12 of the forces inside the body.
TEST(SlenderBodies, ALoadThatIsSmallBesideTheForcesInsideIsFollowedOnBothRoutes) {
  const std::string text = growing_load(
      "modes = 'incompatible', box = { cell = 'hexahedron', min = [0, 0, 0], max = [1, 0.5, "
      "0.001], "
      "cells = [8, 4, 1] }",
      "{ on = 'top', traction = [0, 0, 't*cos(7*x+3*y)'] }, { on = 'left', displacement = [0, 0, "
      "0] }",
      "'unilateral'");
  for (const auto &route : {std::vector<std::string>{}, {monolithic}}) {
    const std::vector<double> largest = run_text(text, route).history().numbers("max_displacement");
    EXPECT_NEAR(largest.at(1) / largest.at(0), 2, 2e-3);
  }
}

// Only the contact holds the strip along the normal, through a gap that moves it by far more than
// the load bends it.
TEST(SlenderBodies, ThatOnlyTheContactHoldsAreHeldOnBothRoutes) {
  for (const char *normal : {"{ law = 'compliance', coefficient = 1.9e8 }", "'unilateral'"}) {
    const std::string text = growing_load(
        "degree = 2, box = { cell = 'quadrilateral', min = [0, 0], max = [1, 0.005], cells = [5, "
        "1] }",
        "{ on = 'top', traction = [0, '-75*t'] }, { on = 'left', displacement = [0, 'free'] }",
        normal + std::string(", gap = '1e-4*(1+x)'"));
    const RunCase condensed = run_text(text), whole = run_text(text, {monolithic});
    EXPECT_LT(difference(condensed.contact(), whole.contact(), "normal_traction"), 1e-6);
    EXPECT_GT(largest(condensed.history(), "max_pressure"), 75);
    const std::string lifted = std::regex_replace(text, std::regex("-75"), "75");
    EXPECT_THROW(run_text(lifted), SolveError);
    EXPECT_THROW(run_text(lifted, {monolithic}), SolveError);
  }
}

// Forces inside are a million times those that act: within a tolerance of the former, balances of
// the latter would be open.
TEST(SlenderBodies, CloseTheBalancesOnTheMonolithicRoute) {
  const std::string text = growing_load(
      "modes = 'incompatible', box = { cell = 'quadrilateral', min = [0, 0], max = [1, 0.02], "
      "cells = [20, "
      "1] }",
      "{ on = 'top', traction = [0, '-8000*t'] }, { on = 'left', displacement = [0, 'free'] }",
      "{ law = 'compliance', coefficient = 1e9 }, gap = '1e-4*(1+x)'");
  expect_closed_balances(run_text(text, {monolithic}).history(), 1e-9);
}

std::string bender(double height, const std::string &load, const std::string &gap,
                   const std::string &friction) {
  return clamped_strip(height, 90, "library = 'BaTiO3-Liu2014'",
                       fmt::format("{{ on = 'top', traction = [0, '-0.1*t*({})'] }}", load),
                       fmt::format("gap = '{}'\n{}", gap, friction));
}

void expect_laws(const Table &contact, double largest_gap) {
  const std::vector<double> gaps = contact.numbers("gap"),
                            pressures = contact.numbers("normal_traction");
  const double most = largest(pressures);
  for (std::size_t i = 0; i < gaps.size(); ++i) {
    EXPECT_GE(gaps[i], -1e-12 * largest_gap);
    EXPECT_GE(-pressures[i], -1e-9 * most);
    EXPECT_TRUE(gaps[i] <= 1e-9 * largest_gap || pressures[i] == 0) << gaps[i];
  }
}

TEST(SlenderBodies, BendersAreSolvedOnBothRoutesToTheSameStatus) {
  for (const char *friction : {"", "friction = { law = 'coulomb', coefficient = 0.3 }"})
    for (const double height : {0.02, 0.003})
      for (const auto &[load, gap] : {std::pair{"1-1.2*x", "1e-8*x"}, {"sin(9*x)", "0"}}) {
        const std::string text = bender(height, load, gap, friction);
        const RunCase condensed = run_text(text), whole = run_text(text, {monolithic});
        SCOPED_TRACE(text);
        const double size = largest(condensed.contact(), "gap");
        expect_laws(condensed.contact(), size);
        EXPECT_EQ(condensed.contact().columns.at("status"), whole.contact().columns.at("status"));
        EXPECT_LT(difference(condensed.contact(), whole.contact(), "gap"), 1e-6);
      }
}

}  // namespace
}  // namespace tourmaline::verified
