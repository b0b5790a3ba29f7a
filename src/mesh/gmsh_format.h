#pragma once

#include <filesystem>

#include "tourmaline/case/case.h"

namespace tourmaline::mesh {

/// What libgmsh reads: meshes in two versions of its format, and geometries that it has to mesh,
/// scripts and CAD files.
enum class Format { msh2, msh4, geo, cad };

bool is_geometry(Format format);

/// By the file's ending and, of a mesh, its first lines. Throws CaseError for what cannot be read,
/// and for a mesh that was cut off.
Format format_of(const std::filesystem::path &file);

/// Throws CaseError where mesh.size is missing or has no meaning, and for a script whose last line
/// libgmsh would not see.
void check_asked(Format format, const casefile::MeshCase &asked);

}  // namespace tourmaline::mesh
