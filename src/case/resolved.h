#pragma once

#include <string>

namespace tourmaline::casefile {

struct Case;

/// The complete case as TOML, with all defaults filled in. Reading it gives the same case again,
/// every number to the last bit.
std::string resolved(const Case &asked);

/// The same for a run whose friction laws a program has brought along under this name, one line:
/// behind a comment that says so. Without a name ("") the same as `resolved`.
std::string resolved_with_law(const Case &asked, const std::string &friction_name);

/// The name in such a text; "" where the case's own law stands.
std::string friction_name_in(const std::string &resolved);

}  // namespace tourmaline::casefile
