#pragma once

#include "case/visitor.h"

/// Every key of the case file is declared once, by `declare`. The reader, its error texts,
/// resolved.toml, the reference page and the JSON Schema are visitors of that one declaration.
namespace tourmaline::casefile {

struct Case;
struct MaterialCase;

/// Declares all tables of the case file. Sets `asked.dimension` as soon as the mesh has been
/// visited.
void declare(Visitor &visitor, Case &asked);

/// An entry of a file of materials: the same keys but those that depend on the body, and `source`.
void declare_entry(Visitor &visitor, MaterialCase &entry);

}  // namespace tourmaline::casefile
