// Label: analytic. In plane stress a sheet does what a solid does whose faces are free.

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "../cases/closed_balances.h"
#include "../cases/run_case.h"
#include "rows_by_place.h"
#include "tourmaline/error.h"

namespace tourmaline::verified {
namespace {

constexpr double thickness = 0.004;

// Pressed on a foundation that yields, pulled, under voltage and warmed: everything is uniform. The
// sheet's x and y are the solid's x and z.
std::string uniform(bool is_sheet) {
  const auto in = [&](const char *sheet, const char *solid) { return is_sheet ? sheet : solid; };
  return fmt::format(
      R"toml(
mesh.box = {{ {} }}
{}
material = {{ library = "BaTiO3-Liu2014", pyroelectric = {} }}
time = {{ end = 0.2, steps = 3 }}
boundary = [ {{ on = "left", displacement = {} }}, {}
             {{ on = "right", traction = {} }}, {{ on = "top", traction = {}, potential = "30*t" }},
             {{ on = "bottom", potential = 0 }} ]
load.heat = "1e7*t"
contact = {{ on = "bottom", normal = {{ law = "compliance", coefficient = 1e14 }} }}
)toml",
      in("min = [0, 0], max = [0.1, 0.1], cells = [3, 3], cell = 'quadrilateral'",
         "min = [0, 0, 0], max = [0.1, 0.004, 0.1], cells = [3, 1, 3], cell = 'hexahedron'"),
      in("model.plane = 'stress'", ""), in("[0, 1e-4]", "[0, 0, 1e-4]"),
      in("[0, 'free']", "[0, 'free', 'free']"),
      in("", "{ on = 'front', displacement = ['free', 0, 'free'] },"),
      in("['2e7*t', 0]", "['2e7*t', 0, 0]"), in("[0, '-5e7*t']", "[0, 0, '-5e7*t']"));
}

TEST(PlaneStress, ASheetDoesWhatASolidWithFreeFacesDoes) {
  const RunCase sheet = run_text(uniform(true)), solid = run_text(uniform(false));
  expect_closed_balances(sheet.history());
  const Table a = sheet.nodes(), b = solid.nodes();
  const Rows in_sheet(a, ""), in_solid(b, "");
  for (const auto &[of_sheet, of_solid] :
       std::vector<std::pair<std::string, std::string>>{{"u_x", "u_x"},
                                                        {"u_y", "u_z"},
                                                        {"potential", "potential"},
                                                        {"temperature", "temperature"}}) {
    const std::vector<double> one = a.numbers(of_sheet), other = b.numbers(of_solid);
    for (std::size_t k = 0; k < in_solid.row.size(); ++k) {
      const Place &at = in_solid.place[k];
      EXPECT_NEAR(other[in_solid.row[k]], one[in_sheet.nearest({at[0], at[2], 0})],
                  1e-9 * largest(one))
          << of_sheet;
    }
  }
  const auto whole = [](const RunCase &run) {
    double sum = 0;
    for (const char *part :
         {"elastic_energy", "electric_energy", "thermal_energy", "coupling_energy"})
      sum += run.history().numbers(part).back();
    return sum;
  };
  EXPECT_NEAR(thickness * whole(sheet) / whole(solid), 1, 1e-8);
  for (const char *column : {"contact_energy", "load_power", "charge_top"})
    EXPECT_NEAR(solid.history().numbers(column).back(),
                thickness * sheet.history().numbers(column).back(),
                1e-8 * std::abs(solid.history().numbers(column).back()))
        << column;
}

// The bimorph of polyvinylidene fluoride that has its closed form 3 d31 V L^2 / (2 h^2), without
// the coupling, in makers' and in program's handbooks.
std::string bimorph(const std::string &mesh, const char *up) {
  return fmt::format(R"toml(
{0}
time = {{ end = 1, steps = 1, regime = "static" }}
boundary = [ {{ on = "left", displacement = [0, {1}0], temperature = 0 }}, {{ on = "top", potential = 100 }},
             {{ on = "bottom", potential = 0 }} ]
[[region]]
where = "{2} > 0"
material = {{ s11 = 5e-10, s12 = -1.45e-10, s13 = -1.45e-10, s33 = 5e-10, s44 = 1.290322580645e-9, d33 = -3e-11, d31 = 2.2e-11, d15 = 0, eps11_T = 12, eps33_T = 12, k11 = 0.2, k33 = 0.2, density = 1780, specific_heat = 1200, reference_temperature = 293, poling = [0, {1}1] }}
[[region]]
where = "{2} <= 0"
material = {{ s11 = 5e-10, s12 = -1.45e-10, s13 = -1.45e-10, s33 = 5e-10, s44 = 1.290322580645e-9, d33 = -3e-11, d31 = 2.2e-11, d15 = 0, eps11_T = 12, eps33_T = 12, k11 = 0.2, k33 = 0.2, density = 1780, specific_heat = 1200, reference_temperature = 293, poling = [0, {1}-1] }}
)toml",
                     mesh, *up == 'y' ? "" : "0, ", up);
}

