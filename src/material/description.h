#pragma once

#include <string>

namespace tourmaline::casefile {
struct MaterialCase;
}

namespace tourmaline::material {

/// One line an entry of the built-in library, or of a file of materials: name, class, whether a
/// case can use it as it is, which keys it must add, what is wrong with it, and source.
std::string describe_library(const std::string &file = {});

/// What `tourmaline materials NAME` prints: the entry's constants with units and source, the
/// expanded tensors in the stress-charge and in the strain-charge form, coupling factors, warnings,
/// and what a case must add. What cannot be computed from the entry is left out.
std::string describe(const casefile::MaterialCase &asked);

/// The same as JSON, for programs: an array of entries, or one. Each has name, source, symmetry,
/// conductor, constants by key, the keys of `tensors`, `complete`, `missing`: key, unit, reason;
/// and `mistake` where something is wrong with it.
std::string library_json(const std::string &file = {});
std::string entry_json(const casefile::MaterialCase &asked);

}  // namespace tourmaline::material
