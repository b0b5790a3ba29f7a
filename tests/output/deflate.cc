#include "output/deflate.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <cstdint>
#include <vector>

#include "output/checksum.h"

namespace tourmaline::output {
namespace {

std::vector<std::byte> some(std::size_t n) {
  std::vector<std::byte> bytes(n);
  for (std::size_t i = 0; i < n; ++i)
    bytes[i] = static_cast<std::byte>(i * i % 251 / (1 + i % 7));
  return bytes;
}

std::vector<std::byte> deflated(const std::vector<std::byte> &bytes, int level) {
  const Deflater deflate(level);
  std::vector<std::byte> stream(deflate.bound(bytes.size()));
  stream.resize(deflate(bytes, stream.data()));
  return stream;
}

// zlib, another program, reads what is written and writes what is read.
TEST(Deflate, IsThatOfZlib) {
  for (const std::size_t n : {0, 1, 1000, 100000})
    for (const int level : {1, 6}) {
      const std::vector<std::byte> bytes = some(n), stream = deflated(bytes, level);
      std::vector<std::byte> back(n + 1);
      uLongf size = back.size();
      ASSERT_EQ(uncompress(reinterpret_cast<Bytef *>(back.data()), &size,
                           reinterpret_cast<const Bytef *>(stream.data()), stream.size()),
                Z_OK);
      back.resize(size);
      EXPECT_EQ(back, bytes);
      std::vector<std::byte> other(compressBound(n));
      size = other.size();
      compress2(reinterpret_cast<Bytef *>(other.data()), &size,
                reinterpret_cast<const Bytef *>(bytes.data()), n, level);
      other.resize(size);
      std::vector<std::byte> again(n);
      EXPECT_TRUE(inflate(other, again));
      EXPECT_EQ(again, bytes);
    }
}

TEST(Deflate, AStreamOfAnotherLengthOrWithAnotherByteIsNone) {
  const std::vector<std::byte> bytes = some(5000);
  std::vector<std::byte> stream = deflated(bytes, 1), room(5000), less(4999), more(5001);
  EXPECT_TRUE(inflate(stream, room));
  EXPECT_FALSE(inflate(stream, less));
  EXPECT_FALSE(inflate(stream, more));
  EXPECT_FALSE(inflate(std::span(stream).first(stream.size() - 5), room));
  EXPECT_FALSE(inflate({}, room));
  stream.back() ^= std::byte{1};  // of the checksum
  EXPECT_FALSE(inflate(stream, room));
}

TEST(Checksum, IsZlibsHoweverItIsDivided) {
  const std::string text = "thermo-piezoelectric";
  const std::uint64_t whole =
      crc32(0, reinterpret_cast<const Bytef *>(text.data()), static_cast<uInt>(text.size()));
  EXPECT_EQ(checksum(0, text), whole);
  for (std::size_t n = 0; n <= text.size(); ++n)
    EXPECT_EQ(checksum(checksum(0, text.substr(0, n)), text.substr(n)), whole);
  EXPECT_EQ(checksum(checksum(0, text), {}), whole);
}

}  // namespace
}  // namespace tourmaline::output
