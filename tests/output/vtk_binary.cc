#include "output/vtk_binary.h"

#include <gtest/gtest.h>

#include <string_view>

#include "decode_vtk.h"
#include "output/base64.h"

namespace tourmaline::output {
namespace {

std::string base64(std::string_view text) {
  std::string encoded;
  append_base64(encoded, std::as_bytes(std::span(text)));
  return encoded;
}

TEST(Base64, TheExamplesOfTheStandardHold) {
  // RFC 4648, section 10.
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("foob"), "Zm9vYg==");
  EXPECT_EQ(base64("fooba"), "Zm9vYmE=");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
}

TEST(Base64, EveryByteIsEncoded) {
  EXPECT_EQ(base64("\xff\xfe\xfd"), "//79");
  EXPECT_EQ(base64(std::string_view("\0\x10\x83", 3)), "ABCD");
}

std::vector<double> numbers(std::size_t n) {
  std::vector<double> list(n);
  for (std::size_t i = 0; i < n; ++i)
    list[i] = 1. / double(i + 1);
  return list;
}

std::string encoded(const std::vector<double> &list) {
  return vtk_binary(std::as_bytes(std::span(list)));
}

TEST(VtkBinary, WhatWasPutInComesOut) {
  // One number; less than a block (4096 numbers); exactly one; a little more; enough for several
  // threads, with and without a shorter block at the end.
  for (const std::size_t n : {1, 4095, 4096, 4097, 40 * 4096, 200 * 4096, 200 * 4096 + 5})
    EXPECT_EQ(decode_vtk_binary<double>(encoded(numbers(n))), numbers(n)) << n << " numbers";
}

TEST(VtkBinary, AnEmptyArrayHasNoBlocks) {
  EXPECT_EQ(vtk_header(encoded({})), (std::vector<std::uint64_t>{0, 32768, 0}));
}

TEST(VtkBinary, TheLastBlockIsDeclaredShorterOnlyIfItIs) {
  const auto whole = vtk_header(encoded(numbers(2 * 4096)));
  EXPECT_EQ(whole[0], 2u);
  EXPECT_EQ(whole[2], 0u);
  const auto rest = vtk_header(encoded(numbers(2 * 4096 + 3)));
  EXPECT_EQ(rest[0], 3u);
  EXPECT_EQ(rest[2], 24u);
}

}  // namespace
}  // namespace tourmaline::output
