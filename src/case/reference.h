#pragma once

#include <string>

namespace tourmaline::casefile {

/// The page docs/case-file.md: every table and key with unit, range, default and meaning.
std::string reference_page();

}  // namespace tourmaline::casefile
