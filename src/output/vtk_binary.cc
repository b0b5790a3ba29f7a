#include "output/vtk_binary.h"

#include <algorithm>
#include <cstdint>
#include <future>
#include <thread>
#include <vector>

#include "output/base64.h"
#include "output/deflate.h"

namespace tourmaline::output {
namespace {

/// VTK's own default. Larger blocks shrink field data by a twentieth at most, and are slower.
constexpr std::size_t block_bytes = 32768;

/// The digits of physical fields hardly repeat: higher levels take twice the time to save a
/// hundredth.
constexpr int compression_level = 1;

/// Fewer blocks than this are not worth a thread.
constexpr std::size_t blocks_per_thread = 16;
constexpr std::size_t most_threads = 4;

using Bytes = std::span<const std::byte>;

struct Compressed {
  std::vector<std::byte> bytes;      // all blocks, one behind the other
  std::vector<std::uint64_t> sizes;  // of each block
};

/// Compresses `array` in blocks, the last one shorter where its size is no multiple.
Compressed compress(Bytes array) {
  const Deflater deflate(compression_level);
  Compressed result;
  result.bytes.resize((array.size() / block_bytes + 1) * deflate.bound(block_bytes));
  std::size_t used = 0;
  for (; !array.empty(); array = array.subspan(std::min(block_bytes, array.size()))) {
    const Bytes block = array.first(std::min(block_bytes, array.size()));
    result.sizes.push_back(deflate(block, result.bytes.data() + used));
    used += result.sizes.back();
  }
  result.bytes.resize(used);
  return result;
}

std::size_t n_threads(std::size_t blocks) {
  const std::size_t cores =
      std::clamp<std::size_t>(std::thread::hardware_concurrency(), 1, most_threads);
  return std::clamp<std::size_t>(blocks / blocks_per_thread, 1, cores);
}

/// Each thread takes a run of whole blocks, so that the blocks are the same for any number of
/// threads.
Compressed compress_in_parallel(Bytes array) {
  const std::size_t blocks = (array.size() + block_bytes - 1) / block_bytes;
  const std::size_t threads = n_threads(blocks);
  const std::size_t share = (blocks + threads - 1) / threads * block_bytes;
  std::vector<std::future<Compressed>> others;
  for (std::size_t begin = share; begin < array.size(); begin += share)
    others.push_back(std::async(std::launch::async, compress,
                                array.subspan(begin, std::min(share, array.size() - begin))));
  Compressed result = compress(array.first(std::min(share, array.size())));
  for (auto &other : others) {
    const Compressed given = other.get();
    result.bytes.insert(result.bytes.end(), given.bytes.begin(), given.bytes.end());
    result.sizes.insert(result.sizes.end(), given.sizes.begin(), given.sizes.end());
  }
  return result;
}

}  // namespace

std::string vtk_binary(Bytes array) {
  const Compressed compressed = compress_in_parallel(array);
  std::vector<std::uint64_t> header{compressed.sizes.size(), block_bytes,
                                    array.size() % block_bytes};
  header.insert(header.end(), compressed.sizes.begin(), compressed.sizes.end());
  std::string text;
  text.reserve((header.size() * 8 + compressed.bytes.size()) / 3 * 4 + 8);
  append_base64(text, std::as_bytes(std::span(header)));
  append_base64(text, compressed.bytes);
  return text;
}

}  // namespace tourmaline::output
