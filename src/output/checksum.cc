#include "output/checksum.h"

#include <zlib.h>

namespace tourmaline::output {

// Of nothing zlib says 0, whatever stood before.
std::uint64_t checksum(std::uint64_t before, std::string_view bytes) {
  return bytes.empty()
             ? before
             : crc32_z(before, reinterpret_cast<const unsigned char *>(bytes.data()), bytes.size());
}

}  // namespace tourmaline::output
