#pragma once

#include <string>

#include "case/schema.h"

namespace tourmaline::casefile {

/// A text in quotes, with what TOML does not allow inside them escaped.
std::string toml_text(const std::string &text);

/// The text itself, or its beginning when it is too long to stand in an error text.
std::string shortened(const std::string &text);

/// A value as TOML; reading it gives the same value again. Empty for an empty list.
std::string toml_text(const Value &value);

}  // namespace tourmaline::casefile
