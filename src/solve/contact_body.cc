#include "solve/contact_body.h"

#include <utility>

namespace tourmaline::solve {

using contact::TangentMatrix;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

DenseBody::DenseBody(const InterfaceProgramme &programme) : programme_(programme) {
  for (const ContactPoint &p : programme_.points)
    curvature_.push_back(largest_curvature(programme_.stiffness, p));
}

VectorXd DenseBody::force(const VectorXd &d) {
  return programme_.force - programme_.stiffness * d;
}

double DenseBody::size_of_forces(const VectorXd &d) const {
  return solve::size_of_forces(programme_, d);
}

double DenseBody::largest_force() const {
  return programme_.force.size() > 0 ? programme_.force.cwiseAbs().maxCoeff() : 0;
}

VectorXd DenseBody::without_contact() {
  const Eigen::LLT<MatrixXd> factor(programme_.stiffness);
  if (factor.info() != Eigen::Success)
    return VectorXd::Zero(programme_.force.size());
  return factor.solve(programme_.force);
}

InterfaceSolution DenseBody::minimise(const std::vector<ContactPoint> &points, VectorXd start,
                                      const InterfaceSettings &settings) {
  return solve::minimise({programme_.stiffness, programme_.force, points, programme_.force_scale},
                         std::move(start), settings);
}

void DenseBody::fill(const ContactTangent::Point &at, Index row, Rows &rows) const {
  const ContactPoint &p = programme_.points[at.point];
  auto by_d = rows.by_d.middleRows(row, p.size);
  by_d = (at.derivative - TangentMatrix::Identity(p.size, p.size)) *
         programme_.stiffness.middleRows(p.offset, p.size);
  by_d.middleCols(p.offset, p.size) += at.of_own;
  if (at.normal) {
    const Index n = programme_.points[*at.normal].offset;
    by_d += at.of_force * programme_.stiffness.row(n);
    by_d.col(n) += at.of_normal;
  }
  if (at.share)
    rows.by_share.block(row, static_cast<Index>(*at.share), p.size, 1) = at.of_share;
  rows.right_side.segment(row, p.size) = at.right_side;
}

DenseBody::Rows DenseBody::rows(const ContactTangent &tangent) const {
  const auto n_shares = static_cast<Index>(tangent.shares.size());
  Index n = n_shares;
  for (const ContactTangent::Point &at : tangent.points)
    n += programme_.points[at.point].size;
  Rows all{MatrixXd(n, tangent.known.size()), MatrixXd::Zero(n, n_shares), VectorXd(n)};
  Index row = 0;
  for (const ContactTangent::Point &at : tangent.points) {
    fill(at, row, all);
    row += programme_.points[at.point].size;
  }
  for (Index k = 0; k < n_shares; ++k, ++row) {
    const ContactTangent::Share &share = tangent.shares[static_cast<std::size_t>(k)];
    const Index normal = programme_.points[share.normal].offset;
    all.by_d.row(row) = -programme_.stiffness.row(normal);
    all.by_d(row, normal) += share.of_normal;
    all.by_share(row, k) = share.of_share;
    all.right_side[row] = share.right_side;
  }
  return all;
}

std::optional<ContactBody::Moved> DenseBody::solve(const ContactTangent &tangent) {
  std::vector<Index> entries;
  for (const ContactTangent::Point &at : tangent.points)
    for (Index c = 0; c < programme_.points[at.point].size; ++c)
      entries.push_back(programme_.points[at.point].offset + c);
  const auto n_entries = static_cast<Index>(entries.size());
  const auto n_shares = static_cast<Index>(tangent.shares.size());
  Moved moved{tangent.known, {}, VectorXd::Zero(n_shares)};
  if (n_entries + n_shares > 0) {
    const Rows all = rows(tangent);
    MatrixXd jacobian(all.right_side.size(), n_entries + n_shares);
    jacobian << all.by_d(Eigen::all, entries), all.by_share;
    const VectorXd solved = jacobian.partialPivLu().solve(all.right_side - all.by_d * moved.x);
    if (!solved.allFinite())
      return std::nullopt;
    moved.x(entries) = solved.head(n_entries);
    moved.share = solved.tail(n_shares);
  }
  moved.resisted = programme_.stiffness * moved.x;
  return moved;
}

}  // namespace tourmaline::solve
