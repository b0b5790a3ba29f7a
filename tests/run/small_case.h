#pragma once

#include <string>
#include <vector>

#include "tourmaline/case/case.h"
#include "tourmaline/case/reader.h"

namespace tourmaline::run {

/// A block that is pressed on its foundation in ten steps, with changes as of `--set`.
inline casefile::Case small_case(const std::vector<std::string> &changes) {
  return casefile::read_text(R"toml(
mesh.box = { min = [0, 0], max = [0.02, 0.01], cells = [4, 2], cell = "quadrilateral" }
material.library = "BaTiO3-Liu2014"
time = { end = 1, steps = 10 }
[[boundary]]
on = "top"
displacement = [0, "-1e-9*t"]
potential = 0
[contact]
on = "bottom"
normal = "unilateral"
friction = { law = "coulomb", coefficient = 0.3 }
)toml",
                             "case.toml", changes);
}

}  // namespace tourmaline::run
