#pragma once

#include "sample.h"

namespace tourmaline::verified {

/// How a case follows from another: by a turn, or a mirror, and by units.
struct Image {
  Eigen::MatrixXd turn;
  Units units = {};
};

/// A quantity by step, then place; a row has the components of a vector or the columns that are
/// alike. `size` is what is large for it in this case.
struct Values {
  Eigen::MatrixXd all;
  double size = 0;
};

/// The numbers of a run.
struct Result {
  std::map<std::string, Values> quantities;
  std::vector<std::string> status;  ///< by step, then contact node
  int steps = 1;
  double uncertainty = 0;  ///< of the solution, by the run's own estimate
};

/// Runs the case through its file and its mesh file.
Result run(const Sample &sample);

/// Of the image of a case, from that of the case.
Result image_of(Result result, const Image &image);
/// Those that are linear in the loads: not powers, energies, rates of slip or statuses.
Result superposed(const Result &one, double a, const Result &other, double b);

/// Finds nodes by their places. Differences may be `tolerance` times the size of a quantity, and
/// more by as much as a solution of one of the two is uncertain. Points of contact whose slip rates
/// are no more than that have any status.
void expect_same(const Result &expected, const Result &actual, double tolerance);

}  // namespace tourmaline::verified
