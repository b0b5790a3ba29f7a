#include "tourmaline/case/formula.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <map>
#include <thread>

#include "tourmaline/error.h"

namespace tourmaline::casefile {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

std::string error_of(const std::string &text) {
  try {
    const Formula formula(text, "case.toml:3:5 [load] heat");
    formula.value({1, 2, 3}, 4);
  } catch (const CaseError &error) {
    return error.what();
  }
  return "no error";
}

TEST(Formula, UsesPlaceAndTime) {
  const Formula formula("x + 10*y + 100*z + 1000*t");
  EXPECT_EQ(formula.value({1, 2, 3}, 4), 4321);
  EXPECT_TRUE(formula.depends_on_place());
  EXPECT_TRUE(formula.depends_on_time());
}

TEST(Formula, KnowsWhichVariablesItUses) {
  EXPECT_FALSE(Formula("x*y*z").depends_on_time());
  EXPECT_FALSE(Formula("sin(t)").depends_on_place());
  EXPECT_FALSE(Formula("2*pi").depends_on_place());
  EXPECT_FALSE(Formula(3.0).depends_on_time());
}

TEST(Formula, WithoutVariablesIsItsNumber) {
  const Formula formula("-2*15");
  EXPECT_TRUE(formula.is_number());
  EXPECT_EQ(formula.value({}, 0), -30);
  EXPECT_EQ(formula.text(), "-30");
}

TEST(Formula, ThatIsZeroKnowsIt) {
  EXPECT_TRUE(Formula().is_zero());
  EXPECT_TRUE(Formula("0*2").is_zero());
  EXPECT_FALSE(Formula("0*t").is_zero());
  EXPECT_FALSE(Formula(1e-300).is_zero());
}

TEST(Formula, NumbersAreWrittenToTheLastBit) {
  for (const double number : {0.1, 1.0 / 3.0, 1e-300, -6.02214076e23, 123456789.123456789})
    EXPECT_EQ(std::stod(Formula(number).text()), number);
}

TEST(Formula, MinusBindsWeakerThanThePower) {
  EXPECT_EQ(Formula("-x^2").value({3, 0, 0}, 0), -9);
}

TEST(Formula, IfChoosesByItsCondition) {
  const Formula formula("if(x < 0.5, 1, 2)");
  EXPECT_EQ(formula.value({0.4, 0, 0}, 0), 1);
  EXPECT_EQ(formula.value({0.6, 0, 0}, 0), 2);
}

TEST(Formula, TheBranchNotTakenMayBeUndefined) {
  EXPECT_EQ(Formula("if(x > 0, sqrt(x), 0)").value({-1, 0, 0}, 0), 0);
}

TEST(Formula, ACompareWithAnUndefinedConditionIsAnError) {
  EXPECT_THAT(error_of("if(sqrt(-x), 1, 2)"), HasSubstr("nan"));
}

TEST(Formula, WhatIsNotANumberIsNotHiddenByWhatFollows) {
  for (const char *text : {"sqrt(-t) ? 1 : 2", "max(1, sqrt(-t))", "min(sqrt(-t), 1)",
                           "sqrt(-t) < 1", "sqrt(-t) == 1 || x > 0", "x > 0 && log(-x) < 1",
                           "sqrt(-t)^0", "1^log(-t)", "if(x > 0, if(sqrt(-x), 1, 2), 3)"})
    EXPECT_THAT(error_of(text), HasSubstr("(nan)")) << text;
  for (const char *text : {"1/(1/(x - 1))", "atan(1/(x - 1))", "t < 1/(x - 1)",
                           "1/(1 + exp(1e3*t))", "max(0, log(x - 1))", "t > 1/0 ? 1 : 2"})
    EXPECT_THAT(error_of(text), HasSubstr("(inf)")) << text;
}

TEST(Formula, WhatIsNotTakenMayBeUndefinedInAnyForm) {
  for (const auto &[text, value] :
       std::map<std::string, double>{{"x < 0 ? log(-x) : 5", 5},
                                     {"x > 0 || log(-x) > 0", 1},
                                     {"x < 0 && sqrt(-x) > 0", 0},
                                     {"x < 0 && sqrt(-x) > 0 || y == 2 && z == 3", 1},
                                     {"if(x < 0, sqrt(-x), if(y > 5, sqrt(-y), z))", 3},
                                     {"if(x < 0 || y < 0, 1/0, max(if(x == 1, 7, 1/0), 2))", 7},
                                     {"1 + if(x==1, 2, 3)*10", 21},
                                     {"x < 0 ? 1 : y < 0 ? 2 : z < 0 ? 3 : 4", 4},
                                     {"x > 0 ? y > 0 ? 11 : 12 : 13", 11},
                                     {"-(x > 0 && t > 0)", -1},
                                     {"(x > 0) + (y > 0 || 1/0)", 2}})
    EXPECT_EQ(Formula(text).value({1, 2, 3}, 4), value) << text;
}

TEST(Formula, LogicalOperatorsAreTrueOrFalse) {
  for (int bits = 0; bits < 8; ++bits) {
    const std::array<double, 3> p{bits & 1 ? 3. : 0., bits & 2 ? -2. : 0., bits & 4 ? 0.5 : 0.};
    const bool a = p[0] != 0, b = p[1] != 0, c = p[2] != 0;
    EXPECT_EQ(Formula("x && y || z").value(p, 0), (a && b) || c);
    EXPECT_EQ(Formula("x || y && z").value(p, 0), a || (b && c));
    EXPECT_EQ(Formula("(x || y) && z").value(p, 0), (a || b) && c);
    EXPECT_EQ(Formula("x && y && z ? 1 : 2").value(p, 0), a && b && c ? 1 : 2);
  }
}

TEST(Formula, AnEarlierTroubleOfTheThreadIsNotTheFormulas) {
  volatile double zero = 0;
  volatile double infinite = 1 / zero;
  EXPECT_TRUE(std::isinf(infinite));
  EXPECT_EQ(Formula("2*x").value({1, 0, 0}, 0), 2);
}

TEST(Formula, ControlCharactersAreRefused) {
  EXPECT_THAT(error_of(std::string("1\0*x", 4)), HasSubstr("control character"));
  EXPECT_THAT(error_of("x\x1B[31m"), HasSubstr("control character"));
  EXPECT_EQ(Formula("x\n+\tt").value({1, 0, 0}, 2), 3);
}

TEST(Formula, ANumberWithoutTheDigitsOfItsExponentIsIncomplete) {
  for (const auto &[text, number] : std::map<std::string, std::string>{{"1e", "1e"},
                                                                       {"2.5E", "2.5E"},
                                                                       {"1.e", "1.e"},
                                                                       {"x + 2e*t", "2e"},
                                                                       {"sin(3e)", "3e"},
                                                                       {"1e-", "1e"},
                                                                       {"1e+t", "1e"},
                                                                       {"1e 5", "1e"}})
    EXPECT_THAT(error_of(text), AllOf(HasSubstr("the number \"" + number + "\" is incomplete"),
                                      Not(HasSubstr("did you mean"))))
        << text;
  for (const char *text : {"e", "1ex", "x1e", "1_e"})
    EXPECT_THAT(error_of(text), AllOf(HasSubstr("not a formula"), Not(HasSubstr("incomplete"))));
  EXPECT_EQ(Formula("1e-1*x").value({2, 0, 0}, 0), 0.2);
}

TEST(Formula, ThatIsNestedTooDeeplyIsRefused) {
  const std::string deep = std::string(5000, '(') + "x" + std::string(5000, ')');
  EXPECT_THAT(error_of(deep), HasSubstr("parentheses"));
  std::string chain = "0";
  for (int i = 0; i < 900; ++i)
    chain = "x==" + std::to_string(i) + "?" + std::to_string(i + 1) + ":" + chain;
  EXPECT_EQ(Formula(chain).value({500, 0, 0}, 0), 501);
  for (int i = 0; i < 200; ++i)
    chain = "1?1:" + chain;
  EXPECT_THAT(error_of(chain), HasSubstr("conditions"));
  std::string either = "x==0";
  for (int i = 1; i < 1000; ++i)
    either += "||x==" + std::to_string(i);
  EXPECT_EQ(Formula(either).value({999, 0, 0}, 0), 1);
  EXPECT_EQ(Formula(either).value({1000, 0, 0}, 0), 0);
}

TEST(Formula, ValuesOutsideOfTheRangeSayWhereAndWhen) {
  const Formula load("1e17*x*t", "case.toml:3:5 [load] heat", any({0, 1e15}), "W/m^3");
  EXPECT_EQ(load.value({1e-3, 0, 0}, 1), 1e14);
  try {
    load.value({1, 2, 0}, 0.5);
    FAIL();
  } catch (const CaseError &error) {
    EXPECT_THAT(error.what(), HasSubstr("[load] heat = \"1e17*x*t\": is 5e+16, but cannot be "
                                        "meant; it must be at most 1e+15 W/m^3 in size, at x = 1"));
    EXPECT_THAT(error.what(), HasSubstr("t = 0.5 s"));
  }
  const Formula bound("1 - t", "", not_negative(), "N/m^2");
  EXPECT_EQ(bound.value({}, 1), 0);
  EXPECT_THROW(bound.value({}, 1.5), CaseError);
}

TEST(Formula, ModHasTheSignOfTheDivisor) {
  EXPECT_DOUBLE_EQ(Formula("mod(x, 3)").value({-1, 0, 0}, 0), 2);
}

TEST(Formula, CopiesEvaluateAlike) {
  const Formula one("x*t");
  const Formula other = one;
  EXPECT_EQ(other.value({2, 0, 0}, 3), 6);
  EXPECT_EQ(one.value({4, 0, 0}, 3), 12);
}

TEST(Formula, ThreadsDoNotDisturbEachOther) {
  const Formula formula("x + 0*t");
  std::array<int, 4> wrong{};
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i)
    threads.emplace_back([&, i] {
      for (int k = 0; k < 20000; ++k)
        if (formula.value({static_cast<double>(i), 0, 0}, k) != i)
          ++wrong[i];
    });
  for (std::thread &thread : threads)
    thread.join();
  EXPECT_EQ(wrong, (std::array<int, 4>{}));
}

