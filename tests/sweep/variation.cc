#include "sweep/variation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tourmaline/error.h"

namespace tourmaline::sweep {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

std::vector<std::string> values_in(const std::string &assignment) {
  return read_variation(assignment).values;
}

TEST(Variation, ListedValuesAreThoseBetweenTheCommas) {
  const Variation read = read_variation("contact.friction.bound = 5, 15,4.5e1");
  EXPECT_EQ(read.key, "contact.friction.bound");
  EXPECT_THAT(read.values, ElementsAre("5", "15", "4.5e1"));
  EXPECT_FALSE(read.logarithmic);
  EXPECT_THAT(values_in("solver.method=condensed,monolithic"),
              ElementsAre("condensed", "monolithic"));
}

TEST(Variation, CommasInsideOfListsTablesAndTextsBelongToAValue) {
  EXPECT_THAT(values_in("mesh.box.cells=[4,4],[8,8]"), ElementsAre("[4,4]", "[8,8]"));
  EXPECT_THAT(values_in("contact.friction={law='none'},{law='tresca',bound=1}"),
              ElementsAre("{law='none'}", "{law='tresca',bound=1}"));
  EXPECT_THAT(values_in("boundary[0].potential='if(t > 1, 2, 3)',\"max(x,y)\""),
              ElementsAre("'if(t > 1, 2, 3)'", "\"max(x,y)\""));
}

TEST(Variation, LinearValuesDifferByAsMuch) {
  EXPECT_THAT(values_in("a=lin:5:45:5"), ElementsAre("5", "15", "25", "35", "45"));
  EXPECT_THAT(values_in("a=lin:0:-0.3:4"), ElementsAre("0", "-0.1", "-0.2", "-0.3"));
}

TEST(Variation, LogarithmicValuesHaveTheSameRatio) {
  const Variation read = read_variation("a=log:0.1:100:7");
  EXPECT_TRUE(read.logarithmic);
  EXPECT_THAT(read.values, ElementsAre("0.1", "0.316227766016838", "1", "3.16227766016838", "10",
                                       "31.6227766016838", "100"));
  EXPECT_THAT(values_in("a=log:1e3:1e-3:3"), ElementsAre("1000", "1", "0.001"));
}

TEST(Variation, NeitherRatioNorDifferenceOfTheEndsNeedBeANumber) {
  EXPECT_THAT(values_in("a=log:1e-300:1e300:3"), ElementsAre("1e-300", "1", "1e+300"));
  EXPECT_THAT(values_in("a=log:1e300:1e-300:5"),
              ElementsAre("1e+300", "1e+150", "1", "1e-150", "1e-300"));
  EXPECT_THAT(values_in("a=lin:-1.5e308:1.5e308:3"), ElementsAre("-1.5e+308", "0", "1.5e+308"));
}

TEST(Variation, TheEndsAreWhatWasWritten) {
  EXPECT_THAT(values_in("a=lin:0.12345678901234567:1.0000000000000002:2"),
              ElementsAre("0.12345678901234566", "1.0000000000000002"));
}

TEST(Variation, AFormulaWithAColonIsAValue) {
  EXPECT_THAT(values_in("a='x > 0 ? 1 : 2','x < 0 ? 1 : 2'"),
              ElementsAre("'x > 0 ? 1 : 2'", "'x < 0 ? 1 : 2'"));
}

struct Wrong {
  const char *assignment, *reason;
};

class WrongVariation : public testing::TestWithParam<Wrong> {};

TEST_P(WrongVariation, IsAnsweredWithWhatIsAllowed) {
  EXPECT_THAT([] { read_variation(GetParam().assignment); },
              ThrowsMessage<CaseError>(
                  testing::AllOf(testing::StartsWith("--vary "), HasSubstr(GetParam().reason))));
}

INSTANTIATE_TEST_SUITE_P(
    Grammar, WrongVariation,
    testing::Values(
        Wrong{"a", "has no \"=\""}, Wrong{"=1,2", "names no key"},
        Wrong{"a=", "a value is missing"}, Wrong{"a=1,,2", "a value is missing"},
        Wrong{"a=1,2,", "a value is missing"}, Wrong{"a=1,2,1", "gives 1 twice"},
        Wrong{"a=1,2,1.0", "gives 1 twice, the second time as 1.0"},
        Wrong{"a=lin:1:2", "write lin:A:B:N"}, Wrong{"a=log:1:2:3:4", "write log:A:B:N"},
        Wrong{"a=lin:one:2:3", "must be numbers"}, Wrong{"a=lin:0:inf:3", "must be numbers"},
        Wrong{"a=lin:1:2:1", "N must be an integer from 2 to 1000"},
        Wrong{"a=lin:1:2:2.5", "N must be an integer"},
        Wrong{"a=lin:1:2:1001", "N must be an integer"},
        Wrong{"a=lin:1:1:2", "A and B must differ"}, Wrong{"a=log:0:1:2", "must be greater than 0"},
        Wrong{"a=log:-1:-2:2", "must be greater than 0"},
        Wrong{"a=lgo:1:2:3", "did you mean \"log\"?"},
        Wrong{"a=linear:1:2:3", "allowed: lin:A:B:N, log:A:B:N"}));

TEST(Variation, AKeyIsVariedOnce) {
  EXPECT_EQ(read_variations({"a=1,2", "b=1"}).size(), 2u);
  EXPECT_THAT(
      [] {
        read_variations({"a=1,2", "b=1", "a=3"});
      },
      ThrowsMessage<CaseError>(HasSubstr("--vary a=3: this key is varied twice")));
}

TEST(Variation, AVariedKeyIsNotSetToo) {
  require_not_set(read_variations({"a.b=1,2"}), {"a=3", "b=4"});
  EXPECT_THAT(
      [] {
        require_not_set(read_variations({"a.b=1,2"}), {"c=1", "a.b =3"});
      },
      ThrowsMessage<CaseError>(HasSubstr("--set a.b =3: this key is varied")));
}

}  // namespace
}  // namespace tourmaline::sweep
