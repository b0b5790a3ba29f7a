#include "sweep/member.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "tourmaline/error.h"

namespace tourmaline::sweep {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

std::vector<std::string> names_of(const std::vector<std::string> &assignments) {
  std::vector<std::string> names;
  for (const Member &member : members_of(read_variations(assignments)))
    names.push_back(member.name);
  return names;
}

TEST(Members, TheyAreTheProductOfAllValuesAndTheLastKeyTurnsFastest) {
  const auto members = members_of(read_variations({"a=1,2", "b=x,y,z"}));
  std::vector<std::vector<std::string>> values;
  for (const Member &member : members)
    values.push_back(member.values);
  EXPECT_THAT(values,
              ElementsAre(ElementsAre("1", "x"), ElementsAre("1", "y"), ElementsAre("1", "z"),
                          ElementsAre("2", "x"), ElementsAre("2", "y"), ElementsAre("2", "z")));
}

TEST(Members, TheirFoldersNamesSayKeysAndValues) {
  EXPECT_THAT(names_of({"contact.friction.bound=5,15", "contact.heat.coefficient=lin:0.1:0.2:2"}),
              ElementsAre("bound=5_coefficient=0.1", "bound=5_coefficient=0.2",
                          "bound=15_coefficient=0.1", "bound=15_coefficient=0.2"));
  EXPECT_THAT(names_of({"mesh.box.cells=[4,4],[8, 16]"}), ElementsAre("cells=4_4", "cells=8_16"));
}

TEST(Members, KeysThatEndAlikeAreNamedInFull) {
  EXPECT_THAT(names_of({"load.heat=1", "contact.heat={law='insulated'}"}),
              ElementsAre("load.heat=1_contact.heat=law_insulated"));
}

TEST(Members, NoTwoHaveTheSameFolderAndNoneIsOutsideOfTheStudys) {
  for (const std::vector<std::string> &assignments :
       {std::vector<std::string>{"a='x*y','x+y','x/y','x-y','(x y)'"},
        {"a=1.00000001,1.00000002,1.00000003"},
        {"title='../../etc','/root','..','.',''"},
        {"a='" + std::string(300, 'x') + "1','" + std::string(300, 'x') + "2'"}}) {
    const std::vector<std::string> names = names_of(assignments);
    EXPECT_EQ(std::set<std::string>(names.begin(), names.end()).size(), names.size());
    for (const std::string &name : names) {
      EXPECT_EQ(name.find('/'), std::string::npos) << name;
      EXPECT_LT(name.size(), 200u);
    }
  }
}

TEST(Members, TheirOverridesAreThoseOfSet) {
  const auto variations = read_variations({"time.steps=2", "solver.method=monolithic"});
  EXPECT_THAT(overrides_of(variations, members_of(variations).front()),
              ElementsAre("time.steps=2", "solver.method=monolithic"));
}

TEST(Members, MoreThanAnybodyWantsAreRefusedBeforeTheyAreMade) {
  EXPECT_THAT(
      [] {
        names_of({"a=lin:0:1:1000", "b=lin:0:1:1000", "c=lin:0:1:1000"});
      },
      ThrowsMessage<CaseError>(HasSubstr("more than 10000 cases")));
}

}  // namespace
}  // namespace tourmaline::sweep
