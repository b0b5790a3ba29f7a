#pragma once

#include <gtest/gtest.h>

#include <ostream>
#include <string>
#include <vector>

#include "example.h"

namespace tourmaline::casefile {

/// The example with one piece of its text replaced.
inline std::string changed(const std::string &from, const std::string &to) {
  std::string text = example;
  const auto place = text.find(from);
  EXPECT_NE(place, std::string::npos) << from;
  return text.replace(place, from.size(), to);
}

/// In the text of the example.
struct Mistake {
  std::string from, to;
  std::vector<std::string> pieces;  ///< of the error text
};

inline void PrintTo(const Mistake &mistake, std::ostream *out) {
  *out << mistake.to;
}

/// What is claimed of every mistake stands in reader_errors.cc.
class MistakeInAFile : public testing::TestWithParam<Mistake> {};

}  // namespace tourmaline::casefile
