#include "mesh/completed.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "mesh/element_table.h"
#include "tourmaline/error.h"
#include "unfolded.h"

namespace tourmaline::mesh {

namespace {

using casefile::Groups;
using casefile::MeshFile;
using Indices = std::vector<std::uint32_t>;
using Point = std::array<double, 3>;

std::string place(const Point &p) {
  return fmt::format("({:g}, {:g}, {:g})", p[0], p[1], p[2]);
}

double extent(const MeshFile &mesh) {
  double size = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const auto [low, high] =
        std::minmax_element(mesh.points.begin(), mesh.points.end(),
                            [&](const Point &a, const Point &b) { return a[axis] < b[axis]; });
    size = std::max(size, (*high)[axis] - (*low)[axis]);
  }
  return size;
}

void check_numbers(const MeshFile &mesh) {
  for (const Point &point : mesh.points)
    for (const double x : point)
      if (!std::isfinite(x))
        throw CaseError("has a vertex at " + place(point) + "; coordinates are finite numbers");
}

void leave_out_unused(MeshFile &mesh) {
  std::vector<bool> used(mesh.points.size(), false);
  for (const std::uint32_t vertex : mesh.cells)
    used[vertex] = true;
  for (const std::uint32_t vertex : mesh.facets)
    if (!used[vertex])
      throw CaseError("lists a facet at " + place(mesh.points[vertex]) +
                      " that no cell has: the mesh of the boundary is not that of the body");
  Indices number(mesh.points.size(), 0);
  std::vector<Point> points;
  for (std::size_t i = 0; i < used.size(); ++i)
    if (used[i]) {
      number[i] = static_cast<std::uint32_t>(points.size());
      points.push_back(mesh.points[i]);
    }
  mesh.points = std::move(points);
  for (Indices *vertices : {&mesh.cells, &mesh.facets})
    for (std::uint32_t &vertex : *vertices)
      vertex = number[vertex];
}

void check_plane(MeshFile &mesh) {
  if (mesh.dimension == 3)
    return;
  const double tolerance = 1e-9 * extent(mesh);
  for (Point &point : mesh.points) {
    if (std::abs(point[2]) > tolerance)
      throw CaseError("is two-dimensional but leaves the plane z = 0, at " + place(point));
    point[2] = 0;
  }
}

// Gmsh lists an element once for each of its groups, in format 2. A cell that one group has twice
// would be twice in the body.
void check_listed_once(const MeshFile &mesh) {
  const std::size_t each = mesh.vertices_per_cell();
  ElementTable(mesh.cells, each).for_each([&](std::span<const std::uint32_t> twins) {
    for (std::size_t i = 1; i < twins.size(); ++i)
      if (mesh.regions.set_of[twins[i]] == mesh.regions.set_of[twins[i - 1]])
        throw CaseError("lists the cell at " + place(mesh.points[mesh.cells[twins[i] * each]]) +
                        " twice");
  });
}

void merge_twins(Indices &vertices, std::size_t each, Groups &groups) {
  const ElementTable table(vertices, each);
  std::vector<bool> keep(vertices.size() / each, false);
  table.for_each([&](std::span<const std::uint32_t> twins) {
    keep[twins.front()] = true;
    std::vector<int> members;
    for (const std::uint32_t twin : twins) {
      const std::vector<int> &set = groups.sets[static_cast<std::size_t>(groups.set_of[twin])];
      members.insert(members.end(), set.begin(), set.end());
    }
    std::sort(members.begin(), members.end());
    members.erase(std::unique(members.begin(), members.end()), members.end());
    groups.set_of[twins.front()] = groups.set_index(members);
  });
  std::size_t kept = 0;
  for (std::size_t i = 0; i < keep.size(); ++i)
    if (keep[i]) {
      std::copy_n(vertices.begin() + static_cast<std::ptrdiff_t>(i * each), each,
                  vertices.begin() + static_cast<std::ptrdiff_t>(kept * each));
      groups.set_of[kept++] = groups.set_of[i];
    }
  vertices.resize(kept * each);
  groups.set_of.resize(kept);
}

Indices faces_of_all_cells(const MeshFile &mesh) {
  Indices faces;
  const std::size_t each = mesh.vertices_per_cell();
  for (std::size_t cell = 0; cell < mesh.n_cells(); ++cell)
    for (const std::vector<int> &facet : facets_of(mesh.cell))
      for (const int local : facet)
        faces.push_back(mesh.cells[cell * each + static_cast<std::size_t>(local)]);
  return faces;
}

// Union of the cells that share a face.
class Pieces {
 public:
  explicit Pieces(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0); }
  std::size_t root(std::size_t i) {
    while (parent_[i] != i)
      i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::size_t a, std::size_t b) { parent_[root(a)] = root(b); }

