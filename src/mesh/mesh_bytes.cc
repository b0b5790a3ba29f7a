#include "mesh_bytes.h"

#include <algorithm>
#include <cstring>
#include <type_traits>

#include "tourmaline/error.h"

namespace tourmaline::mesh {

namespace {

using casefile::Groups;
using casefile::MeshFile;

/// Appends what it visits.
class Writer {
 public:
  std::string bytes;

  template <class T>
  requires std::is_trivially_copyable_v<T>
  void operator()(const T &value) {
    bytes.append(reinterpret_cast<const char *>(&value), sizeof value);
  }
  template <class T>
  requires std::is_trivially_copyable_v<T>
  void operator()(const std::vector<T> &values) {
    (*this)(values.size());
    bytes.append(reinterpret_cast<const char *>(values.data()), values.size() * sizeof(T));
  }
  void operator()(const std::string &text) {
    (*this)(text.size());
    bytes += text;
  }
  template <class T>
  void operator()(const std::vector<T> &values) {
    (*this)(values.size());
    for (const T &value : values)
      (*this)(value);
  }
  void operator()(const std::vector<bool> &values) {
    (*this)(std::vector<char>(values.begin(), values.end()));
  }
};

[[noreturn]] void fail_damaged() {
  throw CaseError("cannot be read: the process that reads it sent what is no mesh");
}

/// Fills what it visits, in the same order. Throws CaseError where the bytes come to an end.
class Reader {
 public:
  explicit Reader(const std::string &bytes)
      : at_(bytes.data()), end_(bytes.data() + bytes.size()) {}

  template <class T>
  requires std::is_trivially_copyable_v<T>
  void operator()(T &value) { std::memcpy(&value, taken(1, sizeof value), sizeof value); }
  template <class T>
  requires std::is_trivially_copyable_v<T>
  void operator()(std::vector<T> &values) {
    const std::size_t n = size();
    const char *bytes = taken(n, sizeof(T));
    values.resize(n);
    if (n > 0)
      std::memcpy(values.data(), bytes, n * sizeof(T));
  }
  void operator()(std::string &text) {
    const std::size_t length = size();
    text.assign(taken(length, 1), length);
  }
  template <class T>
  void operator()(std::vector<T> &values) {
    const std::size_t n = size();
    if (n > static_cast<std::size_t>(end_ - at_))  // each has a byte at least
      fail_damaged();
    values.resize(n);
    for (T &value : values)
      (*this)(value);
  }
  void operator()(std::vector<bool> &values) {
    std::vector<char> bytes;
    (*this)(bytes);
    values.assign(bytes.begin(), bytes.end());
  }
  bool is_at_end() const { return at_ == end_; }

 private:
  std::size_t size() {
    std::size_t n = 0;
    (*this)(n);
    return n;
  }

  const char *taken(std::size_t n, std::size_t bytes_each) {
    if (n > static_cast<std::size_t>(end_ - at_) / bytes_each)
      fail_damaged();
    at_ += n * bytes_each;
    return at_ - n * bytes_each;
  }

  const char *at_, *end_;
};

template <class Visitor, class Mesh>
void visit(Visitor &v, Mesh &mesh) {
  v(mesh.dimension);
  v(mesh.cell);
  v(mesh.points);
  v(mesh.cells);
  v(mesh.facets);
  for (auto *groups : {&mesh.regions, &mesh.boundaries}) {
    v(groups->names);
    v(groups->sets);
    v(groups->set_of);
  }
  v(mesh.inside);
}

}  // namespace

std::string bytes_of(const MeshFile &mesh) {
  Writer writer;
  visit(writer, mesh);
  return std::move(writer.bytes);
}

namespace {

bool all_below(const auto &indices, std::size_t size) {
  return std::all_of(indices.begin(), indices.end(),
                     [&](auto i) { return static_cast<std::size_t>(i) < size; });
}

bool is_consistent(const Groups &groups, std::size_t n_elements) {
  return !groups.sets.empty() && groups.set_of.size() == n_elements &&
         all_below(groups.set_of, groups.sets.size()) &&
         std::all_of(groups.sets.begin(), groups.sets.end(),
                     [&](const auto &set) { return all_below(set, groups.names.size()); });
}

bool is_consistent(const MeshFile &mesh) {
  const auto shape = static_cast<int>(mesh.cell);
  return shape >= 0 && shape < 4 && mesh.dimension == (shape < 2 ? 2 : 3) && !mesh.cells.empty() &&
         mesh.cells.size() % mesh.vertices_per_cell() == 0 &&
         mesh.facets.size() % mesh.vertices_per_facet() == 0 &&
         all_below(mesh.cells, mesh.points.size()) && all_below(mesh.facets, mesh.points.size()) &&
         is_consistent(mesh.regions, mesh.n_cells()) &&
         is_consistent(mesh.boundaries, mesh.n_facets()) &&
         (mesh.inside.empty() || mesh.inside.size() == mesh.n_facets());
}

}  // namespace

MeshFile mesh_of(const std::string &bytes) {
  MeshFile mesh;
  Reader reader(bytes);
  visit(reader, mesh);
  if (!reader.is_at_end() || !is_consistent(mesh))
    fail_damaged();
  return mesh;
}

}  // namespace tourmaline::mesh
