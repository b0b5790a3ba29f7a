#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tourmaline/case/case.h"

namespace tourmaline::casefile {

/// Reads and checks a case file. Each override is `key.path=value`, the value as TOML, as after
/// `--set`. Throws CaseError: one paragraph with file, line, column and key, what was given, and
/// what is allowed. Everything is checked that needs neither the mesh nor the library of materials.
Case read_file(const std::filesystem::path &file, const std::vector<std::string> &overrides = {});

/// The same for the text of a case file; error texts call it `name`.
Case read_text(const std::string &text, const std::string &name,
               const std::vector<std::string> &overrides = {});

}  // namespace tourmaline::casefile
