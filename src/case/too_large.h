#pragma once

#include <string>

namespace tourmaline::casefile {

/// Why a text that begins with a number is none: no double holds it. Empty for all other texts.
std::string too_large(const std::string &text);

/// The same for a value of TOML, whose integers have 64 bits.
std::string too_large_in_toml(const std::string &text);

}  // namespace tourmaline::casefile
