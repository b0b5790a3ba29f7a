#include "case/visitor.h"

#include <fmt/format.h>

#include <algorithm>

namespace tourmaline::casefile {

Use with(const std::string &name, const std::string &actual,
         const std::vector<std::string> &values) {
  return {std::find(values.begin(), values.end(), actual) != values.end(),
          fmt::format("{} = \"{}\"", name, fmt::join(values, "\" or \""))};
}

Use with(const std::string &name, bool is_given) {
  return {is_given, name};
}

Length one_each_axis(int dimension) {
  return {{dimension},
          "one for each axis",
          fmt::format("the shape of its cells makes the case {}-dimensional", dimension)};
}

}  // namespace tourmaline::casefile
