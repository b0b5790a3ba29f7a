// Label: analytic. Bodies of revolution against closed forms, the uniform states of a cylinder,
// and solids.

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <numbers>

#include "../cases/closed_balances.h"
#include "../cases/run_case.h"
#include "rows_by_place.h"
#include "tourmaline/error.h"

namespace tourmaline::verified {
namespace {

using std::numbers::pi;

double last(const RunCase &run, const std::string &column) {
  return run.history().numbers(column).back();
}

const char *const elastic =
    "model = { plane = 'axisymmetric', thermal = false, electric = false }\n"
    "material = { symmetry = 'isotropic', young = 2e11, poisson = 0.3 }\n"
    "time = { end = 1, steps = 1 }\n";

// Lame: u = (1 + nu)/E A ((1 - 2 nu) r + b^2/r), A = p a^2/(b^2 - a^2), between plates.
TEST(Axisymmetric, AThickTubeIsLamesTube) {
  const RunCase run = run_text(std::string(elastic) + R"toml(
mesh = { degree = 2, box = { min = [0.5, 0], max = [1, 0.1], cells = [16, 2], cell = "quadrilateral" } }
boundary = [ { on = ["bottom", "top"], displacement = ["free", 0] }, { on = "left", traction = [1e6, 0] } ]
)toml");
  const Table nodes = run.nodes();
  const std::vector<double> r = nodes.numbers("x"), u = nodes.numbers("u_x");
  for (std::size_t i = 0; i < r.size(); ++i)
    EXPECT_NEAR(u[i] / (1.3 / 2e11 * 1e6 / 3 * (0.4 * r[i] + 1 / r[i])), 1, 3e-7) << r[i];
  EXPECT_NEAR(last(run, "elastic_energy") / (1e6 * 2 * pi * 0.5 * 0.1 * 4.7666666666667e-6 / 2), 1,
              3e-7);
}

// The same for a sphere: u = p a^3/(E (b^3 - a^3)) ((1 - 2 nu) r + (1 + nu) b^3/(2 r^2)). Its
// circles are polygons here, whose error is of second order.
double error_of_sphere(double size) {
  const output::TemporaryFolder folder;
  std::ofstream(folder.path() / "sphere.geo") << R"(
Point(1) = {0, 0, 0}; Point(2) = {0.5, 0, 0}; Point(3) = {1, 0, 0}; Point(4) = {0, 0.5, 0}; Point(5) = {0, 1, 0};
Line(1) = {2, 3}; Circle(2) = {3, 1, 5}; Line(3) = {5, 4}; Circle(4) = {4, 1, 2};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
Physical Curve("bottom") = {1}; Physical Curve("outer") = {2}; Physical Curve("axis") = {3};
Physical Curve("inner") = {4}; Physical Surface("body") = {1};
)";
  const RunCase run = run_text(std::string(elastic) + R"toml(
mesh = { file = "sphere.geo", degree = 2, unnamed = "natural" }
[[boundary]]
on = "bottom"
displacement = ["free", 0]
[[boundary]]
on = "inner"
traction = ["1e6*x/sqrt(x*x + y*y)", "1e6*y/sqrt(x*x + y*y)"]
)toml",
                               {fmt::format("mesh.size={}", size)}, folder.path());
  expect_closed_balances(run.history());
  const Table nodes = run.nodes();
  const std::vector<double> x = nodes.numbers("x"), y = nodes.numbers("y"),
                            ux = nodes.numbers("u_x"), uy = nodes.numbers("u_y");
  double worst = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double r = std::hypot(x[i], y[i]), u = (ux[i] * x[i] + uy[i] * y[i]) / r;
    worst = std::max(worst, std::abs(u / (1e6 / 7 / 2e11 * (0.4 * r + 1.3 / (2 * r * r))) - 1));
  }
  return worst;
}

TEST(Axisymmetric, AThickSphereIsLamesSphere) {
  const double coarse = error_of_sphere(0.08), fine = error_of_sphere(0.04);
  EXPECT_LT(fine, 2e-3);
  EXPECT_LT(fine, coarse / 2.5);
}

