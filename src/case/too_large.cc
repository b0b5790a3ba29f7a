#include "case/too_large.h"

#include <fmt/format.h>

#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>

#include "case/toml_text.h"

namespace tourmaline::casefile {

namespace {

struct Number {
  std::string text;  ///< as far as it is a number
  double value = 0;
};

// TOML allows 1_000_000 and +5; the texts "inf" and "nan" are no numbers that are too large.
Number number_in(const std::string &text) {
  std::string plain;
  for (const char c : text)
    if (c != '_' && (c != '+' || !plain.empty()))
      plain += c;
  const std::size_t first = plain.starts_with("-") ? 1 : 0;
  if (plain.size() == first || !std::isdigit(static_cast<unsigned char>(plain[first])))
    return {};
  char *end = nullptr;
  const double value = std::strtod(plain.c_str(), &end);
  return {std::string(plain.c_str(), static_cast<const char *>(end)), value};
}

}  // namespace

std::string too_large(const std::string &text) {
  const Number number = number_in(text);
  if (!std::isinf(number.value))
    return "";
  return fmt::format("the number {} is too large: double precision ends at {:.2g}",
                     shortened(number.text), std::numeric_limits<double>::max());
}

std::string too_large_in_toml(const std::string &text) {
  const Number number = number_in(text);
  const bool is_integer = number.text.find_first_not_of("-0123456789") == std::string::npos;
  if (!is_integer || std::abs(number.value) < 0x1p63)
    return too_large(text);
  return fmt::format(
      "the integer {} is too large: at most {}; larger numbers need a point or an exponent",
      shortened(number.text), std::numeric_limits<std::int64_t>::max());
}

}  // namespace tourmaline::casefile
