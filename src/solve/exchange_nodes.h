#pragma once

#include <Eigen/Dense>
#include <span>
#include <vector>

#include "output/checkpoint.h"
#include "solve/contact_nodes.h"
#include "solve/exchange_programme.h"
#include "solve/model.h"
#include "solve/route.h"

namespace tourmaline::solve {

/// A temperature or potential of a contact node that a law acts on.
struct ExchangeSite {
  std::size_t node = 0;  ///< of `Model::interface`
  contact::Crossing what = contact::Crossing::heat;
  std::size_t unknown = 0;  ///< of the body
};

/// Those that are free: temperatures, then potentials, each by node.
template <int dim>
std::vector<ExchangeSite> exchange_sites(const Model<dim> &model);

/// The unknowns that the body is condensed onto: the displacements of the contact nodes, dim for
/// each, then `sites`.
template <int dim>
std::vector<std::size_t> contact_unknowns(const Model<dim> &model,
                                          const std::vector<ExchangeSite> &sites);

/// Temperatures and potentials of contact nodes as unknowns of the contact problem: the exchanges
/// of a step, and what crosses in it.
template <int dim>
class ExchangeNodes {
 public:
  /// `model` outlives this.
  explicit ExchangeNodes(const Model<dim> &model);

  Eigen::Index size() const { return static_cast<Eigen::Index>(sites_.size()); }
  /// theta or phi of each entry is this times the entry [K/m, V/m].
  const Eigen::VectorXd &scale() const { return scale_; }
  /// The entries of a state.
  Eigen::VectorXd entries(std::span<const double> state) const;

  /// The exchanges of the step that ends at `time`; `contact` is in it already, and `state` holds
  /// the prescribed values.
  void begin_step(double time, const ContactNodes<dim> &contact, std::span<const double> state);
  const std::vector<ExchangePoint> &points() const { return points_; }
  /// Rows of temperatures and of potentials, if there are any, by the sizes of the terms of each
  /// [N].
  std::vector<FieldRows> fields(const Eigen::VectorXd &terms) const;

  /// What has crossed by a solution, whose increment has the entries here, too. Where the
  /// temperature or the potential is prescribed it crosses as well, and the support has the rest.
  void end_step(const ContactNodes<dim> &contact, const CoupledSolution &solution,
                StepOutcome &outcome);
  /// What that adds to the right side of the rows of the sites.
  Eigen::VectorXd rows(const StepOutcome &outcome) const;
  /// Makes room for what crosses.
  void prepare(StepOutcome &outcome) const;
  /// The step that has ended is to be taken again: the charge that has crossed is forgotten.
  void take_back() { crossed_ = crossed_before_; }

  void save(output::SavedNumbers &numbers) const;
  void restore(const output::SavedNumbers &numbers);

 private:
  double of_flow(std::size_t k) const;
  ExchangePoint seen(const ExchangeSite &site, Eigen::Index crossed, double time,
                     const ContactNodes<dim> &contact) const;
  void cross(const ExchangeSite &site, Eigen::Index crossed, const ExchangePoint &at, double value,
             const contact::ContactState &state, StepOutcome &outcome);

  const Model<dim> &model_;
  std::vector<ExchangeSite> sites_, held_;
  Eigen::VectorXd scale_;
  std::vector<ExchangePoint> points_, held_points_;  // by site
  std::vector<double> held_values_;                  // theta or phi
  Eigen::VectorXd crossed_,
      crossed_before_;  // D.nu by site, those held last, and a step ago [C/m^2]
};

}  // namespace tourmaline::solve
