#include "output/checksum.h"

#include <libdeflate.h>

namespace tourmaline::output {

// Of nothing libdeflate may say 0, whatever stood before.
std::uint64_t checksum(std::uint64_t before, std::string_view bytes) {
  return bytes.empty()
             ? before
             : libdeflate_crc32(static_cast<std::uint32_t>(before), bytes.data(), bytes.size());
}

}  // namespace tourmaline::output
