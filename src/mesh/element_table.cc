#include "mesh/element_table.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace tourmaline::mesh {

ElementTable::Key ElementTable::key_of(std::span<const std::uint32_t> vertices) {
  Key key;
  key.fill(std::numeric_limits<std::uint32_t>::max());
  std::copy(vertices.begin(), vertices.end(), key.begin());
  std::sort(key.begin(), key.end());
  return key;
}

ElementTable::ElementTable(std::span<const std::uint32_t> vertices, std::size_t vertices_each) {
  std::vector<Key> unsorted;
  for (std::size_t at = 0; at < vertices.size(); at += vertices_each)
    unsorted.push_back(key_of(vertices.subspan(at, vertices_each)));
  indices_.resize(unsorted.size());
  std::iota(indices_.begin(), indices_.end(), 0);
  std::sort(indices_.begin(), indices_.end(), [&](std::uint32_t a, std::uint32_t b) {
    return unsorted[a] != unsorted[b] ? unsorted[a] < unsorted[b] : a < b;
  });
  for (const std::uint32_t index : indices_)
    keys_.push_back(unsorted[index]);
}

std::span<const std::uint32_t> ElementTable::find(std::span<const std::uint32_t> vertices) const {
  const auto [begin, end] = std::equal_range(keys_.begin(), keys_.end(), key_of(vertices));
  return std::span(indices_).subspan(static_cast<std::size_t>(begin - keys_.begin()),
                                     static_cast<std::size_t>(end - begin));
}

}  // namespace tourmaline::mesh
