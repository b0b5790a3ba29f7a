#include "solve/settling.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "dense/decompositions.h"
#include "larger.h"
#include "solve/exchange_nodes.h"
#include "solve/free_body.h"
#include "solve/free_electrodes.h"
#include "solve/start_of_motion.h"

namespace tourmaline::solve {

using body::field_of;
using body::Fields;
using body::unknown;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

// Of the terms that a place or a force is summed from, what is round-off.
constexpr double nothing = 1e-12;

// By interface node: whether its contact keeps it where it is.
template <int dim>
std::vector<bool> touching(const Model<dim> &model, std::span<const double> state) {
  std::vector<bool> touches;
  for (const contact::InterfaceNode<dim> &at : model.interface) {
    const Eigen::Map<const typename Model<dim>::Vector> u(&state[unknown<dim>(at.node, 0)]);
    const double reach = model.reach(at, 0);
    touches.push_back(!model.laws.of(at).can_open() ||
                      u.dot(at.normal) >= reach - nothing * (u.norm() + std::abs(reach)));
  }
  return touches;
}

// Where charge crosses by the contact's state, at potentials that are free.
template <int dim>
std::vector<ExchangeSite> charge_sites(const Model<dim> &model) {
  std::vector<ExchangeSite> sites = exchange_sites(model);
  std::erase_if(sites, [](const auto &site) { return site.what != contact::Crossing::charge; });
  return sites;
}

// Supports and given potentials get their values at t = 0.
template <int dim>
void prescribe_at_start(const Model<dim> &model, std::vector<double> &state) {
  const auto is_driven = [&](int electrode) {
    return electrode < 0 || model.asked.electrodes[static_cast<std::size_t>(electrode)].is_driven();
  };
  for (const body::Prescribed &p : model.prescribed)
    if (field_of<dim>(p.unknown) == 0 ||
        (p.unknown % Fields<dim>::count == Fields<dim>::potential && is_driven(p.electrode)))
      state[p.unknown] = p.value.value(p.point, 0);
}

template <int dim>
class Settling {
 public:
  Settling(const Model<dim> &model, bool iteratively, FoundationCircuits<dim> &foundations,
           std::vector<double> &state)
      : model_(model),
        state_(state),
        electrodes_(model, state),
        foundations_(foundations),
        sites_(charge_sites(model)),
        is_free_(state.size(), false),
        iteratively_(iteratively) {
    prescribe_at_start(model, state);
    touches_ = touching(model, state);
    is_prescribed_ = body::mask_of(model.prescribed, state.size());
    for (std::size_t i = Fields<dim>::potential; i < state.size(); i += Fields<dim>::count)
      is_free_[i] = !is_prescribed_[i];
    for (std::size_t n = 0; n < model.interface.size(); ++n)
      if (!touches_[n])
        release(n);
  }

  void run() {
    constexpr int passes = 20;
    for (int i = 0; i < passes; ++i) {
      solve();
      const bool released = release_drawn();
      if (!released && !crosses_otherwise())
        return;
    }
  }

 private:
  // What damping holds back cannot jump.
  void release(std::size_t n) {
    const body::Node node = model_.interface[n].node;
    const body::RateForces<dim> &rates = *model_.op.rate_forces();
    if (!rates.is_massless(node) || rates.holds_back(node))
      return;
    body_.reset();
    for (int c = 0; c < dim; ++c)
      is_free_[unknown<dim>(node, c)] = !is_prescribed_[unknown<dim>(node, c)];
  }

  // With what crosses the contact by its state.
  std::vector<double> left() const {
    std::vector<double> left = left_at_start(model_, state_);
    for (const ExchangeSite &site : sites_)
      left[site.unknown] += crossing(site).flow;
    return left;
  }

  contact::Exchange::Value crossing(const ExchangeSite &site) const {
    const contact::InterfaceNode<dim> &at = model_.interface[site.node];
    contact::Exchange::Value value = charge_exchange_at_start(model_, at, state_);
    value.flow *= at.weight;
    value.by_value *= at.weight;
    return value;
  }

