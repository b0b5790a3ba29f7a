// Any file called checkpoint.bin is a checkpoint or a MachineError. Half of the files get a right
// checksum, so that what stands before it is reached.
#include <unistd.h>
#include <zlib.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

#include "output/checkpoint.h"
#include "tourmaline/error.h"

namespace {

namespace fs = std::filesystem;

std::string with_checksum(std::string text) {
  const std::uint64_t sum =
      crc32(0, reinterpret_cast<const Bytef *>(text.data()), static_cast<uInt>(text.size()));
  return text.append(reinterpret_cast<const char *>(&sum), sizeof sum);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size) {
  std::string text(data, data + size);
  if (size % 2 == 0)
    text = with_checksum(text);
  static const fs::path file =
      fs::temp_directory_path() / ("fuzz-checkpoint-" + std::to_string(getpid()));
  std::ofstream(file, std::ios::binary) << text;
  try {
    tourmaline::output::read_checkpoint(file);
  } catch (const tourmaline::MachineError &) {
  }
  return 0;
}
