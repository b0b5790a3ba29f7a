#include "tourmaline/mesh/gmsh.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <gmsh.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "child_process.h"
#include "mesh/completed.h"
#include "mesh/gmsh_format.h"
#include "mesh/gmsh_listing.h"
#include "mesh_bytes.h"
#include "parallel/ranks.h"
#include "sandbox.h"
#include "tourmaline/error.h"

namespace tourmaline::mesh {

namespace {

using casefile::MeshFile;

// What a geometry may not, for those who wonder why it cannot be read.
constexpr const char *walls =
    "a geometry may not start programs, open connections, write files or read any that do not lie "
    "in its folder; if you trust it, read it with --trust";

/// libgmsh between its start and its end; it keeps one model at a time for the whole process.
class Session {
 public:
  /// `confined`: whether a geometry meets walls, which its errors then tell.
  explicit Session(bool confined) {
    confined_ = confined;
    gmsh::initialize(0, nullptr, false);  // no settings of the user's own: same case, same mesh
    gmsh::option::setNumber("General.Terminal", 0);
    // Newer ones than 4.8 throw at the first error, where what was said before it may be the cause.
    gmsh::option::setNumber("General.AbortOnError", 0);
    gmsh::logger::start();
  }
  ~Session() {
    gmsh::logger::stop();  // what it holds would outlive the session
    gmsh::finalize();
  }
  Session(const Session &) = delete;
  Session &operator=(const Session &) = delete;

  /// Throws CaseError with the first error that libgmsh has reported so far; it goes on after many.
  /// Of nodes and elements that have the same number it keeps one, and says so at most.
  static void check() {
    std::vector<std::string> log;
    gmsh::logger::get(log);
    for (const std::string &line : log) {
      if (line.starts_with("Error"))
        throw CaseError("Gmsh says: " + line + hint(line));
      for (const char *kind : {"node", "element"})
        if (const auto at = line.find(fmt::format("Skipping duplicate {} ", kind));
            at != std::string::npos)
          throw CaseError(fmt::format("lists two {0}s with the number {1}; every {0} has its own",
                                      kind, line.substr(line.find_last_of(' ') + 1)));
    }
  }

 private:
  static std::string hint(const std::string &line) {
    const bool file = line.find("open file") != std::string::npos;
    return file && confined_ ? "; " + std::string(walls) : "";
  }

