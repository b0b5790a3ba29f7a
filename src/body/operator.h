#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "body/cell_modes.h"
#include "body/fields.h"
#include "body/rate_forces.h"
#include "material/composition.h"
#include "tourmaline/case/formula.h"

namespace tourmaline::body {

/// Products of the storage operator with one field of a state at a time: `of[f]` has an entry for
/// each unknown, f = 0 for u, 1 for phi, 2 for theta. Their sum is the operator's product with the
/// state.
struct FieldProducts {
  std::array<std::vector<double>, 3> of;

  double sum(std::size_t unknown) const { return of[0][unknown] + of[1][unknown] + of[2][unknown]; }
};

/// Adds the heat rows of the products with a state to y, which has an entry for each unknown: what
/// the step after that state remembers of it (6), (33).
template <int dim>
void add_history(const FieldProducts &products, std::span<double> y);

/// The operator of the body without boundary conditions, in SI units. With the electric rows
/// multiplied by -1 and the heat rows by -k / theta_ref it is symmetric (design: operator of a
/// step):
///
///     storage    [  A     E^T   -M  ]     A = (F eps(v), eps(v))     H0 = (alpha eta, eta)
///                [  E    -B      P  ]     B = (beta grad psi, grad psi)
///                [ -M^T   P^T   -H0 ]     E, M, P the couplings of (1), (2), (6)
///
///     conduction G = (K grad eta, grad eta) + (k_c eta, eta) on Gamma_C
///     capacitors X = (c psi, psi) on Gamma_C
///
/// G in rows and columns of theta only, X in those of phi, so that the step of (31)-(33) has the
/// operator storage - (k / theta_ref) G - X, and its heat rows see the state before through the
/// heat rows of `storage`. Where products with a step are meant below, X is in them, and so are the
/// forces that resist rates of u (`RateForces`) in its rows and columns, once there are any; not
/// with a step of 0.
///
/// With `Modes::incompatible` the cells' modes (`CellModes`) are condensed out of `storage`, all
/// fields at once: what is left is symmetric, as definite as before, and its heat rows are those of
/// the whole, as the modes have no memory of their own.
///
/// Every rank holds what its cells contribute, each block of two nodes once: the other way round it
/// is transposed. Products are summed over the ranks (`NodeSharing`), so all of them must ask for
/// one.
template <int dim>
class Operator {
 public:
  static constexpr int n = Fields<dim>::count;
  using Block = Eigen::Matrix<double, n, n, Eigen::RowMajor>;

  /// Of one material everywhere.
  Operator(const Discretisation<dim> &body, const material::BodyConstants<dim> &material,
           Modes modes = Modes::none);
  Operator(const Discretisation<dim> &body, const material::Composition<dim> &composition,
           Modes modes = Modes::none);

  /// Adds (k_c theta, eta) on the named boundaries (18); `coefficient` is k_c [W/(K m^2)], by
  /// place.
  void add_exchange(const Discretisation<dim> &body, const std::vector<std::string> &boundaries,
                    const casefile::Formula &coefficient);
  /// Adds (c phi, psi) on the named boundaries; c is `factor` times `coefficient`, by place
  /// [F/m^2].
  void add_capacitors(const Discretisation<dim> &body, const std::vector<std::string> &boundaries,
                      const casefile::Formula &coefficient, double factor = 1);
  /// Before those of another factor are added.
  void clear_capacitors() {
    capacitors_.clear();
    has_capacitors_ = false;
  }

  /// What resists rates of u, from now on.
  void set_rate_forces(RateForces<dim> forces) { rates_ = std::move(forces); }
  /// Null: nothing does.
  const RateForces<dim> *rate_forces() const { return rates_ ? &*rates_ : nullptr; }
  /// M, C_1 or C_2 times x, of all ranks; zero but for displacements.
  std::vector<double> rate_product(typename RateForces<dim>::Kind kind,
                                   std::span<const double> x) const;
  /// Adds what resists rates of u in a step's product with x to y: this rank's share of it.
  void add_rate_share(double step, std::span<const double> x, std::span<double> y) const;

