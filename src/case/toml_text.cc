#include "case/toml_text.h"

#include <fmt/format.h>

namespace tourmaline::casefile {

std::string toml_text(const std::string &text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\')
      quoted += '\\';
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F)
      quoted += fmt::format("\\u{:04X}", static_cast<unsigned char>(c));
    else
      quoted += c;
  }
  return quoted + "\"";
}

std::string shortened(const std::string &text) {
  constexpr std::size_t most = 80;
  if (text.size() <= most)
    return text;
  // Not in the middle of a character of several bytes.
  std::size_t end = most;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80)
    --end;
  return text.substr(0, end) + "...";
}

namespace {

std::string text_of(bool value) {
  return value ? "true" : "false";
}
std::string text_of(int value) {
  return fmt::format("{}", value);
}
std::string text_of(double value) {
  return fmt::format("{}", value);
}
std::string text_of(const std::string &value) {
  return toml_text(value);
}
std::string text_of(const Formula &value) {
  return value.is_number() || value.table() ? value.text() : toml_text(value.text());
}
std::string text_of(const std::optional<Formula> &value) {
  return value ? text_of(*value) : "\"free\"";
}

template <class T>
std::string text_of(const std::vector<T> &values) {
  std::string all;
  for (const T &value : values)
    all += (all.empty() ? "" : ", ") + text_of(value);
  return values.empty() ? "" : "[" + all + "]";
}

}  // namespace

std::string toml_text(const Value &value) {
  return std::visit([](const auto *target) { return text_of(*target); }, value);
}

}  // namespace tourmaline::casefile
