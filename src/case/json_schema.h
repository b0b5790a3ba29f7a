#pragma once

#include <functional>
#include <string>

#include "case/visitor.h"

namespace tourmaline::casefile {

struct Case;

/// Raised when a case file that this schema accepted is no longer accepted or means something else;
/// new keys and new values do not raise it.
constexpr int schema_version = 2;

/// docs/case.schema.json: the case file as JSON Schema (draft 2020-12), for completion and checks
/// in editors. It accepts every valid case. What one key demands of others is in it as far as their
/// presence, their choices and the kind of the mesh go; sums, formulas and names across tables are
/// left to `tourmaline check`.
std::string json_schema();

/// The same of another declaration.
using Declaration = std::function<void(Visitor &, Case &)>;
std::string json_schema(const Declaration &declaration);

}  // namespace tourmaline::casefile
