#include "solve/rigid_work.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

#include "larger.h"
#include "output/place.h"
#include "solve/leaning.h"

namespace tourmaline::solve {

RigidWork::RigidWork(std::vector<casefile::RigidMotion> motions)
    : motions_(std::move(motions)), sums_(2 * motions_.size() + 1, 0.) {}

template <int dim>
RigidWork RigidWork::left_to_contact(const Model<dim> &model) {
  const std::vector<ContactStatus> open(model.interface.size(), ContactStatus::open);
  return RigidWork(
      free_modes_of(model, supports_of<dim>(model, open, [](std::size_t) { return false; })));
}

void RigidWork::add(const Vector3 &point, const double *force, int size) {
  for (std::size_t m = 0; m < motions_.size(); ++m) {
    const Vector3 moved = motions_[m].at(point);
    double work = 0;
    for (int c = 0; c < size; ++c)
      work += force[c] * moved[c];
    sums_[2 * m] += work;
    sums_[2 * m + 1] += std::abs(work);
  }
  double square = 0;
  for (int c = 0; c < size; ++c)
    square += force[c] * force[c];
  sums_.back() += std::sqrt(square);
}

template <int dim>
void RigidWork::add_loads(const Model<dim> &model, std::span<const double> loads) {
  RigidWork of_loads(motions_);
  for (body::Node node = 0; node < model.body.n_nodes(); ++node)
    if (model.sharing().counts(node))
      of_loads.add(model.body.points()[node], &loads[body::unknown<dim>(node, 0)], dim);
  model.sharing().sum(of_loads.sums_);
  std::ranges::transform(sums_, of_loads.sums_, sums_.begin(), std::plus());
}

template <int dim>
void RigidWork::add_at_contact(const Model<dim> &model, const Eigen::VectorXd &forces) {
  for (std::size_t i = 0; i < model.interface.size(); ++i)
    add(model.interface[i].point, &forces[dim * static_cast<Eigen::Index>(i)], dim);
}

double RigidWork::allowed(const casefile::SolverCase &asked, bool is_far) {
  constexpr double several = 10, far_away = 1e-8;
  return std::max(is_far ? far_away : unbalanced,
                  several * std::max(asked.tolerance, asked.linear_tolerance));
}

double RigidWork::imbalance(double beside, double round_off) const {
  double most = std::isfinite(round_off) ? 0 : std::nan("");
  for (std::size_t m = 0; m < motions_.size(); ++m) {
    const double lacks = larger(0., std::abs(sums_[2 * m]) - round_off);
    most = larger(most, relative_to(lacks, sums_[2 * m + 1] + beside * sums_.back()));
  }
  return most;
}

double RigidWork::round_off(double stiffness, double motion) {
  constexpr double several = 10;
  return several * std::numeric_limits<double>::epsilon() * stiffness * motion;
}

template <int dim>
double held_motion(const Model<dim> &model, double time, const std::vector<ContactStatus> &status) {
  constexpr double small = 1e-2;
  double gone = 0;
  for (std::size_t i = 0; i < model.interface.size(); ++i)
    if (const contact::InterfaceNode<dim> &at = model.interface[i];
        status[i] != ContactStatus::open)
      gone = std::max(gone, model.foundation(at, time).norm() + std::abs(model.reach(at, time)));
  for (const body::Prescribed &component : model.prescribed)
    if (body::field_of<dim>(component.unknown) == 0)
      gone = std::max(gone, std::abs(component.value.value(component.point, time)));
  return small * output::largest_extent(model.body.bounds()) + gone;
}

template <int dim>
double round_off_where_held(const Model<dim> &model, double time,
                            const std::vector<ContactStatus> &status) {
  const std::vector<double> diagonal = model.op.diagonal(model.step);
  double squares = 0;
  for (std::size_t i = 0; i < diagonal.size(); ++i)
    if (body::field_of<dim>(i) == 0 && model.counts(i))
      squares += diagonal[i] * diagonal[i];
  return RigidWork::round_off(std::sqrt(model.sharing().sum(squares)),
                              held_motion(model, time, status));
}

template RigidWork RigidWork::left_to_contact(const Model<2> &);
template RigidWork RigidWork::left_to_contact(const Model<3> &);
template void RigidWork::add_loads(const Model<2> &, std::span<const double>);
template void RigidWork::add_loads(const Model<3> &, std::span<const double>);
template void RigidWork::add_at_contact(const Model<2> &, const Eigen::VectorXd &);
template void RigidWork::add_at_contact(const Model<3> &, const Eigen::VectorXd &);
template double round_off_where_held(const Model<2> &, double, const std::vector<ContactStatus> &);
template double round_off_where_held(const Model<3> &, double, const std::vector<ContactStatus> &);
template double held_motion(const Model<2> &, double, const std::vector<ContactStatus> &);
template double held_motion(const Model<3> &, double, const std::vector<ContactStatus> &);

}  // namespace tourmaline::solve
