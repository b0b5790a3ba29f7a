// Label: analytic. Bodies that nothing but contact keeps from a rigid motion: whether loads carry
// them off is for forces to say, not for the round-off of their stiffness.

#include <fmt/format.h>

#include "contact_status.h"
#include "read_table.h"
#include "run_case.h"
#include "tourmaline/error.h"

namespace tourmaline::verified {
namespace {

constexpr const char *direct = "solver.body=direct", *monolithic = "solver.method=monolithic",
                     *iterative = "solver.body=iterative";

std::string block(const std::string &rest) {
  return R"toml(
mesh.box = { min = [0, 0], max = [1, 1], cells = [6, 6], cell = "quadrilateral" }
model = { thermal = false, electric = false }
material = { young = 1e9, poisson = 0.3, symmetry = "isotropic", density = 1000 }
time = { end = 1, steps = 10 }
)toml" + rest;
}

// 10 N/m of friction, and a thousandth more or less of them along the foundation.
std::string pushed(const char *normal, double load) {
  return block(fmt::format(R"toml(
load.force = [{}, -1000]
boundary = []
[contact]
on = "bottom"
normal = "{}"
friction = {{ law = "tresca", bound = 10 }}
)toml",
                           load, normal));
}

TEST(LeftToContact, LoadsBeyondWhatFrictionBearsAreRefusedOnEveryRoute) {
  for (const char *normal : {"unilateral", "bilateral"})
    for (const double load : {10.01, 10.001})
      for (const char *route : {direct, monolithic, iterative})
        EXPECT_THROW(run_text(pushed(normal, load), {route}), SolveError) << normal << " " << load;
}

TEST(LeftToContact, LoadsThatFrictionBearsMoveTheBodyNoFurtherThanItDeforms) {
  for (const char *normal : {"unilateral", "bilateral"})
    for (const double load : {9.9, 9.99})
      EXPECT_LT(largest(run_text(pushed(normal, load)).history(), "max_displacement"), 1e-6);
}

// Round-off of the stiffness may bear what is that little, some tens of metres away.
TEST(LeftToContact, LoadsThatAreAMillionthTooLargeAreNotBorneInSilence) {
  const std::string text = block(R"toml(
load.force = ["500*(1 + 1e-6)", -1000]
boundary = []
[contact]
on = "bottom"
normal = "unilateral"
friction = { law = "coulomb", coefficient = 0.5 }
)toml");
  for (const char *route : {direct, iterative})
    EXPECT_THROW(run_text(text, {route}), SolveError) << route;
  EXPECT_LT(largest(run_text(text, {direct, "load.force=[499.9995,-1000]"}).history(),
                    "max_displacement"),
            1e-5);
}

// Where it does not find what holds the body, it says so.
TEST(LeftToContact, TheMonolithicRouteHasTheBodyWhereItIsHeldOrNotAtAll) {
  for (const double load : {9.9, 9.99, 9.999})
    try {
      EXPECT_LT(
          largest(run_text(pushed("unilateral", load), {monolithic}).history(), "max_displacement"),
          1e-6);
    } catch (const SolveError &) {
    }
}

// A foundation that is nowhere near has nothing to do with the round-off of forces.
TEST(LeftToContact, AnOpenContactFarAwayHidesNoSlide) {
  std::string text = pushed("unilateral", 10.01);
  text.replace(text.find("[contact]"), 9, "[[contact]]");
  text += R"toml(
[[contact]]
on = "top"
normal = "unilateral"
gap = 1e5
)toml";
  for (const char *route : {direct, monolithic, iterative})
    EXPECT_THROW(run_text(text, {route}), SolveError) << route;
}

