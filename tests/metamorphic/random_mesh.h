#pragma once

#include "random.h"
#include "sample.h"

namespace tourmaline::verified {

/// What a random mesh is made like.
struct MeshShape {
  int dimension = 2;
  bool simplices = false, ring = false;
  std::vector<double> size;  ///< of a box; of a ring inner radius, outer radius and height
  std::vector<int> cells;    ///< along each axis; of a ring along the radius, around, along z
  int regions = 1;           ///< 2: `region0` is the half beside `layered`
  int layered = 0;           ///< side
};

/// Sides are named by 2 axis + (0 at the lower end, 1 at the upper); around a ring there are none.
/// Vertices inside are moved at random, those of the boundary stay on it.
SampleMesh random_mesh(const MeshShape &shape, Random &random);

}  // namespace tourmaline::verified
