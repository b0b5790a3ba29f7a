// Label: analytic. What holds of contact that opens, yields or rubs by its pressure whatever the
// numbers are: in another frame, beside a plane of symmetry, one cell deep or of several regions
// the same body does the same.

#include <fmt/format.h>

#include "closed_balances.h"
#include "contact_status.h"
#include "run_case.h"
#include "same_answer.h"

namespace tourmaline::verified {
namespace {

using Overrides = std::vector<std::string>;

// Heat that crosses as friction, pressure and gap say, and charge that leaks where it touches.
const Overrides linear_exchange{},
    exchange_by_state{
        "contact.heat={law='exchange',coefficient=2e4,foundation_temperature='20*t',"
        "pressure={coefficient=3e4,reference=1e7,exponent=0.95},ramp=3e-7,friction_share=0.5}",
        "contact.electric={law='leak',coefficient=1e-6,foundation_potential='50*t',ramp=2e-7}"};

// 1. Another frame.

// Pressed and rubbed, with every law's terms: {0} what holds the top, {1} keys of the contact.
std::string rubbed(const std::string &top, const std::string &contact) {
  return fmt::format(R"toml(
mesh.box = {{ min = [0, 0], max = [0.02, 0.01], cells = [12, 6], cell = "quadrilateral" }}
material = {{ library = "BaTiO3-Liu2014", pyroelectric = [0, 1e-4] }}
time = {{ end = 1, steps = 6 }}
boundary = [ {{ on = "top", displacement = [{}], potential = 0, temperature = 0 }} ]
[contact]
on = "bottom"
gap = "3e-3*(x - 0.008)^2"
{}
heat = {{ law = "exchange", coefficient = 2e4, foundation_temperature = "20*t" }}
)toml",
                     top, contact);
}

const char *const coulomb =
    "normal = \"unilateral\"\nfriction = { law = \"coulomb\", coefficient = 0.3 }";
const char *const weakening =
    "normal = \"unilateral\"\nfriction = { law = \"coulomb\", coefficient = { static = 0.35, "
    "kinetic = 0.25, distance = 1e-6 } }";
const char *const yielding =
    "normal = { law = \"compliance\", coefficient = 1e13, exponent = 1.5 }\nfriction = { law = "
    "\"coulomb\", coefficient = 0.3, cohesion = 1e4, limit = 5e6 }";
const char *const damped =
    "normal = { law = \"damped\", coefficient = 1e12 }\nfriction = { law = \"coulomb\", "
    "coefficient = { static = 0.3, kinetic = 0.2, speed = 1e-6 } }";
const char *const held = "normal = \"bilateral\"\nfriction = { law = \"tresca\", bound = 2e6 }";

class OtherFrame : public ::testing::TestWithParam<const char *> {};
class WhatCrosses : public ::testing::TestWithParam<const char *> {};

// The foundation moves by -U and the top rests, or the foundation rests and the top moves by U.
TEST_P(OtherFrame, AFoundationThatMovesIsABodyThatIsMovedTheOtherWay) {
  const std::string ux = "1.5e-6*sin(4*t)", uy = "-6e-7*sin(3*t)";
  const RunCase foundation = run_text(rubbed(
      "0, 0",
      fmt::format("foundation_displacement = [\"-({})\", \"-({})\"]\n", ux, uy) + GetParam()));
  const RunCase body = run_text(rubbed(fmt::format("\"{}\", \"{}\"", ux, uy), GetParam()));
  const Table moved = foundation.contact(), other = body.contact();
  expect_equal_quantities(moved, other,
                          {{"normal_traction", "tangential_traction_x", "tangential_traction_y"},
                           {"gap", "slip_x"},
                           {"slip_rate"},
                           {"heat_flux"},
                           {"potential"},
                           {"temperature"}});
  EXPECT_EQ(moved.columns.at("status"), other.columns.at("status"));
  EXPECT_EQ(has_status(other, "open"), GetParam() != held);
  EXPECT_TRUE(has_status(other, "slip"));
  for (const char *column : {"friction_dissipation", "elastic_energy", "contact_force_x"})
    EXPECT_LE(difference(foundation.history(), body.history(), column), 1e-9) << column;
  // Who moves does the work.
  EXPECT_GT(largest(foundation.history(), "foundation_power"), 0);
  expect_balances(foundation);
  expect_balances(body);
}

INSTANTIATE_TEST_SUITE_P(Laws, OtherFrame,
                         ::testing::Values(coulomb, weakening, yielding, damped, held));

TEST_P(WhatCrosses, IsTheSameWhoeverMoves) {
  const std::string ux = "1.5e-6*sin(4*t)", uy = "-6e-7*sin(3*t)";
  const RunCase foundation = run_text(
      rubbed("0, 0", fmt::format("foundation_displacement = [\"-({})\", \"-({})\"]\n", ux, uy) +
                         GetParam()),
      exchange_by_state);
  const RunCase body =
      run_text(rubbed(fmt::format("\"{}\", \"{}\"", ux, uy), GetParam()), exchange_by_state);
  expect_equal_quantities(foundation.contact(), body.contact(),
                          {{"heat_flux"}, {"charge_flux"}, {"potential"}, {"temperature"}});
  expect_equal_quantities(foundation.history(), body.history(),
                          {{"friction_heat_body", "friction_heat_foundation"},
                           {"charge_bottom"},
                           {"heat_bottom", "heat_top"}});
  expect_balances(foundation);
  expect_balances(body);
}

INSTANTIATE_TEST_SUITE_P(Laws, WhatCrosses,
                         ::testing::Values(coulomb, weakening, yielding, damped, held));

TEST(OtherFrame, WhatAFoundationThatMovesDoesIsTheSupportsWorkOfTheOtherFrame) {
  const std::string ux = "1.5e-6*sin(4*t)", uy = "-6e-7*sin(3*t)";
  const Table foundation =
      run_text(
          rubbed("0, 0", fmt::format("foundation_displacement = [\"-({})\", \"-({})\"]\n", ux, uy) +
                             coulomb))
          .history();
  const Table body = run_text(rubbed(fmt::format("\"{}\", \"{}\"", ux, uy), coulomb)).history();
  std::vector<double> power = foundation.numbers("foundation_power"),
                      load = body.numbers("load_power");
  for (std::size_t n = 0; n < power.size(); ++n)
    EXPECT_NEAR(power[n], load[n], 1e-9 * largest(load)) << n;
}

// 2. A body that nothing holds but the foundation that it is pressed on.

std::string resting(const std::string &contact) {
  return R"toml(
mesh.box = { min = [-0.01, 0], max = [0.01, 0.01], cells = [8, 4], cell = "quadrilateral" }
material.library = "BaTiO3-Liu2014"
time = { end = 1, steps = 5 }
boundary = [ { on = "top", traction = ["2e5*sin(6*t)", "-1e6*(1 + t)"], potential = 0, temperature = 0 } ]
[contact]
on = "bottom"
)toml" + contact;
}