  inline static bool confined_ = false;
};

// Solids that touch get common faces, so that they are bonded.
void join_solids() {
  gmsh::vectorpair solids;
  gmsh::model::getEntities(solids, gmsh::model::getDimension());
  if (solids.size() < 2)
    return;
  gmsh::model::occ::removeAllDuplicates();
  gmsh::model::occ::synchronize();
}

// libgmsh would leave the cells as they are.
void check_not_meshed() {
  std::vector<int> types;
  std::vector<std::vector<std::size_t>> tags, nodes;
  gmsh::model::mesh::getElements(types, tags, nodes, gmsh::model::getDimension());
  if (!types.empty())
    throw CaseError(
        "makes or merges a mesh itself, on which mesh.size has no effect; leave out "
        "mesh.size");
}

// Area or volume of an entity; without that of CAD's kernel a tenth of the box about it, which
// bodies with holes or thin walls may not fill either.
double measure(int dimension, int tag) {
  gmsh::vectorpair of_cad;
  gmsh::model::occ::getEntities(of_cad, dimension);
  if (std::find(of_cad.begin(), of_cad.end(), std::pair(dimension, tag)) != of_cad.end()) {
    double mass = 0;
    gmsh::model::occ::getMass(dimension, tag, mass);
    return mass;
  }
  double least[3], most[3];
  gmsh::model::getBoundingBox(dimension, tag, least[0], least[1], least[2], most[0], most[1],
                              most[2]);
  double size = 0.1;
  for (int axis = 0; axis < dimension; ++axis)
    size *= most[axis] - least[axis];
  return size;
}

// A size in metres beside a file in millimetres makes 1e6 or 1e9 times as many cells as were meant,
// and libgmsh would mesh until a limit ends it. `bytes` is that of memory; the program alone needs
// so much for a simplex (docs/architecture.md).
void check_size_is_possible(const casefile::MeshCase &asked, double bytes) {
  const int dimension = gmsh::model::getDimension();
  gmsh::vectorpair entities;
  gmsh::model::getEntities(entities, dimension);
  double size = 0;
  for (const auto &[of, tag] : entities)
    size += measure(of, tag);
  // regular triangles and tetrahedra with edges of that size
  const double cell =
      (dimension == 2 ? std::sqrt(3) / 4 : std::sqrt(2) / 12) * std::pow(*asked.size, dimension);
  const double bytes_per_cell = dimension == 2 ? 290 : 480;
  const double most = std::min(2147483647., bytes / bytes_per_cell);
  if (size / cell > most)
    throw CaseError(
        fmt::format("would have about {:.1g} cells with mesh.size = {:g}, and no more than {:.1g} "
                    "fit; mesh.size "
                    "is in the unit of the file, which is mesh.scale = {:g} m: give it larger",
                    size / cell, *asked.size, most, asked.scale));
}

void generate(Format format, const casefile::MeshCase &asked, double bytes) {
  if (format == Format::cad)
    join_solids();
  if (asked.size) {
    check_not_meshed();
    check_size_is_possible(asked, bytes);
    gmsh::option::setNumber("Mesh.MeshSizeMax", *asked.size);
  }
  // Whatever the geometry asks for: on several threads libgmsh 4.8 crashes now and then.
  for (const char *threads : {"General.NumThreads", "Mesh.MaxNumThreads1D", "Mesh.MaxNumThreads2D",
                              "Mesh.MaxNumThreads3D"})
    gmsh::option::setNumber(threads, 1);
  gmsh::model::mesh::generate(gmsh::model::getDimension());
}

// libgmsh obeys a file of options that lies beside a mesh (body.msh.opt), and such options may run
// commands. By this name of the same file there is nothing beside it.
std::string without_options(const std::string &file) {
  const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0)
    throw CaseError(fmt::format("cannot be opened: {}", std::strerror(errno)));
  return fmt::format("/proc/self/fd/{}", descriptor);
}

void load(Format format, const casefile::MeshCase &asked, double bytes) {
  // A format-2 file may give elements of one entity to different groups, which libgmsh would give
  // to all of them. With the two tags switched an entity is a group.
  gmsh::option::setNumber("Mesh.SwitchElementTags", format == Format::msh2 ? 1 : 0);
  // CAD files know their unit.
  if (format == Format::cad)
    gmsh::option::setString("Geometry.OCCTargetUnit", "M");
  if (is_geometry(format))
    gmsh::open(*asked.file);
  else
    gmsh::merge(without_options(*asked.file));
  Session::check();
  if (is_geometry(format))
    generate(format, asked, bytes);
  Session::check();
}

MeshFile read_with_libgmsh(Format format, const casefile::MeshCase &asked, bool confined,
                           double bytes) {
  const Session session(confined);
  try {
    load(format, asked, bytes);
    return listed(format, asked);
  } catch (const std::string &error) {  // libgmsh's own kind of exception
    Session::check();
    throw CaseError("Gmsh says: " + error);
  }
}

// A mesh is read in a time that grows with its size. By the clock anything takes longer on a busy
// machine, but nothing sleeps for
// long.
Limits limits_of(Format format, const std::string &file, const Reading &how) {
  Limits limits;
  if (is_geometry(format) && how.trusted)
    return limits;
  constexpr double least = 30, bytes_per_second = 1e5;
  limits.processor_seconds =
      is_geometry(format)
          ? how.seconds_of_geometry
          : least + static_cast<double>(std::filesystem::file_size(file)) / bytes_per_second;
  limits.seconds = 5 * limits.processor_seconds + least;
  limits.idle_seconds = how.idle_seconds;
  // A script may ask for any amount: half of the machine is left to others.
  limits.bytes = (is_geometry(format) ? 0.5 : 1) * static_cast<double>(sysconf(_SC_PHYS_PAGES)) *
                 static_cast<double>(sysconf(_SC_PAGESIZE));
  return limits;
}

std::string complaint_about(Format format, const Limits &limits, Ending ending) {
  if (ending == Ending::forbidden)
    return fmt::format("wants to start a program; {}", walls);
  if (ending == Ending::waiting)
    return fmt::format(
        "could not be read: for {:g} s nothing came from it, or from a file that it includes, as "
        "from a pipe that nobody writes to or from a disk that does not answer",
        limits.idle_seconds);
  if (is_geometry(format) && ending == Ending::out_of_time)
    return fmt::format(
        "is a geometry that does not come to an end within {:g} s of a processor; give larger "
        "cells (mesh.size is in the unit of the file, which is mesh.scale), mesh it with Gmsh and "
        "name the mesh (.msh), or, if you trust it, read it with --trust, which sets no limit",
        limits.processor_seconds);
  if (is_geometry(format) && ending == Ending::out_of_memory)
    return "is a geometry whose script or mesh takes more than half of the memory; larger cells "
           "take less (mesh.size is in the unit of the file, which is mesh.scale), or, if you "
           "trust it, read it with --trust, which sets no limit";
  if (is_geometry(format) && ending == Ending::silent)
    return "is a geometry whose script ends without making a mesh";
  const std::string text = "cannot be read, it may be damaged: the library that reads it ";
  switch (ending) {
    case Ending::out_of_time:
      return text + "does not come to an end on it";
    case Ending::out_of_memory:
      return text + "takes more memory than there is";
    case Ending::silent:
      return text + "ended without a word";
    default:
      return text + "crashed on it";
  }
}

// A mesh is data, and read with what walls there are; a geometry is a program, and needs them all.
void build_walls(Format format, const std::filesystem::path &file, const Reading &how) {
  std::vector<std::filesystem::path> readable{std::filesystem::canonical(file)};
  Walls walls_to_build = how.walls;
  if (is_geometry(format))
    readable.push_back(file.parent_path());
  else
    walls_to_build.namespaces = false;  // without_options() could not be seen in them
  const Walls stand = confine(readable, walls_to_build);
  if (!is_geometry(format) || stand.complete())
    return;
  throw CaseError(fmt::format(
      "is a geometry, whose script could do anything: the kernel of this machine offers no {} to "
      "keep it from that (containers and old kernels may lack it). Mesh it with Gmsh and name the "
      "mesh (.msh), or, if you trust it, read it with --trust",
      stand.seccomp ? "Landlock and no namespaces" : "seccomp"));
}

MeshFile read(const casefile::MeshCase &asked, const Reading &how) {
  const Format format = format_of(*asked.file);
  check_asked(format, asked);
  const Limits limits = limits_of(format, *asked.file, how);
  const bool confined = !(is_geometry(format) && how.trusted);
  // libgmsh crashes on many a damaged file.
  return mesh_of(in_child_process(
      [&] {
        if (confined)
          build_walls(format, *asked.file, how);
        return bytes_of(
            read_with_libgmsh(format, asked, confined && is_geometry(format), limits.bytes));
      },
      limits, [&](Ending ending) { return complaint_about(format, limits, ending); }));
}

double longest_edge(const MeshFile &mesh) {
  double longest = 0;
  const std::size_t each = mesh.vertices_per_cell();
  for (std::size_t cell = 0; cell < mesh.n_cells(); ++cell)
    for (std::size_t i = 0; i < each; ++i)
      for (std::size_t j = 0; j < i; ++j) {
        const auto &a = mesh.points[mesh.cells[cell * each + i]];
        const auto &b = mesh.points[mesh.cells[cell * each + j]];
        longest = std::max(longest, std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]));
      }
  return longest;
}

