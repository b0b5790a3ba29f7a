#include "solve/first_places.h"

#include <fmt/format.h>

#include <algorithm>

namespace tourmaline::solve {

std::string first_places(std::size_t n, const std::function<Vector3(std::size_t)> &place) {
  constexpr std::size_t most = 3;
  std::string text;
  for (std::size_t i = 0; i < std::min(n, most); ++i) {
    const Vector3 p = place(i);
    text += fmt::format(" ({:g}, {:g}, {:g})", p[0], p[1], p[2]);
  }
  return text;
}

}  // namespace tourmaline::solve
