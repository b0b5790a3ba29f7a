#pragma once

#include <string>
#include <vector>

#include "tourmaline/case/reader.h"

namespace tourmaline::material {

/// A material by name, as the built-in library or a file of materials gives it, with what is wrong
/// with it.
using Entry = casefile::MaterialEntry;

/// The built-in materials. Their text (library_text.cc) is a file of materials like a user's own.
const std::vector<Entry> &library();
/// Those of a file. Throws CaseError where it is no such file; what is wrong with one entry is that
/// entry's `mistake`.
std::vector<Entry> materials_in(const std::string &file);

/// The entry that `asked.library` names, in `asked.file` or in the built-in library. Throws
/// CaseError naming the nearest entry, or the mistake in this one.
Entry find(const casefile::MaterialCase &asked);

}  // namespace tourmaline::material
