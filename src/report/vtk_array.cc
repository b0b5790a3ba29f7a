#include "report/vtk_array.h"

#include <array>
#include <cstdint>
#include <cstring>

#include "output/deflate.h"
#include "tourmaline/error.h"

namespace tourmaline::report {
namespace {

[[noreturn]] void damaged(const std::string &name) {
  throw CaseError(name + ": a data array is damaged; run the case again");
}

std::array<std::int8_t, 256> digits() {
  std::array<std::int8_t, 256> value;
  value.fill(-1);
  constexpr std::string_view alphabet =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  for (std::size_t i = 0; i < alphabet.size(); ++i)
    value[static_cast<unsigned char>(alphabet[i])] = static_cast<std::int8_t>(i);
  return value;
}

/// Decodes one base64 text and moves `text` behind it: padding ends it.
std::vector<unsigned char> take_base64(std::string_view &text, std::size_t bytes,
                                       const std::string &name) {
  static const std::array<std::int8_t, 256> value = digits();
  const std::size_t characters = (bytes + 2) / 3 * 4;
  if (text.size() < characters)
    damaged(name);
  std::vector<unsigned char> decoded;
  decoded.reserve(bytes + 2);
  for (std::size_t i = 0; i < characters; i += 4) {
    std::uint32_t group = 0;
    for (std::size_t j = i; j < i + 4; ++j) {
      const int digit = text[j] == '=' ? 0 : value[static_cast<unsigned char>(text[j])];
      if (digit < 0)
        damaged(name);
      group = group << 6 | static_cast<std::uint32_t>(digit);
    }
    for (const int shift : {16, 8, 0})
      decoded.push_back(static_cast<unsigned char>(group >> shift));
  }
  decoded.resize(bytes);
  text.remove_prefix(characters);
  return decoded;
}

std::vector<std::uint64_t> take_words(std::string_view &text, std::size_t n,
                                      const std::string &name) {
  const std::vector<unsigned char> bytes = take_base64(text, 8 * n, name);
  std::vector<std::uint64_t> words(n);
  std::memcpy(words.data(), bytes.data(), bytes.size());
  return words;
}

template <typename Number>
std::vector<double> numbers(const std::vector<unsigned char> &bytes) {
  std::vector<double> values(bytes.size() / sizeof(Number));
  for (std::size_t i = 0; i < values.size(); ++i) {
    Number number;
    std::memcpy(&number, &bytes[i * sizeof(Number)], sizeof(Number));
    values[i] = static_cast<double>(number);
  }
  return values;
}

std::vector<double> numbers(const std::vector<unsigned char> &bytes, const std::string &type,
                            const std::string &name) {
  if (type == "Float64")
    return numbers<double>(bytes);
  if (type == "Float32")
    return numbers<float>(bytes);
  if (type == "Int64")
    return numbers<std::int64_t>(bytes);
  if (type == "Int32")
    return numbers<std::int32_t>(bytes);
  if (type == "UInt8")
    return numbers<std::uint8_t>(bytes);
  throw CaseError(name + ": a data array has the type \"" + type + "\", which is not read here");
}

/// VTK's header: number of blocks, bytes in a block, bytes in the last one (0: whole), compressed
/// bytes of each.
struct Header {
  std::uint64_t block_bytes = 0, last_bytes = 0;
  std::vector<std::uint64_t> compressed;

  std::size_t bytes(std::size_t block) const {
    return block + 1 == compressed.size() && last_bytes > 0 ? last_bytes : block_bytes;
  }
};

Header take_header(std::string_view &text, const std::string &name) {
  std::string_view ahead = text;
  const std::uint64_t blocks = take_words(ahead, 1, name)[0];
  if (blocks > text.size())
    damaged(name);
  const std::vector<std::uint64_t> words = take_words(text, blocks + 3, name);
  Header header{words[1], words[2], {words.begin() + 3, words.end()}};
  // Deflate packs at most 1032 bytes into one.
  for (std::size_t i = 0; i < header.compressed.size(); ++i)
    if (header.compressed[i] > text.size() || header.bytes(i) > 1032 * (header.compressed[i] + 1))
      damaged(name);
  return header;
}

}  // namespace

std::vector<double> read_vtk_binary(std::string_view text, const std::string &type,
                                    const std::string &name) {
  const std::size_t begin = text.find_first_not_of(" \t\r\n");
  if (begin == std::string_view::npos)
    damaged(name);
  text.remove_prefix(begin);
  const Header header = take_header(text, name);
  std::size_t compressed_bytes = 0, bytes = 0;
  for (std::size_t i = 0; i < header.compressed.size(); ++i) {
    compressed_bytes += header.compressed[i];
    bytes += header.bytes(i);
  }
  const std::vector<unsigned char> compressed = take_base64(text, compressed_bytes, name);
  std::vector<unsigned char> plain(bytes);
  auto from = std::as_bytes(std::span(compressed));
  auto to = std::as_writable_bytes(std::span(plain));
  for (std::size_t i = 0; i < header.compressed.size(); ++i) {
    if (!output::inflate(from.first(header.compressed[i]), to.first(header.bytes(i))))
      damaged(name);
    from = from.subspan(header.compressed[i]);
    to = to.subspan(header.bytes(i));
  }
  return numbers(plain, type, name);
}

}  // namespace tourmaline::report
