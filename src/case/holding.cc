#include "case/holding.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "case/sides.h"
#include "dense/decompositions.h"
#include "tourmaline/case/case.h"
#include "tourmaline/error.h"

namespace tourmaline::casefile {

namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;

// Of the supports' rows, whose entries are of order one.
constexpr double tolerance = 1e-9;

/// The rows that a rigid motion v(p) = T + W x (p - c)/l must annihilate: d.T + ((p - c)/l x d).W =
/// 0 for a support at p in the direction d.
struct Constraints {
  MatrixXd translation, rotation;
};

Vector3d vector(const std::array<double, 3> &a, int dimension) {
  return {a[0], a[1], dimension == 3 ? a[2] : 0.0};
}

Constraints constraints_of(int dimension, const std::vector<Support> &supports) {
  Vector3d centre = Vector3d::Zero();
  for (const Support &support : supports)
    centre += vector(support.point, dimension) / static_cast<double>(supports.size());
  double length = 0;
  for (const Support &support : supports)
    length = std::max(length, (vector(support.point, dimension) - centre).norm());
  if (length == 0)
    length = 1;
  const auto rows = static_cast<Eigen::Index>(supports.size());
  Constraints all{MatrixXd(rows, dimension), MatrixXd(rows, dimension == 2 ? 1 : 3)};
  for (Eigen::Index i = 0; i < rows; ++i) {
    const Support &support = supports[static_cast<std::size_t>(i)];
    const Vector3d arm = (vector(support.point, dimension) - centre) / length;
    const Vector3d direction = vector(support.direction, dimension);
    const Vector3d moment = arm.cross(direction);
    all.translation.row(i) = direction.head(dimension).transpose();
    all.rotation.row(i) = moment.tail(all.rotation.cols()).transpose();
  }
  return all;
}

bool can_rotate_about(const Constraints &constraints, Eigen::Index axis) {
  const Eigen::VectorXd turning = constraints.rotation.col(axis);
  if (turning.size() == 0)
    return true;
  // Some translation must undo what the rotation does at the supports.
  const Eigen::VectorXd translation = dense::least_squares(constraints.translation, -turning);
  return (constraints.translation * translation + turning).norm() < tolerance;
}

void add_translations(const Constraints &constraints, std::vector<std::string> &free) {
  const Eigen::Index dimension = constraints.translation.cols();
  Eigen::Index missing = dimension - dense::rank(constraints.translation, tolerance);
  for (Eigen::Index axis = 0; axis < dimension; ++axis)
    if (constraints.translation.col(axis).norm() < tolerance) {
      free.push_back(fmt::format("a translation along {}", "xyz"[axis]));
      --missing;
    }
  if (missing > 0)
    free.emplace_back("a translation in an oblique direction");
}

void add_rotations(const Constraints &constraints, std::vector<std::string> &free) {
  MatrixXd all(constraints.translation.rows(),
               constraints.translation.cols() + constraints.rotation.cols());
  all << constraints.translation, constraints.rotation;
  const Eigen::Index axes = constraints.rotation.cols();
  Eigen::Index missing =
      axes - (dense::rank(all, tolerance) - dense::rank(constraints.translation, tolerance));
  for (Eigen::Index axis = 0; axis < axes; ++axis)
    if (can_rotate_about(constraints, axis)) {
      free.push_back(axes == 1
                         ? "a rotation in the plane"
                         : fmt::format("a rotation about an axis parallel to {}", "xyz"[axis]));
      --missing;
    }
  if (missing > 0)
    free.emplace_back("a rotation about an oblique axis");
}

// What the contact may hold of a body.
enum class Held { nothing, never_lost, all_it_can };

void add_supports(const Case &asked, const ContactCase &contact, bool all_it_can,
                  std::vector<Support> &supports) {
  const bool is_bilateral = !contact.normal.can_open();
  const bool has_friction = contact.friction.resists();
  for (const std::string &name : contact.on)
    for (const SidePoint &at : points_on(asked.mesh, name)) {
      if (is_bilateral || all_it_can)
        supports.push_back({at.point, at.normal});
      for (int i = 0; has_friction && all_it_can && i < asked.dimension; ++i) {
        supports.push_back({at.point, {}});
        supports.back().direction[i] = 1;
      }
    }
}

// A rigid motion is affine: what it is on a side is decided at so many points.
std::vector<Support> supports_of(const Case &asked, Held by_contact) {
  std::vector<Support> supports;
  for (const BoundaryCase &boundary : asked.boundaries)
    for (const std::string &name : boundary.on)
      for (int i = 0; boundary.displacement && i < asked.dimension; ++i)
        if ((*boundary.displacement)[i])
          for (const SidePoint &at : points_on(asked.mesh, name)) {
            supports.push_back({at.point, {}});
            supports.back().direction[i] = 1;
          }
  for (const ContactCase &contact : asked.contacts)
    if (by_contact != Held::nothing)
      add_supports(asked, contact, by_contact == Held::all_it_can, supports);
  return supports;
}

// What the contact does for the holding, in brackets.
std::string words_of_contact(const Case &asked) {
  if (asked.contacts.empty())
    return "";
  const bool is_slippery =
      std::all_of(asked.contacts.begin(), asked.contacts.end(),
                  [](const ContactCase &contact) { return !contact.friction.resists(); });
  return is_slippery ? " (contact without friction holds only the normal)" : "";
}

std::string listed(const std::vector<std::string> &texts) {
  std::string all;
  for (std::size_t i = 0; i < texts.size(); ++i)
    all += (i == 0 ? "" : i + 1 == texts.size() ? " and " : ", ") + texts[i];
  return all;
}

}  // namespace

