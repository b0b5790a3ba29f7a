#include "output/growing_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <string>
#include <system_error>

#include "output/checksum.h"
#include "tourmaline/error.h"

namespace tourmaline::output {

namespace {

namespace fs = std::filesystem;

// A table of a long run need not fit into memory.
std::uint64_t checksum_of_file(const fs::path &file, std::uint64_t bytes) {
  constexpr std::uint64_t most = 1 << 20;
  std::ifstream in(file, std::ios::binary);
  std::string piece(std::min(bytes, most), '\0');
  std::uint64_t sum = 0;
  for (std::uint64_t left = bytes; left > 0; left -= piece.size()) {
    piece.resize(std::min(left, most));
    if (!in.read(piece.data(), static_cast<std::streamsize>(piece.size())))
      throw MachineError(fmt::format("cannot read {}", file.string()));
    sum = checksum(sum, piece);
  }
  return sum;
}

}  // namespace

GrowingTable::GrowingTable(const fs::path &path, std::string_view header) : file_(path) {
  append(header);
}

GrowingTable::GrowingTable(const fs::path &path, const TablePosition &position)
    : file_(path, position.bytes), checksum_(position.checksum) {}

void GrowingTable::append(std::string_view lines) {
  file_.append(lines);  // first: what it refuses is not in the file
  checksum_ = checksum(checksum_, lines);
}

void require_table(const fs::path &path, const TablePosition &position) {
  if (position.bytes == 0)
    return;
  const fs::path growing = path.string() + ".part";
  std::error_code error;
  const fs::path file = fs::exists(growing, error) ? growing : path;
  require_bytes(file, position.bytes);
  if (checksum_of_file(file, position.bytes) != position.checksum)
    throw MachineError(fmt::format(
        "the first {} bytes of {}, on which the checkpoint counts, are not those that the run "
        "wrote: it was edited or damaged since; put back what stood there, or start again without "
        "--resume",
        position.bytes, file.string()));
}

}  // namespace tourmaline::output
