#pragma once

#include <Eigen/Dense>
#include <functional>
#include <memory>
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

std::vector<std::size_t> unknowns_of(const std::vector<ExchangeSite> &sites);

/// Those that are free: temperatures, then potentials, each by node.
template <int dim>
std::vector<ExchangeSite> exchange_sites(const Model<dim> &model);

/// What crosses of charge at a contact node by the state at t = 0; its contact has such a law.
template <int dim>
contact::Exchange::Value charge_exchange_at_start(const Model<dim> &model,
                                                  const contact::InterfaceNode<dim> &at,
                                                  std::span<const double> state);

/// The unknowns that the body is condensed onto: the displacements of the contact nodes, dim for
/// each, then `sites`.
template <int dim>
std::vector<std::size_t> contact_unknowns(const Model<dim> &model,
                                          const std::vector<ExchangeSite> &sites);

/// The state of a contact node at the end of a step, by its index in `Model::interface`.
using StateAtNode = std::function<contact::ContactState(std::size_t node)>;

/// Temperatures and potentials of contact nodes that laws act on: the exchanges of a step, and what
/// crosses in it. They have an entry each where they are unknowns of the contact problem, too.
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

  /// The exchanges of the step that ends at `time`; `state` holds the prescribed values.
  void begin_step(double time, std::span<const double> state);
  /// Those that are free behind the points of `contact`, which is in the step already.
  std::vector<ExchangePoint> points(const ContactNodes<dim> &contact) const;
  /// Rows of temperatures and of potentials, if there are any, by the sizes of the terms of each
  /// [N]; the first entry is `first`.
  std::vector<FieldRows> fields(Eigen::Index first, const Eigen::VectorXd &terms) const;

  const std::vector<ExchangeSite> &sites() const { return sites_; }
  /// What adds to the right side of a site's row of the body's equations, in its unknown theta or
  /// phi: `rest` + `slope` times that, at a value and a state.
  struct Row {
    double slope = 0, rest = 0;
  };
  Row row(std::size_t site, double value, const contact::ContactState &state) const;

  /// What has crossed where the free unknowns have the `values` theta or phi. Where these are
  /// prescribed it crosses as well, and the support has the rest.
  void end_step(const Eigen::VectorXd &values, const StateAtNode &state_at, StepOutcome &outcome);
  /// What that adds to the right side of the rows of the sites.
  Eigen::VectorXd rows(const StepOutcome &outcome) const;
  /// Makes room for what crosses.
  void prepare(StepOutcome &outcome) const;
  /// The step that has ended is to be taken again: the charge that has crossed is forgotten.
  void take_back() { crossed_ = crossed_before_; }

  void save(output::SavedNumbers &numbers) const;
  void restore(const output::SavedNumbers &numbers);

 private:
  using Law = std::shared_ptr<const contact::Exchange>;

  double of_flow(std::size_t k) const;
  Law law(const ExchangeSite &site, Eigen::Index crossed, double time) const;
  void cross(const ExchangeSite &site, Eigen::Index crossed, const contact::Exchange::Value &q,
             double friction, StepOutcome &outcome);

  const Model<dim> &model_;
  std::vector<ExchangeSite> sites_, held_;
  Eigen::VectorXd scale_;
  std::vector<Law> laws_, held_laws_;  // by site
  std::vector<double> held_values_;    // theta or phi
  Eigen::VectorXd crossed_,
      crossed_before_;  // D.nu by site, those held last, and a step ago [C/m^2]
};

}  // namespace tourmaline::solve
