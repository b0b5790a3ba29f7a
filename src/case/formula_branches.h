#pragma once

#include <string>

namespace tourmaline::casefile {

/// The same formula with every `if(c, a, b)`, `a && b` and `a || b` as `c ? a : b`, of which
/// muParser evaluates only the branch that is taken; of the others it evaluates all. The text must
/// be one that muParser accepts.
std::string with_branches(const std::string &text);

/// How deep parentheses stand inside each other.
int nesting(const std::string &text);

}  // namespace tourmaline::casefile
