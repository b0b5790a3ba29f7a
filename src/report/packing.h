#pragma once

#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <span>
#include <string>

namespace tourmaline::report {

/// Arrays of numbers as one text for a page: each array is predicted, sorted by bytes, deflated and
/// turned into base64, and described by a JSON object that its reader (web/src/packing.ts) needs:
/// {coding, rows, columns, at, length} and for "levels" {low, step}.
///
/// A value is predicted by the straight line through the two rows before it (rows are moments), in
/// the first row by its neighbour; what differs from that takes few bits.
class Packing {
 public:
  /// Exact: the bits of every value come back. `values` holds rows of equal length.
  nlohmann::json floats(std::span<const float> values, std::size_t rows);
  /// Exact, in one row.
  nlohmann::json integers(std::span<const std::uint32_t> values);
  /// To one of 65535 equal steps between the least and the greatest value, so with an error of at
  /// most half a step, which the description states.
  nlohmann::json levels(std::span<const float> values, std::size_t rows);

  const std::string &text() const { return text_; }

 private:
  nlohmann::json add(const char *coding, std::span<const std::byte> bytes, std::size_t rows,
                     std::size_t columns);

  std::string text_;
};

}  // namespace tourmaline::report
