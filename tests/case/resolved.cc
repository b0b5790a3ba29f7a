#include "case/resolved.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "example.h"
#include "tourmaline/case/reader.h"

namespace tourmaline::casefile {
namespace {

using testing::HasSubstr;

TEST(Resolved, FillsInTheDefaults) {
  const std::string text = resolved(read_text(cube, "cube.toml"));
  for (const char *line : {"degree = 1\n", "method = \"condensed\"\n", "tolerance = 1e-12\n",
                           "every = 2\n", "fields = true\n", "charge = 0\n"})
    EXPECT_THAT(text, HasSubstr(line));
}

TEST(Resolved, FillsInWhatIsNothingOrPointsUp) {
  const std::string plane = resolved(read_text(example, "case.toml"));
  for (const char *line : {"poling = [0, 1]\n", "force = [0, 0]\n", "displacement = [0, 0]\n"})
    EXPECT_THAT(plane, HasSubstr(line));
  EXPECT_THAT(plane, testing::Not(HasSubstr("symmetry")));  // the entry's
  const std::string solid = resolved(read_text(cube, "cube.toml"));
  EXPECT_THAT(solid, HasSubstr("poling = [0, 0, 1]\n"));
  EXPECT_THAT(solid, HasSubstr("force = [0, 0, 0]\n"));
  EXPECT_THAT(resolved(read_text(example, "case.toml", {"material={c11=1}"})),
              HasSubstr("symmetry = \"6mm\"\n"));
}

TEST(Resolved, DoesNotInventWhatTheCaseLacks) {
  const std::string text = resolved(read_text(cube, "cube.toml"));
  EXPECT_THAT(text, testing::Not(HasSubstr("[contact")));
  EXPECT_THAT(text, testing::Not(HasSubstr("file = ")));
  EXPECT_THAT(text, testing::Not(HasSubstr("traction")));
}

TEST(Resolved, LeavesOutTheKeysThatALawDoesNotUse) {
  const std::string text =
      resolved(read_text(example, "case.toml", {"contact.friction={law='none'}"}));
  EXPECT_THAT(text, testing::Not(HasSubstr("bound =")));
}

class RoundTrip : public testing::TestWithParam<std::vector<std::string>> {};

TEST_P(RoundTrip, ReadingTheResolvedCaseResolvesToTheSameText) {
  const Case first = read_text(example, "case.toml", GetParam());
  const std::string text = resolved(first);
  EXPECT_EQ(resolved(read_text(text, "resolved.toml")), text);
}

INSTANTIATE_TEST_SUITE_P(
    Variants, RoundTrip,
    testing::Values(std::vector<std::string>{},
                    std::vector<std::string>{"title=\"a \\\"quote\\\", a \\\\ and a \\n\""},
                    std::vector<std::string>{"material.c11=166e9", "material.poling=[1,2]",
                                             "material.permittivity=[[1,0,0],[0,1,0],[0,0,2]]"},
                    std::vector<std::string>{"boundary[1].displacement=['free','1e-6*x']",
                                             "boundary[2].traction=[1,0]"},
                    std::vector<std::string>{"load.force=[1,'t']", "initial.displacement=[0,'x']"},
                    std::vector<std::string>{"mesh.degree=2", "mesh.box.cell=quadrilateral"},
                    std::vector<std::string>{"contact.normal=unilateral", "contact.gap='1e-6*y'"},
                    std::vector<std::string>{"contact.normal={law='damped', coefficient='1+y'}",
                                             "contact.foundation_displacement=[0,'t']"},
                    std::vector<std::string>{"contact.friction={law='coulomb', coefficient='x+t'}"},
                    std::vector<std::string>{
                        "contact.friction={law='coulomb', limit=1, coefficient={static=0.5, "
                        "kinetic=0.3, speed=1}}"}));

TEST(Resolved, WritesATableAsAValueWhereThatSaysItAll) {
  const auto text = [](const std::vector<std::string> &overrides) {
    return resolved(read_text(example, "case.toml", overrides));
  };
  EXPECT_THAT(text({}), HasSubstr("\nnormal = \"bilateral\"\n"));
  EXPECT_THAT(text({"contact.normal={law='unilateral'}"}),
              HasSubstr("\nnormal = \"unilateral\"\n"));
  EXPECT_THAT(
      text({"contact.normal={law='compliance', coefficient=5}"}),
      HasSubstr("\n[contact.normal]\nlaw = \"compliance\"\nexponent = 1\ncoefficient = 5\n"));
  EXPECT_THAT(text({"contact.friction={law='coulomb', coefficient={value=0.3}}"}),
              HasSubstr("\n[contact.friction]\nlaw = \"coulomb\"\ncoefficient = 0.3\n"));
  EXPECT_THAT(text({"contact.friction={law='coulomb', coefficient={static=0.5, kinetic=0.3, "
                    "distance=2}}"}),
              HasSubstr("\n[contact.friction.coefficient]\nstatic = 0.5\nkinetic = 0.3\ndistance "
                        "= 2\n"));
}

TEST(Resolved, KeepsEveryBitOfANumber) {
  Case c = read_text(example, "case.toml");
  for (const double number : {1.0 / 3.0, 0.1 + 0.2, 1e-17, 1e14 / 3, 123456789012345.68}) {
    c.time.end = number;
    c.boundaries[0].potential = Formula(-number);
    const Case again = read_text(resolved(c), "resolved.toml");
    EXPECT_EQ(again.time.end, number);
    EXPECT_EQ(again.boundaries[0].potential->value({}, 0), -number);
  }
}

TEST(Resolved, KeepsEveryValueOfTheExample) {
  const Case first = read_text(example, "case.toml");
  const Case again = read_text(resolved(first), "resolved.toml");
  EXPECT_EQ(again.title, first.title);
  EXPECT_EQ(again.mesh.box->cells, first.mesh.box->cells);
  EXPECT_EQ(again.mesh.box->max, first.mesh.box->max);
  EXPECT_EQ(again.material.pyroelectric, first.material.pyroelectric);
  EXPECT_EQ(again.boundaries.size(), first.boundaries.size());
  EXPECT_EQ(again.boundaries[1].on, first.boundaries[1].on);
  EXPECT_EQ(again.boundaries[2].traction->at(1).text(), "-0.5*t");
  EXPECT_EQ(again.contacts.front().friction.bound.text(), "15");
  EXPECT_EQ(again.contacts.front().heat.foundation_temperature.text(), "-27");
}

}  // namespace
}  // namespace tourmaline::casefile
