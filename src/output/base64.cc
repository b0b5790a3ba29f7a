#include "output/base64.h"

#include <array>
#include <cstdint>

namespace tourmaline::output {
namespace {

constexpr char alphabet[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

/// The two characters of every 12-bit number: half of a group of three bytes in one look-up.
constexpr auto pairs = [] {
  std::array<std::array<char, 2>, 4096> table{};
  for (std::size_t i = 0; i < table.size(); ++i)
    table[i] = {alphabet[i >> 6], alphabet[i & 63]};
  return table;
}();

/// Up to three bytes as a 24-bit number, missing ones as zero.
std::uint32_t group(std::span<const std::byte> bytes) {
  std::uint32_t number = 0;
  for (std::size_t i = 0; i < 3; ++i)
    number = number << 8 | (i < bytes.size() ? std::to_integer<std::uint32_t>(bytes[i]) : 0u);
  return number;
}

void put_group(char *to, std::uint32_t number) {
  const auto &high = pairs[number >> 12], &low = pairs[number & 4095];
  to[0] = high[0];
  to[1] = high[1];
  to[2] = low[0];
  to[3] = low[1];
}

}  // namespace

void append_base64(std::string &text, std::span<const std::byte> bytes) {
  const std::size_t old_size = text.size(), rest = bytes.size() % 3;
  text.resize(old_size + (bytes.size() + 2) / 3 * 4);
  char *to = text.data() + old_size;
  for (; bytes.size() >= 3; bytes = bytes.subspan(3), to += 4)
    put_group(to, group(bytes.first(3)));
  if (rest == 0)
    return;
  put_group(to, group(bytes));
  for (std::size_t i = rest + 1; i < 4; ++i)
    to[i] = '=';
}

}  // namespace tourmaline::output