TEST(PlaneStress, ABimorphBendsByItsClosedFormAndAsANarrowBeam) {
  const auto tip = [](const std::string &text) {
    return run_text(text).history().numbers("max_displacement").back();
  };
  const double plane =
      tip(bimorph("mesh = { degree = 2, box = { min = [0, -0.5e-3], max = [0.1, "
                  "0.5e-3], cells = [100, 8] } }\nmodel.plane = 'stress'",
                  "y"));
  EXPECT_NEAR(plane, 3.29e-5, 0.003 * 3.29e-5);
  EXPECT_NEAR(plane, 3.3e-5, 0.005 * 3.3e-5);
  const double beam =
      tip(bimorph("mesh = { degree = 2, box = { min = [0, 0, -0.5e-3], max = [0.1, "
                  "1e-3, 0.5e-3], cells = [40, 1, 2], cell = 'hexahedron' } }",
                  "z"));
  EXPECT_NEAR(plane / beam, 1, 0.01);
}

// Contact that rubs, on every route, with cells of each kind.
const char *const rubbed = R"toml(
mesh.box = { min = [0, 0], max = [0.02, 0.01], cells = [8, 4], cell = "quadrilateral" }
model.plane = "stress"
material = { library = "BaTiO3-Liu2014", pyroelectric = [0, 1e-4], stiffness_damping = 1e-3 }
time = { end = 1, steps = 4 }
boundary = [ { on = "top", displacement = ["2e-8*t", "-1e-8*sin(4*t)"], potential = "20*t", temperature = "t" } ]
[contact]
on = "bottom"
normal = "unilateral"
friction = { law = "coulomb", coefficient = 0.3 }
heat = { law = "exchange", coefficient = 2e4, foundation_temperature = 0 }
)toml";

TEST(PlaneStress, IsTheSameOnEveryRoute) {
  for (const char *cells : {"mesh.degree=1", "mesh.degree=2", "mesh.modes=incompatible"}) {
    SCOPED_TRACE(cells);
    const RunCase direct = run_text(rubbed, {cells});
    expect_closed_balances(direct.history());
    EXPECT_GT(largest(direct.history(), "friction_dissipation"), 0);
    for (const char *route : {"solver.method=monolithic", "solver.body=iterative"}) {
      const RunCase other = run_text(rubbed, {cells, route, "solver.linear_tolerance=1e-13"});
      for (const char *column : {"u_x", "u_y", "potential", "temperature"})
        EXPECT_LT(difference(other.nodes(), direct.nodes(), column), 1e-8) << route << column;
    }
  }
}

// A material that the plane would move out of itself has no plane strain, but a plane stress.
TEST(PlaneStress, IsRefusedInThreeDimensionsAndUnderAnotherName) {
  const auto complaint = [](const std::string &text, const std::string &override) {
    try {
      run_text(text, {override});
    } catch (const CaseError &error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_THAT(complaint(uniform(false), "model.plane=stress"),
              ::testing::HasSubstr("a mesh of two dimensions"));
  EXPECT_THAT(complaint(uniform(true), "model.plane=stres"),
              ::testing::HasSubstr("did you mean \"stress\"?"));
}

}  // namespace
}  // namespace tourmaline::verified
