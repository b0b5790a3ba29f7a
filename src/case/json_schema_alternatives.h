#pragma once

#include <nlohmann/json.hpp>

/// JSON Schemas of one table as the declaration has it under different conditions.
namespace tourmaline::casefile {

using Json = nlohmann::ordered_json;

/// Accepts what either of the two accepts.
Json merged(const Json &one, const Json &other);

/// What `special` demands beyond `general`, which accepts all that `special` does; null when that
/// is nothing.
Json beyond(const Json &general, const Json &special);

}  // namespace tourmaline::casefile
