#include "solve/free_body.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "condensation/condensed_body.h"
#include "dense/decompositions.h"
#include "krylov/body_system.h"
#include "parallel/ranks.h"
#include "tourmaline/error.h"

namespace tourmaline::solve {

using body::Fields;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

template <int dim>
std::vector<body::Prescribed> held_unknowns(const Model<dim> &model,
                                            const std::vector<bool> &is_free) {
  std::vector<body::Prescribed> held;
  for (std::size_t i = 0; i < is_free.size(); ++i)
    if (!is_free[i])
      held.push_back({i, model.body.points()[i / Fields<dim>::count], 0., ""});
  return held;
}

template <int dim>
class Factorised : public FreeBody<dim> {
 public:
  Factorised(const Model<dim> &model, const std::vector<bool> &is_free,
             const std::vector<ExchangeSite> &sites)
      : model_(model),
        exchanged_(unknowns_of(sites)),
        body_(model.body, model.op, model.step, held_unknowns(model, is_free), exchanged_,
              condensation::choice_of(model.asked.solver)) {}

  void answer(std::span<const double> lacks, const std::vector<double> &slopes,
              std::vector<double> &state) override {
    std::vector<double> right_side(state.size());
    model_.op.multiply(model_.step, state, right_side);
    for (std::size_t i = 0; i < lacks.size(); ++i)
      right_side[i] += lacks[i];
    VectorXd s = body_.reduce(right_side, state);
    const auto slope = VectorXd::Map(slopes.data(), s.size());
    for (Index k = 0; k < s.size(); ++k)
      s[k] -= slope[k] * state[exchanged_[static_cast<std::size_t>(k)]];
    body_.expand(solved(slope, s), state);
  }

 private:
  // S c = s + D c; S stands on the first rank.
  VectorXd solved(const VectorXd &slope, const VectorXd &s) const {
    VectorXd potentials(s.size());
    parallel::on_first([&] {
      if (s.size() > 0)
        potentials =
            dense::Cholesky(MatrixXd(slope.asDiagonal()) - body_.stiffness()).solve(VectorXd(-s));
    });
    parallel::from_first(std::span(potentials.data(), potentials.size()));
    return potentials;
  }

  const Model<dim> &model_;
  const std::vector<std::size_t> exchanged_;
  condensation::CondensedBody<dim> body_;
};

template <int dim>
class Iterated : public FreeBody<dim> {
 public:
  Iterated(const Model<dim> &model, const std::vector<bool> &is_free,
           const std::vector<ExchangeSite> &sites)
      : model_(model),
        sites_(sites),
        scale_(model.op.scales(model.step)),
        system_(model.op, model.step, model.body.points(), held_unknowns(model, is_free)) {
    for (const contact::InterfaceNode<dim> &at : model.interface) {
      krylov::NodeTangent<dim> &tangent = contact_.emplace_back();
      tangent.node = at.node;
      tangent.projector.setZero();
      tangent.stiffness.setZero();
      for (int c = 0; c < dim; ++c)
        tangent.projector(c, c) = is_free[body::unknown<dim>(at.node, c)];
    }
  }

  void answer(std::span<const double> lacks, const std::vector<double> &slopes,
              std::vector<double> &state) override {
    // Beside conductors round-off leaves more than elsewhere.
    constexpr double enough = 1e-13, round_off = 1e-9, of_one_solve = 1e-7;
    constexpr int most = 6;
    for (std::size_t k = 0; k < sites_.size(); ++k)
      contact_[sites_[k].node].crossing[0] = slopes[k];
    system_.set_contact(contact_);
    std::vector<double> left(lacks.begin(), lacks.end()), x(state.size(), 0.), dx(state.size());
    system_.project(left);
    const double all = size_of(left);
    double before = std::numeric_limits<double>::infinity(), now = all;
    for (int i = 0; now > enough * all && (now > round_off * all || now < before / 10); ++i) {
      if (!system_.solve(left, of_one_solve, dx).converged || i == most)
        fail();
      for (std::size_t k = 0; k < x.size(); ++k)
        x[k] += dx[k];
      left = left_by(x, lacks, slopes);
      before = std::exchange(now, size_of(left));
    }
    for (std::size_t k = 0; k < x.size(); ++k)
      state[k] += x[k];
  }

 private:
  std::vector<double> left_by(const std::vector<double> &x, std::span<const double> lacks,
                              const std::vector<double> &slopes) const {
    std::vector<double> left(x.size());
    model_.op.multiply(model_.step, x, left);
    for (std::size_t i = 0; i < left.size(); ++i)
      left[i] = lacks[i] - left[i];
    for (std::size_t k = 0; k < sites_.size(); ++k)
      left[sites_[k].unknown] += slopes[k] * x[sites_[k].unknown];
    system_.project(left);
    return left;
  }

  // Of rows, in scaled unknowns.
  double size_of(const std::vector<double> &rows) const {
    double sum = 0;
    for (std::size_t i = 0; i < rows.size(); ++i)
      if (model_.counts(i))
        sum += std::pow(scale_[i % scale_.size()] * rows[i], 2);
    return std::sqrt(model_.sharing().sum(sum));
  }

  [[noreturn]] static void fail() {
    throw SolveError(
        "the state at t = 0, in which potentials and nodes without mass go to their equilibrium, "
        "was not found by iteration; slender bodies, thin cells and high contrasts of the "
        "materials make this slow: take solver.body = \"direct\"");
  }

  const Model<dim> &model_;
  const std::vector<ExchangeSite> sites_;
  std::vector<krylov::NodeTangent<dim>> contact_;
  const std::array<double, Fields<dim>::count> scale_;
  krylov::BodySystem<dim> system_;
};

}  // namespace

template <int dim>
std::unique_ptr<FreeBody<dim>> free_body(const Model<dim> &model, const std::vector<bool> &is_free,
                                         const std::vector<ExchangeSite> &sites, bool iteratively) {
  const bool some = std::find(is_free.begin(), is_free.end(), true) != is_free.end();
  if (model.sharing().largest(some ? 1. : 0.) == 0)
    return nullptr;
  if (iteratively)
    return std::make_unique<Iterated<dim>>(model, is_free, sites);
  return std::make_unique<Factorised<dim>>(model, is_free, sites);
}

template std::unique_ptr<FreeBody<2>> free_body<2>(const Model<2> &, const std::vector<bool> &,
                                                   const std::vector<ExchangeSite> &, bool);
template std::unique_ptr<FreeBody<3>> free_body<3>(const Model<3> &, const std::vector<bool> &,
                                                   const std::vector<ExchangeSite> &, bool);

}  // namespace tourmaline::solve
