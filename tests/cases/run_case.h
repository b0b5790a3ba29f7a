#pragma once

#include <nlohmann/json.hpp>

#include "../output/temporary_folder.h"
#include "read_table.h"
#include "tourmaline/case/reader.h"
#include "tourmaline/mesh/gmsh.h"
#include "tourmaline/run/simulation.h"

namespace tourmaline::verified {

/// A case of the repository, run with overrides into a folder that goes away with the object.
class RunCase {
 public:
  RunCase(const std::string &file, std::vector<std::string> overrides = {}) {
    overrides.push_back("output.fields=false");
    run(casefile::read_file(std::filesystem::path(TOURMALINE_SOURCE_DIR) / file, overrides,
                            mesh::read_mesh_file));
  }
  RunCase(const casefile::Case &asked) { run(asked); }

  Table nodes() const { return read_table(folder_ / "nodes.csv"); }
  Table contact() const { return read_table(folder_ / "contact.csv"); }
  Table history() const { return read_table(folder_ / "history.csv"); }
  nlohmann::json summary() const {
    std::ifstream in(folder_ / "summary.json");
    return nlohmann::json::parse(in);
  }
  const std::filesystem::path &folder() const { return folder_.path(); }

 private:
  void run(const casefile::Case &asked) { run::simulate(asked, folder_.path(), {.quiet = true}); }

  output::TemporaryFolder folder_;
};

/// A case that writes tables only; its files stand in `folder`.
inline RunCase run_text(const std::string &text, const std::vector<std::string> &overrides = {},
                        const std::filesystem::path &folder = ".") {
  return RunCase(casefile::read_text("output = { fields = false, report = false }\n" + text,
                                     folder / "case.toml", overrides, mesh::read_mesh_file));
}

}  // namespace tourmaline::verified
