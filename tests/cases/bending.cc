// Bodies that bend: closed forms, incompatible modes on every route, and the warning of linear
// cells that are too stiff.
#include <gmock/gmock.h>

#include <fmt/format.h>

#include "closed_balances.h"
#include "run_case.h"
#include "tourmaline/case/case.h"
#include "tourmaline/error.h"

namespace tourmaline::verified {
namespace {

using ::testing::HasSubstr;

casefile::Case read(const std::string &text) {
  return casefile::read_text(text, "bent");
}

// A free series bimorph of 20 mm by 1 mm under 50 V (cases/devices/README.md), in three dimensions
// as a strip of 4 mm.
std::string bimorph(int dimension, const std::string &mesh) {
  const std::string up = dimension == 2 ? "y" : "z", none = dimension == 2 ? "" : "0, ";
  return fmt::format(R"(
[mesh]
{0}
[[region]]
where = "{1} > 0"
material = {{ library = "BaTiO3-Liu2014", poling = [0, {2}1] }}
[[region]]
where = "{1} <= 0"
material = {{ library = "BaTiO3-Liu2014", poling = [0, {2}-1] }}
[time]
end = 1
steps = 1
[[boundary]]
on = "left"
displacement = [0, {2}0]
temperature = 0
[[boundary]]
on = "bottom"
potential = 0
temperature = 0
[[boundary]]
on = "top"
potential = "50*t"
temperature = 0
[output]
fields = false
report = false
)",
                     mesh, up, none);
}

std::string plane_mesh(const std::string &cell, int along, int through, const std::string &more) {
  return fmt::format(
      "{}\nbox = {{ min = [0, -0.5e-3], max = [20e-3, 0.5e-3], cells = [{}, {}], cell = \"{}\" }}",
      more, along, through, cell);
}

std::string solid_mesh(const std::string &cell, const std::string &more) {
  return fmt::format(
      "{}\nbox = {{ min = [0, 0, -0.5e-3], max = [20e-3, 4e-3, 0.5e-3], cells = "
      "[20, 4, 2], cell = \"{}\" }}",
      more, cell);
}

double tip(const RunCase &run) {
  return run.history().numbers("max_displacement").back();
}

std::string warnings(const RunCase &run) {
  return run.summary()["warnings"].dump();
}

const std::string modes = "modes = \"incompatible\"";

// Deflection kappa L^2 / 2 of the free laminate in plane strain.
double deflection_of_the_bimorph() {
  constexpr double c = 166e9 - 78e9 * 78e9 / 162e9, e = -4.4 - 78e9 * 18.6 / 162e9,
                   beta = 12.6e-9 + 18.6 * 18.6 / 162e9, h = 0.5e-3, length = 20e-3, volts = 50;
  return std::abs(e) * volts / (h * h * (4. / 3 * c + e * e / (3 * beta))) * length * length / 2;
}

TEST(IncompatibleModes, ABimorphOfFewQuadrilateralsBendsByTheClosedForm) {
  for (const auto &[along, through] : {std::pair(20, 2), std::pair(50, 2), std::pair(100, 4)})
    EXPECT_NEAR(tip(read(bimorph(2, plane_mesh("quadrilateral", along, through, modes)))) /
                    deflection_of_the_bimorph(),
                1, 0.03)
        << along;
}

TEST(IncompatibleModes, ABimorphOfFewHexahedraBendsAsOneOfDegree2) {
  const double fine = tip(read(bimorph(3, solid_mesh("hexahedron", "degree = 2"))));
  EXPECT_NEAR(tip(read(bimorph(3, solid_mesh("hexahedron", modes)))) / fine, 1, 0.03);
}

// F L^3 / (3 E I) and the share of shear, 6/5 F L / (G A), of an isotropic beam in plane strain.
std::string cantilever(const std::string &mesh) {
  return R"(
[mesh]
)" + mesh +
         R"(
[material]
c11 = 120e9
c12 = 40e9
c13 = 40e9
c33 = 120e9
c44 = 40e9
e31 = 0
e33 = 0
e15 = 0
beta11 = 1e-9
beta33 = 1e-9
m11 = 0
m33 = 0
pyroelectric = [0, 0]
k11 = 1
k33 = 1
density = 5000
specific_heat = 400
reference_temperature = 300
[time]
end = 1
steps = 1
[[boundary]]
on = "left"
displacement = [0, 0]
potential = 0
temperature = 0
[[boundary]]
on = "right"
traction = [0, 1e3]
[output]
fields = false
report = false
)";
}

TEST(IncompatibleModes, ACantileverOfTenSlenderQuadrilateralsInOneLayerBendsByTheClosedForm) {
  constexpr double t = 1e-3, length = 20e-3, force = 1e3 * t, g = 40e9,
                   plane = 120e9 - 40e9 * 40e9 / 120e9;
  const double exact = force * std::pow(length, 3) / (3 * plane * t * t * t / 12) +
                       6. / 5 * force * length / (g * t);
  EXPECT_NEAR(tip(read(cantilever(plane_mesh("quadrilateral", 10, 1, modes)))) / exact, 1, 0.02);
}

// Two regions, contact with friction, electrodes held and a body that bends over its foundation.
casefile::Case bent_in_contact(int dimension, const std::string &solver) {
  const std::string mesh =
      dimension == 2 ? plane_mesh("quadrilateral", 20, 4, modes) : solid_mesh("hexahedron", modes);
  return read(bimorph(dimension, mesh) +
              "[contact]\non = \"right\"\nfriction = { law = \"tresca\", bound = 2e3 }\n"
              "heat = { law = \"exchange\", coefficient = 5, foundation_temperature = -10 }\n" +
              solver);
}

