#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "report/result.h"
#include "run/survey.h"
#include "run_case.h"
#include "tourmaline/case/case.h"
#include "tourmaline/error.h"

namespace tourmaline::verified {
namespace {

using ::testing::HasSubstr;

class MeshFileCase : public ::testing::Test {
 protected:
  void put(const std::string &name, const std::string &text) const {
    std::ofstream(folder_ / name) << text;
  }
  casefile::Case read(const std::string &text, std::vector<std::string> overrides = {}) const {
    overrides.push_back("output.fields=false");
    return casefile::read_text(text, (folder_ / "case.toml").string(), overrides,
                               mesh::read_mesh_file);
  }
  std::string complaint(const std::string &text, std::vector<std::string> overrides = {}) const {
    try {
      read(text, std::move(overrides));
    } catch (const CaseError &error) {
      return error.what();
    }
    return "";
  }

  output::TemporaryFolder folder_;
};

const std::string square = R"(
Point(1) = {0, 0, 0}; Point(2) = {0.1, 0, 0}; Point(3) = {0.1, 0.1, 0}; Point(4) = {0, 0.1, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
Physical Curve("under") = {1}; Physical Curve("clamp") = {2};
Physical Curve("over") = {3}; Physical Curve("rub") = {4};
Physical Surface("body") = {1};
)";
const std::string of_equal_squares =
    "Transfinite Curve {1, 2, 3, 4} = 9; Transfinite Surface {1}; Recombine Surface {1};\n";

const std::string rubbed = R"(
mesh.file = "square.geo"
material.library = "BaTiO3-Liu2014"
time = { end = 0.2, steps = 2 }
boundary = [
  { on = "clamp", displacement = [0, 0], potential = 0, temperature = 0 },
  { on = ["under", "over"], temperature = 0 },
  { on = "over", traction = [0, "-50*t"] },
]
[contact]
on = "rub"
friction = { law = "tresca", bound = 15 }
heat = { law = "exchange", coefficient = 1, foundation_temperature = -27 }
)";

std::string on_a_box(std::string text) {
  const auto replace = [&](const std::string &from, const std::string &to) {
    for (std::size_t at; (at = text.find(from)) != std::string::npos;)
      text.replace(at, from.size(), to);
  };
  replace(
      "mesh.file = \"square.geo\"",
      "mesh.box = { min = [0, 0], max = [0.1, 0.1], cells = [8, 8], cell = \"quadrilateral\" }");
  replace("clamp", "right");
  replace("\"under\"", "\"bottom\"");
  replace("\"over\"", "\"top\"");
  replace("\"rub\"", "\"left\"");
  return text;
}

// The same cells, listed and numbered differently.
TEST_F(MeshFileCase, ASquareFromGmshGivesTheResultsOfTheSameBox) {
  put("square.geo", square + of_equal_squares);
  const RunCase file(read(rubbed)), box(read(on_a_box(rubbed)));
  for (const char *column : {"x", "y", "u_x", "u_y", "potential", "temperature"}) {
    const auto a = file.nodes().numbers(column), b = box.nodes().numbers(column);
    ASSERT_EQ(a.size(), b.size());
    double size = 0;
    for (const double value : b)
      size = std::max(size, std::abs(value));
    for (std::size_t i = 0; i < a.size(); ++i)
      EXPECT_NEAR(a[i], b[i], 1e-9 * size) << column << " at node " << i;
  }
  EXPECT_EQ(file.contact().numbers("x").size(), box.contact().numbers("x").size());
}

// Facets of a plane body do not tell the shape of its cells.
TEST_F(MeshFileCase, AResultOnQuadrilateralsWithIncompatibleModesIsReadAgain) {
  put("square.geo", square + of_equal_squares);
  const casefile::Case asked = casefile::read_text(
      rubbed, (folder_ / "case.toml").string(), {"mesh.modes=incompatible"}, mesh::read_mesh_file);
  const auto results = folder_ / "results";
  run::simulate(asked, results, {.quiet = true});
  const report::Result result = report::read_result(results, {1'000'000, {}});
  EXPECT_EQ(result.remarks, std::vector<std::string>());
  EXPECT_EQ(result.contact_pieces.size(), 1);
  EXPECT_TRUE(result.asked);
  const casefile::Case next = casefile::read_text(
      rubbed, (folder_ / "next.toml").string(), {"mesh.modes=incompatible", "initial.from=results"},
      mesh::read_mesh_file);
  EXPECT_NO_THROW(run::simulate(next, folder_ / "next", {.quiet = true}));
}

// A side that lies on the axis in part, where it has neither area nor centre.
TEST_F(MeshFileCase, TheSurveyOfABodyOfRevolutionHasNumbersForEveryBoundary) {
  put("half.geo", R"(
Point(1) = {0, 0, 0}; Point(2) = {0.1, 0, 0}; Point(3) = {0.1, 0.1, 0}; Point(4) = {0, 0.1, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
Physical Curve("foot") = {1}; Physical Curve("rest") = {2, 3, 4}; Physical Curve("axis") = {4};
Physical Surface("body") = {1};
)");
  const std::string text = run::survey(read(R"(
mesh.file = "half.geo"
model.plane = "axisymmetric"
material.library = "BaTiO3-Liu2014"
time = { end = 1, steps = 1 }
[[boundary]]
on = "foot"
displacement = [0, 0]
potential = 0
temperature = 0
)"));
  EXPECT_THAT(text, ::testing::Not(HasSubstr("nan")));
  // 2 pi r h and pi r^2, whose centres stand at r and 2/3 r, at h/2 and h.
  EXPECT_THAT(text,
              HasSubstr("# boundary \"rest\": area 0.0942478 m^2, centre (0.08889, 0.06667)"));
  EXPECT_THAT(text, HasSubstr("# boundary \"axis\": on the axis, without area"));
}

// A linear state is in the space of every mesh and obeys the equations: it must come back to
// round-off, whatever the shape and orientation of the cells.
void expect_patch(const casefile::Case &asked) {
  const RunCase run(asked);
  const auto nodes = run.nodes();
  const auto x = nodes.numbers("x"), y = nodes.numbers("y");
  const bool solid = asked.dimension == 3;
  const auto z = solid ? nodes.numbers("z") : std::vector<double>(x.size(), 0.);
  for (std::size_t i = 0; i < x.size(); ++i) {
    EXPECT_NEAR(nodes.numbers("u_x")[i], 1e-6 * (x[i] + 2 * y[i] + z[i]), 1e-17);
    EXPECT_NEAR(nodes.numbers("u_y")[i], 1e-6 * (3 * x[i] - y[i]), 1e-17);
    EXPECT_NEAR(nodes.numbers("potential")[i], 10 * (x[i] - 4 * y[i] + z[i]), 1e-11);
  }
}

TEST_F(MeshFileCase, LinearStatesAreExactOnUnstructuredTrianglesAndQuadrilaterals) {
  for (const char *shape : {"", "Recombine Surface {1};"}) {
    put("square.geo", square + shape + "\n");
    for (const char *degree : {"mesh.degree=1", "mesh.degree=2"})
      expect_patch(read(R"case(
mesh.file = "square.geo"
mesh.size = 0.02
material.library = "BaTiO3-Liu2014"
time = { end = 1, steps = 1 }
[[boundary]]
on = ["clamp", "rub", "over", "under"]
displacement = ["1e-6*(x+2*y)", "1e-6*(3*x-y)"]
potential = "10*(x-4*y)"
temperature = 0
[initial]   # as a strain that comes about warms the body
displacement = ["1e-6*(x+2*y)", "1e-6*(3*x-y)"]
potential = "10*(x-4*y)"
)case",
                        {degree}));
  }
}

TEST_F(MeshFileCase, LinearStatesAreExactOnUnstructuredTetrahedraAndOnHexahedra) {
  const std::string base =
      "Point(1) = {0, 0, 0}; Point(2) = {0.1, 0, 0}; Point(3) = {0.13, 0.1, 0}; "
      "Point(4) = {0, 0.1, 0};\nLine(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = "
      "{3, 4}; Line(4) = {4, 1};\nCurve Loop(1) = {1, 2, 3, 4}; Plane "
      "Surface(1) = {1};\n";
  for (const std::string &shape :
       {std::string("e[] = Extrude {0.01, 0, 0.1} { Surface{1}; };"),
        std::string("Recombine Surface {1}; e[] = Extrude {0.01, 0, 0.1} { Surface{1}; Layers{3}; "
                    "Recombine; };")}) {
    put("solid.geo", base + shape +
                         "\nPhysical Surface(\"skin\") = {1, e[0], e[2], e[3], e[4], e[5]}; "
                         "Physical Volume(\"body\") = {e[1]};\n");
    for (const char *degree : {"mesh.degree=1", "mesh.degree=2"})
      expect_patch(read(R"case(
mesh.file = "solid.geo"
mesh.size = 0.06
material.library = "BaTiO3-Liu2014"
time = { end = 1, steps = 1 }
[[boundary]]
on = "skin"
displacement = ["1e-6*(x+2*y+z)", "1e-6*(3*x-y)", 0]
potential = "10*(x-4*y+z)"
temperature = 0
[initial]
displacement = ["1e-6*(x+2*y+z)", "1e-6*(3*x-y)", 0]
potential = "10*(x-4*y+z)"
)case",
                        {degree}));
  }
}

TEST_F(MeshFileCase, ANameThatDoesNotExistIsAnsweredWithThoseThatDo) {
  put("square.geo", square);
  EXPECT_THAT(complaint(rubbed, {"boundary[0].on=clmp", "mesh.size=0.02"}),
              AllOf(HasSubstr("\"under\", \"clamp\", \"over\", \"rub\""),
                    HasSubstr("did you mean \"clamp\"?")));
}

TEST_F(MeshFileCase, FacetsWithoutANameAreAMistakeUntilTheCaseSaysWhatTheyAre) {
  std::string without = square;
  without.replace(without.find("Physical Curve(\"over\") = {3};"), 29, "");
  put("square.geo", without + of_equal_squares);
  std::string text = rubbed;
  text.replace(text.find("[\"under\", \"over\"]"), 17, "\"under\"");
  const std::string load = "  { on = \"over\", traction = [0, \"-50*t\"] },\n";
  text.replace(text.find(load), load.size(), "");
  EXPECT_THAT(complaint(text), AllOf(HasSubstr("8 of the 32 facets"), HasSubstr("mesh.unnamed")));
  EXPECT_EQ(complaint(text, {"mesh.unnamed=natural"}), "");
}

TEST_F(MeshFileCase, ABoundaryInsideTheBodyIsRefusedByName) {
  put("square.geo", square + R"(Point(5) = {0.2, 0, 0}; Point(6) = {0.2, 0.1, 0};
Line(5) = {2, 5}; Line(6) = {5, 6}; Line(7) = {6, 3}; Curve Loop(2) = {5, 6, 7, -2};
Plane Surface(2) = {2}; Physical Surface("more") = {2}; Physical Curve("rest") = {5, 6, 7};

)");
  EXPECT_THAT(complaint(rubbed, {"mesh.size=0.03"}), HasSubstr("\"clamp\" lies inside the body"));
}

TEST_F(MeshFileCase, TwoNamesOfOneFacetMayNotPrescribeTheSameField) {
  put("square.geo", square + of_equal_squares + "Physical Curve(\"electrode\") = {2, 3};\n");
  const std::string entry = "boundary[1]={on='electrode',potential=1}";
  EXPECT_THAT(complaint(rubbed, {entry}), HasSubstr("has already a condition on the potential"));
  EXPECT_EQ(complaint(rubbed, {"boundary[1]={on='electrode',surface_charge=0}",
                               "boundary[0]={on='clamp',displacement=[0,0],temperature=0}",
                               "boundary[2]={on='under',potential=0}"}),
            "");
}

TEST_F(MeshFileCase, ABodyThatNothingHoldsIsRefused) {
  put("square.geo", square + of_equal_squares);
  EXPECT_THAT(
      complaint(rubbed, {"boundary[0]={on='clamp',potential=0}", "contact.friction={law='none'}"}),
      HasSubstr("a translation along y"));
}

TEST_F(MeshFileCase, TheResolvedCaseFindsTheMeshFromAnotherFolder) {
  put("square.geo", square + of_equal_squares);
  const RunCase first(read(rubbed));
  const RunCase again(
      casefile::read_file(first.folder() / "resolved.toml", {}, mesh::read_mesh_file));
  EXPECT_EQ(first.nodes().numbers("u_x"), again.nodes().numbers("u_x"));
}

}  // namespace
}  // namespace tourmaline::verified
