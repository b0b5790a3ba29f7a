#include "case/holding.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "error_in.h"
#include "example.h"

namespace tourmaline::casefile {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr std::array<double, 3> x = {1, 0, 0}, y = {0, 1, 0}, z = {0, 0, 1};

TEST(FreeMotions, ABodyWithoutSupportsHasThemAll) {
  EXPECT_THAT(free_motions(2, {}), ElementsAre("a translation along x", "a translation along y",
                                               "a rotation in the plane"));
  EXPECT_EQ(free_motions(3, {}).size(), 6u);
}

TEST(FreeMotions, ThreeBarsHoldAPlaneBody) {
  EXPECT_THAT(free_motions(2, {{{0, 0}, x}, {{0, 0}, y}, {{1, 0}, y}}), IsEmpty());
}

TEST(FreeMotions, ThreeParallelBarsLeaveATranslation) {
  EXPECT_THAT(free_motions(2, {{{0, 0}, y}, {{1, 0}, y}, {{2, 1}, y}}),
              ElementsAre("a translation along x"));
}

TEST(FreeMotions, ThreeBarsThroughOnePointLeaveARotation) {
  const double s = std::sqrt(0.5);
  EXPECT_THAT(free_motions(2, {{{1, 0}, x}, {{0, 1}, y}, {{1, 1}, {s, s, 0}}}),
              ElementsAre("a rotation in the plane"));
}

TEST(FreeMotions, AHingeLeavesTheRotation) {
  EXPECT_THAT(free_motions(2, {{{3, 4}, x}, {{3, 4}, y}}), ElementsAre("a rotation in the plane"));
}

TEST(FreeMotions, ObliqueBarsLeaveAnObliqueTranslation) {
  const double s = std::sqrt(0.5);
  EXPECT_THAT(free_motions(2, {{{0, 0}, {s, s, 0}}, {{1, 0}, {s, s, 0}}}),
              ElementsAre("a translation in an oblique direction"));
}

TEST(FreeMotions, APinnedEdgeOfACubeIsADoorHinge) {
  std::vector<Support> hinge;
  for (const double height : {0.0, 1.0})
    for (const auto &direction : {x, y, z})
      hinge.push_back({{0, 0, height}, direction});
  EXPECT_THAT(free_motions(3, hinge), ElementsAre("a rotation about an axis parallel to z"));
}

TEST(FreeMotions, APinnedDiagonalIsAnObliqueHinge) {
  std::vector<Support> hinge;
  for (const double corner : {0.0, 1.0})
    for (const auto &direction : {x, y, z})
      hinge.push_back({{corner, corner, corner}, direction});
  EXPECT_THAT(free_motions(3, hinge), ElementsAre("a rotation about an oblique axis"));
}

TEST(FreeMotions, DoNotDependOnTheSizeOfTheBody) {
  for (const double size : {1e-9, 1.0, 1e6}) {
    EXPECT_THAT(free_motions(2, {{{0, 0}, x}, {{0, 0}, y}, {{size, 0}, y}}), IsEmpty()) << size;
    EXPECT_EQ(free_motions(2, {{{0, 0}, x}, {{0, 0}, y}, {{size, 0}, x}}).size(), 1u) << size;
  }
}

TEST(Holding, AClampedSideIsEnough) {
  EXPECT_EQ(error_in(cube, {}), "no error");
  EXPECT_EQ(error_in(example, {}), "no error");
}

const std::string slippery = "contact.friction={law='none'}";
const std::vector<std::string> normal_laws{"contact.normal=bilateral", "contact.normal=unilateral",
                                           "contact.normal={law='compliance', coefficient=1e13}",
                                           "contact.normal={law='damped', coefficient=1e9}"};

TEST(Holding, ContactWithoutFrictionHoldsTheNormalDirectionOnly) {
  for (const std::string &normal : normal_laws) {
    const std::string error =
        error_in(example, {normal, slippery, "boundary[0].displacement=['free','free']"});
    EXPECT_THAT(error, HasSubstr("case.toml [[boundary]]"));
    EXPECT_THAT(error, HasSubstr("against a translation along y;"));
    EXPECT_THAT(error, HasSubstr("contact without friction holds only the normal"));
    EXPECT_EQ(error_in(example, {normal, slippery, "boundary[0].displacement=['free',0]"}),
              "no error");
  }
}

TEST(Holding, FrictionMayHoldABody) {
  const std::string free = "boundary[0].displacement=['free','free']";
  for (const std::string &normal : normal_laws)
    EXPECT_EQ(error_in(example, {normal, free}), "no error");
  EXPECT_EQ(error_in(example, {free, "solver.method=monolithic"}), "no error");
  EXPECT_EQ(error_in(example, {free, "solver.body=iterative"}), "no error");
}

// Whether they do is found out in the run.
TEST(Holding, SaysWhatIsLeftToFrictionAndContactThatOpens) {
  const auto left = [](const std::string &normal) {
    return left_to_contact(
        read_text(example, "case.toml", {normal, "boundary[0].displacement=['free',0]"}));
  };
  EXPECT_EQ(left("contact.normal=bilateral"), "");
  EXPECT_EQ(left("contact.normal=unilateral"), "a translation along x and a rotation in the plane");
}

TEST(Holding, ABoxOnRollersSlidesAndTurnsOnThem) {
  const std::string error = error_in(cube, {"boundary[0].displacement=['free','free',0]"});
  EXPECT_THAT(error, HasSubstr("a translation along x, a translation along y and a rotation about "
                               "an axis parallel to z"));
}

TEST(Holding, RollersOnThreeSidesHoldACube) {
  EXPECT_EQ(error_in(cube, {"boundary[0].displacement=['free','free',0]", "boundary[1].on=left",
                            "boundary[1].displacement=[0,'free','free']", "boundary[2].on=front",
                            "boundary[2].displacement=['free',0,'free']"}),
            "no error");
}

TEST(Holding, AShaftHoldsARingButForTheTurning) {
  EXPECT_EQ(error_in(ring, {}), "no error");
  const std::string error = error_in(ring, {"boundary[0].displacement=['free','free']"});
  EXPECT_THAT(error, HasSubstr("nothing holds the body against a rotation in the plane;"));
}

TEST(Holding, AShaftHoldsATubeButForTurningAndPushing) {
  const std::vector<std::string> tube{
      "mesh.annulus={inner=0.1, outer=0.2, height=0.1, cells=[2,16,2], cell='hexahedron'}",
      "boundary[0].displacement=['free','free','free']"};
  EXPECT_THAT(
      error_in(ring, tube),
      HasSubstr("against a translation along z and a rotation about an axis parallel to z;"));
}

TEST(Holding, NoDisplacementAtAllNamesEveryMotion) {
  const std::string error = error_in(cube, {"boundary[0]={on='top', potential=0}"});
  EXPECT_THAT(error, HasSubstr("a translation along z"));
  EXPECT_THAT(error, HasSubstr("a rotation about an axis parallel to x"));
}

TEST(Holding, AFoundationThatChargeAlwaysCrossesToHoldsThePotential) {
  const std::string held = "boundary[0]={on='bottom', displacement=[0,0,0]}",
                    electric =
                        "contact={on='top', electric={law='exchange', coefficient=1e-9, "
                        "foundation_potential=0";
  EXPECT_EQ(error_in(cube, {held, electric + "}}"}), "no error");
  EXPECT_THAT(error_in(cube, {held, electric + ", ramp=1e-7}}"}),
              HasSubstr("the electric potential floats"));
}

TEST(Holding, APotentialWithoutGroundFloats) {
  EXPECT_THAT(error_in(cube, {"boundary[0]={on='bottom', displacement=[0,0,0]}"}),
              HasSubstr("the electric potential floats"));
}

}  // namespace
}  // namespace tourmaline::casefile
