#include "tourmaline/case/mesh_file.h"

#include <algorithm>

namespace tourmaline::casefile {

int Groups::set_index(const std::vector<int> &members) {
  const auto found = std::find(sets.begin(), sets.end(), members);
  if (found != sets.end())
    return static_cast<int>(found - sets.begin());
  sets.push_back(members);
  return static_cast<int>(sets.size()) - 1;
}

std::vector<int> Groups::sets_with(const std::string &name) const {
  std::vector<int> indices;
  for (std::size_t set = 0; set < sets.size(); ++set)
    for (const int member : sets[set])
      if (names[static_cast<std::size_t>(member)] == name)
        indices.push_back(static_cast<int>(set));
  return indices;
}

std::size_t MeshFile::vertices_per_cell() const {
  constexpr std::array<std::size_t, 4> vertices{3, 4, 4, 8};
  return vertices[static_cast<std::size_t>(cell)];
}

std::size_t MeshFile::vertices_per_facet() const {
  constexpr std::array<std::size_t, 4> vertices{2, 2, 3, 4};
  return vertices[static_cast<std::size_t>(cell)];
}

namespace {

// For each name whether some of its facets lie inside the body.
std::vector<bool> partly_inside(const MeshFile &mesh) {
  std::vector<bool> inner(mesh.boundaries.names.size(), false);
  for (std::size_t facet = 0; facet < mesh.inside.size(); ++facet)
    if (mesh.inside[facet])
      for (const int name :
           mesh.boundaries.sets[static_cast<std::size_t>(mesh.boundaries.set_of[facet])])
        inner[static_cast<std::size_t>(name)] = true;
  return inner;
}

std::vector<std::string> chosen(const MeshFile &mesh, bool wanted_inside) {
  const std::vector<bool> inner = partly_inside(mesh);
  std::vector<std::string> names;
  for (std::size_t name = 0; name < inner.size(); ++name)
    if (inner[name] == wanted_inside)
      names.push_back(mesh.boundaries.names[name]);
  return names;
}

}  // namespace

std::vector<std::string> MeshFile::boundary_names() const {
  return chosen(*this, false);
}

std::vector<std::string> MeshFile::inner_names() const {
  return chosen(*this, true);
}

}  // namespace tourmaline::casefile
