#include "tourmaline/case/sides.h"

namespace tourmaline::casefile {

const std::vector<Side> &sides(int dimension) {
  static const std::vector<Side> square = {
      {"left", 0, false}, {"right", 0, true}, {"bottom", 1, false}, {"top", 1, true}};
  static const std::vector<Side> cube = {{"left", 0, false},   {"right", 0, true},
                                         {"bottom", 2, false}, {"top", 2, true},
                                         {"front", 1, false},  {"back", 1, true}};
  return dimension == 2 ? square : cube;
}

std::vector<std::string> side_names(int dimension) {
  std::vector<std::string> names;
  for (const Side &side : sides(dimension))
    names.push_back(side.name);
  return names;
}

std::vector<std::string> boundary_names(const MeshCase &mesh, int dimension) {
  return mesh.content ? mesh.content->boundary_names() : side_names(dimension);
}

}  // namespace tourmaline::casefile
