#pragma once

#include <memory>

#include "tourmaline/case/mesh_case.h"

namespace tourmaline::mesh {

/// What keeps a child process from the machine.
struct Walls {
  bool landlock = true;    ///< it reads what it was given, and writes nothing
  bool namespaces = true;  ///< it sees no other files; taken where Landlock is missing
  bool seccomp = true;     ///< it starts no program, opens no socket, and writes nothing

  bool complete() const { return (landlock || namespaces) && seccomp; }
};

/// How files of others are read.
struct Reading {
  /// Geometries may do whatever this program may, for as long as they like: their scripts start
  /// programs and write files. Else they are read between walls, or refused where these are not
  /// complete.
  bool trusted = false;
  Walls walls = {};                  ///< those to be built
  double seconds_of_geometry = 600;  ///< of a processor, to evaluate and mesh a geometry
  double idle_seconds = 60;          ///< by the clock, in which the reading child does nothing
};

/// Reads `mesh.file` with libgmsh, in a child process: Gmsh's own format (2 or 4.1, text or
/// binary), or a geometry (.geo, STEP, IGES, BREP), which is meshed with cells of at most
/// `mesh.size`. Physical groups name boundaries and regions; a group without a name goes by its
/// number, and in a CAD file, which has no groups, faces and solids go by their labels or by
/// "surface 1", "volume 1", ... Throws CaseError. With several MPI ranks all call it; the first one
/// reads, and all get the mesh, or the error.
std::shared_ptr<const casefile::MeshFile> read_mesh_file(const casefile::MeshCase &asked);

/// The same with other rules.
casefile::MeshFileReader mesh_file_reader(const Reading &how);

}  // namespace tourmaline::mesh
