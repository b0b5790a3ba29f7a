#include "tourmaline/mesh/gmsh.h"

#include <gmock/gmock.h>
#include <gmsh.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "../output/temporary_folder.h"
#include "body/discretisation.h"
#include "mesh/shapes.h"
#include "tourmaline/case/case.h"
#include "tourmaline/error.h"

namespace tourmaline::mesh {
namespace {

using casefile::CellShape;
using testing::HasSubstr;
using testing::UnorderedElementsAre;

/// A folder for mesh files that goes away with the test.
class MeshFiles : public testing::Test {
 protected:
  casefile::MeshCase text(const std::string &name, const std::string &contents) const {
    std::ofstream(folder_ / name) << contents;
    return file(name);
  }
  casefile::MeshCase file(const std::string &name) const {
    casefile::MeshCase asked;
    asked.file = (folder_ / name).string();
    return asked;
  }
  casefile::MeshCase geo(const std::string &contents, double size) const {
    casefile::MeshCase asked = text("body.geo", contents);
    asked.size = size;
    return asked;
  }
  /// What Gmsh itself saves.
  casefile::MeshCase saved(const std::string &geometry, double version, bool binary,
                           int order = 1) const {
    const casefile::MeshCase from = text("body.geo", geometry);
    gmsh::initialize(0, nullptr, false);
    gmsh::option::setNumber("General.Terminal", 0);
    gmsh::open(*from.file);
    gmsh::option::setNumber("Mesh.MshFileVersion", version);
    gmsh::option::setNumber("Mesh.Binary", binary ? 1 : 0);
    gmsh::option::setNumber("Mesh.ElementOrder", order);
    gmsh::model::mesh::generate(gmsh::model::getDimension());
    gmsh::write((folder_ / "body.msh").string());
    gmsh::finalize();
    return file("body.msh");
  }
  std::string complaint(const casefile::MeshCase &asked) const {
    try {
      read_mesh_file(asked);
    } catch (const CaseError &error) {
      return error.what();
    }
    return "";
  }

  output::TemporaryFolder folder_;
};

// A rectangle of 2 by 3; the fifth point belongs to nothing, as stray points of sketches do.
const std::string rectangle = R"(
lc = 0.5;
Point(1) = {0, 0, 0, lc}; Point(2) = {2, 0, 0, lc}; Point(3) = {2, 3, 0, lc}; Point(4) = {0, 3, 0, lc};
Point(5) = {9, 9, 0, lc};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
Physical Curve("bottom") = {1}; Physical Curve("right") = {2};
Physical Curve("top") = {3}; Physical Curve("left") = {4};
Physical Curve("round") = {1, 2, 3, 4};
Physical Surface("body") = {1};
)";
const std::string of_squares = "Recombine Surface {1};\n";

// The rectangle drawn up by 5; -1 turns it over, so that cells are listed left-handed.
const std::string block = R"(
lc = 1.2;
Point(1) = {0, 0, 0, lc}; Point(2) = {2, 0, 0, lc}; Point(3) = {2, 3, 0, lc}; Point(4) = {0, 3, 0, lc};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
)";
const std::string drawn_up = R"(
out[] = Extrude {0, 0, 5} { Surface{1}; };
Physical Surface("bottom") = {1}; Physical Surface("top") = {out[0]};
Physical Surface("front") = {out[2]}; Physical Surface("right") = {out[3]};
Physical Surface("back") = {out[4]}; Physical Surface("left") = {out[5]};
Physical Volume("body") = {out[1]};
)";
const std::string in_layers = R"(
Recombine Surface {1};
out[] = Extrude {0, 0, 5} { Surface{1}; Layers{3}; Recombine; };
Physical Surface("bottom") = {1}; Physical Surface("top") = {out[0]};
Physical Surface("front") = {out[2]}; Physical Surface("right") = {out[3]};
Physical Surface("back") = {out[4]}; Physical Surface("left") = {out[5]};
Physical Volume("body") = {out[1]};
)";

struct Measures {
  double volume = 0, area = 0, flux = 0;  // flux of the field x, which is dim * volume
};

