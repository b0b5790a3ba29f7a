#include "solve/contact_step.h"

namespace tourmaline::solve {

using Eigen::Index;
using Eigen::VectorXd;

template <int dim>
ContactStep<dim>::ContactStep(const Model<dim> &model)
    : model_(model),
      slipped_(VectorXd::Zero(static_cast<Index>(model.interface.size()))),
      slipped_before_(slipped_) {}

template <int dim>
void ContactStep<dim>::begin(double time, std::span<const double> before) {
  time_ = time;
  before_ = before;
}

template <int dim>
typename ContactStep<dim>::Vector ContactStep<dim>::displacement(std::span<const double> state,
                                                                 std::size_t node) const {
  return Vector::Map(&state[body::unknown<dim>(at(node).node, 0)]);
}

template <int dim>
double ContactStep<dim>::penetration(std::size_t node, const Vector &displacement) const {
  return displacement.dot(at(node).normal) - model_.reach(at(node), time_);
}

template <int dim>
double ContactStep<dim>::penetration_before(std::size_t node) const {
  return displacement(before_, node).dot(at(node).normal) -
         model_.reach(at(node), model_.time_before(time_));
}

template <int dim>
std::shared_ptr<const contact::NormalLaw> ContactStep<dim>::normal(std::size_t node) const {
  return laws(node).normal(at(node).point, penetration_before(node));
}

template <int dim>
double ContactStep<dim>::pressure_under_supports(std::size_t node, double penetration) const {
  return laws(node).pressure_under_supports(at(node).point, penetration_before(node), penetration);
}

template <int dim>
bool ContactStep<dim>::is_closed_under_supports(std::size_t node, double penetration) const {
  return laws(node).is_closed_under_supports(at(node).point, penetration_before(node), penetration);
}

template <int dim>
std::shared_ptr<const contact::FrictionBound> ContactStep<dim>::bound(std::size_t node) const {
  return laws(node).bound(at(node).point, time_, slipped_[static_cast<Index>(node)]);
}

template <int dim>
contact::PointLaw ContactStep<dim>::friction(const Vector3 &place, std::size_t contact,
                                             const Directions &tangent,
                                             const contact::Tangent &held) const {
  return {model_.friction(contact::contact_place(place, time_, tangent, contact)), held};
}

template <int dim>
void ContactStep<dim>::save(output::SavedNumbers &numbers) const {
  if (model_.laws.remembers_slip())
    numbers.put("accumulated slip", slipped_);
}

template <int dim>
void ContactStep<dim>::restore(const output::SavedNumbers &numbers) {
  if (model_.laws.remembers_slip())
    numbers.fill("accumulated slip", slipped_);
}

template class ContactStep<2>;
template class ContactStep<3>;

}  // namespace tourmaline::solve
