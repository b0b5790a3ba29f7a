#include "tourmaline/solve/monolithic_route.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <numeric>

#include "tourmaline/error.h"
#include "tourmaline/solve/saddle_system.h"

namespace tourmaline::solve {

namespace {

using contact::AugmentedLagrangian;
using contact::Local;
using Eigen::Index;
using Eigen::VectorXd;

// Newton iterations without a smaller residual after which the iteration counts as unsettled.
const int patience = getenv("PAT") ? atoi(getenv("PAT")) : 3;
// The method of multipliers uses so many times the default r: the larger, the fewer its steps.
const double stronger = getenv("STR") ? atof(getenv("STR")) : 10;

// Residuals of the blocks of (37), each over its own size: the body's rows by their largest sum of
// terms, u_nu by the largest displacement, and the law, w |lambda_tau - P(lambda_tau + r d)| with
// the default r, by the size of the mechanical rows.
struct Verdict {
  static constexpr std::array names{"the balance of forces (31)", "the balance of charges (32)",
                                    "the balance of heat (33)", "the normal displacement (34)",
                                    "the friction law (35)"};
  std::array<double, 5> blocks{};
  double force_size = 0;  ///< [N]

  double body() const { return std::max({blocks[0], blocks[1], blocks[2]}); }
  double without_law() const { return std::max(body(), blocks[3]); }
  double worst() const { return std::max(without_law(), blocks[4]); }
  const char *worst_name() const {
    return names[std::max_element(blocks.begin(), blocks.end()) - blocks.begin()];
  }
};

double ratio(double residual, double size) {
  return residual == 0 ? 0 : residual / size;
}

template <int dim>
std::vector<contact::MultiplierPoint<dim>> multiplier_points(const Model<dim> &model) {
  if (!model.asked.contact)
    return {};
  contact::IsPrescribed is_prescribed(model.n_unknowns(), false);
  for (const body::Prescribed &p : model.prescribed)
    is_prescribed[p.unknown] = true;
  if (model.asked.solver.multiplier == "nodal")
    return contact::nodal_multipliers(model.interface, is_prescribed);
  return contact::facet_multipliers(model.body, model.asked.contact->on, is_prescribed);
}

template <int dim>
class MonolithicRoute : public Route {
 public:
  explicit MonolithicRoute(const Model<dim> &model);

  StepOutcome advance(double time, std::span<const double> right_side,
                      std::span<const double> before, std::span<double> state) override;
  RouteReport report() const override;

 private:
  using Point = contact::MultiplierPoint<dim>;

  StepData data() const { return {right_side_, before_, laws_}; }
  Local displacement(std::size_t p) const { return system_.displacement(p, x_, before_); }
  Local multiplier(std::size_t p) const { return system_.multiplier(p, x_); }

  void set_laws();
  void predict(double time, std::span<const double> state);
  bool newton();
  void newton_step();
  void multiplier_step();
  void hold_friction(bool held);
  double length(const SaddlePoint &residual, const SaddlePoint &direction) const;
  void correct(const SaddlePoint &increment, double length);
  double law_residual(std::size_t point) const;
  Verdict judge() const;
  [[noreturn]] void give_up(double time) const;

  StepOutcome outcome();
  void settle(const std::vector<output::ContactStatus> &status);
  VectorXd contact_forces() const;
  std::size_t interface_index(body::Node node) const;