template <int dim>
Measures measures(const casefile::MeshFile &file, const std::vector<std::string> &boundaries,
                  int degree) {
  const body::Discretisation<dim> body(imported<dim>(file), degree);
  Measures m;
  body.for_each_cell([&](const body::Quadrature<dim> &cell) {
    for (const double jxw : cell.jxw)
      m.volume += jxw;
  });
  body.for_each_facet(boundaries, [&](const body::Quadrature<dim> &facet) {
    for (std::size_t q = 0; q < facet.jxw.size(); ++q) {
      m.area += facet.jxw[q];
      for (int i = 0; i < dim; ++i)
        m.flux += facet.jxw[q] * facet.points[q][i] * facet.normals[q][i];
    }
  });
  return m;
}

struct Saved {
  double version;
  bool binary;
};
class GmshFormat : public MeshFiles, public testing::WithParamInterface<Saved> {};

TEST_P(GmshFormat, TrianglesAndSquaresKeepNamesAreaAndOutwardNormals) {
  for (const std::string &shape : {std::string(), of_squares}) {
    const auto file =
        read_mesh_file(saved(rectangle + shape, GetParam().version, GetParam().binary));
    EXPECT_EQ(file->dimension, 2);
    EXPECT_EQ(file->cell, shape.empty() ? CellShape::triangle : CellShape::quadrilateral);
    EXPECT_THAT(file->boundary_names(),
                UnorderedElementsAre("bottom", "right", "top", "left", "round"));
    EXPECT_THAT(file->regions.names, testing::ElementsAre("body"));
    for (const int degree : {1, 2}) {
      const Measures m = measures<2>(*file, {"left", "right", "bottom", "top"}, degree);
      EXPECT_NEAR(m.volume, 6, 1e-12);
      EXPECT_NEAR(m.area, 10, 1e-12);
      EXPECT_NEAR(m.flux, 12, 1e-12);
      EXPECT_NEAR(measures<2>(*file, {"round"}, degree).area, 10, 1e-12);
      EXPECT_NEAR(measures<2>(*file, {"right"}, degree).flux, 2 * 3, 1e-12);
    }
  }
}

