#pragma once

#include <string>
#include <vector>

namespace tourmaline::casefile {
struct Case;
}

namespace tourmaline::report {

/// What a case says of one boundary, (7)-(13), in words and formulas for a legend.
struct Conditions {
  /// the mechanical condition: contact | displacement | traction | free
  std::string kind = "free";
  std::vector<std::string> texts;  ///< UTF-8; empty where nothing is said
};

/// `friction_name`: of laws that a program brought along instead of the case's; "": none.
Conditions conditions_on(const casefile::Case &asked, const std::string &boundary,
                         const std::string &friction_name = "");

}  // namespace tourmaline::report
