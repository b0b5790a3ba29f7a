#include "output/deflate.h"

#include <libdeflate.h>

#include "tourmaline/error.h"

namespace tourmaline::output {

void Deflater::Free::operator()(libdeflate_compressor *compressor) const {
  libdeflate_free_compressor(compressor);
}

Deflater::Deflater(int level) : compressor_(libdeflate_alloc_compressor(level)) {
  if (!compressor_)
    throw MachineError("not enough memory to compress a field");
}

std::size_t Deflater::bound(std::size_t size) const {
  return libdeflate_zlib_compress_bound(compressor_.get(), size);
}

std::size_t Deflater::operator()(std::span<const std::byte> bytes, std::byte *to) const {
  return libdeflate_zlib_compress(compressor_.get(), bytes.data(), bytes.size(), to,
                                  bound(bytes.size()));
}

bool inflate(std::span<const std::byte> stream, std::span<std::byte> to) {
  struct Free {
    void operator()(libdeflate_decompressor *d) const { libdeflate_free_decompressor(d); }
  };
  const std::unique_ptr<libdeflate_decompressor, Free> decompressor(
      libdeflate_alloc_decompressor());
  if (!decompressor)
    throw MachineError("not enough memory to read a compressed field");
  return libdeflate_zlib_decompress(decompressor.get(), stream.data(), stream.size(), to.data(),
                                    to.size(), nullptr) == LIBDEFLATE_SUCCESS;
}

}  // namespace tourmaline::output