void expect_one_answer(int dimension, const std::string &solver) {
  const Table direct = RunCase(bent_in_contact(dimension, "")).nodes(),
              other = RunCase(bent_in_contact(dimension, solver)).nodes();
  for (const std::string name : {"u_x", "u_y", "potential", "temperature"}) {
    const std::vector<double> a = direct.numbers(name), b = other.numbers(name);
    for (std::size_t i = 0; i < a.size(); ++i)
      ASSERT_NEAR(a[i], b[i], 1e-7 * largest(direct, name)) << name << " at row " << i;
  }
}

TEST(IncompatibleModes, EveryRouteGivesOneAnswer) {
  for (const int dimension : {2, 3})
    expect_one_answer(dimension, "[solver]\nmethod = \"monolithic\"\n");
  expect_one_answer(3, "[solver]\nbody = \"iterative\"\n");
}

TEST(IncompatibleModes, BalancesCloseAndThePivotsHaveTheirSigns) {
  for (const int dimension : {2, 3}) {
    const RunCase run(bent_in_contact(dimension, ""));
    const nlohmann::json summary = run.summary();
    EXPECT_EQ(summary["negative_pivots"], summary["sizes"]["electric_and_thermal_unknowns"]);
    expect_closed_balances(run.history());
  }
}

TEST(Locking, LinearCellsThatAreTooStiffForABimorphAreToldOf) {
  for (const char *cell : {"triangle", "quadrilateral"})
    EXPECT_THAT(warnings(read(bimorph(2, plane_mesh(cell, 50, 2, "")))), HasSubstr("bends"))
        << cell;
  for (const char *cell : {"tetrahedron", "hexahedron"})
    EXPECT_THAT(warnings(read(bimorph(3, solid_mesh(cell, "")))), HasSubstr("bends")) << cell;
  EXPECT_THAT(warnings(read(bimorph(2, plane_mesh("triangle", 128, 8, "")))), HasSubstr("bends"));
}

// One row of triangles, of which every other one belongs to the upper half.
TEST(Locking, ASlenderBodyInOneRowOfTrianglesIsToldOfAtTheEndOfARun) {
  for (const int n : {30, 60, 100})
    EXPECT_THAT(warnings(read(bimorph(2, plane_mesh("triangle", n, 1, "")))),
                HasSubstr("Give mesh.degree = 2"))
        << n;
}

// So stiff that the voltage bends it by next to nothing, and only stretches it.
TEST(Locking, ABimorphThatItsCellsBlockAltogetherIsToldOf) {
  for (const char *cell : {"triangle", "quadrilateral"})
    for (const int n : {3, 5, 10, 20, 30})
      EXPECT_THAT(warnings(read(bimorph(2, plane_mesh(cell, n, 2, "")))), HasSubstr("bends"))
          << cell << ", " << n;
}

TEST(Locking, LinearCellsThatAreTooStiffForACantileverAreToldOf) {
  for (const char *cell : {"triangle", "quadrilateral"})
    EXPECT_THAT(warnings(read(cantilever(plane_mesh(cell, 50, 4, "")))), HasSubstr("bends"))
        << cell;
  EXPECT_EQ(warnings(read(cantilever(plane_mesh("quadrilateral", 128, 8, "")))), "[]");
}

TEST(Locking, NothingIsSaidOfCellsThatCanBendAndOfBodiesThatDoNot) {
  EXPECT_EQ(warnings(read(bimorph(2, plane_mesh("triangle", 50, 2, "degree = 2")))), "[]");
  EXPECT_EQ(warnings(read(bimorph(2, plane_mesh("quadrilateral", 50, 2, modes)))), "[]");
  EXPECT_EQ(warnings(read(bimorph(3, solid_mesh("hexahedron", modes)))), "[]");
  for (const char *name : {"ouafik-2020/insulated", "ouafik-2020/conductive", "block-3d/twisted",
                           "devices/washers", "devices/friction-sensor", "devices/l-shape"})
    EXPECT_EQ(warnings(RunCase("cases/" + std::string(name) + ".toml", {"time.steps=4"})), "[]")
        << name;
}

TEST(IncompatibleModes, AreRefusedForTrianglesAndTetrahedraWithTheAdviceToTakeDegree2) {
  for (const auto &text : {bimorph(2, plane_mesh("triangle", 4, 2, modes)),
                           bimorph(3, solid_mesh("tetrahedron", modes))})
    try {
      read(text);
      FAIL();
    } catch (const CaseError &error) {
      EXPECT_THAT(error.what(), HasSubstr("modes = \"incompatible\""));
      EXPECT_THAT(error.what(), HasSubstr("mesh.degree = 2"));
    }
}

// Its stresses are the round-off and the error of the mesh, whatever share of them cells hold.
TEST(StiffCells, ABarThatHeatStretchesWithoutHindranceIsNotWarnedOf) {
  const RunCase run(read(R"(
mesh.box = { min = [0, 0], max = [0.02, 0.001], cells = [50, 2], cell = "quadrilateral" }
material.library = "aluminium"
time = { end = 1, steps = 1 }
boundary = [ { on = "left", displacement = [0, "free"], potential = 0 },
             { on = "bottom", displacement = ["free", 0] },
             { on = ["left", "right", "bottom", "top"], temperature = "10*x/0.02" } ]
)"));
  EXPECT_TRUE(run.summary()["warnings"].empty()) << run.summary()["warnings"];
}

}  // namespace
}  // namespace tourmaline::verified
