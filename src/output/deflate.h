#pragma once

#include <cstddef>
#include <memory>
#include <span>

struct libdeflate_compressor;

namespace tourmaline::output {

/// Makes zlib streams (RFC 1950), one after another.
class Deflater {
 public:
  /// `level` from 1, fast, to 12. Throws MachineError without memory for it.
  explicit Deflater(int level);

  /// At most so many bytes come of `size` ones.
  std::size_t bound(std::size_t size) const;
  /// Writes to `to`, which has room for bound(bytes.size()) bytes; returns how many it used.
  std::size_t operator()(std::span<const std::byte> bytes, std::byte *to) const;

 private:
  struct Free {
    void operator()(libdeflate_compressor *compressor) const;
  };
  std::unique_ptr<libdeflate_compressor, Free> compressor_;
};

/// Whether `stream` is a zlib stream of exactly the bytes that fill `to`.
bool inflate(std::span<const std::byte> stream, std::span<std::byte> to);

}  // namespace tourmaline::output
