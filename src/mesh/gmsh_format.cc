#include "mesh/gmsh_format.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>
#include <utility>

#include "case/utf8.h"
#include "tourmaline/error.h"
#include "whole_file.h"

namespace tourmaline::mesh {

namespace {

std::string extension(const std::filesystem::path &file) {
  std::string text = file.extension().string();
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  return text;
}

// libgmsh takes what there is of a file that was cut off.
void check_whole(const std::string &text) {
  if (text.find("$EndNodes") == std::string::npos || text.find("$EndElements") == std::string::npos)
    throw CaseError("is not whole: it does not end its lists of nodes and elements");
}

// Of groups of one dimension with the same name libgmsh keeps the name of one, and the others are
// silently without; longer names it cannot read.
void check_names(const std::string &text) {
  const std::string begin = "$PhysicalNames";
  const std::size_t at = text.find(begin), end = text.find("$EndPhysicalNames");
  if (at == std::string::npos || end == std::string::npos || end < at)
    return;
  std::istringstream section(text.substr(at + begin.size(), end - at - begin.size()));
  std::map<std::pair<int, std::string>, int> tags;
  int dimension = 0, tag = 0;
  std::string rest;
  std::getline(section, rest);
  for (std::getline(section, rest); section >> dimension >> tag && std::getline(section, rest);) {
    const std::size_t first = rest.find('"'), last = rest.rfind('"');
    if (first == last)
      continue;
    const std::string name = rest.substr(first + 1, last - first - 1);
    if (name.size() > 127)
      throw CaseError(fmt::format(
          "has a physical group, {}, whose name has {} bytes; Gmsh reads 127", tag, name.size()));
    const auto [same, is_new] = tags.try_emplace({dimension, name}, tag);
    if (!is_new && same->second != tag && !name.empty())
      throw CaseError(fmt::format(
          "has two physical groups called \"{}\", {} and {}, of which Gmsh would lose the name of "
          "one; make them one group, or give each its own name",
          casefile::readable(name), same->second, tag));
  }
}

Format format_of_msh(const std::filesystem::path &file) {
  std::ifstream in(file, std::ios::binary);
  std::string head;
  double version = 0;
  if (!(in >> head >> version) || head != "$MeshFormat")
    throw CaseError("is no Gmsh file: it does not begin with $MeshFormat");
  const bool old = version >= 2 && version < 3;
  if (!old && !(version >= 4 && version < 5))
    throw CaseError(fmt::format("has Gmsh's format {}; 2.2 and 4.1 can be read", version));
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  check_whole(text);
  check_names(text);
  return old ? Format::msh2 : Format::msh4;
}

// libgmsh does not see what stands behind the last end of a line.
void check_last_line(Format format, const std::string &file) {
  if (format != Format::geo)
    return;
  const std::optional<std::string> text = whole_file(file);
  if (text && !text->empty() && text->back() != '\n')
    throw CaseError("does not end with the end of a line; Gmsh would not see its last line");
}

void check_size(Format format, const casefile::MeshCase &asked) {
  if (format == Format::cad && !asked.size)
    throw CaseError("is a geometry without a mesh; give the size of its cells, mesh.size");
  if (!is_geometry(format) && asked.size)
    throw CaseError("is a mesh already; mesh.size is for geometries (.geo, .step, ...)");
}

}  // namespace

bool is_geometry(Format format) {
  return format == Format::geo || format == Format::cad;
}

Format format_of(const std::filesystem::path &file) {
  const std::string ending = extension(file);
  if (ending == ".msh")
    return format_of_msh(file);
  if (ending == ".geo" || ending == ".geo_unrolled")
    return Format::geo;
  for (const char *cad : {".step", ".stp", ".iges", ".igs", ".brep"})
    if (ending == cad)
      return Format::cad;
  throw CaseError(
      "is of an unknown kind; .msh (mesh), .geo, .step, .stp, .iges, .igs and .brep (geometries) "
      "can be read");
}

void check_asked(Format format, const casefile::MeshCase &asked) {
  check_size(format, asked);
  check_last_line(format, *asked.file);
}

}  // namespace tourmaline::mesh
