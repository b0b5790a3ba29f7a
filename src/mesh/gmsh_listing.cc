#include "mesh/gmsh_listing.h"

#include <fmt/format.h>
#include <gmsh.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <unordered_map>

#include "case/utf8.h"
#include "tourmaline/error.h"

namespace tourmaline::mesh {

using casefile::CellShape;
using casefile::Groups;
using casefile::MeshFile;

namespace {

/// Names of the groups that an entity is in.
class Names {
 public:
  explicit Names(Format format) : format_(format) {}

  std::vector<std::string> of(int dimension, int entity) const {
    if (format_ == Format::cad)
      return {cad_name(dimension, entity)};
    if (format_ == Format::msh2)
      return entity == 0 ? std::vector<std::string>{} : std::vector{group(dimension, entity)};
    std::vector<int> tags;
    gmsh::model::getPhysicalGroupsForEntity(dimension, entity, tags);
    std::vector<std::string> names;
    names.reserve(tags.size());
    for (const int tag : tags)
      names.push_back(group(dimension, tag));
    return names;
  }

 private:
  static std::string group(int dimension, int tag) {
    std::string name;
    gmsh::model::getPhysicalName(dimension, tag, name);
    if (name.find_first_of(",\"\n") != std::string::npos)
      throw CaseError("has a physical group called " + name +
                      "; names may not contain commas, quotes and ends of lines, as result files "
                      "list them");
    require_utf8(name);
    return name.empty() ? std::to_string(std::abs(tag)) : name;
  }

  static void require_utf8(const std::string &name) {
    if (!casefile::is_utf8(name))
      throw CaseError("has a group whose name is not UTF-8, " + casefile::readable(name) +
                      "; save the file as UTF-8, or take a name of plain letters");
  }

  static std::string cad_name(int dimension, int entity) {
    std::string label;
    gmsh::model::getEntityName(dimension, entity, label);
    require_utf8(label);
    constexpr const char *kind[] = {"point", "curve", "surface", "volume"};
    return label.empty() ? fmt::format("{} {}", kind[dimension], entity)
                         : label.substr(label.find_last_of('/') + 1);
  }

