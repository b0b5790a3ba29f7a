#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tourmaline/case/mesh_file.h"

namespace tourmaline::casefile {

int dimension_of(CellShape shape);
const char *name_of(CellShape shape);
/// The shape of that name, one of `name_of`; throws CaseError otherwise.
CellShape shape_named(const std::string &name);

/// [mesh] box: `cells` intervals along each axis between the corners `min` and `max` [m]; simplices
/// come from splitting each square or cube.
struct Box {
  std::vector<double> min, max;
  std::vector<int> cells;
  CellShape cell = CellShape::triangle;
  /// by name of a side, how many times smaller the cells are there than where they are largest
  /// along that axis; what is not named: 1
  std::map<std::string, double> grading = {};
};

/// [mesh] annulus: the ring between two circles about the origin, in three dimensions a tube along
/// z that stands on z = 0. `cells` intervals along the radius, around and, in 3D, along z; the
/// corners of the cells lie on circles, their edges are straight.
struct Annulus {
  double inner = 0, outer = 0, height = 0;  ///< [m]; height in 3D only
  std::vector<int> cells;
  CellShape cell = CellShape::triangle;
};

struct MeshCase {
  std::optional<Box> box;
  std::optional<Annulus> annulus;
  std::optional<std::string> file;          ///< Gmsh's or CAD's, absolute once it is read
  std::optional<double> size;               ///< of the largest cells of a geometry [scale]
  double scale = 1;                         ///< the file's unit of length [m]
  std::string unnamed = "error";            ///< error | natural: boundary facets without a name
  int degree = 1;                           ///< of the finite elements, 1 or 2
  std::string modes = "none";               ///< none | incompatible: of linear cells
  std::shared_ptr<const MeshFile> content;  ///< of `file`
};

int dimension_of(const MeshCase &mesh);
CellShape shape_of(const MeshCase &mesh);

}  // namespace tourmaline::casefile
