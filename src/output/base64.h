#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace tourmaline::output {

/// Appends the base64 text (RFC 4648, padded, no line breaks) of `bytes` to `text`.
void append_base64(std::string &text, std::span<const std::byte> bytes);

}  // namespace tourmaline::output
