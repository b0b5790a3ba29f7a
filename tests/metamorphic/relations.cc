// Label: analytic. What the equations promise of every case, asked of random ones: turned,
// mirrored, in other units, numbered anew, solved another way or loaded by the sum of two loads,
// the same body does the same.

#include <gtest/gtest.h>

#include <set>

#include "random_sample.h"
#include "result.h"
#include "transformations.h"

namespace tourmaline::verified {
namespace {

// Of a quantity's size, in a small body whose solution is certain to the last digits.
constexpr double round_off = 1e-10;

// Each with the seeds of its cases: from 1000 times its number on.
enum Relation : unsigned int { rotation = 1, mirror, units, superposition, order, newton, krylov };
constexpr unsigned int n_cases = 35;  // of each

Wish wish_of(unsigned int seed) {
  const unsigned int relation = seed / 1000;
  return {.linear = relation == superposition, .resistors = relation < newton};
}

// The parameter is the seed.
class RandomCase : public ::testing::TestWithParam<unsigned int> {
 protected:
  void expect_image(const Sample &other) {
    expect_image(other, {Eigen::MatrixXd::Identity(sample.dimension(), sample.dimension())});
  }
  void expect_image(const Sample &other, const Image &image) {
    expect([&] { expect_same(image_of(run(sample), image), run(other), round_off); }, other);
  }
  template <class Comparison>
  void expect(const Comparison &comparison, const Sample &other) const {
    try {
      comparison();
    } catch (const std::exception &error) {
      ADD_FAILURE() << error.what();
    }
    if (HasFailure())
      ADD_FAILURE() << "case.toml, original:\n"
                    << sample.text() << "sample.msh, original:\n"
                    << sample.mesh.text() << "case.toml, image:\n"
                    << other.text() << "sample.msh, image:\n"
                    << other.mesh.text();
  }

