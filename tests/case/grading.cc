#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "case/resolved.h"
#include "error_in.h"
#include "example.h"
#include "tourmaline/case/reader.h"

namespace tourmaline::casefile {
namespace {

using testing::HasSubstr;

std::string error_of(const std::string &text, const std::string &grading) {
  return error_in(text, {"mesh.box.grading=" + grading});
}

TEST(Grading, IsReadBySides) {
  const Case asked =
      read_text(example, "case.toml", {"mesh.box.grading={left=4,bottom=2.5,top=1}"});
  EXPECT_EQ(asked.mesh.box->grading,
            (std::map<std::string, double>{{"left", 4}, {"bottom", 2.5}, {"top", 1}}));
}

TEST(Grading, OfOneSideCanBeSetAlone) {
  const Case asked = read_text(example, "case.toml", {"mesh.box.grading.left=4"});
  EXPECT_EQ(asked.mesh.box->grading, (std::map<std::string, double>{{"left", 4}}));
}

TEST(Grading, OfAnUnknownSideNamesTheNearest) {
  EXPECT_THAT(error_of(example, "{lft=4}"), HasSubstr("did you mean \"left\"?"));
  EXPECT_THAT(error_of(example, "{front=4}"), HasSubstr("allowed: left, right, bottom, top"));
  EXPECT_EQ(error_of(cube, "{front=4}"), "no error");
}

TEST(Grading, BelowOneIsRefused) {
  EXPECT_THAT(error_of(example, "{left=0.5}"),
              HasSubstr("[mesh.box.grading] left = 0.5: must be >= 1"));
  EXPECT_THAT(error_of(example, "{left=inf}"), HasSubstr("not a finite number"));
}

TEST(Grading, IsATableOfNumbers) {
  EXPECT_THAT(error_of(example, "4"), HasSubstr("must be a table"));
  EXPECT_THAT(error_of(example, "{left='x'}"), HasSubstr("must be a number"));
}

TEST(Grading, ThatMakesCellsTooSmallIsRefused) {
  EXPECT_THAT(error_of(example, "{top=1e7}"), HasSubstr("top = 10000000 makes cells too small"));
  EXPECT_EQ(error_of(example, "{top=1e6}"), "no error");
}

TEST(Grading, StandsInTheResolvedCaseAndComesBack) {
  const Case first = read_text(example, "case.toml", {"mesh.box.grading={left=4.1,right=3,top=2}"});
  const std::string text = resolved(first);
  EXPECT_THAT(text, HasSubstr("[mesh.box.grading]\nleft = 4.1\nright = 3\ntop = 2\n"));
  const Case again = read_text(text, "resolved.toml");
  EXPECT_EQ(again.mesh.box->grading, first.mesh.box->grading);
  EXPECT_EQ(resolved(again), text);
}

TEST(Grading, IsNotInventedWhereTheCaseHasNone) {
  EXPECT_THAT(resolved(read_text(example, "case.toml")), testing::Not(HasSubstr("grading")));
}

}  // namespace
}  // namespace tourmaline::casefile
