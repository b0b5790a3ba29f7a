#include "tourmaline/case/case.h"
#include "tourmaline/error.h"

namespace tourmaline::casefile {

int dimension_of(CellShape shape) {
  return shape == CellShape::triangle || shape == CellShape::quadrilateral ? 2 : 3;
}

int dimension_of(const MeshCase &mesh) {
  if (mesh.annulus)
    return dimension_of(mesh.annulus->cell);
  if (mesh.content)
    return mesh.content->dimension;
  return mesh.box ? dimension_of(mesh.box->cell) : 2;
}

CellShape shape_of(const MeshCase &mesh) {
  if (mesh.annulus)
    return mesh.annulus->cell;
  if (mesh.content)
    return mesh.content->cell;
  return mesh.box ? mesh.box->cell : CellShape::triangle;
}

const char *name_of(CellShape shape) {
  constexpr const char *names[] = {"triangle", "quadrilateral", "tetrahedron", "hexahedron"};
  return names[static_cast<int>(shape)];
}

CellShape shape_named(const std::string &name) {
  for (const CellShape shape : {CellShape::triangle, CellShape::quadrilateral,
                                CellShape::tetrahedron, CellShape::hexahedron})
    if (name == name_of(shape))
      return shape;
  throw CaseError("there is no cell shape \"" + name + "\"");
}

}  // namespace tourmaline::casefile
