#pragma once

#include <string>
#include <vector>

#include "body/operator.h"
#include "body/surface_exchange.h"
#include "tourmaline/case/boundary_case.h"
#include "tourmaline/case/load_case.h"

namespace tourmaline::casefile {
struct Case;
}

namespace tourmaline::body {

/// What a load is, and the boundary it acts on; none for volume loads.
struct LoadKind {
  enum Kind {
    force,
    charge,
    heat,
    traction,
    surface_charge,
    heat_flux,
    foundation_heat,
    foundation_charge
  } kind;
  std::string boundary;
  int component = 0;  ///< of force and traction
};

/// The integral of a density against the shape functions, (density(t), v), for one component of the
/// unknowns. What does not change is integrated once: a density without t wholly, one without x, y,
/// z up to its factor in time.
class Load {
 public:
  /// One quadrature point's share: density at `point` times `weights[a]` goes to node `nodes[a]`.
  struct Share {
    Vector3 point;
    std::vector<Node> nodes;
    std::vector<double> weights;
  };

  /// `factor` multiplies the density; `stride` unknowns a node, this load in component `component`.
  Load(LoadKind kind, casefile::Formula density, double factor, int stride, int component);

  const LoadKind &kind() const { return kind_; }
  void add(Share share);
  /// Sums what was integrated here and now over the ranks; once, when all shares are there.
  void sum_over_ranks(const NodeSharing &sharing);
  /// Whether `integrate` gives this rank's share only: shares of a density that depends on place
  /// and time stay with the rank that owns their cells.
  bool is_distributed() const;
  /// Adds the load at time t to `right_side`.
  void integrate(double t, std::vector<double> &right_side) const;
  /// The integral of the density itself, without `factor`, over all ranks: a resultant force [N],
  /// charge [C], heat flow [W].
  double resultant(double t) const;

 private:
  double factor_in_time(double t) const;
  void add_to(std::vector<double> &right_side, double density, const Share &share) const;

  LoadKind kind_;
  casefile::Formula density_;
  double factor_;
  int stride_, component_;
  std::vector<Share> shares_;    // of a density that depends on place and time
  std::vector<double> uniform_;  // by node, of any other: density(t) or 1 times this
  double sum_ = 0;               // of these, over all nodes
};

/// Adds the shares of a cell or facet; `weight` scales the density at each point.
template <int dim>
void add_shares(const Quadrature<dim> &quadrature, const casefile::Formula &weight, Load &load);

/// Right-hand sides (19)-(21), (18) in the signs of `Operator`: the electric part times -1, the
/// heat part times -k / theta_ref.
template <int dim>
class Loads {
 public:
  /// `step` is k [s]; of the exchanges what the outside brings.
  Loads(const Discretisation<dim> &body, const casefile::Case &asked, double step,
        double reference_temperature, const std::vector<SurfaceExchange> &exchanges = {});

  /// Adds all loads at time t, of all ranks; one entry for each unknown of this rank.
  void integrate(double t, std::vector<double> &right_side) const;

  const std::vector<Load> &each() const { return loads_; }

 private:
  void add_volume_loads(const Discretisation<dim> &body, const casefile::LoadCase &load);
  void add_surface_loads(const Discretisation<dim> &body, const casefile::BoundaryCase &boundary);
  void add_exchange(const Discretisation<dim> &body, const SurfaceExchange &exchange);
  void add_over_facets(const Discretisation<dim> &body, LoadKind kind,
                       const casefile::Formula &density, const casefile::Formula &weight,
                       double factor, int component);

  const NodeSharing *sharing_;  // of the body; they may be assigned
  double heat_factor_;
  std::vector<Load> loads_;
};

}  // namespace tourmaline::body
