#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "equal_quantities.h"
#include "run_case.h"

namespace tourmaline::verified {

/// The components of each vector as one quantity; `with` those of the first.
inline std::vector<Quantity> along_axes(int dim, const std::vector<std::string> &names,
                                        const std::vector<std::string> &with = {}) {
  std::vector<Quantity> quantities;
  for (const std::string &name : names) {
    quantities.emplace_back();
    for (int c = 0; c < dim; ++c)
      quantities.back().push_back(name + "xyz"[c]);
  }
  quantities.front().insert(quantities.front().end(), with.begin(), with.end());
  return quantities;
}

/// Fields and contact at the end of two runs of a body in `dim` dimensions, over the largest of
/// each quantity.
inline void expect_same_answer(const RunCase &one, const RunCase &other, int dim,
                               double tolerance = 1e-9) {
  auto nodes = along_axes(dim, {"u_"});
  nodes.push_back({"potential"});
  nodes.push_back({"temperature"});
  expect_equal_quantities(one.nodes(), other.nodes(), nodes, tolerance);
  auto contact = along_axes(dim, {"tangential_traction_", "slip_"}, {"normal_traction"});
  contact.back().push_back("normal_displacement");
  contact.back().push_back("gap");
  expect_equal_quantities(one.contact(), other.contact(), contact, tolerance);
  EXPECT_EQ(one.contact().columns.at("status"), other.contact().columns.at("status"));
}

}  // namespace tourmaline::verified