class RestingBody : public ::testing::TestWithParam<const char *> {};

TEST_P(RestingBody, GoesWhereItsFoundationGoes) {
  const std::string u[] = {"3e-6*sin(2*t)", "1e-6*t^2"};
  const RunCase rests = run_text(resting(GetParam()));
  const RunCase carried = run_text(resting(
      fmt::format("foundation_displacement = [\"{}\", \"{}\"]\n", u[0], u[1]) + GetParam()));
  const Table at_rest = rests.nodes(), moved = carried.nodes();
  const double by[] = {3e-6 * std::sin(2.), 1e-6};
  for (int c = 0; c < 2; ++c) {
    const std::string name = c == 0 ? "u_x" : "u_y";
    const std::vector<double> a = at_rest.numbers(name), b = moved.numbers(name);
    for (std::size_t i = 0; i < a.size(); ++i)
      EXPECT_NEAR(b[i], a[i] + by[c], 1e-9 * 3e-6) << name << " " << i;
  }
  expect_equal_quantities(
      carried.contact(), rests.contact(),
      {{"normal_traction", "tangential_traction_x", "tangential_traction_y"}, {"potential"}});
  EXPECT_EQ(carried.contact().columns.at("status"), rests.contact().columns.at("status"));
  expect_balances(rests);
  expect_balances(carried);
}

INSTANTIATE_TEST_SUITE_P(Laws, RestingBody,
                         ::testing::Values("normal = \"unilateral\"\nfriction = { law = "
                                           "\"coulomb\", coefficient = 0.5 }",
                                           "normal = \"bilateral\"\nfriction = { law = "
                                           "\"coulomb\", coefficient = 0.5, cohesion = 1e5 }",
                                           "normal = \"unilateral\"\nfriction = { law = "
                                           "\"tresca\", bound = 1e6 }",
                                           "normal = { law = \"compliance\", coefficient = 1e13 "
                                           "}\nfriction = { law = \"coulomb\", coefficient = 0.5 "
                                           "}"));

// 3. Nodes of which some components are prescribed: a plane of symmetry.

