#pragma once

#include "sample.h"

namespace tourmaline::testing {

/// How a case follows from another: by a turn, or a mirror, and by units.
struct Image {
  Eigen::MatrixXd turn;
  Units units = {};
};

/// The numbers of a run. A quantity's columns are measured by the largest of them over all places
/// and steps.
struct Result {
  std::map<std::string, Eigen::MatrixXd> quantities;  ///< by step, then place
  Eigen::MatrixXd nodes, contact;                     ///< places, a row each
  std::vector<std::string> status;                    ///< by step, then contact node
  std::vector<double> slip_rate;                      ///< the same, before units
};

/// Runs the case through its file and its mesh file.
Result run(const Sample &sample);

/// Of the image of a case, from that of the case.
Result image_of(Result result, const Image &image);
/// Those that are linear in the loads: not powers, energies or rates of slip.
Result superposed(const Result &one, double a, const Result &other, double b);

/// Finds nodes by their places. Points of contact whose slip rate is round-off have any status.
void expect_same(const Result &expected, const Result &actual, double tolerance);

}  // namespace tourmaline::testing
