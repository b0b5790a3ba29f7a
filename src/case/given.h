#pragma once

#include <map>
#include <string>

namespace tourmaline::casefile {

struct MaterialCase;

/// The tensors that a material may give as a whole, by their keys, and whether it does.
std::map<std::string, bool> given_tensors(const MaterialCase &material);

/// `over` laid over `entry`: a constant that `over` gives in the entry's form overrides it, one in
/// another form (or a whole tensor) replaces all that the entry says of that kind.
MaterialCase merged(const MaterialCase &entry, const MaterialCase &over);

/// The material without all that it says of its left-out kinds.
MaterialCase without_left_out(MaterialCase material);

}  // namespace tourmaline::casefile