std::string whole_or_half(bool half) {
  return fmt::format(R"toml(
mesh.box = {{ min = [{}, 0], max = [0.02, 0.01], cells = [{}, 6], cell = "quadrilateral" }}
material.library = "BaTiO3-Liu2014"
time = {{ end = 1, steps = 4 }}
[[boundary]]
on = "top"
displacement = ["2e-5*x*t", "-1e-6*t*(1 - 3e3*x^2)"]
potential = 0
temperature = 0
{}
[contact]
on = "bottom"
gap = "2e-3*x^2"
foundation_displacement = ["-8e-6*x*sin(3*t)", 0]
normal = "unilateral"
friction = {{ law = "coulomb", coefficient = 0.3 }}
heat = {{ law = "exchange", coefficient = 2e4, foundation_temperature = "20*t" }}
)toml",
                     half ? 0 : -0.02, half ? 10 : 20,
                     half ? "[[boundary]]\non = \"left\"\ndisplacement = [0, \"free\"]" : "");
}

class PlaneOfSymmetry : public ::testing::TestWithParam<Overrides> {};

TEST_P(PlaneOfSymmetry, HalfOfTheBodyDoesWhatTheWholeDoes) {
  const RunCase half = run_text(whole_or_half(true), GetParam()),
                whole = run_text(whole_or_half(false), GetParam());
  const Table a = half.contact(), b = whole.contact();
  expect_every_status(b);
  const std::vector<double> x = b.numbers("x");
  for (const char *column : {"normal_traction", "tangential_traction_x", "slip_x", "gap",
                             "potential", "temperature", "friction_bound", "heat_flux"}) {
    const std::vector<double> ours = a.numbers(column), theirs = b.numbers(column);
    for (std::size_t i = 0, j = 0; j < theirs.size(); ++j)
      if (x[j] > -1e-9) {
        // In the plane itself the foundation bears what the friction law allows of the other half's
        // pressure, as nothing tells these apart.
        if (x[j] > 1e-9 || column != std::string("tangential_traction_x")) {
          EXPECT_NEAR(ours.at(i), theirs[j], 1e-9 * largest(theirs)) << column << " at " << x[j];
        }
        if (x[j] > 1e-9) {
          EXPECT_EQ(a.columns.at("status")[i], b.columns.at("status")[j]) << x[j];
        }
        ++i;
      }
  }
  for (const char *column : {"elastic_energy", "friction_dissipation", "foundation_power"}) {
    const std::vector<double> ours = half.history().numbers(column),
                              theirs = whole.history().numbers(column);
    for (std::size_t n = 0; n < ours.size(); ++n)
      EXPECT_NEAR(2 * ours[n], theirs[n], 1e-9 * largest(theirs)) << column;
  }
  expect_balances(half);
}

INSTANTIATE_TEST_SUITE_P(Exchange, PlaneOfSymmetry,
                         ::testing::Values(linear_exchange, exchange_by_state));

// 4. One cell deep between smooth walls, in cells of either degree.

std::string plane_or_deep(bool deep, int degree) {
  const std::string d = deep ? "0, " : "";
  return fmt::format(
      R"toml(
mesh.box = {{ min = [0, {0}0], max = [0.02, {1}0.01], cells = [8, {2}4], cell = "{3}" }}
mesh.degree = {4}
material = {{ library = "BaTiO3-Liu2014", {5} }}
time = {{ end = 1, steps = 4 }}
{6}
[[boundary]]
on = "top"
displacement = ["1e-6*sin(4*t)", {0}"-6e-7*t"]
potential = 0
temperature = 0
[contact]
on = "bottom"
gap = "3e-3*(x - 0.008)^2"
foundation_displacement = ["-4e-7*t", {0}"2e-7*sin(5*t)"]
normal = "unilateral"
friction = {{ law = "coulomb", coefficient = 0.3 }}
heat = {{ law = "exchange", coefficient = 2e4, foundation_temperature = "20*t" }}
)toml",
      d, deep ? "0.002, " : "", deep ? "1, " : "", deep ? "hexahedron" : "quadrilateral", degree,
      deep ? "poling = [0, 0, 1], axis1 = [1, 0, 0]" : "poling = [0, 1]",
      deep ? "[[boundary]]\non = [\"front\", \"back\"]\ndisplacement = [\"free\", 0, \"free\"]"
           : "");
}

class OneCellDeep : public ::testing::TestWithParam<std::tuple<int, Overrides>> {};

