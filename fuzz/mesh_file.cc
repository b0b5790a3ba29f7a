// Any file called .msh is either a mesh or a CaseError.
#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <fstream>

#include "tourmaline/error.h"
#include "tourmaline/mesh/gmsh.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size) {
  static const std::string file =
      std::filesystem::temp_directory_path() / ("fuzz-" + std::to_string(getpid()) + ".msh");
  std::ofstream(file, std::ios::binary)
      .write(reinterpret_cast<const char *>(data), static_cast<std::streamsize>(size));
  tourmaline::casefile::MeshCase asked;
  asked.file = file;
  try {
    tourmaline::mesh::read_mesh_file(asked);
  } catch (const tourmaline::CaseError &) {
  }
  return 0;
}
