#pragma once

#include <cstddef>
#include <optional>
#include <string>

namespace tourmaline::casefile {

/// Why a text that begins with a number is none: no double holds it. Empty for all other texts.
std::string too_large(const std::string &text);

/// The same for a value of TOML, whose integers have 64 bits.
std::string too_large_in_toml(const std::string &text);

/// Where a formula has a number that is not 0, but that a double takes for 0: why it is none. Empty
/// for all other texts.
std::string too_small(const std::string &formula);

/// The same for numbers in a text of TOML, strings and comments left out; and the line.
struct TooSmall {
  std::string reason;
  std::size_t line = 1;
};
std::optional<TooSmall> too_small_in_toml(const std::string &text);

}  // namespace tourmaline::casefile
