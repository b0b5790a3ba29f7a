#include "output/boundaries.h"

#include <nlohmann/json.hpp>

namespace tourmaline::output {
namespace {

/// Of a facet without the nodes amid its sides; a line has all of its own.
std::vector<std::uint32_t> corners(const std::vector<std::uint32_t> &facet) {
  const std::size_t n = facet.size() == 9 ? 4 : facet.size() == 6 ? 3 : facet.size();
  return {facet.begin(), facet.begin() + static_cast<std::ptrdiff_t>(n)};
}

}  // namespace

std::string boundaries_text(const std::vector<NamedBoundary> &boundaries) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const NamedBoundary &boundary : boundaries) {
    auto facets = nlohmann::ordered_json::array();
    for (const std::vector<std::uint32_t> &facet : boundary.facets)
      facets.push_back(corners(facet));
    list.push_back({{"name", boundary.name}, {"facets", facets}});
    if (boundary.inside)
      list.back()["inside"] = true;
  }
  return nlohmann::ordered_json{{"boundaries", list}}.dump() + "\n";
}

}  // namespace tourmaline::output