// Between cylinders heat and charge flow as 2 pi h c/log(b/a).
TEST(Axisymmetric, HeatAndChargeFlowThroughATubeByTheLogarithmOfItsRadii) {
  const RunCase run = run_text(R"toml(
mesh = { degree = 2, box = { min = [0.5, 0], max = [1, 0.2], cells = [16, 2], cell = "quadrilateral" } }
model.plane = "axisymmetric"
material = { symmetry = "isotropic", young = 1e11, poisson = 0.3, eps11 = 100, k11 = 2, density = 1000, specific_heat = 1000, reference_temperature = 300 }
time = { end = 1, steps = 1, regime = "static" }
boundary = [ { on = ["bottom", "top"], displacement = [0, 0] }, { on = "left", temperature = 10, potential = 5 },
             { on = "right", temperature = 0, potential = 0 } ]
)toml");
  EXPECT_NEAR(last(run, "heat_right") / (2 * pi * 0.2 * 2 * 10 / std::log(2)), 1, 1e-7);
  EXPECT_NEAR(last(run, "charge_right") / (2 * pi * 0.2 * 100 * 8.8541878128e-12 * 5 / std::log(2)),
              1, 1e-7);
}

// Uniform in each coordinate: u_r = c r, whatever the cells. Incompatible modes do no work on it.
TEST(Axisymmetric, APressedCylinderUnderVoltageStaysOne) {
  for (const char *cell : {"triangle", "quadrilateral"})
    for (const char *kind : {"mesh.degree=1", "mesh.degree=2", "mesh.modes=incompatible"}) {
      if (std::string(cell) == "triangle" && std::string(kind) == "mesh.modes=incompatible")
        continue;
      SCOPED_TRACE(std::string(cell) + kind);
      const RunCase run = run_text(fmt::format(R"toml(
mesh.box = {{ min = [0, 0], max = [0.02, 0.01], cells = [5, 4], cell = "{}", grading = {{ left = 3, top = 2 }} }}
model.plane = "axisymmetric"
material = {{ library = "BaTiO3-Liu2014", pyroelectric = [0, 1e-4] }}
time = {{ end = 1, steps = 2 }}
boundary = [ {{ on = "bottom", displacement = ["free", 0], potential = 0 }},
             {{ on = "top", traction = [0, "-1e6*t"], potential = "10*t" }}, {{ on = "right", traction = ["3e5*t", 0] }} ]
)toml",
                                               cell),
                                   {kind});
      expect_closed_balances(run.history());
      const Table nodes = run.nodes();
      const std::vector<double> x = nodes.numbers("x"), y = nodes.numbers("y"),
                                ux = nodes.numbers("u_x"), uy = nodes.numbers("u_y"),
                                phi = nodes.numbers("potential");
      const double radial = ux.back() / 0.02, axial = uy.back() / 0.01;
      for (std::size_t i = 0; i < x.size(); ++i) {
        EXPECT_NEAR(ux[i], radial * x[i], 1e-12 * std::abs(ux.back()));
        EXPECT_NEAR(uy[i], axial * y[i], 1e-12 * std::abs(uy.back()));
        EXPECT_NEAR(phi[i], 1000 * y[i], 1e-11);
      }
      EXPECT_NEAR(last(run, "load_y"), -1e6 * pi * 0.02 * 0.02, 1e-9);
    }
}

// kp^2 = 1 - (capacitance with the rim held)/(free capacitance) = 2 d31^2/(eps33^T (s11 + s12)).
TEST(Axisymmetric, ADiscHasItsMaterialsPlanarCouplingFactor) {
  const auto charge = [](const char *rim) {
    return last(run_text(std::string(R"toml(
mesh.box = { min = [0, 0], max = [0.01, 0.001], cells = [8, 2], cell = "quadrilateral" }
model = { plane = "axisymmetric", thermal = false }
material = { library = "PZT-5A" }
time = { end = 1, steps = 1, regime = "static" }
boundary = [ { on = "bottom", displacement = ["free", 0], potential = 0 }, { on = "top", potential = 1 })toml") +
                         rim + " ]"),
                "charge_top");
  };
  const double held = charge(", { on = 'right', displacement = [0, 'free'] }"), free = charge("");
  const double kp2 = 2 * 1.71e-10 * 1.71e-10 / (1700 * 8.8541878128e-12 * (1.64e-11 - 5.74e-12));
  EXPECT_NEAR(1 - held / free, kp2, 1e-9);
  EXPECT_NEAR(std::sqrt(kp2), 0.60, 0.005);  // as makers' tables have it
}

// Hertz's sphere of radius 1 m as a gap: a^3 = 3 F R/(4 E*), p0 = 3 F/(2 pi a^2).
TEST(Axisymmetric, ASphereOnAPlaneIsHertzs) {
  const double force = 1e4, modulus = 2e11 / 0.91, radius = std::cbrt(3 * force / (4 * modulus)),
               pressure = 3 * force / (2 * pi * radius * radius), width = 100 * radius;
  const RunCase run = run_text(elastic + fmt::format(R"toml(
mesh.box = {{ min = [0, 0], max = [{0}, {0}], cells = [256, 256], cell = "quadrilateral", grading = {{ left = 300, bottom = 300 }} }}
boundary = [ {{ on = "top", traction = [0, {1}] }} ]
contact = {{ on = "bottom", gap = "x^2/2", normal = "unilateral" }}
)toml",
                                                     width, -force / (pi * width * width)));
  EXPECT_NEAR(last(run, "contact_force_y") / force, 1, 1e-7);
  const Table contact = run.contact();
  const std::vector<double> x = contact.numbers("x"), p = contact.numbers("normal_traction");
  double moment = 0, above = 0, below = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double left = i > 0 ? x[i] - x[i - 1] : 0, right = i + 1 < x.size() ? x[i + 1] - x[i] : 0;
    const double weight =
        pi / 3 * (left * (3 * x[i] - left) + right * (3 * x[i] + right));  // 2 pi int N r dr
    moment -= weight * p[i] * x[i] * x[i];
    if (const double s = 1 - x[i] * x[i] / (radius * radius); s > 0.51 && s < 0.99) {
      above -= p[i] * std::sqrt(s);
      below += s;
    }
  }
  EXPECT_NEAR(std::sqrt(2.5 * moment / force) / radius, 1, 5e-4);
  EXPECT_NEAR(above / below / pressure, 1, 5e-4);
}