std::vector<std::string> free_motions(int dimension, const std::vector<Support> &supports) {
  const Constraints constraints = constraints_of(dimension, supports);
  std::vector<std::string> free;
  add_translations(constraints, free);
  add_rotations(constraints, free);
  return free;
}

std::vector<std::string> free_motions(const Case &asked, const std::vector<Support> &supports) {
  if (!asked.model.is_axisymmetric())
    return free_motions(asked.dimension, supports);
  const bool is_held = std::any_of(supports.begin(), supports.end(), [](const Support &support) {
    return std::abs(support.direction[1]) > tolerance;
  });
  return is_held ? std::vector<std::string>{} : std::vector<std::string>{"a translation along y"};
}

std::string free_motions_in_words(const Case &asked, const std::vector<Support> &supports) {
  return listed(free_motions(asked, supports));
}

void check_holding(const Case &asked) {
  const bool grounded =
      std::any_of(asked.boundaries.begin(), asked.boundaries.end(),
                  [](const auto &boundary) { return boundary.potential; }) ||
      std::any_of(asked.electrodes.begin(), asked.electrodes.end(),
                  [](const ElectrodeCase &electrode) {
                    return electrode.is_driven() || (electrode.is_loaded() && !electrode.to);
                  }) ||
      std::any_of(asked.contacts.begin(), asked.contacts.end(), [](const ContactCase &contact) {
        return contact.electric.exchanges() && !contact.electric.ramp &&
               (!contact.electric.circuit || contact.electric.circuit->is_loaded());
      });
  if (!grounded && asked.model.electric)
    throw CaseError(
        asked.source +
        (asked.electrodes.empty()
             ? " [[boundary]]: the electric potential floats, as no boundary "
               "prescribes it; give `potential` on at least one, or an [[electrode]] with a "
               "`voltage`"
             : " [[electrode]]: the electric potential floats, as no electrode has a "
               "path to a given voltage; give one a `voltage`, or a boundary a "
               "`potential`"));
  if (asked.time.is_dynamic())  // inertia holds it
    return;
  const std::vector<std::string> free = free_motions(asked, supports_of(asked, Held::all_it_can));
  if (!free.empty())
    throw CaseError(fmt::format(
        "{} [[boundary]]: nothing holds the body against {}; prescribe further components of "
        "`displacement`{}",
        asked.source, listed(free), words_of_contact(asked)));
}

std::string left_to_contact(const Case &asked) {
  return !asked.contacts.empty() && !asked.time.is_dynamic()
             ? free_motions_in_words(asked, supports_of(asked, Held::never_lost))
             : "";
}

}  // namespace tourmaline::casefile
