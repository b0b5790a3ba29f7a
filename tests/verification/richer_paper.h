#pragma once

#include <algorithm>

#include "../cases/run_case.h"
#include "tourmaline/case/case.h"

/// The paper's conductive case, made richer: both components of traction, a pyroelectric vector
/// with a part across the poling axis, a bound at which some nodes stick and others slip.
namespace tourmaline::verified {

/// Seen: at most 1e-13, in the slip rate, which is a difference of displacements; a changed sign or
/// term is of order 1.
inline constexpr double round_off = 1e-11;

inline std::vector<std::string> richer(std::vector<std::string> more) {
  std::vector<std::string> overrides{"mesh.box.cells=[12,12]",
                                     "time.steps=10",
                                     "material.pyroelectric=[5e-5, 1e-4]",
                                     "contact.friction.bound=12",
                                     "boundary[2].traction=['3*t', '-5*t']",
                                     "output.fields=false"};
  overrides.insert(overrides.end(), more.begin(), more.end());
  return overrides;
}

/// The conductive case, richer, with more overrides.
inline casefile::Case paper(const std::vector<std::string> &more = {}) {
  return casefile::read_file(
      std::filesystem::path(TOURMALINE_SOURCE_DIR) / "cases/ouafik-2020/conductive.toml",
      richer(more));
}

/// Whether more than three of them are this one.
template <class Status>
bool contains(const std::vector<Status> &all, const Status &one) {
  return std::count(all.begin(), all.end(), one) > 3;
}

inline bool sticks_and_slips(const std::vector<std::string> &status) {
  return contains<std::string>(status, "stick") && contains<std::string>(status, "slip");
}

}  // namespace tourmaline::verified
