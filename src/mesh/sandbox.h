#pragma once

#include <filesystem>
#include <vector>

#include "tourmaline/mesh/gmsh.h"

namespace tourmaline::mesh {

/// Takes from this process, for good, whatever computing from files does not need. Nothing can be
/// read but the files in `readable` and what lies in the folders there, and what is open already;
/// nothing can be written but to what is open, no program started, no process but its own threads,
/// no socket opened. A process that tries to start another is killed by SIGSYS, all else fails. The
/// working folder is an empty one. Returns the walls that stand; those of `asked` that the kernel
/// lacks do not.
Walls confine(const std::vector<std::filesystem::path> &readable, Walls asked);

}  // namespace tourmaline::mesh
