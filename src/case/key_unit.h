#pragma once

#include <string>

namespace tourmaline::casefile {

/// The unit of the key with that dotted path, `boundary[1].potential`; empty when it has none, or
/// there is no such key.
std::string unit_of_key(const std::string &path, int dimension);

}  // namespace tourmaline::casefile
