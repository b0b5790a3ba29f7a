// Mistakes in the laws of a contact.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "error_in.h"
#include "mistake.h"

namespace tourmaline::casefile {
namespace {

using testing::HasSubstr;

const std::string tresca = "law = \"tresca\", bound = 15", bilateral = "\"bilateral\"";

std::string coulomb(const std::string &coefficient) {
  return "law = \"coulomb\", coefficient = " + coefficient;
}

const Mistake contact_laws[] = {
    {bilateral,
     "3",
     {"case.toml:30:10 [contact] normal = 3", "must be a text, one of \"bilateral\"",
      "or a table, [contact.normal]"}},
    {bilateral,
     "\"compliance\"",
     {"case.toml:30:10 [contact.normal] coefficient: missing", "[N/m^(2+m)]",
      "write normal = { law = \"compliance\", coefficient = ... }"}},
    {bilateral, "\"damped\"", {"[contact.normal] coefficient: missing", "[N s/m^3]"}},
    {bilateral, "{ law = \"damped\" }", {"[contact.normal] coefficient: missing"}},
    {bilateral,
     "{ law = \"damped\", coefficient = 1e9, exponent = 2 }",
     {"exponent = 2", "only used with law = \"compliance\""}},
    {bilateral,
     "{ law = \"compliance\", coefficient = 0 }",
     {"[contact.normal] coefficient = 0", "must be > 0 N/m^(2+m)"}},
    {bilateral, "{ law = \"compliance\", coefficient = \"1e13*t\" }", {"must not depend on"}},
    {bilateral, "{ law = \"compliance\", coefficient = nan }", {"is not a finite number"}},
    {bilateral,
     "{ law = \"compliance\", coefficient = 1e13, exponent = 0.5 }",
     {"[contact.normal] exponent = 0.5", "must be >= 1"}},
    {bilateral,
     "{ coefficient = 1e13 }",
     {"coefficient = ", "only used with law = \"compliance\" or \"damped\""}},
    {bilateral,
     "{ law = \"unilateral\", coefficient = 1e13 }",
     {"coefficient = ", "only used with law = \"compliance\" or \"damped\""}},
    {bilateral, "{ law = \"damped\", coeficient = 1 }", {"did you mean \"coefficient\"?"}},
    {"normal = \"bilateral\"", "gap = nan", {"[contact] gap = nan", "is not a finite number"}},
    {"normal = \"bilateral\"", "gap = \"1/0\"", {"gap = \"1/0\"", "is not a finite number"}},
    {"normal = \"bilateral\"", "gap = \"t\"", {"gap = \"t\"", "must not depend on the time t"}},
    {"normal = \"bilateral\"",
     "foundation_displacement = [0, 0, 0]",
     {"[contact] foundation_displacement = [0, 0, 0]", "has 3 entries, but needs 2"}},
    {"normal = \"bilateral\"",
     "foundation_displacement = 1e-6",
     {"must be a list of numbers or formulas"}},
    {"normal = \"bilateral\"",
     "foundation_displacement = [\"z\", 0]",
     {"foundation_displacement[0] = \"z\"", "has no z"}},
    {tresca,
     "law = \"coulomb\"",
     {"case.toml:31:12 [contact.friction] coefficient: missing", "coefficient mu"}},
    {"bound = 15", "bound = 15, mu = 1", {"did you mean \"coefficient\"?"}},
    {"bound = 15",
     "bound = 15, coefficient = 0.3",
     {"[contact.friction] coefficient = 0.3", "only used with law = \"coulomb\""}},
    {"bound = 15", "bound = 15, limit = 30", {"limit = 30", "only used with law = \"coulomb\""}},
    {tresca,
     coulomb("-0.3"),
     {"case.toml:31:45 [contact.friction] coefficient = -0.3", "must be >= 0"}},
    {tresca, coulomb("nan"), {"coefficient = nan", "is not a finite number"}},
    {tresca, coulomb("\"1/0\""), {"coefficient = \"1/0\"", "is not a finite number"}},
    {tresca, coulomb("[0.3]"), {"is a list", "or a table, [contact.friction.coefficient]"}},
    {tresca,
     coulomb("{}"),
     {"[contact.friction.coefficient]: has no coefficient", "write coefficient = 0.3"}},
    {tresca,
     coulomb("{ kinetic = 0.2, speed = 1e-3 }"),
     {"[contact.friction.coefficient]: has `kinetic` but not `static`"}},
    {tresca, coulomb("{ static = 0.2, speed = 1e-3 }"), {"has `static` but not `kinetic`"}},
    {tresca, coulomb("{ static = 0.4, kinetic = 0.2 }"), {"neither `speed` nor `distance`"}},
    {tresca,
     coulomb("{ static = 0.4, kinetic = 0.2, speed = 1, distance = 1 }"),
     {"both `speed` and `distance`"}},
    {tresca, coulomb("{ value = 0.4, kinetic = 0.2 }"), {"`value` is the whole coefficient"}},
    {tresca, coulomb("{ static = 0.4, kinetic = 0.2, speed = 0 }"), {"must be > 0 m/s"}},
    {tresca, coulomb("{ static = 0.4, kinetic = 0.2, distance = -1 }"), {"must be > 0 m"}},
    {tresca, coulomb("{ static = 0.4, kinetic = -0.2, speed = 1 }"), {"kinetic = -0.2", ">= 0"}},
    {tresca, coulomb("{ static = 0.4, kinetc = 0.2, speed = 1 }"), {"did you mean \"kinetic\"?"}},
    {tresca,
     coulomb("0.3, cohesion = 20, limit = 15"),
     {"[contact.friction] limit = 15", "at least the cohesion, which is 20 N/m^2"}},
    {"[contact]",
     "[[contact]]\non = \"top\"\n[[contact]]",
     {"[contact[0]] on = \"top\": the traction on a contact boundary is the law's"}},
};
INSTANTIATE_TEST_SUITE_P(ContactLaws, MistakeInAFile, testing::ValuesIn(contact_laws));

struct Unavailable {
  std::vector<std::string> overrides;
  std::string law;
};

void PrintTo(const Unavailable &unavailable, std::ostream *out) {
  *out << unavailable.law;
}

class LawOfTheState : public testing::TestWithParam<Unavailable> {};

TEST_P(LawOfTheState, IsRefusedWithMultipliersOfFacets) {
  const auto error_with = [](const std::string &solver) {
    std::vector<std::string> overrides = GetParam().overrides;
    overrides.push_back(solver);
    return error_in(example, overrides);
  };
  const std::string law = "contact with " + GetParam().law + " is not available with ";
  EXPECT_THAT(error_with("solver={method='monolithic', multiplier='piecewise-constant'}"),
              HasSubstr(law + "solver.multiplier = \"piecewise-constant\" in this version; take "
                              "\"nodal\""));
  EXPECT_EQ(error_with("solver.method=monolithic"), "no error");
  for (const char *body : {"direct", "iterative", "automatic"})
    EXPECT_EQ(error_with(std::string("solver.body=") + body), "no error") << body;
}

INSTANTIATE_TEST_SUITE_P(
    All, LawOfTheState,
    testing::Values(Unavailable{{"contact.normal=unilateral"}, "normal = \"unilateral\""},
                    Unavailable{{"contact.normal={law='compliance', coefficient=1e13}"},
                                "normal = \"compliance\""},
                    Unavailable{{"contact.normal={law='damped', coefficient=1e9}"},
                                "normal = \"damped\""},
                    Unavailable{{"contact.friction={law='coulomb', coefficient=0.3}"},
                                "friction.law = \"coulomb\""}));

TEST(Errors, AGapAndAMovingFoundationAreAvailableInAllSolvers) {
  for (const char *solver : {"solver={method='monolithic'}", "solver={body='iterative'}",
                             "solver={method='monolithic', multiplier='piecewise-constant'}"})
    EXPECT_EQ(error_in(example, {"contact.gap=1e-6", "contact.foundation_displacement=[0,'1e-6*t']",
                                 solver}),
              "no error");
}

}  // namespace
}  // namespace tourmaline::casefile
