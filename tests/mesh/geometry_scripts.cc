#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>

#include "../output/temporary_folder.h"
#include "tourmaline/case/case.h"
#include "tourmaline/error.h"
#include "tourmaline/mesh/gmsh.h"

namespace tourmaline::mesh {
namespace {

using testing::AllOf;
using testing::HasSubstr;

const std::string square = R"(
Point(1) = {0, 0, 0, 1}; Point(2) = {1, 0, 0, 1}; Point(3) = {1, 1, 0, 1}; Point(4) = {0, 1, 0, 1};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
)";

/// A folder with a geometry, and one beside it that is no business of its script.
class GeometryScript : public testing::Test {
 protected:
  GeometryScript() {
    std::filesystem::create_directory(inside());
    put(inside() / "square.geo", square);
    put(folder_ / "far.geo", square);
  }
  std::filesystem::path inside() const { return folder_ / "inside"; }
  static void put(const std::filesystem::path &file, const std::string &text) {
    std::ofstream(file) << text;
  }
  std::string complaint(const std::string &script, const Reading &how = {}) const {
    put(inside() / "body.geo", script);
    return complaint_about("body.geo", how);
  }
  std::string complaint_about(const std::string &name, const Reading &how = {}) const {
    casefile::MeshCase asked;
    asked.file = (inside() / name).string();
    try {
      mesh_file_reader(how)(asked);
    } catch (const CaseError &error) {
      return error.what();
    }
    return "";
  }
  bool is_written() const { return std::filesystem::exists(written()); }
  std::filesystem::path written() const { return folder_ / "written"; }
  std::string command() const { return "SystemCall \"touch " + written().string() + "\";\n"; }

  output::TemporaryFolder folder_;
};

constexpr Walls none{false, false, false}, without_landlock{false, true, true};
const auto is_walled = AllOf(HasSubstr("may not start programs"), HasSubstr("--trust"));

TEST_F(GeometryScript, MayIncludeAndMergeWhatLiesBesideIt) {
  for (const Walls walls : {Walls{}, without_landlock}) {
    EXPECT_EQ(complaint("Include \"square.geo\";\n", {.walls = walls}), "");
    EXPECT_EQ(complaint("Merge \"square.geo\";\n", {.walls = walls}), "");
  }
  EXPECT_EQ(complaint("SetFactory(\"OpenCASCADE\");\nGeometry.OCCFixDegenerated = 1;\n"
                      "Mesh.Algorithm = 6;\nGeneral.NumThreads = 2;\n"
                      "Box(1) = {0, 0, 0, 1, 1, 1};\nSphere(2) = {1, 1, 1, 0.5};\n"
                      "BooleanDifference{ Volume{1}; Delete; }{ Volume{2}; Delete; }\n"),
            "");
}

TEST_F(GeometryScript, StartsNoProgram) {
  for (const std::string &call :
       {command(), "NonBlockingSystemCall \"touch " + written().string() + "\";\n",
        "OnelabRun(\"it\", \"touch " + written().string() + "\");\n"}) {
    complaint(square + call);
    EXPECT_FALSE(is_written()) << call;
  }
  EXPECT_THAT(complaint(square + command()), AllOf(HasSubstr("start a program"), is_walled));
}

TEST_F(GeometryScript, WritesNothing) {
  const std::string file = "\"" + written().string() + "\";\n";
  for (const std::string &statement :
       {"Save " + file, "Print " + file, "Printf(\"text\") > " + file,
        "Printf(\"text\") >> " + file, "CreateDir " + file}) {
    complaint(square + "Mesh 2;\n" + statement);
    EXPECT_FALSE(is_written()) << statement;
  }
  EXPECT_THAT(complaint(square + "Printf(\"text\") > " + file), is_walled);
}

TEST_F(GeometryScript, ReadsNothingFromElsewhere) {
  std::filesystem::create_symlink(folder_ / "far.geo", inside() / "link.geo");
  for (const std::string &file : {(folder_ / "far.geo").string(), std::string("../far.geo"),
                                  std::string("link.geo"), std::string("/etc/passwd")})
    for (const Walls walls : {Walls{}, without_landlock})
      EXPECT_THAT(complaint("Include \"" + file + "\";\n", {.walls = walls}), is_walled) << file;
}

TEST_F(GeometryScript, ThatDoesNotEndIsEnded) {
  const std::string text =
      complaint(square + "For i In {1:1e12}\nEndFor\n", {.seconds_of_geometry = 1});
  EXPECT_THAT(text, AllOf(HasSubstr("does not come to an end within 1 s"), HasSubstr("--trust")));
}

TEST_F(GeometryScript, ThatWaitsForAPipeIsEnded) {
  ASSERT_EQ(mkfifo((inside() / "pipe.geo").c_str(), 0600), 0);
  EXPECT_THAT(complaint("Include \"pipe.geo\";\n", {.idle_seconds = 1}),
              HasSubstr("for 1 s nothing came from it, or from a file that it includes"));
}

TEST_F(GeometryScript, DoesWhatItLikesWhenItIsTrusted) {
  EXPECT_EQ(complaint(square + command(), {.trusted = true}), "");
  EXPECT_TRUE(is_written());
  EXPECT_EQ(complaint("Include \"../far.geo\";\n", {.trusted = true}), "");
}

TEST_F(GeometryScript, IsRefusedWhereAWallIsMissingUnlessItIsTrusted) {
  EXPECT_THAT(complaint(square, {.walls = {false, false, true}}),
              AllOf(HasSubstr("no Landlock and no namespaces to"), HasSubstr("--trust")));
  EXPECT_THAT(complaint(square + command(), {.walls = {true, true, false}}),
              HasSubstr("no seccomp to"));
  EXPECT_FALSE(is_written());
  EXPECT_EQ(complaint(square, {.trusted = true, .walls = none}), "");
}

// What a link leads to is the file that was asked for; what lies beside the link may be included.
TEST_F(GeometryScript, MayBeALink) {
  std::filesystem::create_symlink(folder_ / "far.geo", inside() / "link.geo");
  EXPECT_EQ(complaint_about("link.geo"), "");
  EXPECT_EQ(complaint_about("link.geo", {.walls = without_landlock}), "");
}

TEST_F(GeometryScript, OptionsBesideAMeshAreNotObeyed) {
  std::filesystem::copy_file(
      std::string(TOURMALINE_SOURCE_DIR) + "/fuzz/seeds/mesh_file/triangles-4.1.msh",
      inside() / "m.msh");
  put(inside() / "m.msh.opt", command() + "Mesh.ScalingFactor = 2;\n");
  EXPECT_EQ(complaint_about("m.msh"), "");
  EXPECT_FALSE(is_written());
  EXPECT_EQ(complaint_about("m.msh", {.trusted = true, .walls = none}), "");
  EXPECT_FALSE(is_written());
}

}  // namespace
}  // namespace tourmaline::mesh