TEST(Formula, AHundredThousandEvaluationsTakeLessThanASecond) {
  const Formula formula("-0.5*t*sin(pi*x)*exp(-y)");
  const auto start = std::chrono::steady_clock::now();
  double sum = 0;
  for (int i = 0; i < 100000; ++i)
    sum += formula.value({1e-5 * i, 0.5, 0}, 0.1);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(1));
  EXPECT_LT(sum, 0);
}

TEST(Formula, ThatDoesNotParseSaysWhereAndWhy) {
  const std::string error = error_of("3*(x + 1");
  EXPECT_THAT(error, HasSubstr("case.toml:3:5 [load] heat = \"3*(x + 1\""));
  EXPECT_THAT(error, HasSubstr("Missing parenthesis"));
}

TEST(Formula, MisspeltNamesAreNamedWithTheNearest) {
  const std::string error = error_of("2*cosd(x)");
  EXPECT_THAT(error, HasSubstr("\"cosd\" found at position 2"));
  EXPECT_THAT(error, HasSubstr("did you mean \"cos\"?"));
}

TEST(Formula, ASingleEqualsSignIsNoComparison) {
  EXPECT_THAT(error_of("if(x=1, 2, 3)"), HasSubstr("\"==\""));
  EXPECT_EQ(Formula("if(x==1, 2, 3)").value({1, 0, 0}, 0), 2);
  EXPECT_EQ(Formula("if(x<=1, 2, 3)").value({1, 0, 0}, 0), 2);
  EXPECT_EQ(Formula("if(x!=1, 2, 3)").value({1, 0, 0}, 0), 3);
}

