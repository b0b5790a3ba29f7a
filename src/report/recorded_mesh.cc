#include "report/recorded_mesh.h"

#include <nlohmann/json.hpp>

#include "report/table.h"
#include "report/text_file.h"
#include "tourmaline/error.h"

namespace tourmaline::report {
namespace {

using casefile::CellShape;
using casefile::MeshFile;

void read_points(MeshFile &mesh, const std::filesystem::path &file) {
  const Table nodes = read_table(file);
  const std::vector<double> *x = nodes.find("x"), *y = nodes.find("y"), *z = nodes.find("z");
  if (!x || !y)
    throw CaseError(file.string() + ": has no places");
  mesh.dimension = z ? 3 : 2;
  for (std::size_t i = 0; i < nodes.n_rows(); ++i)
    mesh.points.push_back({(*x)[i], (*y)[i], z ? (*z)[i] : 0});
}

/// The vertices of a facet: of a line its ends, between which its middle may stand.
std::vector<std::uint32_t> vertices_of(const nlohmann::json &facet, int dimension) {
  const auto nodes = facet.get<std::vector<std::uint32_t>>();
  return dimension == 2 ? std::vector{nodes.front(), nodes.back()} : nodes;
}

void add_boundary(MeshFile &mesh, const nlohmann::json &boundary) {
  const int name = static_cast<int>(mesh.boundaries.names.size());
  mesh.boundaries.names.push_back(boundary.at("name"));
  const int set = mesh.boundaries.set_index({name});
  for (const nlohmann::json &facet : boundary.at("facets")) {
    const std::vector<std::uint32_t> vertices = vertices_of(facet, mesh.dimension);
    if (mesh.dimension == 3)
      mesh.cell = vertices.size() == 3 ? CellShape::tetrahedron : CellShape::hexahedron;
    mesh.facets.insert(mesh.facets.end(), vertices.begin(), vertices.end());
    mesh.boundaries.set_of.push_back(set);
    mesh.inside.push_back(boundary.value("inside", false));
  }
}

}  // namespace

std::shared_ptr<const MeshFile> recorded_mesh(const std::filesystem::path &folder) {
  auto mesh = std::make_shared<MeshFile>();
  read_points(*mesh, folder / "nodes.csv");
  const std::filesystem::path file = folder / "boundaries.json";
  try {
    const auto json = nlohmann::json::parse(read_text_file(file));
    for (const auto &boundary : json.at("boundaries"))
      add_boundary(*mesh, boundary);
  } catch (const nlohmann::json::exception &) {
    throw CaseError(file.string() + ": is not what a run writes there");
  }
  for (const std::uint32_t vertex : mesh->facets)
    if (vertex >= mesh->points.size())
      throw CaseError(file.string() + ": names a node that there is not");
  return mesh;
}

}  // namespace tourmaline::report