// Where a size decides, a line is divided into parts longer than half of it, unless the line itself
// is shorter.
void check_size_decided(const casefile::MeshCase &asked, const MeshFile &mesh) {
  if (!asked.size)
    return;
  const double longest = longest_edge(mesh) / asked.scale;
  if (longest < 0.5 * *asked.size)
    throw CaseError(fmt::format(
        "has no cell longer than {:.3g} in its own unit (mesh.scale = {:g} m), so that mesh.size = "
        "{:g} has no effect: the geometry asks for smaller cells itself, or is smaller. Leave out "
        "mesh.size, or give a smaller one in the unit of the file",
        longest, asked.scale, *asked.size));
}

std::shared_ptr<const MeshFile> read_file(casefile::MeshCase asked, const Reading &how) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(*asked.file, ignored))
    throw CaseError(std::filesystem::exists(*asked.file, ignored) ? "is no regular file"
                                                                  : "there is no such file");
  if (!std::ifstream(*asked.file))
    throw CaseError("cannot be read");
  asked.file = std::filesystem::absolute(*asked.file).string();
  auto mesh = std::make_shared<const MeshFile>(completed(read(asked, how)));
  check_size_decided(asked, *mesh);
  return mesh;
}

// One rank reads: libgmsh takes much more memory than the mesh, and all are to have the same one.
std::shared_ptr<const MeshFile> read_for_all(const casefile::MeshCase &asked, const Reading &how) {
  std::shared_ptr<const MeshFile> mesh;
  std::string bytes;
  parallel::on_first([&] {
    mesh = read_file(asked, how);
    if (parallel::n_ranks() > 1)
      bytes = bytes_of(*mesh);
  });
  parallel::from_first(bytes);
  if (!mesh)
    mesh = std::make_shared<const MeshFile>(mesh_of(bytes));
  return mesh;
}

}  // namespace

std::shared_ptr<const MeshFile> read_mesh_file(const casefile::MeshCase &asked) {
  return read_for_all(asked, {});
}

casefile::MeshFileReader mesh_file_reader(const Reading &how) {
  return [how](const casefile::MeshCase &asked) { return read_for_all(asked, how); };
}

}  // namespace tourmaline::mesh
