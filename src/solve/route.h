#pragma once

#include <Eigen/Dense>
#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "body/node_sharing.h"
#include "output/checkpoint.h"
#include "output/records.h"
#include "solve/rate_record.h"

namespace tourmaline::condensation {
struct FactorisationStatistics;
}

namespace tourmaline::solve {

/// How a step's contact was found: as one convex programme; by Newton's method on all at once; by
/// convex programmes whose friction bounds are held, in a fixed point; with bounds that grow from
/// zero.
enum class ContactStage : std::uint8_t { convex, newton, fixed_point, continuation };
constexpr int n_contact_stages = 4;
const char *name_of(ContactStage stage);

/// What a step did at the contact, besides the new state.
struct StepOutcome {
  ContactStage stage = ContactStage::convex;
  int newton_iterations = 0;
  double residual = 0;
  /// nodal contact forces q on the body, dim entries for each interface node [N]: what the
  /// foundation exerts, without what the supports of prescribed components bear
  Eigen::VectorXd contact_forces;
  Eigen::VectorXd friction_forces;    ///< the part of them that opposes the slip [N]
  std::vector<ContactStatus> status;  ///< by interface node
  /// by interface node, where friction depends on the pressure; else empty
  Eigen::VectorXd friction_bound;    ///< [N/m^2]
  Eigen::VectorXd accumulated_slip;  ///< over all steps [m]; empty, too, where no law depends on it
  /// by interface node, where what crosses depends on the contact's state; else empty. Without what
  /// the operator has of it.
  Eigen::VectorXd heat_flow;      ///< out of the body, that of friction in it [W]
  Eigen::VectorXd friction_heat;  ///< of it what friction brings into the body [W]
  Eigen::VectorXd charge_flow;    ///< D.nu times the weight [C]
  /// by interface node, what crossed leaks in the steps before, where these are in the operator
  Eigen::VectorXd leaked_charge;  ///< integrated against the shape functions [C]
  Eigen::VectorXd leaked_flux;    ///< [C/m^2]
  /// by contact, of foundations whose potential is found; else empty
  struct Foundation {
    std::size_t contact = 0;
    double voltage = 0, charge = 0, current = 0;  ///< [V, C, A]
  };
  std::vector<Foundation> foundations;
  RateRecord rates;  ///< what resists rates of u
  /// Whether friction fell faster with the slip of this step, where it began, than the body
  /// unloads: then the slip is a jump. Looked for in the condensed route, on contacts of less than
  /// a thousand slipping unknowns.
  bool slip_jumped = false;
  /// Of the body's equations, the largest of all steps so far, whose errors stay, where they are
  /// solved by iteration; else only round-off is left.
  double backward_error = 0;

  /// Whether the step had more than a convex programme to solve.
  bool has_stages() const {
    return friction_bound.size() > 0 || heat_flow.size() > 0 || charge_flow.size() > 0;
  }
};

/// What a route did to get ready, and how well it solves.
struct RouteReport {
  int factorisations = 0;
  double analyse_seconds = 0, factorise_seconds = 0, condense_seconds = 0;
  double substitution_seconds = 0, contact_seconds = 0;  ///< over all steps
  double estimate_seconds = 0;                           ///< of errors, likewise
  std::size_t unknowns = 0, electric_and_thermal_unknowns = 0;
  long long factor_entries = 0;
  double factor_flops = 0;
  std::string factorised_by, instead_of_own;  ///< as in `FactorisationStatistics`
  int negative_pivots = -1;                   ///< -1: not known to this route
  bool is_iterative = false;                  ///< solved by iteration, which the following are of
  std::size_t krylov_iterations = 0;          ///< over all linear systems
  int krylov_largest = 0;                     ///< of one linear system
  int preconditioners = 0;                    ///< made in the run
  int safe_steps = 0;                         ///< in which a safe stage followed the fast one
  /// of the contact's matrix A, made by one solution of the body's equations each
  int contact_columns = 0;
  /// largest over the steps in which it was measured; NaN: in none
  double backward_error = std::numeric_limits<double>::quiet_NaN();
  double forward_error = std::numeric_limits<double>::quiet_NaN();  ///< likewise
  bool is_refined = false;                                          ///< by iterative refinement
};

/// How far the digits of a step's solution can be trusted; NaN where it was not measured.
struct Accuracy {
  double backward_error = std::numeric_limits<double>::quiet_NaN();  ///< of the linear equations
  double forward_error = std::numeric_limits<double>::quiet_NaN();   ///< estimate, of the unknowns
};

/// A way to solve the nonlinear system of one step, (31)-(35).
class Route {
 public:
  virtual ~Route() = default;

