// Label: analytic. A solid in contact, turned about the contact normal with all that acts on it,
// does the same, turned.

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "../cases/run_case.h"
#include "rows_by_place.h"

namespace tourmaline::verified {
namespace {

using std::numbers::pi;

// A solid pushed, twisted and bent over its foundation z = 0, all of it turned by an angle about
// the z axis. The material is isotropic about it.
std::string turned_case(const std::string &mesh, const std::string &moved, double angle) {
  // Quarter turns to the last bit.
  const auto exact = [](double v) { return std::abs(v) < 1e-15 ? 0 : v; };
  const double c = exact(std::cos(angle)), s = exact(std::sin(angle));
  const std::string x = fmt::format("({:.17g}*x + {:.17g}*y)", c, s),
                    y = fmt::format("({:.17g}*y - {:.17g}*x)", c, s);
  const std::string u = fmt::format("(2e-9*t + 3e-8*t^2*{})", y),
                    v = fmt::format("(1e-9*t^2 - 5e-8*t*{})", x),
                    w = fmt::format("(1e-8*t*{} - 3e-10*t)", x);
  return fmt::format(R"(
{}
material = {{ library = "BaTiO3-Liu2014", pyroelectric = [0, 0, 1e-4] }}
time = {{ end = 1, steps = 4 }}
boundary = [ {{ on = "{}", displacement = ["{:.17g}*{} - {:.17g}*{}", "{:.17g}*{} + {:.17g}*{}", "{}"] }},
             {{ on = "{}", potential = "0.01*t*{}", temperature = 0 }} ]
contact = {{ on = "bottom", friction = {{ law = "tresca", bound = 3000 }}, heat = {{ law = "exchange", coefficient = 5, foundation_temperature = -10 }} }}
output = {{ fields = false }}
)",
                     mesh, moved, c, u, s, v, s, u, c, v, w, moved, y);
}

void expect_turned(const Table &original, const Table &image, const std::string &step, double angle,
                   const std::vector<std::string> &scalars,
                   const std::vector<std::string> &vectors) {
  const Rows from(original, step), to(image, step);
  const double c = std::cos(angle), s = std::sin(angle);
  std::vector<std::size_t> partner;
  for (const Place &at : from.place)
    partner.push_back(to.nearest({c * at[0] - s * at[1], s * at[0] + c * at[1], at[2]}));
  for (const std::string &name : scalars) {
    const std::vector<double> a = original.numbers(name), b = image.numbers(name);
    for (std::size_t k = 0; k < partner.size(); ++k)
      EXPECT_NEAR(b[partner[k]], a[from.row[k]], 1e-9 * largest(a)) << name;
  }
  if (const auto status = original.columns.find("status"); status != original.columns.end()) {
    for (std::size_t k = 0; k < partner.size(); ++k)
      EXPECT_EQ(image.columns.at("status")[partner[k]], status->second[from.row[k]]);
  }
  for (const std::string &name : vectors) {
    const std::vector<double> ax = original.numbers(name + "x"), ay = original.numbers(name + "y"),
                              bx = image.numbers(name + "x"), by = image.numbers(name + "y");
    const double size = std::max(largest(ax), largest(ay));
    for (std::size_t k = 0; k < partner.size(); ++k) {
      const std::size_t i = from.row[k];
      EXPECT_NEAR(bx[partner[k]], c * ax[i] - s * ay[i], 1e-9 * size) << name;
      EXPECT_NEAR(by[partner[k]], s * ax[i] + c * ay[i], 1e-9 * size) << name;
    }
  }
}

void expect_turned(const std::string &mesh, const std::string &moved, double angle) {
  const RunCase original(casefile::read_text(turned_case(mesh, moved, 0), "original"));
  const RunCase image(casefile::read_text(turned_case(mesh, moved, angle), "image"));
  expect_turned(original.nodes(), image.nodes(), "", angle, {"u_z", "potential", "temperature"},
                {"u_"});
  const Table contact = original.contact(), turned = image.contact();
  for (const std::string step : {"1", "4"})
    expect_turned(contact, turned, step, angle, {"normal_traction", "slip_rate"},
                  {"tangential_traction_", "slip_"});
  for (const char *status : {"stick", "slip"})
    EXPECT_GT(std::count(contact.columns.at("status").begin(), contact.columns.at("status").end(),
                         status),
              30);
}

TEST(TurnedAboutTheContactNormal, ABlockAndItsLoadsByAQuarterTurnTheAnswerTurnsWithThem) {
  expect_turned(
      "mesh.box = { min = [-0.05,-0.05,0], max = [0.05,0.05,0.04], cells = [5,5,3], cell = "
      "\"hexahedron\" }",
      "top", pi / 2);
}

TEST(TurnedAboutTheContactNormal, ATubesLoadsBySomeOfItsFifteenDegreesTheAnswerTurnsWithThem) {
  for (const char *cell : {"hexahedron", "tetrahedron"})
    for (const int segments : {1, 7})
      expect_turned(
          fmt::format("mesh.annulus = {{ inner = 0.02, outer = 0.05, height = 0.02, cells = "
                      "[3,24,2], cell = \"{}\" }}",
                      cell),
          "outer", segments * pi / 12);
}

}  // namespace
}  // namespace tourmaline::verified
