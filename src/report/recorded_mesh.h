#pragma once

#include <filesystem>
#include <memory>

#include "tourmaline/case/mesh_file.h"

namespace tourmaline::report {

/// What a result folder tells of the mesh that its case read from a file, from boundaries.json and
/// nodes.csv: the named facets, without cells and regions. That is enough to read the case again
/// where the file is not at hand. Throws CaseError when one of the two is missing or damaged.
std::shared_ptr<const casefile::MeshFile> recorded_mesh(const std::filesystem::path &folder);

}  // namespace tourmaline::report
