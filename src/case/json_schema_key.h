#pragma once

#include "case/schema.h"
#include "json_schema_alternatives.h"

namespace tourmaline::casefile {

/// The name among the schema's definitions of values over time, and what it stands for.
constexpr const char *values_over_time = "values_over_time";
Json schema_of_values_over_time();
/// The same of a number that is given with its unit.
constexpr const char *number_with_unit = "number_with_unit";
Json schema_of_number_with_unit();

/// The JSON Schema of a key's values. A list of names that depend on the mesh is one only where the
/// key has them.
Json schema_of_key(const Key &key, const Value &value);

}  // namespace tourmaline::casefile
