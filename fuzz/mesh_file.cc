// Any file called .msh is either a mesh or a CaseError.
#include <pthread.h>
#include <sanitizer/common_interface_defs.h>
#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <fstream>

#include "tourmaline/case/case.h"
#include "tourmaline/error.h"
#include "tourmaline/mesh/gmsh.h"

// libgmsh's crashes in its child process are no findings.
extern "C" int LLVMFuzzerInitialize(int *, char ***) {
  pthread_atfork(nullptr, nullptr, [] { __sanitizer_set_death_callback([] {}); });
  return 0;
}

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
