#include "report/wrapped_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace tourmaline::report {
namespace {

using testing::ElementsAre;

double bytes(const std::string &text) {
  return static_cast<double>(text.size());
}

TEST(WrappedText, WhatFitsStaysOneLine) {
  EXPECT_THAT(wrapped("u = (0, 0) m", 12, bytes), ElementsAre("u = (0, 0) m"));
  EXPECT_THAT(wrapped("", 12, bytes), ElementsAre(""));
}

TEST(WrappedText, BreaksAtBlanks) {
  EXPECT_THAT(wrapped("heat exchange, k = 1", 9, bytes), ElementsAre("heat", "exchange,", "k = 1"));
}

TEST(WrappedText, AFormulaWithoutBlanksIsBrokenBehindItsOperators) {
  EXPECT_THAT(wrapped("S = 15+sin(2*x)*exp(t) N", 10, bytes),
              ElementsAre("S = 15+", "sin(2*x)*", "exp(t) N"));
}

TEST(WrappedText, NothingIsLostAndNoLineIsTooWideWhateverTheText) {
  const std::string text = "θ = if(x<0.001,1234567890123456789*sin(100*x),θθθθθθθθθθθθθθθθ) K";
  for (int room = 2; room < 70; ++room) {
    std::string joined;
    for (const std::string &line : wrapped(text, room, bytes)) {
      EXPECT_LE(line.size(), static_cast<std::size_t>(room));
      EXPECT_NE(static_cast<unsigned char>(line[0]) & 0xc0, 0x80) << "amid a letter";
      joined += line;
    }
    std::string wanted = text;
    std::erase(wanted, ' ');
    std::erase(joined, ' ');
    EXPECT_EQ(joined, wanted);
  }
}

}  // namespace
}  // namespace tourmaline::report