TEST_P(GmshFormat, TetrahedraAndCubesKeepNamesVolumeAndOutwardNormals) {
  for (const std::string &shape : {drawn_up, in_layers}) {
    const auto file = read_mesh_file(saved(block + shape, GetParam().version, GetParam().binary));
    EXPECT_EQ(file->dimension, 3);
    EXPECT_EQ(file->cell, shape == drawn_up ? CellShape::tetrahedron : CellShape::hexahedron);
    for (const int degree : {1, 2}) {
      const Measures m =
          measures<3>(*file, {"left", "right", "bottom", "top", "front", "back"}, degree);
      EXPECT_NEAR(m.volume, 30, 1e-11);
      EXPECT_NEAR(m.area, 62, 1e-11);
      EXPECT_NEAR(m.flux, 90, 1e-11);
      EXPECT_NEAR(measures<3>(*file, {"top"}, degree).flux, 5 * 6, 1e-12);
      EXPECT_NEAR(measures<3>(*file, {"back"}, degree).flux, 3 * 10, 1e-12);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Gmsh, GmshFormat,
                         testing::Values(Saved{2.2, false}, Saved{2.2, true}, Saved{4.1, false},
                                         Saved{4.1, true}),
                         [](const auto &saved_as) {
                           return std::string(saved_as.param.version < 3 ? "Two" : "Four") +
                                  (saved_as.param.binary ? "Binary" : "Text");
                         });

TEST_F(MeshFiles, AGeometryIsMeshedWithTheSizeThatIsAskedFor) {
  const auto coarse = read_mesh_file(geo(rectangle, 0.5)),
             fine = read_mesh_file(geo(rectangle, 0.25));
  EXPECT_NEAR(measures<2>(*fine, {"round"}, 1).volume, 6, 1e-12);
  EXPECT_NEAR(static_cast<double>(fine->n_cells()) / static_cast<double>(coarse->n_cells()), 4,
              0.8);
}

TEST_F(MeshFiles, TheSameGeometryGivesTheSameMeshAgain) {
  const auto once = read_mesh_file(geo(block + drawn_up, 1)),
             again = read_mesh_file(geo(block + drawn_up, 1));
  EXPECT_EQ(once->points, again->points);
  EXPECT_EQ(once->cells, again->cells);
}

TEST_F(MeshFiles, AFileInMillimetresIsScaledToMetresAndItsCellsAreSizedInMillimetres) {
  casefile::MeshCase asked = geo(rectangle, 0.5);
  asked.scale = 1e-3;
  const auto file = read_mesh_file(asked);
  EXPECT_NEAR(measures<2>(*file, {"round"}, 1).volume, 6e-6, 1e-18);
  EXPECT_EQ(file->n_cells(), read_mesh_file(geo(rectangle, 0.5))->n_cells());
}

TEST_F(MeshFiles, ASizeThatChangesNothingIsRefused) {
  EXPECT_THAT(complaint(geo(rectangle, 5)), HasSubstr("mesh.size = 5 has no effect"));
  EXPECT_THAT(complaint(geo(rectangle + "Mesh 2;\n", 0.1)),
              HasSubstr("makes or merges a mesh itself"));
  casefile::MeshCase mesh = saved(rectangle, 4.1, false);
  mesh.size = 0.1;
  EXPECT_THAT(complaint(mesh), HasSubstr("is a mesh already"));
}

// Metres beside a file in millimetres: without the look ahead libgmsh would mesh for ten minutes.
TEST_F(MeshFiles, ASizeThatMakesMoreCellsThanFitIsRefusedBeforeMeshing) {
  const std::string cad =
      "SetFactory(\"OpenCASCADE\");\nBox(1) = {0, 0, 0, 20, 20, 10};\n"
      "Physical Volume(\"body\") = {1};\n";
  for (const std::string &body : {cad, rectangle})
    EXPECT_THAT(complaint(geo(body, 1e-6)),
                AllOf(HasSubstr("cells with mesh.size = 1e-06"),
                      HasSubstr("in the unit of the file, which is mesh.scale = 1 m")));
}

// Two steel blocks of 10 mm that touch, as a CAD program would leave them.
TEST_F(MeshFiles, SolidsOfAStepFileComeInMetresAndAreJoinedWhereTheyTouch) {
  gmsh::initialize(0, nullptr, false);
  gmsh::option::setNumber("General.Terminal", 0);
  gmsh::option::setString("Geometry.OCCTargetUnit", "MM");
  gmsh::model::occ::addBox(0, 0, 0, 10, 10, 10);
  gmsh::model::occ::addBox(10, 0, 0, 10, 10, 10);
  gmsh::model::occ::synchronize();
  gmsh::write((folder_ / "two.step").string());
  gmsh::finalize();
  casefile::MeshCase asked = file("two.step");
  EXPECT_THAT(complaint(asked), HasSubstr("give the size of its cells, mesh.size"));
  asked.size = 4e-3;
  const auto two = read_mesh_file(asked);
  EXPECT_NEAR(measures<3>(*two, two->boundary_names(), 1).volume, 2e-6, 1e-15);
  EXPECT_NEAR(measures<3>(*two, two->boundary_names(), 1).area, 10e-4, 1e-13);
  EXPECT_EQ(two->regions.names.size(), 2u);
  EXPECT_EQ(two->boundary_names().size(), 10u);
  EXPECT_EQ(two->inner_names().size(), 1u);
}

// Format 2 gives each element its own group, whatever entity it belongs to, and lists an element of
// two groups twice. The fifth node belongs to no cell.
const std::string format2 = R"($MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
3
1 1 "left"
1 2 "right"
2 3 "body"
$EndPhysicalNames
$Nodes
5
1 0 0 0
2 1 0 0
3 1 1 0
4 0 1 0
9 5 5 0
$EndNodes
$Elements
8
1 1 2 1 1 4 1
2 1 2 2 1 2 3
3 1 2 2 1 1 2
4 1 2 1 1 1 2
5 1 2 7 1 3 4
6 2 2 3 1 1 2 3
7 2 2 4 1 1 3 4
8 1 2 0 1 1 3
$EndElements
)";

TEST_F(MeshFiles, OfOneEntityElementsInDifferentGroupsStayApart) {
  const auto file = read_mesh_file(text("two.msh", format2));
  EXPECT_EQ(file->points.size(), 4u);
  EXPECT_THAT(file->boundary_names(), UnorderedElementsAre("left", "right", "7"));
  EXPECT_THAT(file->regions.names, UnorderedElementsAre("body", "4"));
  EXPECT_NEAR(measures<2>(*file, {"left"}, 1).area, 2, 1e-15);
  EXPECT_NEAR(measures<2>(*file, {"right"}, 1).area, 2, 1e-15);
  EXPECT_NEAR(measures<2>(*file, {"left", "right"}, 1).area, 3, 1e-15);
  EXPECT_NEAR(measures<2>(*file, {"7"}, 1).area, 1, 1e-15);
}

std::string with(std::string text, const std::string &from, const std::string &to) {
  return text.replace(text.find(from), from.size(), to);
}

const std::string format4 = R"($MeshFormat
4.1 0 8
$EndMeshFormat
$Entities
0 0 1 0
1 0 0 0 1 1 0 1 3 0
$EndEntities
$Nodes
1 4 1 4
2 1 0 4
1
2
3
4
0 0 0
1 0 0
1 1 0
0 1 0
$EndNodes
$Elements
1 2 1 2
2 1 2 2
1 1 2 3
2 1 3 4
$EndElements
)";

