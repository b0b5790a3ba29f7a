#include "case/free_modes.h"

#include "dense/decompositions.h"
#include "tourmaline/case/case.h"

namespace tourmaline::casefile {

namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;

// All that a free body of the case has.
std::vector<RigidMotion> rigid_motions(const Case &asked, const std::array<double, 3> &centre,
                                       double size) {
  std::vector<RigidMotion> all;
  for (int axis = 0; axis < asked.dimension; ++axis)
    if (!asked.model.is_axisymmetric() || axis == 1) {
      all.push_back({{}, {}, centre});
      all.back().translation[axis] = 1;
    }
  for (int axis = asked.dimension == 3 ? 0 : 2; !asked.model.is_axisymmetric() && axis < 3;
       ++axis) {
    all.push_back({{}, {}, centre});
    all.back().rotation[axis] = 1 / size;
  }
  return all;
}

Vector3d vector(const std::array<double, 3> &a) {
  return {a[0], a[1], a[2]};
}

// How the supports resist these motions, as stiffness of unit springs.
MatrixXd resistance(const std::vector<RigidMotion> &motions, const std::vector<Support> &supports) {
  const auto n = static_cast<Eigen::Index>(motions.size());
  MatrixXd springs = MatrixXd::Zero(n, n);
  for (const Support &support : supports) {
    Eigen::VectorXd along(n);
    for (Eigen::Index i = 0; i < n; ++i)
      along[i] = vector(motions[static_cast<std::size_t>(i)].at(support.point))
                     .dot(vector(support.direction));
    springs += along * along.transpose();
  }
  return springs;
}

// Spans the same as these orthonormal columns, single motions where it can: columns of the
// projector on them, by its largest pivots.
MatrixXd along_axes(const MatrixXd &columns) {
  MatrixXd left = columns * columns.transpose(), axes(columns.rows(), columns.cols());
  for (Eigen::Index i = 0; i < columns.cols(); ++i) {
    Eigen::Index most = 0;
    left.diagonal().maxCoeff(&most);
    axes.col(i) = left.col(most).normalized();
    left -= axes.col(i) * (axes.col(i).transpose() * left);
  }
  return axes;
}

RigidMotion combined(const std::vector<RigidMotion> &motions, const Eigen::VectorXd &parts) {
  RigidMotion sum{{}, {}, motions.front().centre};
  for (std::size_t i = 0; i < motions.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      sum.translation[c] += parts[static_cast<Eigen::Index>(i)] * motions[i].translation[c];
      sum.rotation[c] += parts[static_cast<Eigen::Index>(i)] * motions[i].rotation[c];
    }
  return sum;
}

}  // namespace

std::array<double, 3> RigidMotion::at(const std::array<double, 3> &point) const {
  const Vector3d moved =
      vector(translation) + vector(rotation).cross(vector(point) - vector(centre));
  return {moved[0], moved[1], moved[2]};
}

std::vector<RigidMotion> free_modes(const Case &asked, const std::vector<Support> &supports,
                                    const std::array<double, 3> &centre, double size) {
  constexpr double tolerance = 1e-14;  // of squares, of which no more digits are certain
  const std::vector<RigidMotion> all = rigid_motions(asked, centre, size);
  const auto springs = dense::spectrum(resistance(all, supports));
  const double strongest = springs.values.maxCoeff();
  const Eigen::Index n = (springs.values.array() <= tolerance * strongest).count();
  const MatrixXd axes = along_axes(springs.vectors.leftCols(n));
  std::vector<RigidMotion> free;
  for (Eigen::Index i = 0; i < n; ++i)
    free.push_back(combined(all, axes.col(i)));
  return free;
}

}  // namespace tourmaline::casefile
