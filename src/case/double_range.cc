#include "case/double_range.h"

#include <fmt/format.h>

#include <algorithm>
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

bool continues_word(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '.';
}

// Behind the string that begins there.
std::size_t end_of_string(const std::string &text, std::size_t begin) {
  const char quote = text[begin];
  const std::string three(3, quote);
  const std::string mark = text.compare(begin, 3, three) == 0 ? three : std::string(1, quote);
  std::size_t at = begin + mark.size();
  while (at < text.size() && text.compare(at, mark.size(), mark) != 0)
    at += quote == '"' && text[at] == '\\' ? 2 : 1;
  return std::min(at + mark.size(), text.size());
}

// What there is of a number at a place where one may begin, if a double takes it for 0.
std::string vanishing_at(const std::string &text, std::size_t begin) {
  const Number number = number_in(text.substr(begin, 400));
  const std::size_t exponent = number.text.find_first_of("eE");
  const std::string digits = number.text.substr(0, exponent);
  return number.value == 0 && digits.find_first_of("123456789") != std::string::npos
             ? fmt::format("the number {} is closer to 0 than double precision holds; write 0",
                           shortened(number.text))
             : "";
}

}  // namespace

std::string too_small(const std::string &formula) {
  for (std::size_t i = 0; i < formula.size(); ++i)
    if (std::isdigit(static_cast<unsigned char>(formula[i])) &&
        (i == 0 || !continues_word(formula[i - 1])))
      if (std::string reason = vanishing_at(formula, i); !reason.empty())
        return reason;
  return "";
}

std::optional<TooSmall> too_small_in_toml(const std::string &text) {
  TooSmall found;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '#')
      i = std::min(text.find('\n', i), text.size());
    std::size_t end = i + 1;
    if (i < text.size() && (text[i] == '"' || text[i] == '\''))
      end = end_of_string(text, i);
    else if (i < text.size() && std::isdigit(static_cast<unsigned char>(text[i])) &&
             (i == 0 || !continues_word(text[i - 1])))
      found.reason = vanishing_at(text, i);
    if (!found.reason.empty())
      return found;
    found.line += static_cast<std::size_t>(
        std::count(text.begin() + static_cast<std::ptrdiff_t>(std::min(i, text.size())),
                   text.begin() + static_cast<std::ptrdiff_t>(std::min(end, text.size())), '\n'));
    i = end - 1;
  }
  return std::nullopt;
}

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