// libgmsh keeps the first or the last of them.
TEST_F(MeshFiles, NumbersThatAreGivenTwiceAreRefused) {
  EXPECT_EQ(complaint(text("four.msh", format4)), "");
  for (const std::string &twice :
       {with(format2, "9 5 5 0", "4 5 5 0"), with(format4, "3\n4\n0", "3\n3\n0")})
    EXPECT_THAT(complaint(text("a.msh", twice)), HasSubstr("lists two nodes with the number"));
  EXPECT_THAT(complaint(text("a.msh", with(format4, "2 1 3 4", "1 1 3 4"))),
              HasSubstr("lists two elements with the number 1"));
}

TEST_F(MeshFiles, GroupsWhoseNamesLibgmshWouldLoseAreRefused) {
  EXPECT_THAT(complaint(text("a.msh", with(format2, "\"right\"", "\"left\""))),
              HasSubstr("has two physical groups called \"left\", 1 and 2"));
  EXPECT_EQ(complaint(text("a.msh", with(format2, "\"body\"", "\"left\""))), "");
  const std::string name(127, 'a');
  EXPECT_EQ(complaint(text("a.msh", with(format2, "right", name))), "");
  EXPECT_THAT(complaint(text("a.msh", with(format2, "right", name + "a"))),
              HasSubstr("whose name has 128 bytes; Gmsh reads 127"));
}

TEST_F(MeshFiles, WhatIsInconsistentIsRefused) {
  EXPECT_THAT(complaint(text("a.msh", with(format2, "3 1 1 0", "3 nan 1 0"))),
              HasSubstr("finite numbers"));
  EXPECT_THAT(complaint(text("a.msh", with(format4, "2 1 3 4", "2 1 3 3"))),
              HasSubstr("degenerate"));
  EXPECT_THAT(complaint(text("a.msh", with(format2, "3 1 1 0", "3 -1 0.5 0"))),
              HasSubstr("is folded at"));
  EXPECT_THAT(complaint(text("a.msh", with(format4, "2 1 3 4", "2 1 2 3"))),
              HasSubstr("lists the cell at (0, 0, 0) twice"));
  EXPECT_THAT(complaint(text("a.msh", with(format2, "\"left\"", "\"l\xE4\""))),
              HasSubstr("not UTF-8, l\\xE4"));
}

TEST_F(MeshFiles, FacetsThatTheFileDoesNotListAreThereWithoutName) {
  std::string text_ = format2;
  text_.replace(text_.find("5 1 2 7 1 3 4\n"), 14, "");
  text_.replace(text_.find("\n8\n1 1"), 3, "\n7\n");
  const auto file = read_mesh_file(text("two.msh", text_));
  EXPECT_EQ(std::count(file->inside.begin(), file->inside.end(), false), 4);
  EXPECT_EQ(std::count(file->inside.begin(), file->inside.end(), true), 1);
}

