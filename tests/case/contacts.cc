// Several contacts in a case file.
#include "case/contacts.h"

#include <gmock/gmock.h>

#include "case/resolved.h"
#include "example.h"
#include "tourmaline/case/reader.h"
#include "tourmaline/error.h"

namespace tourmaline::casefile {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

// A square that is held on its top.
const std::string held = R"(
mesh.box = { min = [0, 0], max = [1, 1], cells = [2, 2] }
material.library = "BaTiO3-Liu2014"
time = { end = 1, steps = 2 }
boundary = [ { on = "top", displacement = [0, 0], potential = 0 } ]
)";

Case read(const std::string &contacts, const std::vector<std::string> &overrides = {}) {
  return read_text(held + contacts, "case.toml", overrides);
}

std::string error_in(const std::string &contacts, const std::vector<std::string> &overrides = {}) {
  try {
    read(contacts, overrides);
  } catch (const CaseError &error) {
    return error.what();
  }
  return "no error";
}

const std::string two = R"([[contact]]
on = "left"
friction = { law = "tresca", bound = 15 }
[[contact]]
name = "jaw_2"
on = ["right", "bottom"]
normal = "unilateral"
)";

TEST(SeveralContacts, HaveBoundariesAndLawsOfTheirOwn) {
  const Case asked = read(two);
  ASSERT_EQ(asked.contacts.size(), 2u);
  EXPECT_EQ(asked.contacts[0].friction.bound.text(), "15");
  EXPECT_EQ(asked.contacts[0].normal.law, "bilateral");
  EXPECT_EQ(asked.contacts[1].normal.law, "unilateral");
  EXPECT_EQ(asked.contacts[1].on, (std::vector<std::string>{"right", "bottom"}));
}

TEST(SeveralContacts, AreCalledByTheirNamesOrBoundaries) {
  const Case asked = read(two);
  EXPECT_EQ(asked.contacts[0].called(), "left");
  EXPECT_EQ(asked.contacts[1].called(), "jaw_2");
  EXPECT_EQ(read("contact = { on = [\"left\", \"bottom\"] }").contacts[0].called(), "left+bottom");
}

TEST(SeveralContacts, AreReadBackFromTheResolvedCase) {
  const std::string text = resolved(read(two));
  EXPECT_THAT(text, HasSubstr("[[contact]]\nname = \"jaw_2\"\non = [\"right\", \"bottom\"]"));
  EXPECT_EQ(resolved(read_text(text, "resolved.toml")), text);
}

TEST(SeveralContacts, OneOfThemIsResolvedAsTheTableThatItMayBe) {
  const std::string text = resolved(read("[contact]\non = \"left\"\n"));
  EXPECT_THAT(text, AllOf(HasSubstr("\n[contact]\non"), HasSubstr("\nfriction = \"none\"\n")));
  EXPECT_EQ(resolved(read("[[contact]]\non = \"left\"\n")), text);
}

TEST(SeveralContacts, AreChangedByTheirNumbers) {
  const Case asked = read(two, {"contact[0].friction.bound=30", "contact[1].normal=bilateral"});
  EXPECT_EQ(asked.contacts[0].friction.bound.text(), "30");
  EXPECT_EQ(asked.contacts[1].normal.law, "bilateral");
  EXPECT_EQ(read(two, {"contact[2].on=top", "boundary[0].on=bottom", "contact[1].on=right"})
                .contacts.size(),
            3u);
  EXPECT_THAT(error_in(two, {"contact.friction.bound=30"}),
              HasSubstr("contact is a list; its entries are contact[0], contact[1]"));
}

struct Mistake {
  std::string from, to;
  std::vector<std::string> pieces;
};
void PrintTo(const Mistake &mistake, std::ostream *out) {
  *out << mistake.to;
}

class MistakeInContacts : public ::testing::TestWithParam<Mistake> {};

TEST_P(MistakeInContacts, IsToldWithItsPlace) {
  std::string text = two;
  const std::size_t at = text.find(GetParam().from);
  ASSERT_NE(at, std::string::npos);
  text.replace(at, GetParam().from.size(), GetParam().to);
  for (const std::string &piece : GetParam().pieces)
    EXPECT_THAT(error_in(text), HasSubstr(piece));
}

INSTANTIATE_TEST_SUITE_P(
    All, MistakeInContacts,
    ::testing::Values(
        Mistake{"[\"right\", \"bottom\"]",
                "[\"right\", \"left\"]",
                {"[contact[1]] on = \"left\": this boundary is in contact already, by case.toml:7:",
                 "[contact[0]] on = \"left\"; a boundary can have one contact"}},
        Mistake{"jaw_2",
                "jaw 2",
                {"[contact[1]] name = \"jaw 2\"", "must consist of letters, digits, _ and -"}},
        Mistake{"jaw_2", "", {"[contact[1]] name = \"\"", "must consist of letters"}},
        Mistake{"jaw_2",
                "left",
                {"[contact[1]] name = \"left\": a contact is called so already, by case.toml:7:",
                 "[contact[0]] on"}},
        Mistake{"on = \"left\"",
                "on = \"left\"\nname = \"jaw_2\"",
                {"[contact[1]] name = \"jaw_2\": a contact is called so already, by case.toml:8:"}},
        Mistake{"on = \"left\"", "on = \"lfet\"", {"[contact[0]] on = \"lfet\"", "did you mean"}},
        Mistake{"bound = 15", "bound = -15", {"[contact[0].friction] bound = -15", "must be >= 0"}},
        Mistake{"normal =", "normla =", {"[contact[1]] normla", "did you mean \"normal\"?"}},
        Mistake{"on = \"left\"", "on = \"top\"", {"[contact[0]] on = \"top\"", "clamped"}},
        Mistake{two, "contact = []", {"contact = []", "is an empty list"}},
        Mistake{two, "contact = 3", {"must be a table, [contact], or several"}},
        Mistake{two, "contact = [3]", {"must be a table, [contact], or several"}}));

TEST(SeveralContacts, AreRefusedWhereMultipliersStandOnFacets) {
  EXPECT_THAT(error_in(two, {"solver={method='monolithic', multiplier='piecewise-constant'}"}),
              HasSubstr("several contacts are not available with solver.multiplier = "
                        "\"piecewise-constant\""));
}

TEST(SeveralContacts, TogetherHoldABody) {
  const std::string walls = R"(
[[contact]]
on = "left"
friction = { law = "tresca", bound = 15 }
[[contact]]
on = "bottom"
)",
                    free = "boundary=[{on='top', potential=0}]";
  EXPECT_EQ(error_in(walls, {free}), "no error");
  EXPECT_THAT(error_in(walls, {free, "contact[0].friction.law=none", "solver.body=direct"}),
              HasSubstr("only used with"));
  EXPECT_THAT(error_in("[[contact]]\non = \"left\"\n[[contact]]\non = \"right\"\n", {free}),
              AllOf(HasSubstr("nothing holds the body against a translation along y"),
                    HasSubstr("contact without friction holds only the normal")));
}

}  // namespace
}  // namespace tourmaline::casefile
