#pragma once

#include <memory>

#include "tourmaline/case/case.h"

namespace tourmaline::mesh {

/// Reads `mesh.file` with libgmsh: Gmsh's own format (2 or 4.1, text or binary), or a geometry
/// (.geo, STEP, IGES, BREP), which is meshed with cells of at most `mesh.size`. Physical groups
/// name boundaries and regions; a group without a name goes by its number, and in a CAD file, which
/// has no groups, faces and solids go by their labels or by "surface 1", "volume 1", ... Throws
/// CaseError.
std::shared_ptr<const casefile::MeshFile> read_mesh_file(const casefile::MeshCase &asked);

}  // namespace tourmaline::mesh
