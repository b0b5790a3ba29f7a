// A study that is run again keeps what is done and still holds, and runs the rest.

#include <gmock/gmock.h>

#include <chrono>
#include <map>

#include "sweep.h"

namespace {

using testing::HasSubstr;

/// When each member's run ended.
std::map<std::string, std::filesystem::file_time_type> ends(const std::filesystem::path &study) {
  std::map<std::string, std::filesystem::file_time_type> times;
  for (const auto &entry : std::filesystem::directory_iterator(study))
    if (exists(entry.path() / "summary.json"))
      times[entry.path().filename()] = last_write_time(entry.path() / "summary.json");
  return times;
}

TEST_F(Sweep, WhatIsDoneIsNotRunAgain) {
  const std::string study = "sweep small.toml --vary contact.friction.bound=15,30,45 -o study";
  ASSERT_EQ(run(study), 0);
  const auto first = ends(here() / "study");
  const std::string table = content_of(here() / "study/sweep.csv");
  ASSERT_EQ(first.size(), 3u);
  ASSERT_EQ(run(study), 0);
  EXPECT_THAT(said_, HasSubstr("3 cases: 3 done before"));
  EXPECT_EQ(ends(here() / "study"), first);
  EXPECT_EQ(content_of(here() / "study/sweep.csv"), table);

  // A run that did not finish has no summary.
  remove(here() / "study/bound=30/summary.json");
  ASSERT_EQ(run(study + " --vary time.steps=4"), 0);
  EXPECT_THAT(said_, HasSubstr("3 cases: 0 done before")) << "other folders";
  ASSERT_EQ(run(study), 0);
  EXPECT_THAT(said_, HasSubstr("3 cases: 2 done before"));
  const auto second = ends(here() / "study");
  EXPECT_EQ(second.at("bound=15"), first.at("bound=15"));
  EXPECT_EQ(second.at("bound=45"), first.at("bound=45"));
  EXPECT_GT(second.at("bound=30"), first.at("bound=30"));
}

TEST_F(Sweep, AChangedCaseIsRunAgain) {
  const std::string study = "sweep small.toml --vary contact.friction.bound=15,30 -o study";
  ASSERT_EQ(run(study), 0);
  const auto first = ends(here() / "study");
  ASSERT_EQ(run(study + " --set time.end=2"), 0);
  EXPECT_THAT(said_, HasSubstr("2 cases: 0 done before"));
  for (const auto &[member, end] : ends(here() / "study"))
    EXPECT_GT(end, first.at(member));
}

TEST_F(Sweep, AChangedMeshFileIsNoticed) {
  const std::string square = R"(
    Point(1) = {0, 0, 0, 0.05}; Point(2) = {0.1, 0, 0, 0.05};
    Point(3) = {0.1, 0.1, 0, 0.05}; Point(4) = {0, 0.1, 0, 0.05};
    Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
    Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
    Physical Curve("bottom") = {1}; Physical Curve("right") = {2};
    Physical Curve("top") = {3}; Physical Curve("left") = {4}; Physical Surface("all") = {1};
)";
  std::ofstream(here() / "square.geo") << square;
  std::string text = small_case;
  text.replace(0, text.find('\n'), "mesh.file = \"square.geo\"");
  std::ofstream(here() / "small.toml") << text;
  const std::string study = "sweep small.toml --vary contact.friction.bound=15,30 -o study";
  ASSERT_EQ(run(study), 0) << complained_;
  ASSERT_EQ(run(study), 0);
  EXPECT_THAT(said_, HasSubstr("2 cases: 2 done before"));
  std::ofstream(here() / "square.geo") << square << "// a comment changes no mesh\n";
  ASSERT_EQ(run(study), 0);
  EXPECT_THAT(said_, HasSubstr("2 cases: 2 done before"));
  // However old the file is: the content counts.
  std::string wider = square;
  for (auto at = wider.find("0.1,"); at != std::string::npos; at = wider.find("0.1,", at))
    wider.replace(at, 4, "0.2,");
  std::ofstream(here() / "square.geo") << wider;
  last_write_time(here() / "square.geo",
                  std::filesystem::file_time_type::clock::now() - std::chrono::hours(1000));
  ASSERT_EQ(run(study), 0) << complained_;
  EXPECT_THAT(said_, HasSubstr("2 cases: 0 done before"));
}

