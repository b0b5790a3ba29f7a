#pragma once

#include <array>
#include <string>
#include <vector>

#include "tourmaline/case/mesh_case.h"

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

/// The sides of the case's mesh: of a box as above; of an annulus inner, outer, in three dimensions
/// also bottom and top; of a mesh file the names it gives to boundaries.
std::vector<std::string> side_names(const MeshCase &mesh);

/// A place on a side of the mesh [m] with the outward unit normal there.
struct SidePoint {
  std::array<double, 3> point{};
  std::array<double, 3> normal{};
};

/// So many places on a side that an affine function is zero on the side when it is zero there, and
/// so is the normal component of a rigid motion: corners of a box, points of an annulus' circles,
/// all vertices of a mesh file.
std::vector<SidePoint> points_on(const MeshCase &mesh, const std::string &side);

}  // namespace tourmaline::casefile
