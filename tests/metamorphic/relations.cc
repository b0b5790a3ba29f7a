// Label: analytic. What the equations promise of every case, asked of random ones: turned,
// mirrored, in other units, numbered anew, solved another way or loaded by the sum of two loads,
// the same body does the same.

#include <gtest/gtest.h>

#include "random_sample.h"
#include "result.h"
#include "transformations.h"

namespace tourmaline::testing {
namespace {

// Of a quantity's largest value. Round-off in a well-conditioned small body; a conductor's
// permittivity takes six digits of the electric equations.
double round_off(const Sample &sample) {
  return sample.has_conductor() ? 1e-7 : 1e-9;
}

Image unchanged(const Sample &sample) {
  return {Eigen::MatrixXd::Identity(sample.dimension(), sample.dimension())};
}

std::string both(const Sample &original, const Sample &image) {
  return "case.toml, original:\n" + original.text() + "\nsample.msh, original:\n" +
         original.mesh.text() + "\ncase.toml, image:\n" + image.text() + "\nsample.msh, image:\n" +
         image.mesh.text();
}

void expect_image(const Sample &original, const Sample &other, const Image &image,
                  double tolerance) {
  try {
    expect_same(image_of(run(original), image), run(other), tolerance);
  } catch (const std::exception &error) {
    ADD_FAILURE() << error.what();
  }
  if (::testing::Test::HasFailure())
    ADD_FAILURE() << both(original, other);
}

// The parameter is the seed.
class RandomCase : public ::testing::TestWithParam<unsigned int> {
 protected:
  Random random{GetParam()};
};

class Rotation : public RandomCase {};
class Mirror : public RandomCase {};
class OtherUnits : public RandomCase {};
class Superposition : public RandomCase {};
class Renumbering : public RandomCase {};
class MonolithicRoute : public RandomCase {};
class IterativeRoute : public RandomCase {};

TEST_P(Rotation, OfTheWholeCaseRotatesTheResult) {
  const Sample sample = random_sample(random);
  const Image image{random_turn(sample, false, random)};
  expect_image(sample, turned(sample, image.turn), image, round_off(sample));
}

TEST_P(Mirror, OfTheWholeCaseMirrorsTheResult) {
  const Sample sample = random_sample(random);
  const Image image{random_turn(sample, true, random)};
  expect_image(sample, turned(sample, image.turn), image, round_off(sample));
}

TEST_P(OtherUnits, ChangeNothingButTheNumbers) {
  const Sample sample = random_sample(random);
  Image image = unchanged(sample);
  image.units = random_units(random);
  expect_image(sample, in_units(sample, image.units), image, round_off(sample));
}

TEST_P(Superposition, OfLoadsSuperposesTheResults) {
  const Sample one = random_sample(random, {.linear = true}), other = with_other_loads(one, random),
               sum = superposed(one, 1.7, other, -0.6);
  try {
    expect_same(superposed(run(one), 1.7, run(other), -0.6), run(sum), round_off(one));
  } catch (const std::exception &error) {
    ADD_FAILURE() << error.what();
  }
  if (HasFailure())
    ADD_FAILURE() << other.text() << both(one, sum);
}

TEST_P(Renumbering, TheMeshFileChangesNothing) {
  const Sample sample = random_sample(random);
  expect_image(sample, renumbered(sample, random), unchanged(sample), round_off(sample));
}

TEST_P(MonolithicRoute, GivesTheResultOfTheCondensedOne) {
  const Sample sample = random_sample(random, {.resistors = false});
  Sample other = sample;
  other.solver = "method = \"monolithic\"";
  expect_image(sample, other, unchanged(sample), round_off(sample));
}

// The body's equations are solved to 1e-13 of their residual; its condition makes more of that.
TEST_P(IterativeRoute, GivesTheResultOfTheDirectOne) {
  const Sample sample = random_sample(random, {.resistors = false});
  Sample other = sample;
  other.solver = "body = \"iterative\", linear_tolerance = 1e-13";
  expect_image(sample, other, unchanged(sample), 10 * round_off(sample));
}

INSTANTIATE_TEST_SUITE_P(Seed, Rotation, ::testing::Range(1000U, 1040U));
INSTANTIATE_TEST_SUITE_P(Seed, Mirror, ::testing::Range(2000U, 2035U));
INSTANTIATE_TEST_SUITE_P(Seed, OtherUnits, ::testing::Range(3000U, 3035U));
INSTANTIATE_TEST_SUITE_P(Seed, Superposition, ::testing::Range(4000U, 4035U));
INSTANTIATE_TEST_SUITE_P(Seed, Renumbering, ::testing::Range(5000U, 5035U));
INSTANTIATE_TEST_SUITE_P(Seed, MonolithicRoute, ::testing::Range(6000U, 6030U));
INSTANTIATE_TEST_SUITE_P(Seed, IterativeRoute, ::testing::Range(7000U, 7030U));

}  // namespace
}  // namespace tourmaline::testing
