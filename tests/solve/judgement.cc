#include "solve/judgement.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "tourmaline/error.h"

namespace tourmaline::solve {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::ThrowsMessage;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

void see(Judgement &judgement, int n, double forces, double heat = 0) {
  judgement.step(n, 0.5 * n, {{"force_imbalance", forces}, {"heat_imbalance", heat}}, [] {
    return Accuracy{1e-3, 0.5};
  });
}

TEST(Judgement, AStepWhoseBalanceLacksATenthOrIsNoNumberFails) {
  Judgement judgement;
  see(judgement, 1, 0.09, -0.09);
  for (const double lacks : {0.11, -0.11, nan}) {
    EXPECT_THROW(see(judgement, 2, lacks), SolveError);
    EXPECT_THROW(see(judgement, 2, 0, lacks), SolveError);
  }
}

TEST(Judgement, ABodyThatOnlyContactHoldsHasForcesThatBalance) {
  Judgement judgement("a translation along x");
  see(judgement, 1, 9e-6, 0.09);
  for (const double lacks : {1.1e-5, -1.1e-5})
    EXPECT_THAT([&] { see(judgement, 2, lacks); },
                ThrowsMessage<SolveError>(HasSubstr("keeps the body from a translation along x")));
  Judgement of_supports;
  see(of_supports, 1, 1.1e-5);
}

TEST(Judgement, OfABodyThatSlidesTheForcesSaySoWhateverElseLacks) {
  Judgement judgement("a translation along x");
  EXPECT_THAT(
      [&] {
        judgement.step(1, 0.5, {{"energy_imbalance", 0.2}, {"force_imbalance", 1e-3}},
                       [] { return Accuracy{}; });
      },
      ThrowsMessage<SolveError>(HasSubstr("keeps the body from a translation along x")));
}

TEST(Judgement, AStepWhoseErrorIsATenthFailsAndAnUnknownErrorDoesNot) {
  Judgement judgement;
  judgement.forward_error(1, 0.5, {nan, 0.09});
  judgement.forward_error(2, 1, {nan, nan});
  EXPECT_THROW(judgement.forward_error(3, 1.5, {nan, 0.11}), SolveError);
}

TEST(Judgement, OfEachBalanceAndOfTheErrorTheLargestIsWarnedOfWithItsStep) {
  Judgement judgement;
  see(judgement, 1, 1e-7, 1e-5);
  see(judgement, 2, -1e-7, -1e-3);
  see(judgement, 3, 0, 1e-4);
  judgement.forward_error(2, 1, {nan, 1e-2});
  judgement.forward_error(3, 1.5, {nan, 1e-3});
  EXPECT_THAT(
      judgement.warnings(),
      ElementsAre(HasSubstr("1.0e-03 of the size of its terms (heat_imbalance, step 2, t = 1 s"),
                  HasSubstr("1.0e-02 of its size (forward_error, step 2, t = 1 s")));
}

TEST(Judgement, OfWhatIsSmallNothingIsSaid) {
  Judgement judgement;
  see(judgement, 1, 1e-7, 1e-7);
  judgement.forward_error(1, 0.5, {nan, 1e-7});
  EXPECT_THAT(judgement.warnings(), IsEmpty());
}

TEST(Judgement, AResumedRunWarnsOfTheSame) {
  Judgement judgement, resumed;
  see(judgement, 1, 1e-5, 1e-4);
  judgement.forward_error(2, 1, {nan, 1e-3});
  output::SavedNumbers numbers;
  judgement.save(numbers);
  resumed.restore(numbers);
  EXPECT_EQ(resumed.warnings(), judgement.warnings());
  EXPECT_EQ(resumed.warnings().size(), 3u);
}

}  // namespace
}  // namespace tourmaline::solve