TEST_F(MeshFiles, WhatIsNoBodyIsAnsweredWithTheReason) {
  EXPECT_THAT(complaint(file("none.msh")), HasSubstr("there is no such file"));
  EXPECT_THAT(complaint(text("a.vtk", "")), HasSubstr("unknown kind"));
  EXPECT_THAT(complaint(text("a.msh", "solid")), HasSubstr("$MeshFormat"));
  EXPECT_THAT(complaint(text("a.msh", "$MeshFormat\n1.0 0 8\n")), HasSubstr("2.2 and 4.1"));
  EXPECT_THAT(complaint(text("a.msh", format2.substr(0, format2.size() - 20))),
              HasSubstr("not whole"));
  EXPECT_THAT(complaint(text("a.geo", "Point(1) = {0, 0, 0};")), HasSubstr("end of a line"));
  EXPECT_THAT(complaint(text("a.geo", "Point(1) = {0, 0\n")), HasSubstr("Gmsh says"));
  EXPECT_THAT(complaint(text("a.geo", "Point(1) = {0, 0, 0};\n")), HasSubstr("no cells"));
}

TEST_F(MeshFiles, CurvedMixedTiltedAndBrokenMeshesAreRefused) {
  EXPECT_THAT(complaint(saved(rectangle, 4.1, false, 2)), HasSubstr("Mesh.ElementOrder = 1"));
  EXPECT_THAT(complaint(geo(rectangle + R"(
Point(6) = {4, 0, 0, lc}; Point(7) = {4, 3, 0, lc};
Line(6) = {2, 6}; Line(7) = {6, 7}; Line(8) = {7, 3};
Curve Loop(2) = {6, 7, 8, -2}; Plane Surface(2) = {2}; Recombine Surface {2};
Physical Surface("more") = {2};
)",
                            0.5)),
              HasSubstr("mixes shapes"));
  EXPECT_THAT(
      complaint(geo(rectangle + "Rotate {{1, 0, 0}, {0, 0, 0}, 0.1} { Surface{1}; }\n", 0.5)),
      HasSubstr("leaves the plane z = 0"));
}

// The same rectangle again beside the first, with points and lines of its own.
TEST_F(MeshFiles, PartsThatTouchWithoutACommonMeshAreRefused) {
  EXPECT_THAT(complaint(geo(rectangle + R"(
Point(6) = {2, 0, 0, lc}; Point(7) = {4, 0, 0, lc}; Point(8) = {4, 3, 0, lc}; Point(9) = {2, 3, 0, lc};
Line(6) = {6, 7}; Line(7) = {7, 8}; Line(8) = {8, 9}; Line(9) = {9, 6};
Curve Loop(2) = {6, 7, 8, 9}; Plane Surface(2) = {2}; Physical Surface("more") = {2};
)",
                            0.5)),
              HasSubstr("without being joined"));
}

TEST_F(MeshFiles, PiecesThatNothingJoinsAreRefused) {
  EXPECT_THAT(complaint(geo(rectangle + R"(
Point(6) = {5, 0, 0, lc}; Point(7) = {6, 0, 0, lc}; Point(8) = {6, 3, 0, lc};
Line(6) = {6, 7}; Line(7) = {7, 8}; Line(8) = {8, 6};
Curve Loop(2) = {6, 7, 8}; Plane Surface(2) = {2}; Physical Surface("more") = {2};
)",
                            0.5)),
              HasSubstr("falls into pieces"));
}

// On these libgmsh 4.8 crashes, and 4.13 does not; they were found by `./dev fuzz`.
TEST_F(MeshFiles, ThatCrashLibgmshAreErrorsAsOthers) {
  for (const char *name : {"damaged-1.msh", "damaged-2.msh", "damaged-3.msh"}) {
    casefile::MeshCase asked;
    asked.file = std::string(TOURMALINE_SOURCE_DIR) + "/fuzz/seeds/mesh_file/" + name;
    EXPECT_THAT(
        complaint(asked),
        testing::AnyOf(HasSubstr("cannot be read, it may be damaged"), HasSubstr("is not UTF-8"),
                       HasSubstr("lists a facet at (1, 1, 0) that no cell")))
        << name;
  }
}

}  // namespace
}  // namespace tourmaline::mesh
