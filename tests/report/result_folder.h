#pragma once

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "tourmaline/case/reader.h"
#include "tourmaline/solve/simulation.h"

namespace tourmaline::report {

/// The folder of a small case in contact, run with `overrides`; it goes away with the object.
class ResultFolder {
 public:
  explicit ResultFolder(std::vector<std::string> overrides, const std::string &cells = "[4, 3]") {
    std::string pattern = std::filesystem::temp_directory_path() / "tourmaline-report-XXXXXX";
    path_ = mkdtemp(pattern.data());
    overrides.push_back("mesh.box.cells=" + cells);
    const auto file =
        std::filesystem::path(TOURMALINE_SOURCE_DIR) / "cases/ouafik-2020/conductive.toml";
    solve::simulate(casefile::read_file(file, overrides), path_, true);
  }
  ~ResultFolder() { std::filesystem::remove_all(path_); }
  ResultFolder(const ResultFolder &) = delete;
  ResultFolder &operator=(const ResultFolder &) = delete;

  const std::filesystem::path &path() const { return path_; }
  std::string content(const std::string &file) const {
    std::ifstream in(path_ / file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }

 private:
  std::filesystem::path path_;
};

}  // namespace tourmaline::report
