#include "solve/node_system.h"

#include "dense/decompositions.h"

namespace tourmaline::solve {

using contact::Tangent;
using contact::TangentMatrix;
using Eigen::Index;
using Eigen::VectorXd;

template <int dim>
NodeSystem<dim>::NodeSystem(const ContactNodes<dim> &contact, const Model<dim> &model,
                            const ContactTangent &tangent)
    : couplings(model.interface.size(), {Matrix::Zero(), Matrix::Zero()}),
      known(tangent.known),
      force(VectorXd::Zero(known.size())),
      of_share(known.size(), static_cast<Index>(tangent.shares.size())),
      contact_(contact) {
  for (const contact::InterfaceNode<dim> &at : model.interface)
    tangents.push_back({at.node, Matrix::Zero(), Matrix::Zero()});
  of_share.setZero();
  for (const ContactTangent::Point &at : tangent.points)
    add(at, tangent);
}

template <int dim>
typename NodeSystem<dim>::Directions NodeSystem<dim>::directions(std::size_t point) const {
  const ContactPoint &p = contact_.points()[point];
  const Index first = dim * static_cast<Index>(contact_.node_of(point));
  Directions d(dim, p.size);
  for (Index k = 0; k < p.size; ++k)
    d.col(k) = VectorXd(contact_.directions().col(p.offset + k)).segment<dim>(first);
  return d;
}

template <int dim>
void NodeSystem<dim>::add(const ContactTangent::Point &at, const ContactTangent &tangent) {
  const ContactPoint &p = contact_.points()[at.point];
  const std::size_t node = contact_.node_of(at.point);
  Tangent right_side = at.right_side;
  if (at.share)
    right_side -= tangent.known_share[static_cast<Index>(*at.share)] * at.of_share;
  const double vertical = p.law.normal() == nullptr ? 1e-3 : 1e-9;
  const auto modes =
      dense::spectrum(TangentMatrix(TangentMatrix::Identity(p.size, p.size) - at.derivative));
  TangentMatrix inverse = TangentMatrix::Zero(p.size, p.size), free = inverse;
  for (Index k = 0; k < p.size; ++k) {
    const Tangent v = modes.vectors.col(k);
    const double left = modes.values[k];
    if (left > vertical) {
      inverse += v * v.transpose() / left;
      free += v * v.transpose();
    } else {
      known.segment(p.offset, p.size) += v.dot(right_side) / v.dot(at.of_own * v) * v;
    }
  }
  if ((modes.values.array() > vertical).all())
    free.setIdentity();  // without round-off, which would make it another projector every time
  const Directions d = directions(at.point);
  const TangentMatrix own = -inverse * at.of_own * free;
  const auto [stiffness, along] = dense::spectrum(TangentMatrix((own + own.transpose()) / 2));
  const TangentMatrix resists = along * stiffness.cwiseMax(0).asDiagonal() * along.transpose();
  tangents[node].projector += d * free * d.transpose();
  tangents[node].stiffness += d * resists * d.transpose();
  force.segment(p.offset, p.size) = -inverse * right_side;
  for (std::size_t k = 0; at.share && k < tangent.shares.size(); ++k)
    if (tangent.shares[k].share == *at.share)
      of_share.block(p.offset, static_cast<Index>(k), p.size, 1) = inverse * at.of_share;
  if (const TangentMatrix rest = own - resists; rest.norm() > 1e-12 * own.norm()) {
    couplings[node].of_displacement += d * rest * d.transpose();
    is_coupled_ = true;
  }
  if (!at.normal)
    return;
  const Directions normal = directions(*at.normal);
  couplings[node].of_force -= d * inverse * at.of_force * normal.transpose();
  couplings[node].of_displacement -= d * inverse * at.of_normal * normal.transpose();
  is_coupled_ = true;
}

template struct NodeSystem<2>;
template struct NodeSystem<3>;

}  // namespace tourmaline::solve
