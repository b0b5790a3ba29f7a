#include "tourmaline/case/reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "case/key_unit.h"
#include "error_in.h"
#include "example.h"

namespace tourmaline::casefile {
namespace {

Case read(const std::vector<std::string> &overrides = {}) {
  return read_text(example, "case.toml", overrides);
}

TEST(Reader, ReadsTheMesh) {
  const Case c = read();
  ASSERT_TRUE(c.mesh.box);
  EXPECT_EQ(c.title, "Thermally conductive foundation");
  EXPECT_EQ(c.source, "case.toml");
  EXPECT_EQ(c.mesh.box->min, (std::vector<double>{0, 0}));
  EXPECT_EQ(c.mesh.box->max, (std::vector<double>{0.1, 0.1}));
  EXPECT_EQ(c.mesh.box->cells, (std::vector<int>{64, 64}));
  EXPECT_EQ(c.mesh.box->cell, CellShape::triangle);
  EXPECT_EQ(c.mesh.degree, 1);
  EXPECT_EQ(c.dimension, 2);
}

TEST(Reader, ReadsTheMaterial) {
  const Case c = read();
  EXPECT_EQ(c.material.library, "BaTiO3-Liu2014");
  EXPECT_EQ(c.material.pyroelectric, (std::vector<double>{0, 1e-4}));
  EXPECT_TRUE(c.material.constants.empty());
  EXPECT_FALSE(c.material.stiffness);
}

TEST(Reader, ReadsNamedConstantsAndTensors) {
  const Case c = read({"material.c11=166e9", "material.density=5800",
                       "material.permittivity=[[1e-8,0,0],[0,1e-8,0],[0,0,2e-8]]"});
  EXPECT_EQ(c.material.constants.at("c11"), 166e9);
  EXPECT_EQ(c.material.constants.at("density"), 5800);
  EXPECT_EQ(c.material.constants.size(), 2u);
  EXPECT_EQ(c.material.permittivity->at(2).at(2), 2e-8);
}

TEST(Reader, ReadsBoundaryConditions) {
  const Case c = read();
  ASSERT_EQ(c.boundaries.size(), 3u);
  EXPECT_EQ(c.boundaries[0].on, std::vector<std::string>{"right"});
  EXPECT_TRUE(c.boundaries[0].displacement->at(1)->is_zero());
  EXPECT_EQ(c.boundaries[0].where, "case.toml:14:1 [boundary[0]]");
  EXPECT_EQ(c.boundaries[1].on, (std::vector<std::string>{"bottom", "top"}));
  EXPECT_FALSE(c.boundaries[1].displacement);
  EXPECT_FALSE(c.boundaries[1].potential);
  EXPECT_EQ(c.boundaries[2].traction->at(1).value({}, 2), -1);
  EXPECT_EQ(c.boundaries[2].traction->at(1).where(), "case.toml:26:16 [boundary[2]] traction[1]");
}

TEST(Reader, AFreeComponentHasNoFormula) {
  const Case c = read({"boundary[1].displacement=['free', 0]", "boundary[2].traction=[1, 0]"});
  EXPECT_FALSE(c.boundaries[1].displacement->at(0));
  EXPECT_TRUE(c.boundaries[1].displacement->at(1));
}

TEST(Reader, EntriesOfListsGoByTheirNamesToo) {
  const std::string electrodes =
      "electrode=[{name='a', on='left', voltage=0}, {name='b-1', on='right', resistor=5}]";
  const Case c =
      read({"boundary=[{on='right', displacement=[0, 0]}, {on=['bottom', 'top'], "
            "traction=[1, 2]}]",
            electrodes, "electrode[b-1].resistor=7", "electrode[a].voltage=3",
            "probe=[{name='tip.1', at=[0, 0]}]", "probe[tip.1].at=[0.1, 0]",
            "boundary[bottom+top].traction[1]=4"});
  EXPECT_EQ(c.electrodes.at(1).resistor, 7);
  EXPECT_EQ(c.electrodes.at(0).voltage->value({}, 0), 3);
  EXPECT_EQ(c.probes.at(0).at->front(), 0.1);
  EXPECT_EQ((*c.boundaries.at(1).traction)[1].value({}, 0), 4);
  EXPECT_EQ(unit_of_key("electrode[b-1].resistor", c), "ohm m");
  const std::string twice =
      error_in(example, {"boundary=[{on='top', traction=[1, 2]}, {on='top', temperature=0}]",
                         "boundary[top].temperature=4"});
  EXPECT_THAT(twice, testing::HasSubstr("several entries of boundary are called \"top\""));
}

TEST(Reader, ReadsTheContact) {
  const Case c = read();
  ASSERT_EQ(c.contacts.size(), 1u);
  EXPECT_EQ(c.contacts.front().on, std::vector<std::string>{"left"});
  EXPECT_EQ(c.contacts.front().normal.law, "bilateral");
  EXPECT_EQ(c.contacts.front().friction.law, "tresca");
  EXPECT_EQ(c.contacts.front().friction.bound.value({}, 0), 15);
  EXPECT_EQ(c.contacts.front().heat.law, "exchange");
  EXPECT_EQ(c.contacts.front().heat.coefficient.value({}, 0), 1);
  EXPECT_EQ(c.contacts.front().heat.foundation_temperature.value({}, 0), -27);
}

TEST(Reader, ContactWithoutLawsIsSlipperyAndInsulated) {
  const Case c = read({"contact={on='left'}"});
  EXPECT_EQ(c.contacts.front().friction.law, "none");
  EXPECT_EQ(c.contacts.front().heat.law, "insulated");
}

TEST(Reader, ATextForTheNormalStandsForItsLaw) {
  EXPECT_EQ(read({"contact.normal=unilateral"}).contacts.front().normal.law, "unilateral");
  EXPECT_EQ(read({"contact.normal={law='unilateral'}"}).contacts.front().normal.law, "unilateral");
  EXPECT_EQ(read({"contact={on='left'}"}).contacts.front().normal.law, "bilateral");
}

TEST(Reader, ReadsANormalLawWithItsConstants) {
  const NormalCase normal =
      read({"contact.normal={law='compliance', coefficient='1e13*(1+y)', exponent=2}"})
          .contacts.front()
          .normal;
  EXPECT_EQ(normal.law, "compliance");
  EXPECT_EQ(normal.coefficient.value({0, 1}, 0), 2e13);
  EXPECT_EQ(normal.exponent, 2);
  EXPECT_EQ(
      read({"contact.normal={law='damped', coefficient=1e9}"}).contacts.front().normal.exponent, 1);
}

TEST(Reader, ReadsTheGapAndTheFoundationsMotion) {
  const ContactCase contact =
      read({"contact.gap='-1e-6*y'", "contact.foundation_displacement=[1e-9,'1e-6*t']"})
          .contacts.front();
  EXPECT_EQ(contact.gap.value({0, 2}, 0), -2e-6);
  ASSERT_EQ(contact.foundation_displacement.size(), 2u);
  EXPECT_EQ(contact.foundation_displacement[0].value({}, 3), 1e-9);
  EXPECT_EQ(contact.foundation_displacement[1].value({}, 3), 3e-6);
  EXPECT_TRUE(read().contacts.front().gap.is_zero());
  EXPECT_TRUE(read().contacts.front().foundation_displacement.empty());
}

TEST(Reader, ANumberForTheCoefficientOfFrictionIsItsValue) {
  const FrictionCase friction =
      read({"contact.friction={law='coulomb', coefficient=0.3, cohesion=2, limit='3e4*(1+t)'}"})
          .contacts.front()
          .friction;
  EXPECT_EQ(friction.coefficient.value->value({}, 0), 0.3);
  EXPECT_FALSE(friction.coefficient.at_rest);
  EXPECT_EQ(friction.cohesion.value({}, 0), 2);
  EXPECT_EQ(friction.limit->value({}, 1), 6e4);
  EXPECT_FALSE(read().contacts.front().friction.limit);
}

TEST(Reader, ReadsACoefficientOfFrictionThatFallsWithSlip) {
  const FrictionCoefficientCase mu =
      read({"contact.friction={law='coulomb', coefficient={static=0.5, kinetic='0.3*y', "
            "distance=1e-6}}"})
          .contacts.front()
          .friction.coefficient;
  EXPECT_FALSE(mu.value);
  EXPECT_EQ(mu.at_rest->value({}, 0), 0.5);
  EXPECT_EQ(mu.kinetic->value({0, 2}, 0), 0.6);
  EXPECT_FALSE(mu.speed);
  EXPECT_EQ(mu.distance, 1e-6);
}

TEST(Reader, ACaseWithoutContactIsPossible) {
  EXPECT_TRUE(read_text(cube, "cube.toml").contacts.empty());
}

TEST(Reader, ThreeDimensionsFollowFromTheCells) {
  EXPECT_EQ(read_text(cube, "cube.toml").dimension, 3);
}

TEST(Reader, DefaultsLeaveAtMostFiftyFieldFiles) {
  EXPECT_EQ(read_text(cube, "cube.toml").output.every, 2);
  EXPECT_EQ(read_text(cube, "cube.toml", {"time.steps=1"}).output.every, 1);
  EXPECT_EQ(read_text(cube, "cube.toml", {"time.steps=50"}).output.every, 1);
  EXPECT_EQ(read_text(cube, "cube.toml", {"time.steps=51"}).output.every, 2);
  EXPECT_EQ(read_text(cube, "cube.toml", {"time.steps=2147483647"}).output.every, 42949673);
}

TEST(Reader, ReadsLoadsAndInitialValues) {
  const Case c = read({"load.force=[0,'-9.81*5800']", "load.heat='exp(-t)'",
                       "initial.displacement=['1e-6*x',0]", "initial.temperature=20"});
  EXPECT_DOUBLE_EQ(c.load.force.at(1).value({}, 0), -9.81 * 5800);
  EXPECT_TRUE(c.load.heat.depends_on_time());
  EXPECT_TRUE(c.initial.displacement.at(0).depends_on_place());
  EXPECT_EQ(c.initial.temperature.value({}, 0), 20);
  EXPECT_TRUE(c.load.charge.is_zero());
}

TEST(Reader, IntegersAreNumbers) {
  EXPECT_EQ(read({"time.end=9007199254740993"}).time.end, 9007199254740992.0);
}

TEST(Reader, ReadsAFile) {
  const auto file = std::filesystem::path(testing::TempDir()) / "read a file.toml";
  std::ofstream(file) << "\xEF\xBB\xBF" << example;  // as some editors on Windows write it
  const Case c = read_file(file);
  EXPECT_EQ(c.source, file.string());
  EXPECT_EQ(c.time.steps, 20);
  std::filesystem::remove(file);
}

TEST(Override, ReplacesAValue) {
  EXPECT_EQ(read({"time.steps=40"}).time.steps, 40);
}

TEST(Override, TheLastOneCounts) {
  EXPECT_EQ(read({"time.steps=40", "time.steps=50"}).time.steps, 50);
}

TEST(Override, ReachesIntoInlineTables) {
  const Case c = read({"contact.friction.bound=30", "mesh.box.cells[0]=8"});
  EXPECT_EQ(c.contacts.front().friction.bound.value({}, 0), 30);
  EXPECT_EQ(c.mesh.box->cells, (std::vector<int>{8, 64}));
}

TEST(Override, ReachesIntoArrayEntriesInBothSpellings) {
  EXPECT_EQ(read({"boundary[2].traction=[0,\"-1*t\"]"}).boundaries[2].traction->at(1).text(),
            "-1*t");
  EXPECT_EQ(read({"boundary.2.traction=[0,\"-1*t\"]"}).boundaries[2].traction->at(1).text(),
            "-1*t");
}

TEST(Override, MakesTheTablesThatTheFileLacks) {
  const Case c =
      read_text(cube, "cube.toml",
                {"contact.on=left", "contact.friction.bound=30", "contact.friction.law=tresca",
                 "boundary[1].on=top", "boundary[1].potential=5"});
  EXPECT_EQ(c.contacts.front().friction.bound.value({}, 0), 30);
  EXPECT_EQ(c.boundaries.at(1).potential->value({}, 0), 5);
}

TEST(Override, MakesTheFirstEntryOfAnArray) {
  const std::string without = cube.substr(0, cube.find("[[boundary]]"));
  const Case c = read_text(
      without, "cube.toml",
      {"boundary[0].on=bottom", "boundary[0].displacement=[0,0,0]", "boundary[0].potential=2"});
  ASSERT_EQ(c.boundaries.size(), 1u);
  EXPECT_EQ(c.boundaries[0].on, std::vector<std::string>{"bottom"});
  EXPECT_TRUE(c.boundaries[0].displacement->at(2)->is_zero());
  EXPECT_EQ(c.boundaries[0].potential->value({}, 0), 2);
}

TEST(Override, ABareWordIsAText) {
  EXPECT_EQ(read({"solver.method=monolithic"}).solver.method, "monolithic");
  EXPECT_EQ(read({"boundary[0].potential=100*sin(2*pi*t)"}).boundaries[0].potential->text(),
            "100*sin(2*pi*t)");
}

TEST(Override, TheEqualsSignOfAFormulaBelongsToTheValue) {
  EXPECT_EQ(read({"boundary[0].potential=\"if(t==0,1,2)\""}).boundaries[0].potential->text(),
            "if(t==0,1,2)");
}

TEST(Override, AValueTakesThePlaceOfItsTable) {
  const std::string table = "contact.normal={law='compliance', coefficient=1e13}";
  EXPECT_EQ(read({table, "contact.normal=unilateral"}).contacts.front().normal.law, "unilateral");
  const std::string friction =
      "contact.friction={law='coulomb', coefficient={static=0.5, kinetic=0.3, speed=1}}";
  const FrictionCoefficientCase mu =
      read({friction, "contact.friction.coefficient=0.2"}).contacts.front().friction.coefficient;
  EXPECT_EQ(mu.value->value({}, 0), 0.2);
  EXPECT_FALSE(mu.speed);
}

TEST(Override, AKeyBesideAValueMakesItTheTable) {
  const NormalCase normal = read({"contact.normal=compliance", "contact.normal.coefficient=1e13"})
                                .contacts.front()
                                .normal;
  EXPECT_EQ(normal.law, "compliance");
  EXPECT_EQ(normal.coefficient.value({}, 0), 1e13);
  // The file says normal = "bilateral".
  EXPECT_EQ(read({"contact.normal.coefficient=1e13", "contact.normal.law=compliance"})
                .contacts.front()
                .normal.law,
            "compliance");
}

TEST(Override, ReplacesAWholeTable) {
  EXPECT_EQ(read({"contact.heat={law='insulated'}"}).contacts.front().heat.law, "insulated");
}

TEST(Reader, TakesALawThatNeedsNothingElseAsAText) {
  const Case asked = read_text(
      "mesh.box = { min = [0, 0], max = [1, 1], cells = [1, 1] }\n"
      "material.library = \"BaTiO3-Liu2014\"\ntime = { end = 1, steps = 1 }\n"
      "boundary = [ { on = \"top\", displacement = [0, 0], potential = 0, temperature = 0 } ]\n"
      "contact = { on = \"bottom\", normal = \"unilateral\", friction = \"none\", heat = "
      "\"insulated\" }\n",
      "case.toml", {});
  EXPECT_TRUE(asked.contacts[0].normal.can_open());
  EXPECT_FALSE(asked.contacts[0].friction.resists());
  EXPECT_FALSE(asked.contacts[0].heat.exchanges());
}

}  // namespace
}  // namespace tourmaline::casefile