  const Model<dim> &model_;
  SaddleSystem<dim> system_;
  std::vector<AugmentedLagrangian> laws_;  // by multiplier point
  std::vector<double> default_r_;          // likewise [N/m^3]
  SaddlePoint x_;
  const std::vector<double> zero_;  // no state at all
  std::span<const double> right_side_, before_;
  int iterations_ = 0;
  double backward_error_ = 0;
};

template <int dim>
MonolithicRoute<dim>::MonolithicRoute(const Model<dim> &model)
    : model_(model),
      system_(model.op, model.step, model.prescribed, multiplier_points(model),
              model.asked.solver.threads),
      x_{{}, VectorXd::Zero(static_cast<Index>(system_.n_multipliers()))},
      zero_(model.n_unknowns(), 0.) {
  for (std::size_t p = 0; p < system_.points().size(); ++p)
    default_r_.push_back(system_.stiffness_at(p));
  laws_.resize(system_.points().size());
  set_laws();
}

// r_nu and r = r_tau / k as given, or as large as the stiffness of the body at the point, so that
// r w, which the tangent adds there, neither vanishes beside the body nor drowns it.
template <int dim>
void MonolithicRoute<dim>::set_laws() {
  const casefile::SolverCase &solver = model_.asked.solver;
  const double ff = getenv("RF") ? atof(getenv("RF")) : 1, fn = getenv("RN") ? atof(getenv("RN")) : ff;
  for (std::size_t p = 0; p < laws_.size(); ++p) {
    laws_[p].has_normal = system_.points()[p].has_normal;
    laws_[p].r_normal = solver.r_normal.value_or(fn * default_r_[p]);
    laws_[p].r_slip = solver.r_tangential ? *solver.r_tangential / model_.step : ff * default_r_[p];
    laws_[p].friction_held = false;
  }
}

// Prediction step of 3.2: everything as it was, but for what is prescribed at the new time.
template <int dim>
void MonolithicRoute<dim>::predict(double time, std::span<const double> state) {
  x_.body.assign(before_.begin(), before_.end());
  for (const body::Prescribed &p : model_.prescribed)
    x_.body[p.unknown] = state[p.unknown];
  for (std::size_t p = 0; p < laws_.size(); ++p)
    laws_[p].friction =
        contact::friction_at(model_.asked.contact->friction, system_.points()[p].place, time);
}

template <int dim>
StepOutcome MonolithicRoute<dim>::advance(double time, std::span<const double> right_side,
                                          std::span<const double> before, std::span<double> state) {
  right_side_ = right_side;
  before_ = before;
  iterations_ = 0;
  predict(time, state);
  VectorXd safe = x_.multipliers;  // a sequence of the method of multipliers' own
  while (!newton()) {
    if (iterations_ >= model_.asked.solver.max_iterations)
      give_up(time);
    x_.multipliers = safe;
    multiplier_step();
    safe = x_.multipliers;
  }
  backward_error_ = std::max(backward_error_, judge().body());
  StepOutcome step = outcome();
  std::copy(x_.body.begin(), x_.body.end(), state.begin());
  return step;
}

template <int dim>
bool MonolithicRoute<dim>::newton() {
  double smallest = std::numeric_limits<double>::infinity();
  int without_progress = 0;
  while (true) {
    const double residual = judge().worst();
    if (getenv("MONO_DEBUG")) {
      const auto v = judge();
      fprintf(stderr, "  it %d: %.2e %.2e %.2e %.2e %.2e\n", iterations_, v.blocks[0], v.blocks[1],
              v.blocks[2], v.blocks[3], v.blocks[4]);
    }
    if (residual <= model_.asked.solver.tolerance)
      return true;
    without_progress = residual < smallest ? 0 : without_progress + 1;
    smallest = std::min(smallest, residual);
    if (without_progress == patience || iterations_ == model_.asked.solver.max_iterations)
      return false;
    newton_step();
  }
}

// (44) and the correction step.
template <int dim>
void MonolithicRoute<dim>::newton_step() {
  system_.factorise(data(), x_);
  correct(system_.increment(system_.residual(data(), x_)), 1);
  ++iterations_;
}

template <int dim>
void MonolithicRoute<dim>::correct(const SaddlePoint &increment, double length) {
  for (std::size_t i = 0; i < x_.body.size(); ++i)
    x_.body[i] += length * increment.body[i];
  x_.multipliers += increment.multipliers;
}

// Minimises the augmented Lagrangian, as a function of the displacement a convex one with a
// continuous gradient, for fixed lambda_tau, and then moves lambda_tau to P(lambda_tau + r d): a
// proximal step on the dual problem, so a sequence of these converges from any start
// (R. T. Rockafellar, Math. Oper. Res. 1 (1976) 97-116). Newton's iteration before this has
// solved the linear rows of (37), which then stay solved.
template <int dim>
void MonolithicRoute<dim>::multiplier_step() {
  hold_friction(true);
  while (judge().without_law() > model_.asked.solver.tolerance &&
         iterations_ < model_.asked.solver.max_iterations) {
    const SaddlePoint residual = system_.residual(data(), x_);
    system_.factorise(data(), x_);
    const SaddlePoint direction = system_.increment(residual);
    const double t = length(residual, direction);
    if (getenv("MONO_DEBUG"))
      fprintf(stderr, "    held it %d: %.2e t %g\n", iterations_, judge().without_law(), t);
    correct(direction, t);
    ++iterations_;
  }
  for (std::size_t p = 0; p < laws_.size(); ++p) {
    Local lambda = multiplier(p);
    const contact::Tangent moved = laws_[p].friction_traction(displacement(p), lambda);
    lambda.tail(moved.size()) = moved;
    system_.set_multiplier(p, lambda, x_);
  }
  hold_friction(false);
}

template <int dim>
void MonolithicRoute<dim>::hold_friction(bool held) {
  set_laws();
  for (std::size_t p = 0; held && p < laws_.size(); ++p) {
    laws_[p].r_slip = stronger * default_r_[p];
    laws_[p].friction_held = true;
  }
}

// Where the augmented Lagrangian is least along the direction, but not beyond the whole step: a
// root of its slope, which grows with t.
template <int dim>
double MonolithicRoute<dim>::length(const SaddlePoint &residual,
                                    const SaddlePoint &direction) const {
  const auto dot = [](const std::vector<double> &a, const std::vector<double> &b) {
    return std::inner_product(a.begin(), a.end(), b.begin(), 0.);
  };
  std::vector<double> resisted(direction.body.size());
  model_.op.multiply(model_.step, direction.body, resisted);
  const double start = dot(residual.body, direction.body), slope = dot(resisted, direction.body);
  const auto derivative = [&](double t) {
    double sum = start + t * slope;
    for (std::size_t p = 0; p < laws_.size(); ++p) {
      const Local y = displacement(p), lambda = multiplier(p);
      const Local change = system_.points()[p].displacement(direction.body, zero_);
      const contact::Tangent more = laws_[p].friction_traction(y + t * change, lambda) -
                                    laws_[p].friction_traction(y, lambda);
      sum += system_.points()[p].weight * more.dot(change.tail(more.size()));
    }
    return sum;
  };
  constexpr double round_off = 1e-8;
  if (derivative(1) <= round_off * std::abs(start))
    return 1;
  double low = 0, high = 1;
  for (int k = 0; k < 40; ++k)
    (derivative((low + high) / 2) > 0 ? high : low) = (low + high) / 2;
  return (low + high) / 2;
}

template <int dim>
double MonolithicRoute<dim>::law_residual(std::size_t point) const {
  AugmentedLagrangian natural = laws_[point];
  natural.r_slip = default_r_[point];
  const Local lambda = multiplier(point);
  const contact::Tangent projected = natural.friction_traction(displacement(point), lambda);
  return system_.points()[point].weight * (projected - lambda.tail(projected.size())).norm();
}

template <int dim>
Verdict MonolithicRoute<dim>::judge() const {
  Verdict verdict;
  const auto rows = system_.largest_rows(system_.residual(data(), x_));
  const auto sizes = system_.row_sizes(data(), x_);
  verdict.force_size = sizes[0];
  for (std::size_t field = 0; field < 3; ++field)
    verdict.blocks[field] = ratio(rows[field], sizes[field]);
  double largest_displacement = 0, gap = 0, law = 0;
  for (std::size_t i = 0; i < x_.body.size(); ++i)
    if (i % body::Fields<dim>::count < dim)
      largest_displacement = std::max(largest_displacement, std::abs(x_.body[i]));
  for (std::size_t p = 0; p < laws_.size(); ++p) {
    if (laws_[p].has_normal)
      gap = std::max(gap, std::abs(displacement(p)[0]));
    law = std::max(law, law_residual(p));
  }
  verdict.blocks[3] = ratio(gap, largest_displacement);
  verdict.blocks[4] = ratio(law, verdict.force_size);
  return verdict;
}

template <int dim>
void MonolithicRoute<dim>::give_up(double time) const {
  const Verdict verdict = judge();
  const double tolerance = model_.asked.solver.tolerance;
  int unsettled = 0;
  std::string places;
  for (std::size_t p = 0; p < laws_.size(); ++p) {
    if (law_residual(p) <= tolerance * verdict.force_size)
      continue;
    const output::Vector &place = system_.points()[p].place;
    if (++unsettled <= 3)
      places += fmt::format(" ({:g}, {:g}, {:g})", place[0], place[1], place[2]);
  }
  if (unsettled > 0)
    places = fmt::format("; {} contact points are unsettled, among them{}", unsettled, places);
  throw SolveError(fmt::format(
      "Newton's method did not converge at t = {:g} s: after {} iterations {} is left with a "
      "residual of {:.3g} of its own size, wanted {:.3g}{}; raise solver.max_iterations or "
      "solver.tolerance, take smaller time steps, leave solver.r_normal and solver.r_tangential "
      "at their defaults, or use solver.method = \"condensed\"",
      time, iterations_, verdict.worst_name(), verdict.worst(), tolerance, places));
}

template <int dim>
StepOutcome MonolithicRoute<dim>::outcome() {
  StepOutcome outcome;
  outcome.newton_iterations = iterations_;
  outcome.residual = judge().worst();
  outcome.status.assign(model_.interface.size(), output::ContactStatus::stick);
  for (std::size_t p = 0; p < laws_.size(); ++p)
    if (laws_[p].status(displacement(p), multiplier(p)) == output::ContactStatus::slip)
      for (const auto &share : system_.points()[p].mean)
        outcome.status[interface_index(share.node)] = output::ContactStatus::slip;
  if (model_.asked.solver.multiplier == "nodal")
    settle(outcome.status);
  outcome.contact_forces = contact_forces();
  return outcome;
}

// A node that the law or a condition holds is put exactly there, not where the round-off of
// the last increment has left it.
template <int dim>
void MonolithicRoute<dim>::settle(const std::vector<output::ContactStatus> &status) {
  for (std::size_t p = 0; p < laws_.size(); ++p) {
    Local off = displacement(p);
    if (status[p] == output::ContactStatus::slip)
      off.tail(off.size() - laws_[p].has_normal).setZero();
    const typename Point::Vector correction = system_.points()[p].directions * off;
    for (int c = 0; c < dim; ++c) {
      const std::size_t i = body::unknown<dim>(model_.interface[p].node, c);
      if (system_.is_free(i))
        x_.body[i] -= correction[c];
    }
  }
}

// The multipliers as nodal forces, -w (dy/du)^T (lambda_nu, P(lambda_tau + r d)); in prescribed
// components the reaction, which includes what holds them.
template <int dim>
VectorXd MonolithicRoute<dim>::contact_forces() const {
  VectorXd forces = VectorXd::Zero(dim * static_cast<Index>(model_.interface.size()));
  for (std::size_t p = 0; p < laws_.size(); ++p) {
    const Point &point = system_.points()[p];
    const Local traction = laws_[p].gradient(displacement(p), multiplier(p)).traction;
    for (const auto &share : point.mean)
      forces.template segment<dim>(dim * static_cast<Index>(interface_index(share.node))) -=
          point.weight * share.factor * point.directions * traction;
  }
  for (std::size_t n = 0; n < model_.interface.size(); ++n)
    for (int c = 0; c < dim; ++c) {
      const std::size_t i = body::unknown<dim>(model_.interface[n].node, c);
      if (!system_.is_free(i))
        forces[dim * static_cast<Index>(n) + c] =
            model_.op.row_times(i, model_.step, x_.body) - right_side_[i];
    }
  return forces;
}

template <int dim>
std::size_t MonolithicRoute<dim>::interface_index(body::Node node) const {
  const auto found =
      std::lower_bound(model_.interface.begin(), model_.interface.end(), node,
                       [](const auto &at, body::Node wanted) { return at.node < wanted; });
  return found - model_.interface.begin();
}

template <int dim>
RouteReport MonolithicRoute<dim>::report() const {
  const condensation::FactorisationStatistics &statistics = system_.factorisation().statistics();
  RouteReport report;
  report.factorisations = system_.factorisation().count();
  report.analyse_seconds = statistics.analyse_seconds;
  report.factorise_seconds = statistics.factorise_seconds;
  report.unknowns = system_.n_variables();
  report.electric_and_thermal_unknowns = system_.n_electric_and_thermal();
  report.factor_entries = statistics.factor_entries;
  report.backward_error = backward_error_;
  return report;
}

}  // namespace

template <int dim>
std::unique_ptr<Route> monolithic_route(const Model<dim> &model) {
  return std::make_unique<MonolithicRoute<dim>>(model);
}

template std::unique_ptr<Route> monolithic_route<2>(const Model<2> &);
template std::unique_ptr<Route> monolithic_route<3>(const Model<3> &);

}  // namespace tourmaline::solve
