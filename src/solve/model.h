#pragma once

#include <memory>
#include <span>
#include <vector>

#include "body/cell_products.h"
#include "body/loads.h"
#include "body/operator.h"
#include "body/prescribed.h"
#include "case/time_steps.h"
#include "contact/contacts.h"
#include "contact/interface.h"
#include "material/composition.h"
#include "tourmaline/case/case.h"
#include "tourmaline/contact/friction.h"

namespace tourmaline::solve {

/// Everything a step needs that does not change from step to step: the case as mathematics.
template <int dim>
struct Model {
  /// `shares_nodes`: of several ranks each has a part of the nodes alone (`body::NodeSharing`).
  explicit Model(const casefile::Case &asked_for, bool shares_nodes = false);
  /// On a mesh of the caller's, whose boundaries the case names, of one material; `asked_for.mesh`
  /// says only the degree.
  Model(const casefile::Case &asked_for, mesh::Mesh<dim> mesh);
  Model(const Model &) = delete;  // its members refer to each other

  casefile::Case asked;
  casefile::TimeSteps steps;
  double step;  ///< k of the step at hand [s]
  material::Composition<dim> composition;
  body::Discretisation<dim> body;
  body::Operator<dim> op;
  body::CellProducts<dim> cells;                    ///< the products of `op`, cell by cell
  std::vector<body::Prescribed> prescribed;         ///< of a static case all temperatures, too
  std::vector<std::vector<body::Node>> electrodes;  ///< nodes by electrode of the case
  /// By contact: where the potential of its foundation is found, else nothing.
  std::vector<std::shared_ptr<double>> found_potentials;
  contact::Contacts laws;                               ///< the case's
  std::vector<body::SurfaceExchange> linear_exchanges;  ///< in operator and loads
  body::Loads<dim> loads;
  std::vector<contact::InterfaceNode<dim>> interface;  ///< empty without contact
  std::vector<body::Node> contact_edges;  ///< where contacts meet with normals of their own
  contact::FrictionAt friction;           ///< the case's, unless replaced
  double mesh_seconds = 0, assemble_seconds = 0;

  double time(int n) const { return steps.at(n); }
  /// Of the step before the one that ends then.
  double time_before(double time) const { return steps.before(time); }
  /// Steps of that k follow [s]. What has factorised or scaled by the k before serves them no more.
  void set_step(double k);
  std::size_t n_unknowns() const { return body.n_nodes() * body::Fields<dim>::count; }
  const body::NodeSharing &sharing() const { return body.sharing(); }
  /// Whether sums over unknowns count this one here.
  bool counts(std::size_t unknown) const {
    return sharing().counts(static_cast<body::Node>(unknown / body::Fields<dim>::count));
  }

  using Vector = Eigen::Matrix<double, dim, 1>;
  /// Where the foundation has moved to [m]; and u_nu at which a contact node touches it.
  Vector foundation(const contact::InterfaceNode<dim> &at, double time) const;
  double reach(const contact::InterfaceNode<dim> &at, double time) const;
  /// The last step's unknowns, the contact nodes' displacements carried along with the foundation:
  /// slip is what they differ from these. `carried` is filled where the foundation moves.
  std::span<const double> carried(std::span<const double> before, double time,
                                  std::vector<double> &carried) const;
  /// Adds the loads at time t: `loads` and the inertia of the base's acceleration.
  void add_loads(double t, std::vector<double> &right_side) const;
  /// K x of the step; cell by cell, where the round-off of assembled entries would stay unseen.
  std::vector<double> product(std::span<const double> x, bool by_cells) const;
  /// Of the storage operator, likewise.
  body::FieldProducts products_by_field(std::span<const double> x, bool by_cells) const;

 private:
  void add_capacitors();
  void add_rate_forces();
  struct Built;  // material and mesh, made before the members that need them
  explicit Model(const casefile::Case &asked_for, Built built);
};

}  // namespace tourmaline::solve
