#pragma once

#include <span>
#include <vector>

#include "body/cell_modes.h"
#include "material/composition.h"

namespace tourmaline::body {

/// What resists rates of u: the inertia of the densities and the damping of the materials (viscous
/// stress eta F eps(du/dt) beside F eps(u); force a rho du/dt on the volume), as forms between
/// nodes
///
///     M = (rho v, v)      C = (eta F eps(v), eps(v)) + a M.
///
/// Over a step of length k the matrix of these forces is what they gain with u at its end:
///
///     4/k^2 M + 2/k C_1 + 1/k C_2.
///
/// C_1 has the velocity of Newmark's scheme with 1/4 and 1/2, and with it damping is of order 2 and
/// dissipates in the mean over each step. C_2 has the backward difference of u: all damping of the
/// quasistatic regime; in the dynamic one that of the cells at nodes without mass, whose velocity
/// is no unknown of a differential equation of order 2, so that Newmark's would swing about the
/// true one from step to step for ever. Those cells are one layer, so the order of the whole stays.
///
/// Mass is redistributed as of Khenous, Laborde, Renard (Eur. J. Mech. A 27 (2008) 918): nodes that
/// are `massless` have none. Each cell at such nodes is lumped, and gives their shares to its other
/// nodes in equal parts: the mass of every cell stays, and on parallelograms so does the centre of
/// mass along the contact. All linear cells are lumped: what is wrong of a wave front then comes
/// behind it, where with the consistent mass the contact would feel it ahead.
///
/// Cells with incompatible modes resist their rate of strain with modes of its own, as an element
/// beside the elastic one: so the modes need no memory, and damping does not lock where elasticity
/// does not.
///
/// On several ranks each holds its cells' share, and products are shares of a sum.
template <int dim>
class RateForces {
 public:
  using Block = Eigen::Matrix<double, dim, dim, Eigen::RowMajor>;
  /// M, C_1 and C_2.
  enum class Kind { inertia, damping, backward_damping };

  /// `massless` by node; `is_dynamic` false: inertia resists nothing. Throws CaseError where the
  /// mass of a node has no other to go to.
  RateForces(const Discretisation<dim> &body, const material::Composition<dim> &composition,
             Modes modes, bool is_dynamic, const std::vector<bool> &massless);

  /// Only inertia is left.
  void drop_damping() {
    damping_.clear();
    backward_damping_.clear();
    is_damped_ = false;
  }

  bool is_dynamic() const { return is_dynamic_; }
  bool is_damped() const { return is_damped_; }
  bool is_massless(Node node) const { return massless_[node]; }
  /// Whether C_2 resists displacements of the node, which cannot jump then.
  bool holds_back(Node node) const { return is_damped_ && held_back_[node] > 0; }
  /// Of the step at place `entry` of the graph.
  Block step_block(std::size_t entry, double step) const;
  /// Adds the product of the step's matrix with the displacements of x to those of y.
  void add_of_step(const NodeGraph &graph, double step, std::span<const double> x,
                   std::span<double> y) const;
  /// Adds M, C_1 or C_2 times the displacements of x to those of y.
  void add(Kind kind, const NodeGraph &graph, std::span<const double> x, std::span<double> y) const;
  /// M 1 by node, of all ranks [kg], in two dimensions [kg/m].
  const std::vector<double> &node_masses() const { return node_masses_; }
  /// The diagonal of M by node, of all ranks.
  const std::vector<double> &diagonal() const { return diagonal_; }

 private:
  struct Assembly;
  void add_stranded(const Discretisation<dim> &body, Assembly &assembly);

  bool is_dynamic_, is_damped_ = false;  // the same on all ranks
  std::vector<bool> massless_;
  std::vector<double> mass_;                       // by entry of the graph, as the others
  std::vector<Block> damping_, backward_damping_;  // empty: none here
  std::vector<double> node_masses_, diagonal_;
  std::vector<double> held_back_;  // by node, the trace of C_2's diagonal block of all ranks
};

}  // namespace tourmaline::body
