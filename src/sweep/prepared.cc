#include "prepared.h"

#include <algorithm>
#include <exception>
#include <map>
#include <thread>
#include <tuple>

#include "output/checkpoint.h"
#include "parallel/available_memory.h"
#include "run/memory.h"
#include "run/resumption.h"
#include "tourmaline/case/reader.h"
#include "tourmaline/error.h"
#include "tourmaline/mesh/gmsh.h"
#include "tourmaline/run/simulation.h"

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

double memory_of(const casefile::Case &asked) {
  return run::solves_iteratively(asked) ? run::iterative_memory(asked)
                                        : run::factorised_memory(asked);
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
      run::check(asked);
      all.push_back({std::move(asked)});
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

namespace {

// What --resume would be refused for; with it the run itself would look the same way.
Found found_behind(const run::Resumption &resumption) {
  if (resumption.is_complete())
    return {Found::State::done, ""};
  const bool goes_on = resumption.has_all_steps || resumption.checkpoint;
  return {goes_on ? Found::State::interrupted : Found::State::nothing, ""};
}

// Why --resume would refuse, without its advice.
std::string obstacle(const fs::path &checkpoint, const Prepared &member,
                     const std::string &refusal) {
  try {
    std::string changed =
        run::differences(output::read_checkpoint(checkpoint).inputs, run::inputs_of(member.asked));
    if (!changed.empty())
      return changed;
  } catch (const MachineError &) {
    // The refusal says so.
  }
  return refusal.substr(0, refusal.find(';'));
}

}  // namespace

Found found_in(const fs::path &folder, const Prepared &member) {
  const fs::path checkpoint = folder / output::checkpoint_name;
  std::error_code error;
  const bool was_interrupted = fs::exists(checkpoint, error);
  try {
    return found_behind(run::resumption(member.asked, folder));
  } catch (const std::exception &refusal) {
    // A complete run of another case makes room without a word, as that of a run does.
    return {Found::State::nothing,
            was_interrupted ? obstacle(checkpoint, member, refusal.what()) : ""};
  }
}

std::size_t jobs_for(const std::vector<Prepared> &members) {
  int threads = 1;
  double memory = 0;
  for (const Prepared &member : members) {
    threads = std::max(threads, member.asked.solver.threads);
    memory = std::max(memory, memory_of(member.asked));
  }
  const double by_cores = static_cast<double>(std::thread::hardware_concurrency()) / threads;
  const double by_memory = parallel::available_memory().bytes / memory;
  return static_cast<std::size_t>(
      std::clamp(std::min(by_cores, by_memory), 1., static_cast<double>(members.size())));
}

}  // namespace tourmaline::sweep
