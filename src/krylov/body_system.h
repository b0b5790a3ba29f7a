#pragma once

#include <Eigen/Dense>
#include <memory>
#include <span>
#include <vector>

#include "body/cell_products.h"
#include "body/operator.h"
#include "body/prescribed.h"
#include "krylov/node_tangent.h"
#include "output/checkpoint.h"

namespace tourmaline::krylov {

/// What a linear solve took, and whether it came as far as it was asked to.
struct Solved {
  int iterations = 0;
  bool converged = false;
};

/// The operator K of a step without a factorisation, for bodies too large for one: solves
///
///     Q (K + C) Q x = Q r,   x in the range of Q
///
/// with Q the projector onto what is free (prescribed unknowns and the contact hold the rest) and C
/// the contact's stiffness, by flexible GMRES (PETSc). The electric and heat rows change their sign
/// back, so that the diagonal blocks are positive definite; the preconditioner solves by blocks, u,
/// then phi, then theta: aggregation multigrid with the rigid motions for u (GAMG), BoomerAMG
/// (hypre) for phi and theta. Only the first follows the contact, in coarse spaces without it. All
/// vectors are SI, by unknown of this rank.
template <int dim>
class BodySystem {
 public:
  BodySystem(const body::Operator<dim> &op, double step, const std::vector<Vector3> &points,
             const std::vector<body::Prescribed> &prescribed);
  ~BodySystem();
  BodySystem(const BodySystem &) = delete;
  BodySystem &operator=(const BodySystem &) = delete;

  /// Sets the matrix of another contact; one entry for each contact node, always the same nodes.
  /// The preconditioner stays where only stiffnesses differ.
  void set_contact(const std::vector<NodeTangent<dim>> &contact);
  /// Slopes of what crosses, by contact node, which `set_contact` gives its own from now on.
  void set_crossing(const std::vector<Eigen::Vector2d> &crossing);
  /// From now on the iteration solves Q (K + C) Q x + E K Q x + G Q x = Q r, with E and G of these,
  /// one for each contact node, or of none; the preconditioner stays. `set_contact` comes first.
  void set_coupling(std::vector<NodeCoupling<dim>> coupling);
  /// Makes the preconditioner that of the matrix as it is now, unless it is.
  void refresh();

  /// From now on the iteration takes its products with K cell by cell; the preconditioner stays
  /// that of the assembled matrix. Where its entries' round-off decides, thin bodies and constants
  /// that differ by many powers of ten, only this finds the solution. `cells` outlives this object.
  void refine(const body::CellProducts<dim> &cells);
  bool is_refined() const;

  /// Solves for a projected right-hand side r until the residual is `reduction` times r, in scaled
  /// unknowns. The solution is in the range of Q: exactly zero in prescribed unknowns.
  Solved solve(std::span<const double> right_side, double reduction, std::span<double> solution);

  /// Q r.
  void project(std::span<double> vector) const;

  /// body::relative_size of a change of the state.
  double relative_size(std::span<const double> change, std::span<const double> state) const;

  /// body::backward_error of a projected residual.
  double backward_error(std::span<const double> residual, std::span<const double> right_side,
                        std::span<const double> state) const;

  /// Matrix and preconditioner of the steps before, for a new system to go on with; of
  /// `contact_nodes` nodes.
  void save(output::SavedNumbers &numbers) const;
  void restore(const output::SavedNumbers &numbers, std::size_t contact_nodes);

  double set_up_seconds() const;  ///< assembly and preconditioners
  int set_ups() const;            ///< preconditioners made

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

/// Ends PETSc, if something here started it; before MPI ends.
void finish();

}  // namespace tourmaline::krylov