TEST(Formula, ADecimalCommaIsAnError) {
  EXPECT_THAT(error_of("1,5"), HasSubstr("comma"));
}

TEST(Formula, AnEmptyTextIsAnError) {
  EXPECT_THAT(error_of(""), HasSubstr("empty"));
}

TEST(Formula, NotANumberNamesPlaceTimeAndText) {
  const std::string error = error_of("sqrt(-t*x)");
  EXPECT_THAT(error, HasSubstr("case.toml:3:5 [load] heat = \"sqrt(-t*x)\""));
  EXPECT_THAT(error, HasSubstr("nan"));
  EXPECT_THAT(error, HasSubstr("at x = 1 m, t = 4 s"));
  EXPECT_THAT(error_of("sqrt(-x*y*z)"), HasSubstr("at x = 1, y = 2, z = 3 m"));
  EXPECT_THAT(error_of("sqrt(-t)"), HasSubstr("at t = 4 s"));
}

TEST(Formula, DivisionByZeroIsAnError) {
  EXPECT_THAT(error_of("1/(x - 1)"), HasSubstr("inf"));
  EXPECT_THAT(error_of("1/0"), HasSubstr("not a finite number"));
  EXPECT_THROW(Formula(std::nan("")), CaseError);
}

TEST(Formula, ALineBreakInsideDoesNotBreakTheErrorText) {
  EXPECT_EQ(error_of("x\n\ny").find('\n'), std::string::npos);
}

}  // namespace
}  // namespace tourmaline::casefile
