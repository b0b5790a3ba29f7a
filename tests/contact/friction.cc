#include "tourmaline/contact/friction.h"

#include <gtest/gtest.h>

#include <string>

#include "tourmaline/case/contact_case.h"
#include "tourmaline/error.h"

namespace tourmaline::contact {
namespace {

Friction law_at(const char *law, const std::string &bound, const Vector3 &point, double time) {
  casefile::FrictionCase asked;
  asked.law = law;
  asked.bound = casefile::Formula(bound, "the bound");
  return friction_of(asked)({point, time, {}});
}

double bound_at(const std::string &bound, const Vector3 &point, double time) {
  return std::get<Tresca>(law_at("tresca", bound, point, time)).bound;
}

TEST(Friction, ItsBoundIsThatOfThePlaceAndTheTime) {
  EXPECT_EQ(bound_at("x + 10*y + 100*z + 1000*t", {1, 2, 3}, 4), 4321);
}

TEST(Friction, ABoundOfZeroIsAllowedAndANegativeOneIsNot) {
  EXPECT_EQ(bound_at("1 - t", {0, 0, 0}, 1), 0);
  EXPECT_THROW(bound_at("1 - t", {0, 0, 0}, 1.5), CaseError);
}

TEST(Friction, WithoutALawIsTheBoundZero) {
  EXPECT_EQ(std::get<Tresca>(law_at("none", "15", {0, 0, 0}, 0)).bound, 0);
}

}  // namespace
}  // namespace tourmaline::contact
