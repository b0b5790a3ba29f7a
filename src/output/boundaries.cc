#include "output/boundaries.h"

#include <nlohmann/json.hpp>

namespace tourmaline::output {

std::string boundaries_text(const std::vector<NamedBoundary> &boundaries) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const NamedBoundary &boundary : boundaries)
    list.push_back({{"name", boundary.name}, {"facets", boundary.facets}});
  return nlohmann::ordered_json{{"boundaries", list}}.dump() + "\n";
}

}  // namespace tourmaline::output
