#pragma once

#include <string>
#include <vector>

#include "tourmaline/case/case.h"

namespace tourmaline::material {

/// A material by name, as the built-in library or a file of materials gives it.
struct Entry {
  std::string name;
  casefile::MaterialCase given;
};

/// The built-in materials. Their text (library_text.cc) is a file of materials like a user's own.
const std::vector<Entry> &library();
/// Those of a file. Throws CaseError.
std::vector<Entry> materials_in(const std::string &file);

/// The entry that `asked.library` names, in `asked.file` or in the built-in library. Throws
/// CaseError naming the nearest entry.
Entry find(const casefile::MaterialCase &asked);

}  // namespace tourmaline::material
