#include "case/probes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "case/resolved.h"
#include "error_in.h"
#include "example.h"
#include "tourmaline/case/case.h"

namespace tourmaline::casefile {
namespace {

using testing::HasSubstr;

std::string error_of(const std::string &probes) {
  return error_in(example, {"probe=[" + probes + "]"});
}

TEST(Probes, PlacesLinesAndBoundariesCanBeAsked) {
  EXPECT_EQ(error_of("{ name = 'tip', at = [0.1, 0.05] }"), "no error");
  EXPECT_EQ(error_of("{ name = 'a.b-c_1', from = [0, 0], to = [0.1, 0.1], points = 2 }"),
            "no error");
  EXPECT_EQ(error_of("{ name = 'a', on = 'left' }, { name = 'b', on = ['top', 'bottom'], about = "
                     "[0.1, 0] }"),
            "no error");
}

TEST(Probes, StandInTheResolvedCaseAsTheyWereGiven) {
  const std::string both =
      "probe=[{ name = 'tip', at = [0.1, 0.05] },"
      "{ name = 'line', from = [0, 0], to = [0.1, 0.1], points = 7 }]";
  const Case again = read_text(resolved(read_text(example, "case.toml", {both})), "again.toml");
  ASSERT_EQ(again.probes.size(), 2u);
  EXPECT_EQ(again.probes[0].name, "tip");
  EXPECT_EQ(again.probes[0].at, (std::vector{0.1, 0.05}));
  EXPECT_FALSE(again.probes[0].from);
  EXPECT_EQ(again.probes[1].to, (std::vector{0.1, 0.1}));
  EXPECT_EQ(again.probes[1].points, 7);
}

// The example in two layers instead of one material.
std::string error_in_layers(const std::string &regions, const std::string &probe) {
  std::string text = example;
  const std::size_t begin = text.find("[material]"), end = text.find("[time]");
  text.erase(begin, end - begin);
  return error_in(text, {"region=[" + regions + "]", "probe=[{ name = 'p', " + probe + " }]"});
}

TEST(Probes, KnowRegionsByTheirNames) {
  const std::string steel = "material = { library = 'steel' } }",
                    layers = "{ name = 'lower', where = 'y < 0.05', " + steel +
                             ", { name = 'upper', where = 'y >= 0.05', " + steel;
  EXPECT_EQ(error_in_layers(layers, "region = 'lower'"), "no error");
  EXPECT_EQ(error_in_layers(layers, "region = ['lower', 'upper']"), "no error");
  EXPECT_THAT(error_in_layers(layers, "region = 'lowre'"),
              HasSubstr("region = \"lowre\": no region is called so; there are lower, upper; did "
                        "you mean \"lower\"?"));
  EXPECT_THAT(error_in_layers("{ where = '1', " + steel, "region = 'a'"),
              HasSubstr("no region is called so; give the [[region]] that is meant a `name`"));
  EXPECT_THAT(error_in_layers("{ name = 'a', where = 'y < 0.05', " + steel +
                                  ", { name = 'a', where = 'y >= 0.05', " + steel,
                              "region = 'a'"),
              HasSubstr("2 regions are called so; give each a `name` of its own"));
  EXPECT_THAT(error_of("{ name = 'p', region = [] }"),
              HasSubstr("names nothing; give at least one name"));
  EXPECT_THAT(error_of("{ name = 'p', region = 'a' }"), HasSubstr("the case has no [[region]]"));
}

struct Mistake {
  std::string probe, key, piece;  ///< of the error text
};

void PrintTo(const Mistake &mistake, std::ostream *out) {
  *out << mistake.probe;
}

class MistakeInAProbe : public testing::TestWithParam<Mistake> {};

TEST_P(MistakeInAProbe, IsAnsweredWithTheReason) {
  const std::string error = error_of("{ name = 'tip', at = [0, 0] }, { " + GetParam().probe + " }");
  EXPECT_THAT(error, HasSubstr("[probe[1]]" + GetParam().key));
  EXPECT_THAT(error, HasSubstr(GetParam().piece));
}

INSTANTIATE_TEST_SUITE_P(
    Probes, MistakeInAProbe,
    testing::Values(
        Mistake{"name = 'tip', at = [0, 0]", " name", "this name has already been given at"},
        Mistake{"name = 'a/b', at = [0, 0]", " name",
                "must consist of letters, digits, _, - and ."},
        Mistake{"name = '', at = [0, 0]", " name", "must consist of letters"},
        Mistake{"name = '" + std::string(101, 'a') + "', at = [0, 0]", " name",
                "may have 100 letters; it has 101"},
        Mistake{"name = 'a'", "", "does not say where it looks"},
        Mistake{"name = 'a', at = [0, 0], points = 3", "", "give either"},
        Mistake{"name = 'a', at = [0, 0, 0]", " at", "has 3 entries, but needs 2"},
        Mistake{"name = 'a', at = [0, 'x']", " at", "number"},
        Mistake{"name = 'a', from = [0, 0], to = [1, 0]", "", "has no `points`"},
        Mistake{"name = 'a', to = [1, 0], points = 3", "", "has no `from`"},
        Mistake{"name = 'a', from = [1, 0], to = [1, 0], points = 3", "",
                "ends where it begins; give `at`"},
        Mistake{"name = 'a', from = [0, 0], to = [1, 0], points = 1", " points", "must be >= 2"},
        Mistake{"name = 'a', on = 'rihgt'", " on", "did you mean \"right\"?"},
        Mistake{"name = 'a', on = 'left', at = [0, 0]", "", "give either"},
        Mistake{"name = 'a', at = [0, 0], about = [0, 0]", " about", "is only used with on"},
        Mistake{"name = 'a', on = 'left', about = [0]", " about", "has 1 entr"},
        Mistake{"at = [0, 0]", " name", "missing"},
        Mistake{"name = 'a', att = [0, 0]", " att", "did you mean \"at\"?"}));

}  // namespace
}  // namespace tourmaline::casefile
