#pragma once

#include <string>

#include "tourmaline/case/mesh_file.h"

namespace tourmaline::mesh {

/// A mesh on its way from one process of this program to another on machines of one kind.
std::string bytes_of(const casefile::MeshFile &mesh);
/// Throws CaseError for bytes that are no mesh, as a process that a file has taken over may send.
casefile::MeshFile mesh_of(const std::string &bytes);

}  // namespace tourmaline::mesh