  /// The run begins at a state that the case's initial one has been settled to (`settle`), not at
  /// that itself.
  virtual void begin(std::span<const double> /*settled*/) {}

  /// From the state of the last step and the right-hand side of this one (loads and history) to the
  /// new state at `time`. `state` holds the prescribed values already and is filled; `before` is
  /// the state of the last step. Throws SolveError when the iteration does not converge.
  virtual StepOutcome advance(double time, std::span<const double> right_side,
                              std::span<const double> before, std::span<double> state) = 0;

  /// The step that `advance` has just taken will be taken again, from the same `before` with
  /// another right-hand side, its `state` (with the prescribed values anew) being the start: what
  /// it has added to the route's memory of the steps is forgotten.
  virtual void take_back() = 0;

  /// Of the step that `advance` has just taken, measured now.
  virtual Accuracy accuracy(std::span<const double> right_side, std::span<const double> state,
                            const StepOutcome &outcome) = 0;
  /// The largest of the steps in which it was measured.
  Accuracy accuracy_so_far() const { return {so_far_.backward_error, so_far_.forward_error}; }
  /// Whether products that belong to this route's states are those of `Model::cells`.
  virtual bool is_refined() const { return false; }

  /// The slip that friction remembers, by interface node [m], empty where it does not; with it
  /// another route goes on.
  virtual Eigen::VectorXd accumulated_slip() const { return {}; }
  virtual void go_on_from(const Eigen::VectorXd & /*accumulated_slip*/) {}

  RouteReport report() const;

  /// Hears of work within a step that takes long: what it is and how much of it is done.
  using Listener = std::function<void(const char *what, int done, int all)>;
  void tell(Listener listener) { listener_ = std::move(listener); }

  /// What the route knows from the steps before: with it a new route goes on to the same bits, and
  /// counts on. Saved on the first rank alone, restored on all.
  void save(output::SavedNumbers &numbers) const;
  /// `of_other_step`: the numbers are those of steps of another size than this route's.
  void restore(const output::SavedNumbers &numbers, bool of_other_step = false);
  /// What the next step depends on of those before, besides the state.
  struct Memory {
    std::array<double, 3> measured{};
    output::SavedNumbers numbers;
  };
  Memory memory() const;
  /// What a route for steps of another size goes on from.
  struct Handover {
    RouteReport report;
    Memory memory;
  };
  /// After a step; the route may then go.
  Handover hand_over();
  /// Goes on from the step of a route of the same kind, or its own, to the same bits whatever this
  /// one did before. Its report then has what that one did.
  void take_over(const Handover &other);

 protected:
  void see_backward_error(double error);
  void see_forward_error(double error);
  /// Whether the forward error of this step is to be measured: a field (u, phi, theta) moves for
  /// the first time, or is ten times as large as when it was measured last. What a thin part does
  /// not take part in says nothing of it.
  template <int dim>
  bool outgrew_measured(const body::NodeSharing &sharing, std::span<const double> state);
  void say(const char *what, int done, int all) const;
  void forget_errors();
  static void add_factorisation(const condensation::FactorisationStatistics &statistics,
                                RouteReport &report);

  /// What adds up over the steps, those before this process included.
  RouteReport so_far_;

 private:
  std::array<double, 3> measured_{};  // the largest of each field (SI) when measured
  Listener listener_;
  bool is_counted_ = false;  // what this one did is in `so_far_` of those that followed

  /// Adds what is of this process to a report of what was so far.
  virtual void describe(RouteReport &report) const = 0;
  /// Refines a new route as the one was that is to go on; before its memory is restored.
  virtual void refine_again() {}
  virtual void save_memory(output::SavedNumbers &numbers) const = 0;
  virtual void restore_memory(const output::SavedNumbers &numbers) = 0;
  /// What was restored of matrices is of no use: they were those of steps of another size.
  virtual void forget_matrices() {}
};

}  // namespace tourmaline::solve