// A disc, spread and pressed on a plane by its upper side.
const char *const rubbed = R"toml(
mesh.box = { min = [0, 0], max = [0.02, 0.01], cells = [8, 4], cell = "quadrilateral" }
model.plane = "axisymmetric"
material = { library = "BaTiO3-Liu2014", pyroelectric = [0, 1e-4], stiffness_damping = 1e-3 }
time = { end = 1, steps = 4 }
boundary = [ { on = "top", displacement = ["5e-6*x*t", "-1e-8*sin(4*t)"], potential = "20*t", temperature = "t" } ]
[contact]
on = "bottom"
normal = "unilateral"
friction = { law = "coulomb", coefficient = 0.3 }
heat = { law = "exchange", coefficient = 2e4, foundation_temperature = 0, friction_share = 0.5 }
electric = { law = "exchange", coefficient = 1e-6, foundation_potential = 3, ramp = 1e-8 }
)toml";

TEST(Axisymmetric, IsTheSameOnEveryRoute) {
  for (const char *cells : {"mesh.degree=1", "mesh.degree=2", "mesh.modes=incompatible"}) {
    SCOPED_TRACE(cells);
    const bool hollow = std::string(cells) == "mesh.degree=2";
    const std::vector<std::string> common{
        cells, hollow ? "mesh.box.min=[0.005, 0]" : "mesh.box.min=[0, 0]"};
    const RunCase direct = run_text(rubbed, common);
    expect_closed_balances(direct.history());
    EXPECT_GT(largest(direct.history(), "friction_dissipation"), 0);
    for (const char *route : {"solver.method=monolithic", "solver.body=iterative"}) {
      std::vector<std::string> other = common;
      other.insert(other.end(), {route, "solver.linear_tolerance=1e-13"});
      const RunCase by_other = run_text(rubbed, other);
      for (const char *column : {"u_x", "u_y", "potential", "temperature"})
        EXPECT_LT(difference(by_other.nodes(), direct.nodes(), column), 1e-8) << route << column;
    }
  }
}

