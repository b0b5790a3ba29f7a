#pragma once

#include <Eigen/Dense>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "solve/model.h"
#include "solve/passage.h"

namespace tourmaline::solve {

/// What goes through a part of the boundary at the end of a step.
struct BoundaryFlow {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();   ///< on the body [N]
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();  ///< of it [N m]
  double charge = 0;                                 ///< integral of D.nu [C]
  double heat = 0;                                   ///< integral of q.nu [W]
};

/// A part of the boundary by its names, and what the case's conditions and contacts do there.
/// Several parts have together what the whole has, and all what the balances say: loads and
/// exchanges by place alone are integrated over the part's own facets, and what passes at a node
/// counts for the boundary that the balances give it to, shared out among the parts of that by the
/// areas of their facets at the node.
template <int dim>
class BoundaryPart {
 public:
  /// All ranks make one together.
  BoundaryPart(const Model<dim> &model, std::vector<std::string> names);

  /// [m^(dim-1)]
  double area() const { return area_; }
  /// All ranks ask together. The moment is about `about` [m], with the nodes where they are in the
  /// undeformed body.
  BoundaryFlow flow(double time, std::span<const Passage> passages, std::span<const double> state,
                    const Vector3 &about) const;

 private:
  /// Of an exchange by place: k_c N_i integrated by unknown, and k_c theta_f.
  struct Exchange {
    std::size_t number;  // in the model
    std::vector<double> weights;
    body::Load outside;
  };
  using Shares = std::map<body::Node, double>;

  void add_loads(const casefile::BoundaryCase &boundary);
  void add_exchange(std::size_t number);
  body::Load over_facets(const std::string &name, const casefile::Formula &density,
                         const casefile::Formula &weight, int component) const;
  void find_shares();
  Shares shares_of(const std::vector<std::string> &boundaries) const;
  double share(const Passage &passage) const;
  std::vector<double> tractions(double time) const;
  BoundaryFlow at_nodes(double time, std::span<const Passage> passages, const Vector3 &about) const;
  void add_given(double time, std::span<const double> state, BoundaryFlow &flow) const;
  double exchanged(const Exchange &exchange, double time, std::span<const double> state) const;

  const Model<dim> &model_;
  std::vector<std::string> names_;
  double area_ = 0;
  std::vector<body::Load> tractions_, charges_, heats_;
  std::vector<Exchange> exchanges_;
  // By boundary and by electrode: what of their nodes is this part's.
  std::map<std::string, Shares, std::less<>> of_boundaries_, of_electrodes_;
};

}  // namespace tourmaline::solve
