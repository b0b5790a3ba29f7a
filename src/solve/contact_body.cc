#include "solve/contact_body.h"

#include <utility>

#include "dense/decompositions.h"

namespace tourmaline::solve {

using contact::TangentMatrix;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

DenseBody::DenseBody(const InterfaceProgramme &programme, KeptFactor *factor)
    : programme_(programme), size_(programme_), factor_(factor == nullptr ? own_ : *factor) {
  factor_.begin();
  for (const ContactPoint &p : programme_.points)
    curvature_.push_back(largest_curvature(programme_.stiffness, p));
}

VectorXd DenseBody::force(const VectorXd &d) {
  VectorXd force = programme_.force;
  subtract_product(programme_.stiffness, d, force);
  return force;
}

double DenseBody::largest_force() const {
  const auto forces = programme_.force.head(programme_.n_forces());
  return forces.size() > 0 ? forces.cwiseAbs().maxCoeff() : 0;
}

VectorXd DenseBody::without_contact() {
  const dense::Cholesky factor(programme_.stiffness);
  if (!factor.is_definite())
    return VectorXd::Zero(programme_.force.size());
  return factor.solve(programme_.force);
}

InterfaceSolution DenseBody::minimise(const std::vector<ContactPoint> &points, VectorXd start,
                                      const InterfaceSettings &settings) {
  InterfaceSettings with_factor = settings;
  with_factor.factor = &factor_;
  return solve::minimise({programme_.stiffness, programme_.force, points, programme_.force_scale},
                         std::move(start), with_factor);
}

void DenseBody::fill(const ContactTangent::Point &at, Index row, Rows &rows) const {
  const ContactPoint &p = programme_.points[at.point];
  rows.of_unknowns.add_of_force(row, p.offset,
                                at.derivative - TangentMatrix::Identity(p.size, p.size));
  rows.of_unknowns.add_local(row, p.offset, at.of_own);
  rows.right_side.segment(row, p.size) = at.right_side;
  for (Index c = 0; c < p.size; ++c)
    rows.unknowns.push_back(p.offset + c);
  if (at.normal) {
    const Index n = programme_.points[*at.normal].offset;
    rows.of_unknowns.add_of_force(row, n, at.of_force);
    rows.of_unknowns.add_local(row, n, at.of_normal);
  }
  if (at.share)
    rows.of_unknowns.add_local(row, programme_.force.size() + static_cast<Index>(*at.share),
                               at.of_share);
}

namespace {

TangentMatrix one(double value) {
  return TangentMatrix::Constant(1, 1, value);
}

}  // namespace

void DenseBody::fill(const ContactTangent::Exchange &at, Index row, Rows &rows) const {
  rows.of_unknowns.add_of_force(row, at.entry, one(-1));
  rows.of_unknowns.add_local(row, at.entry, one(at.of_own));
  if (at.normal) {
    const Index n = programme_.points[*at.normal].offset;
    rows.of_unknowns.add_of_force(row, n, one(at.of_normal_force));
    rows.of_unknowns.add_local(row, n, one(at.of_normal));
  }
  rows.of_unknowns.add_local(row, programme_.points[at.slip].offset, at.of_slip.transpose());
  rows.right_side[row] = at.right_side;
  rows.unknowns.push_back(at.entry);
}

void DenseBody::fill(const ContactTangent::Share &at, Index row, Rows &rows) const {
  const Index n = programme_.points[at.normal].offset;
  const Index share = programme_.force.size() + static_cast<Index>(at.share);
  rows.of_unknowns.add_of_force(row, n, one(-1));
  rows.of_unknowns.add_local(row, n, one(at.of_normal));
  rows.of_unknowns.add_local(row, share, one(at.of_share));
  rows.right_side[row] = at.right_side;
  rows.unknowns.push_back(share);
}

DenseBody::Rows DenseBody::rows(const ContactTangent &tangent) const {
  auto n = static_cast<Index>(tangent.shares.size() + tangent.exchanges.size());
  for (const ContactTangent::Point &at : tangent.points)
    n += programme_.points[at.point].size;
  Rows all;
  all.right_side.resize(n);
  Index row = 0;
  for (const ContactTangent::Point &at : tangent.points) {
    fill(at, row, all);
    row += programme_.points[at.point].size;
  }
  for (const ContactTangent::Exchange &at : tangent.exchanges)
    fill(at, row++, all);
  for (const ContactTangent::Share &at : tangent.shares)
    fill(at, row++, all);
  return all;
}

std::optional<ContactBody::Moved> DenseBody::solve(const ContactTangent &tangent) {
  const Index n = tangent.known.size(), n_shares = tangent.known_share.size();
  VectorXd known(n + n_shares);
  known << tangent.known, tangent.known_share;
  VectorXd resisted = VectorXd::Zero(n);
  if (!tangent.known.isZero(0))
    resisted = symmetric_product(programme_.stiffness, tangent.known);
  const Rows all = rows(tangent);
  if (!all.unknowns.empty()) {
    const InterfaceSystem asked = all.of_unknowns.system(all.unknowns, n, n + n_shares);
    const std::optional<KeptFactor::Solved> found =
        factor_.solve(asked, programme_.stiffness,
                      all.right_side - asked.of_force * resisted - asked.local * known,
                      tangent.is_last ? KeptFactor::for_none : KeptFactor::for_the_next);
    if (!found)
      return std::nullopt;
    known += found->x;
    resisted += found->resisted;
  }
  return Moved{known.head(n), resisted, known.tail(n_shares)};
}

}  // namespace tourmaline::solve
