#pragma once

#include <functional>
#include <string>
#include <vector>

namespace tourmaline::report {

/// A text (UTF-8) in lines at most `room` wide, one at least. It is broken at blanks; a word wider
/// than a line, such as a formula, behind its operators, or else between any two letters. Without
/// the blanks at which it is broken the lines are the text.
std::vector<std::string> wrapped(const std::string &text, double room,
                                 const std::function<double(const std::string &)> &width);

}  // namespace tourmaline::report
