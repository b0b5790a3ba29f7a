#include "mesh_bytes.h"

#include <cstring>
#include <type_traits>

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
};

/// Fills what it visits, in the same order.
class Reader {
 public:
  explicit Reader(const std::string &bytes) : at_(bytes.data()) {}

  template <class T>
  requires std::is_trivially_copyable_v<T>
  void operator()(T &value) {
    std::memcpy(&value, at_, sizeof value);
    at_ += sizeof value;
  }
  template <class T>
  requires std::is_trivially_copyable_v<T>
  void operator()(std::vector<T> &values) {
    values.resize(size());
    if (!values.empty())
      std::memcpy(values.data(), at_, values.size() * sizeof(T));
    at_ += values.size() * sizeof(T);
  }
  void operator()(std::string &text) {
    const std::size_t length = size();
    text.assign(at_, length);
    at_ += length;
  }
  template <class T>
  void operator()(std::vector<T> &values) {
    values.resize(size());
    for (T &value : values)
      (*this)(value);
  }

 private:
  std::size_t size() {
    std::size_t n = 0;
    (*this)(n);
    return n;
  }

  const char *at_;
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
}

}  // namespace

std::string bytes_of(const MeshFile &mesh) {
  Writer writer;
  visit(writer, mesh);
  return std::move(writer.bytes);
}

MeshFile mesh_of(const std::string &bytes) {
  MeshFile mesh;
  Reader reader(bytes);
  visit(reader, mesh);
  return mesh;
}

}  // namespace tourmaline::mesh
