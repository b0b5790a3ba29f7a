#pragma once

#include <string>
#include <vector>

#include "tourmaline/case/case.h"

namespace tourmaline::casefile {

/// A side of a box: the one where the coordinate along `axis` (0, 1, 2) is least or greatest.
struct Side {
  std::string name;
  int axis = 0;
  bool greatest = false;
};

/// left, right, bottom, top; in three dimensions left and right (x), front and back (y), bottom and
/// top (z).
const std::vector<Side> &sides(int dimension);

std::vector<std::string> side_names(int dimension);

/// Names that boundary conditions and contact may use: of a box's sides, or those in the mesh file.
std::vector<std::string> boundary_names(const MeshCase &mesh, int dimension);

}  // namespace tourmaline::casefile
