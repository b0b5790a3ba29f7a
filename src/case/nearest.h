#pragma once

#include <optional>
#include <string>
#include <vector>

namespace tourmaline::casefile {

/// Letters to insert, delete, replace or swap with their neighbour (upper and lower case are the
/// same) to turn one word into the other.
int edit_distance(const std::string &one, const std::string &other);

/// The candidate that a misspelt name most likely means; nothing when none is near.
std::optional<std::string> nearest(const std::string &name,
                                   const std::vector<std::string> &candidates);

/// `; did you mean "..."?`, or nothing.
std::string did_you_mean(const std::string &name, const std::vector<std::string> &candidates);

}  // namespace tourmaline::casefile