TEST(LeftToContact, SolidsSlideOffOnEveryRoute) {
  const std::string text = R"toml(
mesh.box = { min = [0, 0, 0], max = [1, 1, 1], cells = [3, 3, 3], cell = "hexahedron" }
model = { thermal = false, electric = false }
material = { young = 1e9, poisson = 0.3, symmetry = "isotropic", density = 1000 }
time = { end = 1, steps = 2 }
load.force = [6, 8, -1000]
boundary = []
[contact]
on = "bottom"
normal = "unilateral"
friction = { law = "tresca", bound = 9.99 }
)toml";
  for (const char *route : {direct, monolithic, iterative}) {
    EXPECT_THROW(run_text(text, {route}), SolveError) << route;
    EXPECT_NO_THROW(run_text(text, {route, "contact.friction.bound=12"})) << route;
  }
}

TEST(LeftToContact, ABodyThatIsUnloadedIsPressedAgain) {
  for (const char *normal : {"'unilateral'", "{ law = 'compliance', coefficient = 1e10 }"}) {
    const std::string text = block(fmt::format(R"toml(
boundary = [
  {{ on = "left", displacement = [0, "free"] }},
  {{ on = "top", traction = [0, "t < 0.25 ? -1000 : (t < 0.65 ? 0 : -1000)"] }} ]
[contact]
on = "bottom"
normal = {}
)toml",
                                               normal));
    for (const char *route : {direct, monolithic, iterative}) {
      const std::vector<double> pressures =
          run_text(text, {route}).history().numbers("max_pressure");
      for (std::size_t n = 0; n < pressures.size(); ++n)
        EXPECT_NEAR(pressures[n], n >= 2 && n < 6 ? 0 : 1000, 1e-3) << normal << " " << n;
    }
  }
}

TEST(LeftToContact, AFoundationLiftsABodyWithoutLoads) {
  const std::string text = block(R"toml(
boundary = [ { on = "left", displacement = [0, "free"] } ]
[contact]
on = "bottom"
normal = "unilateral"
foundation_displacement = [0, "0.01*t"]
)toml");
  for (const char *route : {direct, monolithic, iterative}) {
    const RunCase run = run_text(text, {route});
    for (const double moved : run.nodes().numbers("u_y"))
      EXPECT_NEAR(moved, 0.01, 1e-4) << route;
    EXPECT_LT(largest(run.history(), "max_pressure"), 1e-3) << route;
  }
}

TEST(LeftToContact, AFoundationLiftsASolidThatNothingElseHolds) {
  const std::string text = R"toml(
mesh.box = { min = [0, 0, 0], max = [1, 1, 1], cells = [3, 3, 3], cell = "hexahedron" }
model = { thermal = false, electric = false }
material = { young = 1e9, poisson = 0.3, symmetry = "isotropic", density = 1000 }
time = { end = 1, steps = 4 }
load.force = [0, 0, "t < 0.4 ? -1000 : 0"]
boundary = []
[contact]
on = "bottom"
normal = "unilateral"
friction = { law = "coulomb", coefficient = 0.5 }
foundation_displacement = [0, 0, "0.01*t"]
)toml";
  for (const char *route : {direct, monolithic, iterative})
    for (const double moved : run_text(text, {route}).nodes().numbers("u_z"))
      EXPECT_NEAR(moved, 0.01, 1e-4) << route;
}

// 1000 kg at 1/s bear 1000 N at 1 m/s. Of a stiff body that little damping holds the direct route
// knows some digits only, and warns.
TEST(LeftToContact, MassDampingHoldsABodyOnEveryRoute) {
  const std::string text = block(R"toml(
boundary = [ { on = "left", displacement = [0, "free"] } ]
[contact]
on = "bottom"
normal = "unilateral"
)toml");
  struct Held {
    std::vector<std::string> overrides;
    double tolerance;
  };
  for (const Held &body :
       {Held{{"material.mass_damping=1", "load.force=[0,1000]"}, 1e-6},
        Held{{"material.mass_damping=0.1", "material.young=2e11", "load.force=[0,100]"}, 1e-2}})
    for (const char *route : {direct, monolithic, iterative}) {
      std::vector<std::string> all = body.overrides;
      all.emplace_back(route);
      EXPECT_NEAR(largest(run_text(text, all).history(), "max_displacement"), 1, body.tolerance)
          << route;
    }
}

}  // namespace
}  // namespace tourmaline::verified
