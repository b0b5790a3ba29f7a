#include "sweep/reduction.h"

#include <gtest/gtest.h>

#include <cmath>

namespace tourmaline::sweep {
namespace {

const std::vector<double> times{1, 2, 4}, values{3, -6, 1.5};

double made(const std::string &word) {
  return reduced(*reduction_named(word), times, values);
}

double at(double time) {
  return reduced({.kind = Reduction::Kind::at, .time = time}, times, values);
}

TEST(Reduction, LastAndExtremesAreValuesOfTheColumn) {
  EXPECT_EQ(made("last"), 1.5);
  EXPECT_EQ(made("min"), -6);
  EXPECT_EQ(made("max"), 3);
}

TEST(Reduction, MeansWeighAStepWithItsLength) {
  EXPECT_DOUBLE_EQ(made("mean"), (3 - 6 + 2 * 1.5) / 4);
  EXPECT_DOUBLE_EQ(made("rms"), std::sqrt((9 + 36 + 2 * 2.25) / 4));
}

TEST(Reduction, OfAWindowStepsCountWithWhatLiesInIt) {
  const auto in = [](const char *word, double from, double to) {
    Reduction reduction = *reduction_named(word);
    reduction.window = Reduction::Window{from, to};
    return reduced(reduction, times, values);
  };
  EXPECT_DOUBLE_EQ(in("mean", 1, 4), (-6 + 2 * 1.5) / 3);
  EXPECT_DOUBLE_EQ(in("mean", 0.5, 3), (0.5 * 3 - 6 + 1.5) / 2.5);
  EXPECT_DOUBLE_EQ(in("rms", 1.5, 2.5), std::sqrt((0.5 * 36 + 0.5 * 2.25) / 1));
  EXPECT_EQ(in("min", 2, 4), 1.5) << "the step that ends where the window begins is not in it";
  EXPECT_EQ(in("min", 2 * (1 - 1e-15), 4), 1.5);
  EXPECT_EQ(in("max", 1, 2), -6);
  EXPECT_EQ(in("max", 0, 4), made("max"));
  EXPECT_TRUE(std::isnan(in("mean", 5, 6)));
}

TEST(Reduction, NoSquareLeavesTheRangeOfNumbers) {
  const std::vector<double> large{3e300, 4e300}, small{3e-300, 4e-300}, nothing{0, 0}, ends{1, 2};
  const Reduction rms{.kind = Reduction::Kind::rms};
  EXPECT_DOUBLE_EQ(reduced(rms, ends, large), std::sqrt(12.5) * 1e300);
  EXPECT_DOUBLE_EQ(reduced(rms, ends, small), std::sqrt(12.5) * 1e-300);
  EXPECT_EQ(reduced(rms, ends, nothing), 0);
}

TEST(Reduction, AtATimeItIsTheStepsValueOrOneBetweenTwo) {
  EXPECT_EQ(at(2), -6);
  EXPECT_EQ(at(2 * (1 + 1e-15)), -6);
  EXPECT_EQ(at(4 * (1 + 1e-16)), 1.5);
  EXPECT_DOUBLE_EQ(at(1.5), -1.5);
  EXPECT_DOUBLE_EQ(at(3.5), -0.375);
  EXPECT_TRUE(std::isnan(at(0.5))) << "the initial state is no row of the history";
  EXPECT_TRUE(std::isnan(at(4.5)));
}

TEST(Reduction, OfNothingOrOfWhatIsNoNumberThereIsNone) {
  for (const std::string &word : reduction_words())
    EXPECT_TRUE(std::isnan(reduced(*reduction_named(word), {}, {})));
  const std::vector<double> gap{1, std::nan(""), 2};
  for (const char *word : {"min", "max", "mean", "rms"})
    EXPECT_TRUE(std::isnan(reduced(*reduction_named(word), times, gap)));
  EXPECT_FALSE(reduction_named("median"));
}

}  // namespace
}  // namespace tourmaline::sweep
