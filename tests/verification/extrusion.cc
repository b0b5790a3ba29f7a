// Label: analytic. In plane strain a solid must do what the plane case that it extends does.

#include "../cases/run_case.h"
#include "rows_by_place.h"

namespace tourmaline::verified {
namespace {

const std::string no_fields = "output.fields=false";

const char *const plane_case = R"(
[mesh]
box = { min = [0, 0], max = [0.1, 0.1], cells = [12, 12], cell = "quadrilateral" }
[material]
library = "BaTiO3-Liu2014"
pyroelectric = [0, 1e-4]
[time]
end = 0.2
steps = 10
[[boundary]]
on = "right"
displacement = [0, 0]
potential = 0
temperature = 0
[[boundary]]
on = ["bottom", "top"]
temperature = 0
[[boundary]]
on = "top"
traction = ["3*t", "-5*t"]
[contact]
on = "left"
friction = { law = "tresca", bound = 12 }
heat = { law = "exchange", coefficient = 1, foundation_temperature = -27 }
)";

// The plane's x and y are the solid's x and z; across them nothing moves.
const char *const extruded_case = R"(
[mesh]
box = { min = [0, 0, 0], max = [0.1, 0.013, 0.1], cells = [12, 1, 12], cell = "hexahedron" }
[material]
library = "BaTiO3-Liu2014"
pyroelectric = [0, 0, 1e-4]
[time]
end = 0.2
steps = 10
[[boundary]]
on = "right"
displacement = [0, 0, 0]
potential = 0
temperature = 0
[[boundary]]
on = ["bottom", "top"]
temperature = 0
[[boundary]]
on = "top"
traction = ["3*t", 0, "-5*t"]
[[boundary]]
on = ["front", "back"]
displacement = ["free", 0, "free"]
[contact]
on = "left"
friction = { law = "tresca", bound = 12 }
heat = { law = "exchange", coefficient = 1, foundation_temperature = -27 }
)";

void expect_extruded(const Table &plane, const Table &solid, const std::string &step,
                     const std::vector<std::pair<std::string, std::string>> &columns) {
  const Rows in_plane(plane, step), in_solid(solid, step);
  ASSERT_EQ(in_solid.row.size(), 2 * in_plane.row.size());
  for (const auto &[of_plane, of_solid] : columns) {
    const std::vector<double> a = plane.numbers(of_plane), b = solid.numbers(of_solid);
    double worst = 0;
    for (std::size_t k = 0; k < in_solid.row.size(); ++k) {
      const Place &at = in_solid.place[k];
      worst =
          std::max(worst, std::abs(b[in_solid.row[k]] - a[in_plane.nearest({at[0], at[2], 0})]));
    }
    EXPECT_LT(worst, 1e-8 * largest(a)) << of_plane << " " << step;
  }
}

class Extrusion : public ::testing::TestWithParam<const char *> {};

TEST_P(Extrusion, InPlaneStrainASolidDoesWhatThePlaneCaseDoes) {
  const std::string method = std::string("solver.method=") + GetParam();
  const RunCase plane(casefile::read_text(plane_case, "plane", {no_fields, method}));
  const RunCase solid(casefile::read_text(extruded_case, "solid", {no_fields, method}));
  expect_extruded(
      plane.nodes(), solid.nodes(), "",
      {{"u_x", "u_x"}, {"u_y", "u_z"}, {"potential", "potential"}, {"temperature", "temperature"}});
  const Table contact = plane.contact(), of_solid = solid.contact();
  for (const std::string step : {"1", "5", "10"})
    expect_extruded(contact, of_solid, step,
                    {{"normal_traction", "normal_traction"},
                     {"tangential_traction_y", "tangential_traction_z"},
                     {"slip_y", "slip_z"},
                     {"slip_rate", "slip_rate"},
                     {"heat_flux", "heat_flux"}});
  const auto count = [](const Table &table, const char *status) {
    const auto &all = table.columns.at("status");
    return std::count(all.begin(), all.end(), status);
  };
  EXPECT_GT(count(contact, "stick"), 3);
  EXPECT_GT(count(contact, "slip"), 3);
  EXPECT_EQ(count(of_solid, "slip"), 2 * count(contact, "slip"));
  EXPECT_LT(largest(of_solid.numbers("slip_y")), 1e-8 * largest(of_solid.numbers("slip_z")));
}

INSTANTIATE_TEST_SUITE_P(Routes, Extrusion, ::testing::Values("condensed", "monolithic"));

}  // namespace
}  // namespace tourmaline::verified
