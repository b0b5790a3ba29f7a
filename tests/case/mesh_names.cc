#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>

#include "example.h"
#include "tourmaline/case/reader.h"
#include "tourmaline/error.h"

namespace tourmaline::casefile {
namespace {

using testing::AllOf;
using testing::HasSubstr;

// One tetrahedron, whose groups have these names, all of them one facet.
std::shared_ptr<const MeshFile> tetrahedron(const std::vector<std::string> &boundaries) {
  auto mesh = std::make_shared<MeshFile>();
  mesh->dimension = 3;
  mesh->cell = CellShape::tetrahedron;
  mesh->points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh->cells = {0, 1, 2, 3};
  mesh->facets = {0, 1, 2, 0, 1, 3, 0, 2, 3, 1, 2, 3};
  mesh->regions.set_of = {0};
  mesh->inside.assign(4, false);
  mesh->boundaries.names = boundaries;
  std::vector<int> all(boundaries.size());
  std::iota(all.begin(), all.end(), 0);
  mesh->boundaries.set_of = {0, 0, 0, all.empty() ? 0 : mesh->boundaries.set_index(all)};
  return mesh;
}

std::string error_of(const std::string &text, const std::vector<std::string> &boundaries) {
  try {
    read_text(
        "mesh = { file = \"body.msh\", unnamed = \"natural\" }\ntime = { end = 1, steps = 1 }\n" +
            text,
        "case.toml", {}, [&](const MeshCase &) { return tetrahedron(boundaries); });
  } catch (const CaseError &error) {
    return error.what();
  }
  return "no error";
}

const std::string steel = "material.library = \"steel\"\n",
                  held = "displacement = [0, 0, 0]\npotential = 0\n";

TEST(NamesOfAMesh, ARegionThatAMeshWithoutNamesCannotHaveIsRefused) {
  EXPECT_THAT(
      error_of("[[region]]\non = \"shim\"\n" + steel + "[[boundary]]\non = \"foot\"\n" + held,
               {"foot"}),
      AllOf(HasSubstr("case.toml:4:6 [region[0]] on = \"shim\""),
            HasSubstr("the mesh file names no region: put its volumes into physical groups")));
}

TEST(NamesOfAMesh, ABoundaryThatAMeshWithoutNamesCannotHaveIsRefused) {
  EXPECT_THAT(error_of(steel + "[[boundary]]\non = \"head\"\n" + held, {}),
              AllOf(HasSubstr("case.toml:5:6 [boundary[0]] on = \"head\""),
                    HasSubstr("the mesh file names no boundary: put its surfaces into physical")));
  EXPECT_EQ(error_of(steel + "[[boundary]]\non = \"head\"\n" + held, {"head"}), "no error");
}

TEST(NamesOfAMesh, TwoElectrodesOnOneFacetAreRefusedByWhateverNames) {
  const auto plates = [](const std::string &first, const std::string &second) {
    return error_of(steel + "[[boundary]]\non = \"foot\"\ndisplacement = [0, 0, 0]\n" +
                        "[[electrode]]\nname = \"a\"\non = " + first + "\nvoltage = 0\n" +
                        "[[electrode]]\nname = \"b\"\non = " + second + "\nvoltage = 1\n",
                    {"foot", "pad"});
  };
  for (const char *second : {"\"foot\"", "\"pad\""})
    EXPECT_THAT(plates("\"foot\"", second),
                AllOf(HasSubstr("there is an electrode already, by case.toml:9:6"),
                      HasSubstr("case.toml:13:6 [electrode[1]] on = ")));
}

TEST(NamesOfAMesh, ContactOnTetrahedraOfDegree2IsRefusedWhereItIsAskedFor) {
  const auto box = [](const std::string &cell, int degree) {
    try {
      read_text(cube + "[contact]\non = \"top\"\n", "case.toml",
                {"mesh.box.cell=" + cell, "mesh.degree=" + std::to_string(degree)});
    } catch (const CaseError &error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  EXPECT_THAT(box("tetrahedron", 2),
              AllOf(HasSubstr("[contact] on = \"top\": contact on tetrahedra of degree 2"),
                    HasSubstr("case.toml:")));
  EXPECT_EQ(box("tetrahedron", 1), "no error");
  EXPECT_EQ(box("hexahedron", 2), "no error");
}

}  // namespace
}  // namespace tourmaline::casefile
