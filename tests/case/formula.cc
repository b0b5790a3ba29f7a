#include "tourmaline/case/formula.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <thread>

#include "tourmaline/error.h"

namespace tourmaline::casefile {
namespace {

using testing::HasSubstr;

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
  EXPECT_THAT(error, HasSubstr("x = 1, y = 2, z = 3 m, t = 4 s"));
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
