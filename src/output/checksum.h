#pragma once

#include <cstdint>
#include <string_view>

namespace tourmaline::output {

/// CRC-32 of bytes that follow those with the checksum `before`; of the first ones that is 0. Tells
/// what was damaged or edited from what was written, not from what was forged.
std::uint64_t checksum(std::uint64_t before, std::string_view bytes);

}  // namespace tourmaline::output
