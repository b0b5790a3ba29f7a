#pragma once

#include <filesystem>
#include <string>

#include "../output/temporary_folder.h"
#include "tourmaline/case/reader.h"
#include "tourmaline/run/simulation.h"

namespace tourmaline::report {

/// The folder of a small case in contact, run with `overrides`; it goes away with the object.
class ResultFolder {
 public:
  explicit ResultFolder(std::vector<std::string> overrides, const std::string &cells = "[4, 3]") {
    overrides.push_back("mesh.box.cells=" + cells);
    const auto file =
        std::filesystem::path(TOURMALINE_SOURCE_DIR) / "cases/ouafik-2020/conductive.toml";
    run::simulate(casefile::read_file(file, overrides), path(), {.quiet = true});
  }

  const std::filesystem::path &path() const { return folder_.path(); }
  std::string content(const std::string &file) const { return output::content_of(folder_ / file); }

 private:
  output::TemporaryFolder folder_;
};

}  // namespace tourmaline::report
