#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "solve/body_equations.h"
#include "solve/interface_newton.h"
#include "solve/model.h"
#include "solve/route.h"

namespace tourmaline::solve {

/// The route for bodies too large for a factorisation: each linear system of a step is solved by
/// preconditioned Krylov iteration (`krylov::BodySystem`) and, where round-off decides, refined; a
/// step starts where the last one goes on to. How the contact is found in it is the matter of who
/// derives from this.
template <int dim>
class IterativeRoute : public Route {
 public:
  StepOutcome advance(double time, std::span<const double> right_side,
                      std::span<const double> before, std::span<double> state) override;
  void take_back() override;
  Accuracy accuracy(std::span<const double>, std::span<const double>,
                    const StepOutcome &) override {
    return accuracy_so_far();
  }
  bool is_refined() const override { return body_.is_refined(); }

 protected:
  explicit IterativeRoute(const Model<dim> &model);

  /// The residual of the contact, over the size of its forces, that counts as none.
  double contact_tolerance() const;

  /// Throws SolveError: where the contact did not settle, `place` by contact point, or which motion
  /// nothing keeps the body from.
  [[noreturn]] void give_up_contact(const InterfaceSolution &solution,
                                    const std::function<Vector3(std::size_t)> &place) const;

  const Model<dim> &model_;
  const std::vector<bool> is_prescribed_;
  const std::string left_to_contact_;  // rigid motions
  BodyEquations<dim> body_;
  // Of the step at hand:
  double time_ = 0;
  std::span<double> state_;
  int iterations_ = 0;  // Newton iterations

 private:
  /// The contact of a step from `before` to a state that is predicted. The body's equations have
  /// begun theirs.
  virtual void begin_contact(std::span<const double> before) = 0;
  /// Solves the step from where the state is.
  virtual void settle() = 0;
  /// b - K x, or the same cell by cell, in what is free when the step is solved.
  virtual std::vector<double> freed(std::vector<double> residual) const = 0;
  /// Sets the body's matrix to that of the contact as it was found.
  virtual void set_contact() = 0;
  virtual StepOutcome outcome() = 0;
  /// As of `Route`.
  virtual void take_contact_back() {}
  /// The rigid motions that neither supports nor the contact as it was found keep the body from, as
  /// a phrase; empty: it is not known better than by `left_to_contact_`.
  virtual std::string unheld() const { return ""; }
  virtual void save_contact(output::SavedNumbers &numbers) const = 0;
  virtual void restore_contact(const output::SavedNumbers &numbers) = 0;

  typename Model<dim>::Vector carried_to(double time) const;
  void predict(std::span<const double> before);
  void check_held() const;
  void measure();
  void describe(RouteReport &report) const override;
  void refine_again() override { body_.refine(); }
  void save_memory(output::SavedNumbers &numbers) const override;
  void restore_memory(const output::SavedNumbers &numbers) override;

  std::vector<double> two_before_;
  bool is_predicted_ = false;  // the state that the next step is taken from
};

/// With the way to find the contact that its laws need. `model` outlives the route.
template <int dim>
std::unique_ptr<Route> iterative_route(const Model<dim> &model);

}  // namespace tourmaline::solve
