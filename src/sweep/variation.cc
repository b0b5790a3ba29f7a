#include "sweep/variation.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>

#include "case/nearest.h"
#include "case/toml_text.h"
#include "tourmaline/error.h"

namespace tourmaline::sweep {

namespace {

constexpr int most_values = 1000;

[[noreturn]] void fail(const std::string &assignment, const std::string &reason) {
  throw CaseError("--vary " + casefile::shortened(assignment) + ": " + reason);
}

std::string trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos)
    return "";
  return std::string(text.substr(first, text.find_last_not_of(" \t") - first + 1));
}

std::vector<std::string> split(const std::string &text, char separator) {
  std::vector<std::string> parts(1);
  for (const char c : text)
    if (c == separator)
      parts.emplace_back();
    else
      parts.back() += c;
  return parts;
}

// At commas outside of brackets and quotes, which belong to one value.
std::vector<std::string> listed(const std::string &text) {
  std::vector<std::string> values(1);
  int depth = 0;
  char quote = 0;
  for (const char c : text) {
    if (quote != 0)
      quote = c == quote ? '\0' : quote;
    else if (c == '"' || c == '\'')
      quote = c;
    else if (c == '[' || c == '{')
      ++depth;
    else if (c == ']' || c == '}')
      --depth;
    if (c == ',' && depth == 0 && quote == 0)
      values.emplace_back();
    else
      values.back() += c;
  }
  for (std::string &value : values)
    value = trimmed(value);
  return values;
}

// Fifteen digits, so that 0.3 is not 0.30000000000000004.
std::string text_of(double number) {
  return fmt::format("{:.15g}", number == 0 ? 0 : number);
}

// The ends are what was written, to the last bit.
std::string exact_text(double number) {
  const std::string rounded = text_of(number);
  return number_in(rounded) == number ? rounded : fmt::format("{:.17g}", number);
}

struct Spacing {
  bool logarithmic;
  double first, last;
  int n;

  std::string text(int i) const {
    if (i == 0 || i == n - 1)
      return exact_text(i == 0 ? first : last);
    // Neither difference nor ratio of the ends need be a number; the logarithms have the digits
    // that their sizes cost.
    const long double part = static_cast<long double>(i) / (n - 1);
    return text_of(static_cast<double>(
        logarithmic ? std::exp((1 - part) * std::log(static_cast<long double>(first)) +
                               part * std::log(static_cast<long double>(last)))
                    : (1 - part) * static_cast<long double>(first) + part * last));
  }
};

Spacing read_spacing(const std::string &assignment, const std::vector<std::string> &parts) {
  const std::string form = parts[0] + ":A:B:N, N values from A to B";
  if (parts.size() != 4)
    fail(assignment, "write " + form);
  const std::optional<double> first = number_in(parts[1]), last = number_in(parts[2]),
                              n = number_in(parts[3]);
  if (!first || !last || !n)
    fail(assignment, "A, B and N must be numbers, without units, in " + form);
  if (!(*n >= 2 && *n <= most_values) || *n != std::floor(*n))
    fail(assignment, fmt::format("N must be an integer from 2 to {} in {}", most_values, form));
  const Spacing spacing{parts[0] == "log", *first, *last, static_cast<int>(*n)};
  if (*first == *last)
    fail(assignment, "A and B must differ in " + form);
  if (spacing.logarithmic && !(*first > 0 && *last > 0))
    fail(assignment, "A and B must be greater than 0 in " + form);
  return spacing;
}

// "lin" of "lin:0:1:5"; empty where there is no such word, as in "5,15" and "x > 0 ? 1 : 2".
std::string spacing_word(const std::string &text) {
  const std::string word = trimmed(text.substr(0, text.find(':')));
  const bool letters = !word.empty() && std::all_of(word.begin(), word.end(), [](unsigned char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
  });
  return letters && text.find(':') != std::string::npos ? word : "";
}

// 15 and 1.5e1 are one number: two runs of one case.
bool is_same(const std::string &one, const std::string &other) {
  const std::optional<double> number = number_in(one);
  return one == other || (number && number == number_in(other));
}

void check_values(const std::string &assignment, const std::vector<std::string> &values) {
  if (std::find(values.begin(), values.end(), "") != values.end())
    fail(assignment, "a value is missing; write key.path=value,value,...");
  if (values.size() > most_values)
    fail(assignment,
         fmt::format("has {} values; at most {} are possible", values.size(), most_values));
  for (std::size_t i = 0; i < values.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (is_same(values[i], values[j]))
        fail(assignment, "gives " + casefile::shortened(values[j]) + " twice" +
                             (values[i] == values[j]
                                  ? std::string()
                                  : ", the second time as " + casefile::shortened(values[i])));
}

}  // namespace

std::optional<double> number_in(const std::string &text) {
  const std::string bare = trimmed(text);
  double number = 0;
  const auto [end, error] = std::from_chars(bare.data(), bare.data() + bare.size(), number);
  const bool whole = error == std::errc() && end == bare.data() + bare.size();
  return whole && std::isfinite(number) ? std::optional(number) : std::nullopt;
}

Variation read_variation(const std::string &assignment) {
  const std::size_t equals = assignment.find('=');
  if (equals == std::string::npos)
    fail(assignment, "has no \"=\"; write key.path=value,value,...");
  const std::string text = trimmed(std::string_view(assignment).substr(equals + 1));
  Variation read{.key = trimmed(std::string_view(assignment).substr(0, equals)), .values = {}};
  if (read.key.empty())
    fail(assignment, "names no key; write key.path=value,value,...");
  const std::string word = spacing_word(text);
  if (word == "lin" || word == "log") {
    const Spacing spacing = read_spacing(assignment, split(text, ':'));
    for (int i = 0; i < spacing.n; ++i)
      read.values.push_back(spacing.text(i));
    read.logarithmic = spacing.logarithmic;
  } else if (!word.empty()) {
    fail(assignment, "no spacing is called \"" + casefile::shortened(word) +
                         "\"; allowed: lin:A:B:N, log:A:B:N" +
                         casefile::did_you_mean(word, {"lin", "log"}));
  } else {
    read.values = listed(text);
  }
  check_values(assignment, read.values);
  return read;
}

std::vector<Variation> read_variations(const std::vector<std::string> &assignments) {
  std::vector<Variation> all;
  for (const std::string &assignment : assignments) {
    all.push_back(read_variation(assignment));
    for (std::size_t i = 0; i + 1 < all.size(); ++i)
      if (all[i].key == all.back().key)
        fail(assignment, "this key is varied twice; give all its values at once");
  }
  return all;
}

void require_not_set(const std::vector<Variation> &variations,
                     const std::vector<std::string> &overrides) {
  for (const std::string &override : overrides)
    for (const Variation &variation : variations)
      if (trimmed(override.substr(0, override.find('='))) == variation.key)
        throw CaseError("--set " + casefile::shortened(override) +
                        ": this key is varied, by --vary; give one of both");
}

}  // namespace tourmaline::sweep
