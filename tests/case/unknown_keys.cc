#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <initializer_list>
#include <utility>

#include "error_in.h"
#include "mistake.h"

namespace tourmaline::casefile {
namespace {

using testing::HasSubstr;
using testing::Not;

// The example with several mistakes in its keys, in the order of the file.
std::string misspelt() {
  std::string text = example;
  for (const auto &[right, wrong] : std::initializer_list<std::pair<const char *, const char *>>{
           {"cells = ", "ceells = "},
           {"steps = 20", "stps = 20"},
           {"potential = 0", "potental = 0"},
           {"bound = 15", "bonud = 15"},
           {"[output]", "[ouptut]"}})
    text.replace(text.find(right), std::string(right).size(), wrong);
  return text;
}

TEST(UnknownKeys, AreAllNamedAtOnceWithPlaceAndNearestName) {
  const std::string error = error_in(misspelt());
  std::size_t last = 0;
  for (const char *piece :
       {"case.toml:4:41 [mesh.box] ceells = [64, 64]: unknown key", "did you mean \"cells\"?",
        "case.toml:12:1 [time] stps = 20: unknown key", "did you mean \"steps\"?",
        "case.toml:17:1 [boundary[0]] potental = 0", "did you mean \"potential\"?",
        "case.toml:31:30 [contact.friction] bonud = 15", "did you mean \"bound\"?",
        "case.toml:37:2 ouptut", "did you mean \"output\"?"}) {
    const std::size_t place = error.find(piece, last);
    ASSERT_NE(place, std::string::npos) << piece << " in\n" << error;
    last = place;
  }
  EXPECT_THAT(error, Not(HasSubstr("\n")));
}

TEST(UnknownKeys, ATableBehindAnotherOneIsSentToTheTop) {
  EXPECT_THAT(error_in(example +
                       std::string("\n[[boundary]]\non = \"top\"\ninitial = { potential = 1 }\n")),
              HasSubstr("initial is a table of its own: write initial = ... before the first "
                        "[table], or [initial]"));
}

TEST(UnknownKeys, OfTheCommandLineStandBehindThoseOfTheFile) {
  const std::string error = error_in(changed("steps = 20", "steps = 20\nstpes = 3"),
                                     {"solver.methud=condensed", "tittle=x"});
  EXPECT_THAT(error, testing::StartsWith("case.toml:13:1 [time] stpes = 3: unknown key"));
  EXPECT_THAT(error, HasSubstr("; and --set solver.methud=condensed [solver] methud"));
  EXPECT_THAT(error, HasSubstr("; and --set tittle=x tittle"));
}

TEST(UnknownKeys, AreNamedBesideValuesThatAreWrong) {
  const std::string error =
      error_in(changed("steps = 20", "stpes = 20"),
               {"boundary[0].displacement=3", "contact.friction.law=tresco", "contact.haet=1"});
  EXPECT_THAT(error, HasSubstr("did you mean \"steps\"?"));
  EXPECT_THAT(error, HasSubstr("did you mean \"heat\"?"));
  // Nobody knows what keys that law has.
  EXPECT_THAT(error, Not(HasSubstr("bound =")));
}

TEST(UnknownKeys, OfAFileThatIsNoCaseAreCounted) {
  std::string text = example;
  for (int i = 0; i < 300; ++i)
    text += "nonsense" + std::to_string(i) + " = 1\n";
  EXPECT_THAT(error_in(text), testing::EndsWith("; and 280 more unknown keys"));
  EXPECT_LT(error_in(text).size(), 5000u);
}

}  // namespace
}  // namespace tourmaline::casefile