TEST_P(OneCellDeep, ASolidDoesWhatThePlaneBodyDoes) {
  const auto &[degree, exchange] = GetParam();
  const RunCase plane = run_text(plane_or_deep(false, degree), exchange),
                solid = run_text(plane_or_deep(true, degree), exchange);
  const Table flat = plane.contact(), deep = solid.contact();
  EXPECT_TRUE(has_status(flat, "slip"));
  EXPECT_TRUE(has_status(flat, "open"));
  const std::size_t layers = deep.n_rows() / flat.n_rows();
  ASSERT_EQ(layers, static_cast<std::size_t>(degree + 1));
  const std::vector<double> x = flat.numbers("x"), step = flat.numbers("step"),
                            deep_x = deep.numbers("x"), deep_step = deep.numbers("step");
  for (const auto &[column, of_deep] :
       std::map<std::string, std::string>{{"normal_traction", "normal_traction"},
                                          {"tangential_traction_x", "tangential_traction_x"},
                                          {"slip_x", "slip_x"},
                                          {"gap", "gap"},
                                          {"friction_bound", "friction_bound"},
                                          {"potential", "potential"},
                                          {"heat_flux", "heat_flux"},
                                          {"charge_flux", "charge_flux"},
                                          {"temperature", "temperature"}}) {
    const std::vector<double> theirs = flat.numbers(column), ours = deep.numbers(of_deep);
    for (std::size_t i = 0; i < ours.size(); ++i) {
      const std::size_t j = i / layers;  // by x, then y
      ASSERT_EQ(deep_step[i], step[j]);
      ASSERT_NEAR(deep_x[i], x[j], 1e-12);
      EXPECT_NEAR(ours[i], theirs[j], 1e-9 * largest(theirs)) << column << " " << x[j];
      EXPECT_EQ(deep.columns.at("status")[i], flat.columns.at("status")[j]);
    }
  }
  for (const auto &[column, of_deep] :
       std::map<std::string, std::string>{{"contact_force_y", "contact_force_z"},
                                          {"foundation_power", "foundation_power"},
                                          {"friction_dissipation", "friction_dissipation"}})
    for (std::size_t n = 0; n < 4; ++n)
      EXPECT_NEAR(solid.history().numbers(of_deep)[n] / 0.002, plane.history().numbers(column)[n],
                  1e-9 * largest(plane.history(), column))
          << column;
  expect_balances(solid);
  expect_balances(plane);
}

INSTANTIATE_TEST_SUITE_P(Degree, OneCellDeep,
                         ::testing::Combine(::testing::Values(1, 2),
                                            ::testing::Values(linear_exchange, exchange_by_state)));

// 5. Regions and a circuit.

std::string device(const std::string &regions) {
  return R"toml(
mesh.box = { min = [0, 0], max = [0.02, 0.01], cells = [12, 6], cell = "quadrilateral" }
time = { end = 0.5, steps = 5 }
boundary = [ { on = "top", displacement = ["4e-7*sin(8*t)", "-6e-7*sin(9*t)"], temperature = 0 } ]
electrode = [ { name = "ground", on = "bottom", voltage = 0 },
              { name = "sensor", on = "top", resistor = 2e5 } ]
contact = { on = "bottom", normal = "unilateral", friction = { law = "coulomb", coefficient = 0.3 } }
)toml" + regions;
}

const char *const one_region = "material.library = \"BaTiO3-Liu2014\"";
const char *const two_regions = R"toml(
region = [ { where = "y < 0.005", material.library = "BaTiO3-Liu2014" },
           { where = "y >= 0.005", material.library = "BaTiO3-Liu2014" } ]
)toml";

TEST(Device, OfTwoRegionsOfOneMaterialIsThatOfOne) {
  const RunCase one = run_text(device(one_region)), two = run_text(device(two_regions));
  expect_every_status(one.contact());
  expect_same_answer(one, two, 2);
  expect_balances(one);
}

TEST(Device, TheResistorTakesWhatTheCurrentOfTheRubbedBodyDrives) {
  const Table history = run_text(device(one_region)).history();
  const std::vector<double> voltage = history.numbers("electrode_sensor_voltage"),
                            current = history.numbers("electrode_sensor_current");
  EXPECT_GT(largest(voltage), 1);
  for (std::size_t n = 0; n < voltage.size(); ++n)
    EXPECT_NEAR(voltage[n], -2e5 * current[n], 1e-9 * largest(voltage)) << n;
}

// What forces that would close the gap leave of round-off is no lack of energy.
TEST(FarFromTheFoundation, ABodyMovesAsOneWithoutContact) {
  for (const char *gap : {"1e-4", "3e-3", "1"}) {
    const RunCase run = run_text(R"toml(
mesh.box = { min = [0, 0], max = [0.1, 0.05], cells = [8, 4], cell = "quadrilateral" }
material.library = "BaTiO3-Liu2014"
time = { end = 1, steps = 4 }
boundary = [ { on = "top", displacement = [0, "-1e-6*t"], potential = 0 } ]
contact = { on = "bottom", normal = "unilateral" }
)toml",
                                 {std::string("contact.gap=") + gap});
    for (const double u : run.nodes().numbers("u_y"))
      EXPECT_NEAR(u, -1e-6, 1e-16 + 1e-15 * std::stod(gap));
    EXPECT_EQ(run.history().numbers("open").back(), 9);
  }
}

}  // namespace
}  // namespace tourmaline::verified
