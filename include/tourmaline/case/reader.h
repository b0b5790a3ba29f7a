#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tourmaline/case/case.h"

namespace tourmaline::casefile {

/// Reads and checks a case file. Each override is `key.path=value`, the value as TOML, as after
/// `--set`. Throws CaseError: one paragraph with file, line, column and key, what was given, and
/// what is allowed. Everything is checked that does not need the library of materials. `mesh.file`
/// is found from the case's own folder and read by `read_mesh`; without that only boxes are
/// possible.
Case read_file(const std::filesystem::path &file, const std::vector<std::string> &overrides = {},
               const MeshFileReader &read_mesh = {});

/// The same for the text of a case file; error texts call it `name`.
Case read_text(const std::string &text, const std::string &name,
               const std::vector<std::string> &overrides = {},
               const MeshFileReader &read_mesh = {});

}  // namespace tourmaline::casefile
