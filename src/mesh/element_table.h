#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace tourmaline::mesh {

/// Finds elements (facets or cells) by their vertices, in whatever order these are listed.
class ElementTable {
 public:
  /// Elements of `vertices_each` (at most 8) vertices, one behind the other.
  ElementTable(std::span<const std::uint32_t> vertices, std::size_t vertices_each);

  /// Indices of all elements with these vertices, ascending.
  std::span<const std::uint32_t> find(std::span<const std::uint32_t> vertices) const;
  /// Calls `visit(indices)` for each different element with the indices of those that are the same.
  template <class Visit>
  void for_each(const Visit &visit) const {
    for (std::size_t begin = 0, end; begin < keys_.size(); begin = end) {
      end = begin + 1;
      while (end < keys_.size() && keys_[end] == keys_[begin])
        ++end;
      visit(std::span(indices_).subspan(begin, end - begin));
    }
  }

 private:
  using Key = std::array<std::uint32_t, 8>;

  static Key key_of(std::span<const std::uint32_t> vertices);

  std::vector<Key> keys_;  // sorted
  std::vector<std::uint32_t> indices_;
};

}  // namespace tourmaline::mesh
