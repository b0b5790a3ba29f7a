#pragma once

#include <algorithm>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "program.h"

inline const std::string small_case =
    R"(mesh.box = { min = [0, 0], max = [0.1, 0.1], cells = [4, 4] }
material.library = "BaTiO3-Liu2014"
time = { end = 1, steps = 4 }
output = { fields = false, report = false }
boundary = [
  { on = "right", displacement = [0, 0], potential = 0 },
  { on = "top", traction = [0, "-50*t"] },
]
[contact]
on = "left"
friction = { law = "tresca", bound = 15 }
)";

using Cells = std::vector<std::string>;

/// Of tables without commas inside of cells.
inline std::vector<Cells> table_in(const std::filesystem::path &file) {
  std::vector<Cells> rows;
  std::istringstream lines(content_of(file));
  for (std::string line; std::getline(lines, line);) {
    rows.emplace_back();
    std::istringstream cells(line);
    for (std::string cell; std::getline(cells, cell, ',');)
      rows.back().push_back(cell);
  }
  return rows;
}

inline std::string cell_under(const std::string &name, const std::vector<Cells> &table,
                              std::size_t row) {
  const auto found = std::find(table[0].begin(), table[0].end(), name);
  return table.at(row).at(static_cast<std::size_t>(found - table[0].begin()));
}

/// A folder with a small case to vary.
class Sweep : public Program {
 protected:
  void SetUp() override {
    Program::SetUp();
    std::ofstream(here() / "small.toml") << small_case;
  }
};
