#include "solve/leaning.h"

#include <fmt/format.h>

#include <algorithm>

#include "output/place.h"
#include "tourmaline/error.h"

namespace tourmaline::solve {

template <int dim>
std::string resisted_by_contact_alone(const Model<dim> &model) {
  return model.composition.resists_motion() && !model.asked.time.is_static()
             ? ""
             : casefile::left_to_contact(model.asked);
}

template <int dim>
std::vector<casefile::Support> supports_of(const Model<dim> &model,
                                           const std::vector<ContactStatus> &status,
                                           const std::function<bool(std::size_t)> &rubs) {
  using Vector = Eigen::Matrix<double, dim, 1>;
  std::vector<casefile::Support> supports;
  const auto add = [&](const Vector3 &point, const Vector &direction) {
    supports.push_back({point, {}});
    std::copy(direction.begin(), direction.end(), supports.back().direction.begin());
  };
  for (const body::Prescribed &p : model.prescribed)
    if (const int c = static_cast<int>(p.unknown % body::Fields<dim>::count); c < dim)
      add(p.point, Vector::Unit(c));
  for (std::size_t i = 0; i < model.interface.size(); ++i) {
    const contact::InterfaceNode<dim> &at = model.interface[i];
    if (model.laws.of(at).can_open() && status[i] == ContactStatus::open)
      continue;
    add(at.point, at.normal);
    for (int c = 0; rubs(i) && c < dim; ++c)
      add(at.point, Vector::Unit(c));
  }
  return supports;
}

template <int dim>
std::vector<casefile::RigidMotion> free_modes_of(const Model<dim> &model,
                                                 const std::vector<casefile::Support> &supports) {
  const auto &[low, high] = model.body.bounds();
  Vector3 middle{};
  for (int c = 0; c < dim; ++c)
    middle[c] = (low[c] + high[c]) / 2;
  return casefile::free_modes(model.asked, supports, middle,
                              output::largest_extent(model.body.bounds()));
}

template <int dim>
std::string unheld_motions(const Model<dim> &model, const std::vector<ContactStatus> &status) {
  const auto sticks = [&](std::size_t node) { return status[node] == ContactStatus::stick; };
  return casefile::free_motions_in_words(model.asked, supports_of(model, status, sticks));
}

template <int dim>
std::vector<ContactStatus> status_by_node(const Model<dim> &model, const ContactNodes<dim> &contact,
                                          const std::vector<ContactStatus> &status) {
  std::vector<ContactStatus> by_node(model.interface.size(), ContactStatus::slip);
  const std::vector<ContactPoint> &points = contact.points();
  for (std::size_t i = 0; i < points.size(); ++i) {
    ContactStatus &of_node = by_node[contact.node_of(i)];
    const bool decides =
        points[i].law.normal() ? status[i] == ContactStatus::open : of_node != ContactStatus::open;
    if (decides)
      of_node = status[i];
  }
  return by_node;
}

template <int dim>
std::string unheld_motions(const Model<dim> &model, const ContactNodes<dim> &contact,
                           const std::vector<ContactStatus> &status) {
  return unheld_motions(model, status_by_node(model, contact, status));
}

template <int dim>
bool is_conclusive(const Model<dim> &model, const InterfaceSolution &solution) {
  return solution.converged ||
         model.asked.solver.max_iterations >= InterfaceSettings{}.max_iterations;
}

void let_go(double time, const std::string &motions) {
  throw SolveError(
      fmt::format("no solution of the contact problem at t = {:g} s was found: nothing keeps the "
                  "body from {}, as "
                  "under these loads neither supports nor the contact hold it there. Prescribe "
                  "further components of "
                  "`displacement`, or press the body to the foundation in every step",
                  time, motions));
}

void give_up_leaning(double time, const InterfaceSolution &solution,
                     const std::string &left_to_contact) {
  throw UnsettledStep(fmt::format(
      "the contact problem at t = {:g} s has no solution that was found: residual {:.3g} of the "
      "largest force after {} iterations. Nothing but the contact keeps the body from {}: where "
      "these loads do not press it to the foundation it moves rigidly, and needs further "
      "components of `displacement`; where they do, raise solver.max_iterations or take smaller "
      "time steps",
      time, solution.residual, solution.iterations, left_to_contact));
}

template std::string resisted_by_contact_alone(const Model<2> &);
template std::string resisted_by_contact_alone(const Model<3> &);
template std::vector<casefile::Support> supports_of(const Model<2> &,
                                                    const std::vector<ContactStatus> &,
                                                    const std::function<bool(std::size_t)> &);
template std::vector<casefile::RigidMotion> free_modes_of(const Model<2> &,
                                                          const std::vector<casefile::Support> &);
template std::vector<casefile::RigidMotion> free_modes_of(const Model<3> &,
                                                          const std::vector<casefile::Support> &);
template std::string unheld_motions(const Model<2> &, const std::vector<ContactStatus> &);
template std::vector<casefile::Support> supports_of(const Model<3> &,
                                                    const std::vector<ContactStatus> &,
                                                    const std::function<bool(std::size_t)> &);
template std::string unheld_motions(const Model<3> &, const std::vector<ContactStatus> &);
template std::vector<ContactStatus> status_by_node(const Model<2> &, const ContactNodes<2> &,
                                                   const std::vector<ContactStatus> &);
template std::vector<ContactStatus> status_by_node(const Model<3> &, const ContactNodes<3> &,
                                                   const std::vector<ContactStatus> &);
template std::string unheld_motions(const Model<2> &, const ContactNodes<2> &,
                                    const std::vector<ContactStatus> &);
template std::string unheld_motions(const Model<3> &, const ContactNodes<3> &,
                                    const std::vector<ContactStatus> &);
template bool is_conclusive(const Model<2> &, const InterfaceSolution &);
template bool is_conclusive(const Model<3> &, const InterfaceSolution &);

}  // namespace tourmaline::solve
