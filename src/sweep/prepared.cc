#include "prepared.h"

#include <algorithm>
#include <map>
#include <thread>
#include <tuple>

#include "tourmaline/case/reader.h"
#include "tourmaline/case/resolved.h"
#include "tourmaline/error.h"
#include "tourmaline/mesh/gmsh.h"
#include "tourmaline/report/text_file.h"
#include "tourmaline/solve/available_memory.h"
#include "tourmaline/solve/memory.h"
#include "tourmaline/solve/simulation.h"

namespace tourmaline::sweep {

namespace {

namespace fs = std::filesystem;

/// Reads each mesh file once, however many members have it.
class Meshes {
 public:
  explicit Meshes(bool trusted) : reader_(mesh::mesh_file_reader({.trusted = trusted})) {}

  std::shared_ptr<const casefile::MeshFile> read(const casefile::MeshCase &mesh) {
    auto &content = known_[{*mesh.file, mesh.size.value_or(0), mesh.scale, mesh.unnamed}];
    if (!content)
      content = reader_(mesh);
    return content;
  }

 private:
  casefile::MeshFileReader reader_;
  std::map<std::tuple<std::string, double, double, std::string>,
           std::shared_ptr<const casefile::MeshFile>>
      known_;
};

std::vector<fs::path> files_named_in(const casefile::Case &asked) {
  std::vector<fs::path> files;
  const auto add = [&](const std::optional<std::string> &file) {
    if (file)
      files.emplace_back(*file);
  };
  add(asked.mesh.file);
  add(asked.material.file);
  for (const casefile::RegionCase &region : asked.regions)
    add(region.material.file);
  return files;
}

double memory_of(const casefile::Case &asked) {
  return solve::solves_iteratively(asked) ? solve::iterative_memory(asked)
                                          : solve::factorised_memory(asked);
}

}  // namespace

std::vector<Prepared> prepared(const Request &request, const std::vector<Variation> &variations,
                               const std::vector<Member> &members) {
  Meshes meshes(request.trust);
  std::vector<Prepared> all;
  for (const Member &member : members) {
    std::vector<std::string> overrides = request.overrides;
    for (const std::string &value : overrides_of(variations, member))
      overrides.push_back(value);
    try {
      casefile::Case asked =
          casefile::read_file(request.file, overrides,
                              [&](const casefile::MeshCase &mesh) { return meshes.read(mesh); });
      solve::check(asked);
      std::string resolved = casefile::resolved(asked);
      all.push_back({std::move(asked), std::move(resolved)});
    } catch (const CaseError &error) {
      const std::string text = error.what();
      // What is wrong in the first one, and is no value of a study's, is wrong in the case file.
      if (all.empty() && !text.starts_with("--set"))
        throw;
      throw CaseError(text + " (in the case " + member.name +
                      " of the study; nothing has been run)");
    }
  }
  return all;
}

bool is_done(const fs::path &folder, const Prepared &member) {
  std::error_code error;
  const fs::path summary = folder / "summary.json", resolved = folder / "resolved.toml";
  const auto finished = fs::last_write_time(summary, error);
  if (error || !fs::exists(folder / "history.csv", error) || !fs::exists(resolved, error) ||
      report::read_text_file(resolved) != member.resolved)
    return false;
  const std::vector<fs::path> files = files_named_in(member.asked);
  return std::none_of(files.begin(), files.end(), [&](const fs::path &file) {
    return fs::last_write_time(file, error) > finished;
  });
}

bool was_interrupted(const fs::path &folder, const Prepared &member) {
  std::error_code error;
  return fs::exists(folder / "checkpoint.bin", error) &&
         fs::exists(folder / "resolved.toml", error) &&
         report::read_text_file(folder / "resolved.toml") == member.resolved;
}

std::size_t jobs_for(const std::vector<Prepared> &members) {
  int threads = 1;
  double memory = 0;
  for (const Prepared &member : members) {
    threads = std::max(threads, member.asked.solver.threads);
    memory = std::max(memory, memory_of(member.asked));
  }
  const double by_cores = static_cast<double>(std::thread::hardware_concurrency()) / threads;
  const double by_memory = solve::available_memory().bytes / memory;
  return static_cast<std::size_t>(
      std::clamp(std::min(by_cores, by_memory), 1., static_cast<double>(members.size())));
}

}  // namespace tourmaline::sweep
