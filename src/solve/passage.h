#pragma once

#include <string_view>

#include "body/fields.h"

namespace tourmaline::solve {

/// What goes through the boundary at a node because a condition holds an unknown there or the
/// contact does something: a force on the body [N], or charge (D.nu) or heat out of it [C, W]. What
/// loads and exchanges by place alone bring is not in it.
struct Passage {
  body::Node node = 0;
  int component = 0;  ///< of the node's unknowns
  double amount = 0;
  std::string_view boundary;  ///< that it counts for, or electrode, by its name in the case
  bool is_on_electrode = false;
};

}  // namespace tourmaline::solve
