#pragma once

#include "case/schema.h"
#include "json_schema_alternatives.h"

namespace tourmaline::casefile {

/// The JSON Schema of a key's values. A list of names that depend on the mesh is one only where the
/// key has them.
Json schema_of_key(const Key &key, const Value &value);

}  // namespace tourmaline::casefile
