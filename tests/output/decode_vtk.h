#pragma once

#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

/// VTK's compressed inline arrays read back, written from VTK's description of the format and slow
/// on purpose.
namespace tourmaline::output {

inline std::string decode_base64(std::string_view text) {
  constexpr std::string_view alphabet =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  unsigned bits = 0;
  int n_bits = 0;
  for (const char c : text.substr(0, text.find('='))) {
    const std::size_t digit = alphabet.find(c);
    EXPECT_NE(digit, std::string_view::npos) << "not base64: " << int(c);
    bits = (bits << 6 | static_cast<unsigned>(digit)) & 0xffff;
    n_bits += 6;
    if (n_bits >= 8) {
      n_bits -= 8;
      bytes += static_cast<char>(bits >> n_bits & 0xff);
    }
  }
  return bytes;
}

template <typename Number>
std::vector<Number> numbers_in(std::string_view bytes) {
  std::vector<Number> numbers(bytes.size() / sizeof(Number));
  if (!numbers.empty())
    std::memcpy(numbers.data(), bytes.data(), numbers.size() * sizeof(Number));
  return numbers;
}

inline std::size_t base64_length(std::size_t bytes) {
  return (bytes + 2) / 3 * 4;
}

/// Number of blocks, bytes of a block, of a shorter last one, and of each block compressed.
inline std::vector<std::uint64_t> vtk_header(std::string_view text) {
  const auto start = numbers_in<std::uint64_t>(decode_base64(text.substr(0, base64_length(24))));
  const std::size_t bytes = 8 * (3 + start.at(0));
  return numbers_in<std::uint64_t>(decode_base64(text.substr(0, base64_length(bytes))));
}

template <typename Number>
std::vector<Number> decode_vtk_binary(std::string_view text) {
  const auto header = vtk_header(text);
  const std::string data = decode_base64(text.substr(base64_length(8 * header.size())));
  std::string bytes;
  std::size_t begin = 0;
  for (std::size_t block = 0; block < header[0]; ++block) {
    const bool shorter = block + 1 == header[0] && header[2] != 0;
    std::string plain(shorter ? header[2] : header[1], '\0');
    uLongf size = plain.size();
    EXPECT_EQ(uncompress(reinterpret_cast<Bytef *>(plain.data()), &size,
                         reinterpret_cast<const Bytef *>(data.data() + begin), header[3 + block]),
              Z_OK);
    EXPECT_EQ(size, plain.size());
    bytes += plain;
    begin += header[3 + block];
  }
  EXPECT_EQ(begin, data.size());
  return numbers_in<Number>(bytes);
}

/// The numbers of the DataArray of that name in a VTU file.
template <typename Number>
std::vector<Number> array_in(std::string_view vtu, const std::string &name) {
  const std::size_t element = vtu.find("Name=\"" + name + "\"");
  if (element == std::string_view::npos) {
    ADD_FAILURE() << "no array " << name;
    return {};
  }
  const std::size_t begin = vtu.find(">\n", element) + 2;
  return decode_vtk_binary<Number>(vtu.substr(begin, vtu.find('\n', begin) - begin));
}

}  // namespace tourmaline::output