  const NodeGraph &graph() const { return graph_; }
  const NodeSharing &sharing() const { return sharing_; }
  double reference_temperature() const { return reference_temperature_; }

  /// Block of storage - step / theta_ref G at place `entry` of the graph; `step` = k [s]. On
  /// several ranks this rank's share of it.
  Block step_block(std::size_t entry, double step) const;

  /// y = (storage - step / theta_ref G) x.
  void multiply(double step, std::span<const double> x, std::span<double> y) const;

  /// Row `row` of (storage - step / theta_ref G) times x.
  double row_times(std::size_t row, double step, std::span<const double> x) const;

  /// Subtracts `columns` of storage - step / theta_ref G, times their entries of x, from y.
  void subtract_columns(std::span<const std::size_t> columns, double step,
                        std::span<const double> x, std::span<double> y) const;

  /// The diagonal of storage - step / theta_ref G.
  std::vector<double> diagonal(double step) const;

  /// Of each component of a node, 1 / sqrt(largest diagonal entry of its field): in unknowns that
  /// are measured by it the fields' blocks are of one size. The second by `diagonal(step)`.
  std::array<double, n> scales(double step) const { return scales(diagonal(step)); }
  std::array<double, n> scales(std::span<const double> diagonal) const;

  /// |storage - step / theta_ref G| |x|, entry by entry, the size of the terms of a product; on
  /// several ranks at most that of their shares.
  std::vector<double> sizes(double step, std::span<const double> x) const;

  /// storage x, field by field; `products` is overwritten. A constant potential has no charges, so
  /// those of a row come from differences to its own: in a conductor, whose permittivity is 10^6
  /// times the others', sums of the potentials themselves lose seven digits.
  void multiply_by_field(std::span<const double> x, FieldProducts &products) const;

  /// The incompatible modes of this rank's cells, in the order of `for_each_cell`; empty without.
  const std::vector<CellModes<dim>> &modes() const { return modes_; }
  /// What the modes of state x shift between the parts of the stored energy [J]: the forms of the
  /// condensed `storage` add up to the whole, but each form is the energy of its own field only
  /// together with this. Its sum is zero; without modes it is nothing.
  Energies energy_shift(std::span<const double> x) const;

  /// G theta by node [W], what conduction and exchange take from each node.
  std::vector<double> conducted(std::span<const double> x) const;
  /// X phi by node [C], what capacitors at the boundary hold; empty: there are none.
  std::vector<double> held_by_capacitors(std::span<const double> x) const;

 private:
  void add_cell(const Quadrature<dim> &cell, const material::BodyConstants<dim> &material);
  void add_modes(const Quadrature<dim> &cell, const material::BodyConstants<dim> &material);
  void add_facets(const Discretisation<dim> &body, const std::vector<std::string> &boundaries,
                  const casefile::Formula &coefficient, double factor, const char *what,
                  std::vector<double> &blocks);
  std::vector<double> times(const std::vector<double> &blocks, int component,
                            std::span<const double> x) const;
  /// Where an entry of the graph is held: with the other of the same two nodes.
  struct Place {
    std::size_t block : 63;
    std::size_t is_transposed : 1;
  };
  std::vector<Place> places() const;
  std::size_t block_of(Node row, Node column) const;
  template <class Visit>
  void for_each_block(const Visit &visit) const;
  std::size_t n_blocks() const;

  NodeGraph graph_;
  std::vector<Place> place_;    // by entry of the graph
  const NodeSharing &sharing_;  // of the body
  std::vector<Block, Eigen::aligned_allocator<Block>> storage_;
  std::vector<double> conduction_;
  std::vector<double> capacitors_;     // empty: there are none here
  bool has_capacitors_ = false;        // the same on all ranks
  std::vector<CellModes<dim>> modes_;  // of this rank's cells
  std::optional<RateForces<dim>> rates_;
  double reference_temperature_;
};

}  // namespace tourmaline::body
