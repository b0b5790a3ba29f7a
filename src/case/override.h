#pragma once

#include <toml++/toml.h>
#include <string>

namespace tourmaline::casefile {

/// Puts the value of `key.path=value` into the case. Tables that the case lacks are made; entries
/// of an array have zero-based indices, `boundary[1].potential` or `boundary.1.potential`, and the
/// index after the last makes a new entry; in brackets they also go by their `name`, or where they
/// have none by what they are `on`, `electrode[drive].voltage`. A value that is not TOML is a text.
/// Values remember the override as the place they come from. Throws CaseError.
void apply_override(toml::table &root, const std::string &assignment);

}  // namespace tourmaline::casefile
