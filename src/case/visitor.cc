#include "tourmaline/case/visitor.h"

#include <fmt/format.h>

namespace tourmaline::casefile {

Length one_each_axis(int dimension) {
  return {{dimension},
          "one for each axis",
          fmt::format("the shape of its cells makes the case {}-dimensional", dimension)};
}

}  // namespace tourmaline::casefile
