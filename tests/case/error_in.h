#pragma once

#include <string>
#include <vector>

#include "tourmaline/case/reader.h"
#include "tourmaline/error.h"

namespace tourmaline::casefile {

/// What the reader has to say against a case with overrides, or "no error".
inline std::string error_in(const std::string &text,
                            const std::vector<std::string> &overrides = {}) {
  try {
    read_text(text, "case.toml", overrides);
  } catch (const CaseError &error) {
    return error.what();
  }
  return "no error";
}

}  // namespace tourmaline::casefile
