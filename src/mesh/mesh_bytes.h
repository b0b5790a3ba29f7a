#pragma once

#include <string>

#include "tourmaline/case/mesh_file.h"

namespace tourmaline::mesh {

/// A mesh on its way from one process of this program to another on the same machine.
std::string bytes_of(const casefile::MeshFile &mesh);
casefile::MeshFile mesh_of(const std::string &bytes);

}  // namespace tourmaline::mesh