  Format format_;
};

/// Elements of one dimension in the order of the file.
struct Elements {
  std::map<int, std::size_t> count;  // by Gmsh's type
  std::vector<std::size_t> nodes;    // tags
  Groups groups;
};

std::vector<int> members(Groups &groups, const std::vector<std::string> &names) {
  std::vector<int> indices;
  for (const std::string &name : names) {
    const auto found = std::find(groups.names.begin(), groups.names.end(), name);
    indices.push_back(static_cast<int>(found - groups.names.begin()));
    if (found == groups.names.end())
      groups.names.push_back(name);
  }
  std::sort(indices.begin(), indices.end());
  indices.erase(std::unique(indices.begin(), indices.end()), indices.end());
  return indices;
}

Elements elements_of(int dimension, const Names &names) {
  Elements all;
  gmsh::vectorpair entities;
  gmsh::model::getEntities(entities, dimension);
  for (const auto &[dim, entity] : entities) {
    std::vector<int> types;
    std::vector<std::vector<std::size_t>> tags, nodes;
    gmsh::model::mesh::getElements(types, tags, nodes, dim, entity);
    const int set = all.groups.set_index(members(all.groups, names.of(dim, entity)));
    for (std::size_t i = 0; i < types.size(); ++i) {
      all.count[types[i]] += tags[i].size();
      all.nodes.insert(all.nodes.end(), nodes[i].begin(), nodes[i].end());
      all.groups.set_of.insert(all.groups.set_of.end(), tags[i].size(), set);
    }
  }
  return all;
}

struct Kind {
  int type;  // Gmsh's number
  CellShape cell;
  int facet_type;
  const char *name;
};

constexpr Kind kinds[] = {{2, CellShape::triangle, 1, "triangles"},
                          {3, CellShape::quadrilateral, 1, "quadrilaterals"},
                          {4, CellShape::tetrahedron, 2, "tetrahedra"},
                          {5, CellShape::hexahedron, 3, "hexahedra"}};

std::string counts(const std::map<int, std::size_t> &count) {
  std::string text;
  for (const auto &[type, number] : count) {
    std::string name;
    int dimension = 0, order = 0, nodes = 0, vertices = 0;
    std::vector<double> places;
    gmsh::model::mesh::getElementProperties(type, name, dimension, order, nodes, places, vertices);
    text += fmt::format("{}{} of type \"{}\"", text.empty() ? "" : ", ", number, name);
  }
  return text;
}

int order_of(int type) {
  std::string name;
  int dimension = 0, order = 0, nodes = 0, vertices = 0;
  std::vector<double> places;
  gmsh::model::mesh::getElementProperties(type, name, dimension, order, nodes, places, vertices);
  return order;
}

const Kind &kind_of(const Elements &cells) {
  for (const auto &[type, number] : cells.count)
    if (order_of(type) != 1)
      throw CaseError(
          fmt::format("holds cells of order {} ({}); cells must be straight: save it with "
                      "Mesh.ElementOrder = 1, and take mesh.degree = 2 for quadratic fields",
                      order_of(type), counts(cells.count)));
  if (cells.count.size() > 1)
    throw CaseError("mixes shapes of cells (" + counts(cells.count) +
                    "); all must be of one shape");
  for (const Kind &kind : kinds)
    if (kind.type == cells.count.begin()->first)
      return kind;
  throw CaseError("holds cells of a shape that there are no elements for (" + counts(cells.count) +
                  "); triangles, quadrilaterals, tetrahedra or hexahedra are possible");
}

/// Places of the nodes, and where to find a node by its tag.
struct Nodes {
  std::vector<std::array<double, 3>> points;
  std::unordered_map<std::size_t, std::uint32_t> index;  // by tag

  explicit Nodes(double scale) {
    std::vector<std::size_t> tags;
    std::vector<double> places, parameters;
    gmsh::model::mesh::getNodes(tags, places, parameters);
    for (std::size_t i = 0; i < tags.size(); ++i) {
      points.push_back(
          {scale * places[3 * i], scale * places[3 * i + 1], scale * places[3 * i + 2]});
      if (!index.emplace(tags[i], static_cast<std::uint32_t>(i)).second)
        throw CaseError(
            fmt::format("lists two nodes with the number {0}; every node has its own", tags[i]));
    }
  }

  std::vector<std::uint32_t> indices(const std::vector<std::size_t> &tags) const {
    std::vector<std::uint32_t> all;
    for (const std::size_t tag : tags) {
      const auto found = index.find(tag);
      if (found == index.end())
        throw CaseError(
            fmt::format("has an element with the node {}, which it does not list", tag));
      all.push_back(found->second);
    }
    return all;
  }
};

}  // namespace

MeshFile listed(Format format, const casefile::MeshCase &asked) {
  const Names names(format);
  int dimension = 3;
  Elements cells = elements_of(dimension, names);
  if (cells.nodes.empty())
    cells = elements_of(dimension = 2, names);
  if (cells.nodes.empty())
    throw CaseError("holds no cells: neither volumes nor surfaces are meshed in it");
  const Kind &kind = kind_of(cells);
  Elements facets = elements_of(dimension - 1, names);
  for (const auto &[type, number] : facets.count)
    if (type != kind.facet_type)
      throw CaseError(fmt::format("holds facets ({}) that are not those of its {}",
                                  counts(facets.count), kind.name));
  const Nodes nodes(asked.scale);
  MeshFile mesh;
  mesh.dimension = dimension;
  mesh.cell = kind.cell;
  mesh.points = nodes.points;
  mesh.cells = nodes.indices(cells.nodes);
  mesh.facets = nodes.indices(facets.nodes);
  mesh.regions = std::move(cells.groups);
  mesh.boundaries = std::move(facets.groups);
  return mesh;
}

}  // namespace tourmaline::mesh
