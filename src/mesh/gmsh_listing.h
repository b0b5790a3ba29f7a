#pragma once

#include "mesh/gmsh_format.h"
#include "tourmaline/case/mesh_file.h"

namespace tourmaline::mesh {

/// The mesh that libgmsh holds: nodes, cells of the largest dimension that there is, facets of the
/// one below it, and the groups that both are in. Throws CaseError for cells that there are no
/// elements for and for what does not fit together.
casefile::MeshFile listed(Format format, const casefile::MeshCase &asked);

}  // namespace tourmaline::mesh