// A quarter of the solid, whose circles are polygons: errors of second order are left.
TEST(Axisymmetric, ATubeThatIsPressedOnItsShaftAndSlidesIsTheSolidOne) {
  const auto text = [](bool is_solid, int n) {
    return fmt::format(
        R"toml(
{}
{}
material = {{ library = "BaTiO3-Liu2014", pyroelectric = {} }}
time = {{ end = 1, steps = 2 }}
boundary = [ {{ on = "{}", displacement = {}, potential = "20*t", temperature = "3*t" }}, {{ on = "bottom", displacement = {} }},
             {{ on = "{}", traction = {} }} ]
[contact]
on = "{}"
normal = {{ law = "compliance", coefficient = 1e14 }}
friction = {{ law = "coulomb", coefficient = 0.3 }}
heat = {{ law = "exchange", coefficient = 2e4, foundation_temperature = 0 }}
)toml",
        is_solid ? fmt::format("mesh.annulus = {{ inner = 0.01, outer = 0.02, height = 0.01, cells "
                               "= [4, {}, 4], cell = 'hexahedron' }}",
                               n)
                 : "mesh.box = { min = [0.01, 0], max = [0.02, 0.01], cells = [4, 4], cell = "
                   "'quadrilateral' }",
        is_solid ? "" : "model.plane = 'axisymmetric'", is_solid ? "[0, 0, 1e-4]" : "[0, 1e-4]",
        "top", is_solid ? "['free', 'free', '-1e-6*t']" : "['free', '-1e-6*t']",
        is_solid ? "['free', 'free', 0]" : "['free', 0]", is_solid ? "outer" : "right",
        is_solid ? "['-2e6*t*x/sqrt(x*x + y*y)', '-2e6*t*y/sqrt(x*x + y*y)', 0]" : "['-2e6*t', 0]",
        is_solid ? "inner" : "left");
  };
  const RunCase section = run_text(text(false, 0));
  EXPECT_GT(largest(section.history(), "friction_dissipation"), 0);
  const auto error = [&](int n) {
    const RunCase solid = run_text(text(true, n));
    double worst = 0;
    for (const char *column :
         {"elastic_energy", "electric_energy", "friction_dissipation", "heat_top"})
      worst = std::max(worst, std::abs(last(solid, column) / last(section, column) - 1));
    return worst;
  };
  const double coarse = error(24), fine = error(48);
  EXPECT_LT(fine, 0.01);
  EXPECT_LT(fine, coarse / 3);
}

// Of a name whose facets lie in part on the axis only the others count.
TEST(Axisymmetric, FacetsOnTheAxisHoldNothing) {
  const output::TemporaryFolder folder;
  std::ofstream(folder.path() / "mixed.geo") << R"(
Point(1) = {0, 0, 0}; Point(2) = {0.01, 0, 0}; Point(3) = {0.01, 0.01, 0}; Point(4) = {0, 0.01, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
Physical Curve("base") = {1, 4}; Physical Curve("rim") = {2}; Physical Curve("top") = {3};
Physical Surface("body") = {1};
)";
  const RunCase run = run_text(std::string(elastic) + R"toml(
mesh = { file = "mixed.geo", size = 2e-3 }
boundary = [ { on = "base", displacement = ["free", 0] }, { on = "top", traction = [0, -1e6] } ]
)toml",
                               {}, folder.path());
  const Table nodes = run.nodes();
  const std::vector<double> y = nodes.numbers("y"), u = nodes.numbers("u_y");
  for (std::size_t i = 0; i < y.size(); ++i)
    EXPECT_NEAR(u[i], -5e-6 * y[i], 1e-20);
}

std::string complaint(const std::string &text, const std::vector<std::string> &overrides) {
  try {
    run_text(text, overrides);
  } catch (const CaseError &error) {
    return error.what();
  }
  return "";
}

TEST(Axisymmetric, WhatHasNoMeaningAroundAnAxisIsRefused) {
  using ::testing::HasSubstr;
  EXPECT_THAT(complaint(rubbed, {"mesh.degree=2"}), HasSubstr("needs mesh.degree = 1"));
  for (const char *near : {"5e-12", "1e-6", "4e-5"})
    EXPECT_THAT(complaint(rubbed, {"mesh.degree=2", fmt::format("mesh.box.min=[{}, 0]", near)}),
                HasSubstr("needs mesh.degree = 1"));
  for (const char *moved :
       {"initial.displacement=[1e-9, 0]", "contact.foundation_displacement=['t', 0]"})
    EXPECT_THAT(complaint(rubbed, {moved}), HasSubstr("on the axis of the body")) << moved;
  EXPECT_THAT(complaint(rubbed, {"contact.on='left'"}), HasSubstr("lies on the axis"));
  EXPECT_THAT(complaint(rubbed, {"mesh.box.min=[-0.01, 0]"}), HasSubstr("x is the radius"));
  EXPECT_THAT(complaint(rubbed, {"boundary[0].displacement=[1e-7, 0]"}),
              HasSubstr("on the axis of the body"));
  EXPECT_THAT(complaint(rubbed, {"boundary[0].on='left'"}), HasSubstr("lies on the axis"));
  EXPECT_THAT(complaint(rubbed, {"load.base_acceleration=[1, 0]"}), HasSubstr("along its axis y"));
  EXPECT_THAT(complaint(rubbed, {"material.poling=[0, 1, 1]"}), HasSubstr("poling"));
}

}  // namespace
}  // namespace tourmaline::verified
