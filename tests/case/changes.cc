#include "case/changes.h"

#include <gtest/gtest.h>

namespace tourmaline::casefile {
namespace {

const std::string then = R"(title = "a = b"

[time]
end = 1
steps = 2

[[region]]
on = ["one"]

[region.material]
c11 = 1

[[region]]
on = ["two"]

[region.material]
c11 = 1
)";

std::string with(const std::string &from, const std::string &to) {
  std::string text = then;
  return text.replace(text.rfind(from), from.size(), to);
}

void expect_one(const std::vector<Change> &changes, const Change &expected) {
  ASSERT_EQ(changes.size(), 1u);
  EXPECT_EQ(changes[0].key, expected.key);
  EXPECT_EQ(changes[0].then, expected.then);
  EXPECT_EQ(changes[0].now, expected.now);
}

TEST(Changes, TheSameCaseHasNone) {
  EXPECT_TRUE(changes(then, then).empty());
}

TEST(Changes, AValueIsNamedByThePathOfItsKey) {
  expect_one(changes(then, with("steps = 2", "steps = 3")), {"time.steps", "2", "3"});
  expect_one(changes(then, with("a = b", "a = c")), {"title", "\"a = b\"", "\"a = c\""});
}

TEST(Changes, ATableInsideAnEntryBelongsToTheLastOne) {
  expect_one(changes(then, with("c11 = 1", "c11 = 2")), {"region[1].material.c11", "1", "2"});
  expect_one(changes(then, with("[\"two\"]", "[\"one\"]")),
             {"region[1].on", "[\"two\"]", "[\"one\"]"});
}

TEST(Changes, AKeyThatIsNewOrGoneHasAnEmptySide) {
  expect_one(changes(then, with("steps = 2\n", "")), {"time.steps", "2", ""});
  expect_one(changes(then, with("steps = 2\n", "steps = 2\nstart = 0\n")), {"time.start", "", "0"});
}

}  // namespace
}  // namespace tourmaline::casefile
