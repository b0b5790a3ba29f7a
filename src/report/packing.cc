#include "report/packing.h"

#include <algorithm>
#include <bit>
#include <vector>

#include "output/base64.h"
#include "output/deflate.h"

namespace tourmaline::report {
namespace {

/// Higher levels take three times as long to save a hundredth.
constexpr int compression_level = 6;

static_assert(std::endian::native == std::endian::little, "the page reads little-endian numbers");

std::vector<std::byte> deflated(std::span<const std::byte> bytes) {
  const output::Deflater deflate(compression_level);
  std::vector<std::byte> packed(deflate.bound(bytes.size()));
  packed.resize(deflate(bytes, packed.data()));
  return packed;
}

/// Small differences of either sign become small numbers: 0, -1, 1, -2, ... to 0, 1, 2, 3, ...
template <typename Unsigned>
Unsigned folded(Unsigned difference) {
  const bool negative = difference >> (8 * sizeof(Unsigned) - 1);
  return static_cast<Unsigned>(static_cast<Unsigned>(difference << 1) ^
                               (negative ? static_cast<Unsigned>(-1) : Unsigned{0}));
}

/// All lowest bytes, then all next ones: the high bytes are mostly zero.
template <typename Unsigned>
std::vector<std::byte> by_bytes(const std::vector<Unsigned> &words) {
  std::vector<std::byte> bytes;
  bytes.reserve(words.size() * sizeof(Unsigned));
  for (std::size_t b = 0; b < sizeof(Unsigned); ++b)
    for (const Unsigned word : words)
      bytes.push_back(static_cast<std::byte>(word >> (8 * b)));
  return bytes;
}

/// A float's bits as a number that grows with it.
std::uint32_t ordered_bits(float value) {
  const auto bits = std::bit_cast<std::uint32_t>(value);
  return bits >> 31 ? ~bits : bits | 0x80000000U;
}

/// The straight line through the two rows before, or the neighbour in the first row. What is not a
/// number is predicted as 0, as its bits differ between machines.
template <typename Number>
Number predicted(std::span<const Number> values, std::size_t columns, std::size_t i) {
  if (i < columns)
    return i == 0 ? Number{0} : values[i - 1];
  if (i < 2 * columns)
    return values[i - columns];
  const auto line = static_cast<Number>(2 * values[i - columns] - values[i - 2 * columns]);
  return line == line ? line : Number{0};
}

}  // namespace

nlohmann::json Packing::add(const char *coding, std::span<const std::byte> bytes, std::size_t rows,
                            std::size_t columns) {
  const std::size_t at = text_.size();
  output::append_base64(text_, deflated(bytes));
  return {{"coding", coding},
          {"rows", rows},
          {"columns", columns},
          {"at", at},
          {"length", text_.size() - at}};
}

nlohmann::json Packing::floats(std::span<const float> values, std::size_t rows) {
  const std::size_t columns = rows > 0 ? values.size() / rows : 0;
  std::vector<std::uint32_t> words;
  words.reserve(values.size());
  for (std::size_t i = 0; i < values.size(); ++i)
    words.push_back(folded(ordered_bits(values[i]) - ordered_bits(predicted(values, columns, i))));
  return add("floats", by_bytes(words), rows, columns);
}

nlohmann::json Packing::integers(std::span<const std::uint32_t> values) {
  std::vector<std::uint32_t> words;
  words.reserve(values.size());
  for (std::size_t i = 0; i < values.size(); ++i)
    words.push_back(folded(values[i] - (i > 0 ? values[i - 1] : 0)));
  return add("integers", by_bytes(words), 1, values.size());
}

nlohmann::json Packing::levels(std::span<const float> values, std::size_t rows) {
  const std::size_t columns = rows > 0 ? values.size() / rows : 0;
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  const double least = values.empty() ? 0 : *low;
  const double step = values.empty() ? 0 : (static_cast<double>(*high) - least) / 65535;
  std::vector<std::uint16_t> levels;
  levels.reserve(values.size());
  for (const float value : values)
    levels.push_back(static_cast<std::uint16_t>(step > 0 ? (value - least) / step + 0.5 : 0));
  std::vector<std::uint16_t> words;
  words.reserve(values.size());
  for (std::size_t i = 0; i < levels.size(); ++i)
    words.push_back(folded(static_cast<std::uint16_t>(
        levels[i] - predicted(std::span<const std::uint16_t>(levels), columns, i))));
  nlohmann::json description = add("levels", by_bytes(words), rows, columns);
  description["low"] = least;
  description["step"] = step;
  return description;
}

}  // namespace tourmaline::report