TEST_F(Sweep, AChangedIncludedFileOrFileOfMaterialsIsNoticed) {
  const std::filesystem::path here_are = std::string(TOURMALINE_SOURCE_DIR) + "/tests/cli";
  copy_file(here_are / "own_material.toml", here() / "own.toml");
  copy_file(here_are / "materials.toml", here() / "materials.toml");
  const std::string study = "sweep own.toml --vary contact.friction.bound=15,30 -o study";
  ASSERT_EQ(run(study), 0) << complained_;
  std::string text = content_of(here() / "materials.toml");
  std::ofstream(here() / "materials.toml") << text.replace(text.find("1e9"), 3, "2e9");
  last_write_time(here() / "materials.toml",
                  std::filesystem::file_time_type::clock::now() - std::chrono::hours(1000));
  ASSERT_EQ(run(study), 0) << complained_;
  EXPECT_THAT(said_, HasSubstr("2 cases: 0 done before"));
}

TEST_F(Sweep, AMemberWithoutItsPageIsNotDone) {
  const std::string study =
      "sweep small.toml --vary contact.friction.bound=15,30 --set output.report=true -o study";
  ASSERT_EQ(run(study), 0);
  const auto first = ends(here() / "study");
  remove(here() / "study/bound=15/report.html");
  ASSERT_EQ(run(study), 0) << complained_;
  EXPECT_THAT(said_, HasSubstr("2 cases: 1 done before"));
  EXPECT_TRUE(exists(here() / "study/bound=15/report.html"));
  EXPECT_EQ(ends(here() / "study"), first) << "no step was computed again";
}

TEST_F(Sweep, AMemberWhoseTableWasCutIsRunAgain) {
  const std::string study =
      "sweep small.toml --vary contact.friction.bound=5,15 --columns max:slip -q -o study";
  ASSERT_EQ(run(study), 0);
  const std::string table = content_of(here() / "study/sweep.csv");
  const std::filesystem::path history = here() / "study/bound=15/history.csv";
  const std::string whole = content_of(history);
  std::ofstream(history) << whole.substr(0, whole.find('\n', whole.find('\n') + 1) + 1);
  EXPECT_EQ(run(study), 0);
  EXPECT_EQ(content_of(history), whole);
  EXPECT_EQ(content_of(here() / "study/sweep.csv"), table);
}

TEST_F(Sweep, AMemberWhoseResultsAnotherRunReplacedIsRunAgain) {
  const std::string study =
      "sweep small.toml --vary contact.friction.bound=5,15 --columns max:slip,load_y -o study";
  ASSERT_EQ(run(study), 0);
  const auto first = ends(here() / "study");
  const std::string table = content_of(here() / "study/sweep.csv"),
                    nodes = content_of(here() / "study/bound=15/nodes.csv");
  ASSERT_EQ(run("run small.toml --set contact.friction.bound=15 "
                "--set 'boundary[1].traction=[0,\"-70*t\"]' -q -o study/bound=15"),
            0);
  ASSERT_NE(content_of(here() / "study/bound=15/nodes.csv"), nodes);
  ASSERT_EQ(run(study), 0);
  EXPECT_THAT(said_, HasSubstr("2 cases: 1 done before"));
  EXPECT_EQ(content_of(here() / "study/bound=15/nodes.csv"), nodes);
  EXPECT_EQ(content_of(here() / "study/sweep.csv"), table);
  EXPECT_EQ(ends(here() / "study").at("bound=5"), first.at("bound=5"));
}

}  // namespace
