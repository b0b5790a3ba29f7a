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

/// An entry of a file of materials.
struct MaterialEntry {
  std::string name;
  MaterialCase given;   ///< empty where a mistake keeps it from being read
  std::string mistake;  ///< what is wrong with it, as one paragraph; empty: nothing

  bool is_read() const { return !given.where.empty(); }
};

/// The entries of a file of materials, by name. Throws CaseError where the file is none; what is
/// wrong with one entry is that entry's.
std::vector<MaterialEntry> read_materials(const std::filesystem::path &file);
/// The same for its text; error texts call it `name`.
std::vector<MaterialEntry> read_materials(const std::string &text, const std::string &name);

}  // namespace tourmaline::casefile