  Random random{GetParam()};
  const Sample sample = random_sample(random, wish_of(GetParam()));
};

class Rotation : public RandomCase {};
class Mirror : public RandomCase {};
class OtherUnits : public RandomCase {};
class Superposition : public RandomCase {};
class Renumbering : public RandomCase {};
class MonolithicRoute : public RandomCase {};
class IterativeRoute : public RandomCase {};

TEST_P(Rotation, OfTheWholeCaseRotatesTheResult) {
  const Image image{random_turn(sample, false, random)};
  expect_image(turned(sample, image.turn), image);
}

TEST_P(Mirror, OfTheWholeCaseMirrorsTheResult) {
  const Image image{random_turn(sample, true, random)};
  expect_image(turned(sample, image.turn), image);
}

TEST_P(OtherUnits, ChangeNothingButTheNumbers) {
  const int n = sample.dimension();
  const Image image{Eigen::MatrixXd::Identity(n, n), random_units(random)};
  expect_image(in_units(sample, image.units), image);
}

TEST_P(Superposition, OfLoadsSuperposesTheResults) {
  const Sample other = with_other_loads(sample, random), sum = superposed(sample, 1.7, other, -0.6);
  expect([&] { expect_same(superposed(run(sample), 1.7, run(other), -0.6), run(sum), round_off); },
         sum);
}

TEST_P(Renumbering, TheMeshFileChangesNothing) {
  expect_image(renumbered(sample, random));
}

TEST_P(MonolithicRoute, GivesTheResultOfTheCondensedOne) {
  Sample other = sample;
  other.solver = "method = \"monolithic\", tolerance = 1e-14";
  expect_image(other);
}

TEST_P(IterativeRoute, GivesTheResultOfTheDirectOne) {
  Sample other = sample;
  other.solver = "body = \"iterative\", linear_tolerance = 1e-13";
  expect_image(other);
}

auto seeds_of(unsigned int relation) {
  return ::testing::Range(1000 * relation, 1000 * relation + n_cases);
}

INSTANTIATE_TEST_SUITE_P(Seed, Rotation, seeds_of(rotation));
INSTANTIATE_TEST_SUITE_P(Seed, Mirror, seeds_of(mirror));
INSTANTIATE_TEST_SUITE_P(Seed, OtherUnits, seeds_of(units));
INSTANTIATE_TEST_SUITE_P(Seed, Superposition, seeds_of(superposition));
INSTANTIATE_TEST_SUITE_P(Seed, Renumbering, seeds_of(order));
INSTANTIATE_TEST_SUITE_P(Seed, MonolithicRoute, seeds_of(newton));
INSTANTIATE_TEST_SUITE_P(Seed, IterativeRoute, seeds_of(krylov));

// What the generator may not lose, of what is wished for.
std::map<std::string, bool> features(const Sample &sample, const Wish &wish) {
  const bool is_solid = sample.dimension() == 3, held = sample.has_free_components(),
             touches = !sample.contact.empty(), tilted = touches && sample.contact_is_tilted();
  const Condition *electrode = sample.find("electrode", "voltage");
  const auto law = [&](const std::string &table, const std::string &name) {
    const auto found = sample.laws.find("contact." + table);
    return found != sample.laws.end() && found->second == name;
  };
  std::map<std::string, bool> all{
      {"2D", !is_solid},
      {"3D", is_solid},
      {"degree 2", sample.degree == 2},
      {"3D of degree 2 in contact", is_solid && sample.degree == 2 && touches},
      {"simplices", sample.mesh.simplices},
      {"quadrilaterals or hexahedra", !sample.mesh.simplices},
      {"incompatible modes", sample.incompatible},
      {"regions", sample.materials.size() == 2},
      {"conductor", sample.materials[0].conductor},
      {"electrode", electrode != nullptr},
      {"contact", touches},
      {"no contact", !touches},
      {"Tresca's friction", law("friction", "tresca")},
      {"heat exchange", sample.find("contact.heat", "coefficient") != nullptr},
      {"moving foundation", sample.find("contact", "foundation_displacement") != nullptr},
      {"tilted contact", tilted},
      {"partly prescribed nodes", held},
      {"partly prescribed nodes in contact", held && touches},
      {"volume loads", sample.find("load", "force") != nullptr}};
  if (!wish.linear)
    all.insert({{"gap", sample.find("contact", "gap") != nullptr},
                {"unilateral contact", law("normal", "unilateral")},
                {"compliance", law("normal", "compliance")},
                {"damped contact", law("normal", "damped")},
                {"Coulomb's friction", law("friction", "coulomb")}});
  if (!wish.linear)
    all.insert({{"heat of friction", sample.numbers.contains("contact.heat.friction_share")},
                {"heat by pressure", sample.numbers.contains("contact.heat.pressure.reference")},
                {"fading exchange", sample.numbers.contains("contact.heat.ramp")},
                {"charge through the contact", law("electric", "exchange")},
                {"leak", law("electric", "leak")}});
  return all;
}

TEST(RandomCases, HaveEveryFeatureUnderEveryRelation) {
  std::map<std::string, int> count;
  for (unsigned int relation = rotation; relation <= krylov; ++relation) {
    std::map<std::string, bool> found;
    for (unsigned int seed = 1000 * relation; seed < 1000 * relation + n_cases; ++seed) {
      Random random(seed);
      const Wish wish = wish_of(seed);
      for (const auto &[name, is_there] : features(random_sample(random, wish), wish)) {
        found[name] = found[name] || is_there;
        count[name] += is_there;
      }
    }
    for (const auto &[name, is_there] : found)
      EXPECT_TRUE(is_there) << name << " under relation " << relation;
  }
  for (const auto &[name, n] : count)
    EXPECT_GE(n, 20) << name;
}

TEST(RandomCases, StickAtOnePlaceWhileTheySlipAtAnother) {
  int n = 0;
  for (unsigned int seed = 1000; seed < 1000 + n_cases; ++seed) {
    Random random(seed);
    const Result result = run(random_sample(random));
    n += std::set<std::string>(result.status.begin(), result.status.end()).size() >= 2;
  }
  EXPECT_GE(n, 5);
}

}  // namespace
}  // namespace tourmaline::verified