 private:
  std::vector<std::size_t> parent_;
};

void check_faces(const MeshFile &mesh, const Indices &faces, const ElementTable &table) {
  const std::size_t each = mesh.vertices_per_facet(), per_cell = facets_of(mesh.cell).size();
  Pieces pieces(mesh.n_cells());
  table.for_each([&](std::span<const std::uint32_t> same) {
    if (same.size() > 2)
      throw CaseError(fmt::format("has a facet of {} cells at {}; at most two can share one",
                                  same.size(), place(mesh.points[faces[same[0] * each]])));
    if (same.size() == 2)
      pieces.join(same[0] / per_cell, same[1] / per_cell);
  });
  for (std::size_t cell = 1; cell < mesh.n_cells(); ++cell)
    if (pieces.root(cell) != pieces.root(0))
      throw CaseError(fmt::format(
          "falls into pieces that share no facets: the cells at {} and at {} are not joined. Parts "
          "that touch need a common mesh on their interface (in Gmsh: BooleanFragments or "
          "Coherence)",
          place(mesh.points[mesh.cells[0]]),
          place(mesh.points[mesh.cells[cell * mesh.vertices_per_cell()]])));
}

// Two vertices at one place are a slit: parts touch there and are not joined. Places count as one
// when they fall into one cell of a grid of the tolerance, or of the same grid shifted by a half.
void check_places(const MeshFile &mesh, double shift) {
  const double tolerance = 1e-9 * extent(mesh);
  std::vector<std::pair<std::array<long long, 3>, std::uint32_t>> grid;
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    std::array<long long, 3> at;
    for (int axis = 0; axis < 3; ++axis)
      at[axis] = std::llround(
          std::floor((mesh.points[i][axis] - mesh.points[0][axis]) / tolerance + shift));
    grid.emplace_back(at, static_cast<std::uint32_t>(i));
  }
  std::sort(grid.begin(), grid.end());
  const auto twin = std::adjacent_find(
      grid.begin(), grid.end(), [](const auto &a, const auto &b) { return a.first == b.first; });
  if (twin != grid.end())
    throw CaseError("has two vertices at " + place(mesh.points[twin->second]) +
                    ": parts touch there without being joined. They need a common mesh on their "
                    "interface (in Gmsh: Coherence Mesh, or BooleanFragments before meshing)");
}

// What the file does not list gets no name; what it lists must be the body's.
void complete_facets(MeshFile &mesh, const Indices &faces, const ElementTable &table) {
  const std::size_t each = mesh.vertices_per_facet();
  const ElementTable listed(mesh.facets, each);
  mesh.inside.clear();
  for (std::size_t facet = 0; facet < mesh.n_facets(); ++facet) {
    const auto same = table.find(std::span(mesh.facets).subspan(facet * each, each));
    if (same.empty())
      throw CaseError("lists a facet at " + place(mesh.points[mesh.facets[facet * each]]) +
                      " that no cell has: the mesh of the boundary is not that of the body");
    mesh.inside.push_back(same.size() == 2);
  }
  table.for_each([&](std::span<const std::uint32_t> same) {
    const std::span<const std::uint32_t> face = std::span(faces).subspan(same[0] * each, each);
    if (same.size() == 2 || !listed.find(face).empty())
      return;
    mesh.facets.insert(mesh.facets.end(), face.begin(), face.end());
    mesh.boundaries.set_of.push_back(0);
    mesh.inside.push_back(false);
  });
}

}  // namespace

MeshFile completed(MeshFile mesh) {
  check_numbers(mesh);
  leave_out_unused(mesh);
  check_plane(mesh);
  orient(mesh);
  check_listed_once(mesh);
  merge_twins(mesh.cells, mesh.vertices_per_cell(), mesh.regions);
  merge_twins(mesh.facets, mesh.vertices_per_facet(), mesh.boundaries);
  const Indices faces = faces_of_all_cells(mesh);
  const ElementTable table(faces, mesh.vertices_per_facet());
  check_places(mesh, 0);
  check_places(mesh, 0.5);
  check_faces(mesh, faces, table);
  check_unfolded(mesh, faces, table);
  complete_facets(mesh, faces, table);
  return mesh;
}

}  // namespace tourmaline::mesh