  void solve() {
    if (!body_)
      body_ = free_body(model_, is_free_, sites_, iteratively_);
    VectorXd potentials(electrodes_.size() + foundations_.potentials().size());
    if (potentials.size() == 0)
      return follow();
    before_ = state_;
    potentials << electrodes_.voltages(state_), foundations_.potentials();
    const VectorXd lacks = lacks_with(potentials);
    const MatrixXd slope = slope_at(potentials, lacks);
    // Again, as a difference over one volt has the round-off of all that is there.
    constexpr int rounds = 3;
    VectorXd left_over = lacks;
    for (int i = 0; i < rounds; ++i) {
      potentials -= dense::least_squares(slope, left_over);
      left_over = lacks_with(potentials);
    }
  }

  // A foundation that nothing touches has a row of zeros, and stays where it is.
  MatrixXd slope_at(const VectorXd &potentials, const VectorXd &lacks) {
    MatrixXd slope(lacks.size(), lacks.size());
    for (Index f = 0; f < lacks.size(); ++f)
      slope.col(f) = lacks_with(potentials + VectorXd::Unit(lacks.size(), f)) - lacks;
    return slope;
  }

  // Of electrodes and foundations, once the body has followed their potentials [C]. What is damped
  // does not follow all the way, and would go on from where other potentials have left it.
  VectorXd lacks_with(const VectorXd &potentials) {
    state_ = before_;
    electrodes_.put(potentials.head(electrodes_.size()), state_);
    foundations_.put_at_start(potentials.tail(potentials.size() - electrodes_.size()));
    follow();
    VectorXd lacks(potentials.size());
    lacks << electrodes_.lacks(state_, left_at_start(model_, state_)),
        foundations_.lacks_at_start(state_);
    return lacks;
  }

  // What is free goes to its equilibrium with all else at hand.
  void follow() {
    const std::vector<double> lacks = left();
    double most = 0;
    for (std::size_t i = 0; i < lacks.size(); ++i)
      if (is_free_[i])
        most = larger(most, std::abs(lacks[i]));
    if (model_.sharing().largest(most) == 0)
      return;
    std::vector<double> slopes;
    for (const ExchangeSite &site : sites_)
      slopes.push_back(crossing(site).by_value);
    body_->answer(lacks, slopes, state_);
  }

  // What crosses by a state that has moved since, as nodes without mass went.
  bool crosses_otherwise() const {
    const std::vector<double> left = this->left(), sizes = model_.op.sizes(0, state_);
    return std::any_of(sites_.begin(), sites_.end(), [&](const ExchangeSite &site) {
      return std::abs(left[site.unknown]) > nothing * sizes[site.unknown];
    });
  }

  // What the foundation exerts on the node has to press.
  bool release_drawn() {
    using Vector = typename Model<dim>::Vector;
    const std::vector<double> left = left_at_start(model_, state_),
                              terms = model_.op.sizes(0, state_);
    bool released = false;
    for (std::size_t n = 0; n < touches_.size(); ++n) {
      const contact::InterfaceNode<dim> &at = model_.interface[n];
      if (!touches_[n] || !model_.laws.of(at).can_open())
        continue;
      const auto force = Vector::Map(&left[unknown<dim>(at.node, 0)]),
                 of_force = Vector::Map(&terms[unknown<dim>(at.node, 0)]);
      if (force.dot(at.normal) >= -nothing * (of_force.norm() + force.norm()))
        continue;
      touches_[n] = false;
      released = true;
      release(n);
    }
    return released;
  }

  const Model<dim> &model_;
  std::vector<double> &state_;
  std::vector<double> before_;             // where it begins to follow
  FreeElectrodesAtStart<dim> electrodes_;  // of the state before it is settled
  FoundationCircuits<dim> &foundations_;
  std::vector<ExchangeSite> sites_;
  std::vector<bool> is_free_, is_prescribed_, touches_;
  bool iteratively_;
  std::unique_ptr<FreeBody<dim>> body_;
};

}  // namespace

template <int dim>
void settle(const Model<dim> &model, bool iteratively, FoundationCircuits<dim> &foundations,
            std::vector<double> &state) {
  Settling<dim>(model, iteratively, foundations, state).run();
  foundations.begin_settled();
}

template void settle<2>(const Model<2> &, bool, FoundationCircuits<2> &, std::vector<double> &);
template void settle<3>(const Model<3> &, bool, FoundationCircuits<3> &, std::vector<double> &);

}  // namespace tourmaline::solve
