#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <random>

#include "contact/compliance.h"
#include "contact/coulomb.h"
#include "contact/damped.h"
#include "contact/held_normal.h"
#include "contact/unilateral.h"
#include "solve/connected_body.h"
#include "solve/contact_nodes.h"
#include "solve/coupled_programme.h"
#include "tourmaline/case/reader.h"

namespace tourmaline::solve {

// Of each kind in a test.
#ifdef NDEBUG
constexpr int n_programmes = 2000;
#else
constexpr int n_programmes = 60;
#endif

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// The matrix of a contact problem, by node the normal and dim - 1 tangential entries, and the
/// nodes' weights.
struct CondensedMatrix {
  int dim;
  MatrixXd stiffness;
  std::vector<double> weights;
};

/// What a block of barium titanate, or of it with an electrode and heat, shows its contact.
template <int dim>
CondensedMatrix condensed_block(const std::string &mesh, const std::string &held) {
  const auto asked = casefile::read_text(
      "mesh.box = " + mesh + "\nmaterial = { library = \"BaTiO3-Liu2014\" }\n" +
          "time = { end = 1, steps = 1 }\n" + "boundary = [ { on = \"" + held +
          "\", displacement = [0, 0" + (dim == 3 ? ", 0" : "") +
          "], potential = 0, temperature = 0 } ]\n" +
          "contact = { on = \"bottom\", normal = \"unilateral\", friction = { law = \"coulomb\", "
          "coefficient = 0.5 } }\n",
      "block.toml", {});
  const Model<dim> model(asked);
  const std::vector<bool> mask = body::mask_of(model.prescribed, model.n_unknowns());
  const ContactNodes<dim> nodes(model, mask);
  const ConnectedBody<dim> body(model);
  const MatrixXd s = nodes.directions().transpose() * (body.stiffness() * nodes.directions());
  CondensedMatrix found{dim, (s + s.transpose()) / (2 * s.diagonal().maxCoeff()), {}};
  for (const ContactPoint &p : nodes.points())
    if (p.size > 0 && p.offset % dim == 0)  // its normal, where nothing holds the node
      found.weights.push_back(p.weight / model.interface[0].weight);
  return found;
}

enum class NormalKind { bilateral, unilateral, compliance, damped };
enum class FrictionKind { none, tresca, coulomb };

/// A contact problem and what its laws are, by node.
struct ContactProblem {
  struct Node {
    Index offset;
    double weight;
    double compliance = 0, exponent = 1, before = 0;  // p = compliance (delta - before)+^exponent
    double bound = 0;                                 // S [N/m^2], or
    double mu = 0, cohesion = 0, limit = std::numeric_limits<double>::infinity();
  };
  NormalKind normal;
  FrictionKind friction;
  int dim;
  MatrixXd stiffness;
  VectorXd force;
  std::vector<Node> nodes;
  std::vector<ContactPoint> points;
  std::vector<FrictionCoupling> couplings;

  CoupledSolution solve(const VectorXd &start, const InterfaceSettings &settings = {}) const {
    const InterfaceProgramme convex{stiffness, force, points};
    return solve_coupled({convex, couplings}, start, settings);
  }
};

// What the force lacks of the friction of a ball with a radius from `least` to `most` [N], which is
// one where the node touches without pressure and the filled graph of the bound has all of them.
inline double lack_of_friction(const VectorXd &slip, const VectorXd &force, double least,
                               double most) {
  const double size = slip.norm();
  if (size == 0)
    return std::max(0., force.norm() - most);
  const double bound = std::clamp(force.dot(slip) / size, least, most);
  return (force - bound / size * slip).norm();
}

/// The conditions of the laws, written out without the solver's own functions: the largest that is
/// not met, as a force or as a displacement times the stiffness, over the size of the forces.
inline double violation(const ContactProblem &p, const VectorXd &d) {
  const VectorXd force = p.force - p.stiffness * d;
  const double size =
      std::max(p.force.cwiseAbs().maxCoeff(), (p.stiffness.cwiseAbs() * d.cwiseAbs()).maxCoeff());
  const double small = 1e-9 * size;
  double worst = 0;
  for (const ContactProblem::Node &node : p.nodes) {
    const double curvature = p.stiffness(node.offset, node.offset);
    const double delta = d[node.offset], pressed = force[node.offset];
    const double depth = delta - node.before;
    bool may_be_open = delta * curvature<small, may_be_closed = delta * curvature> - small;
    switch (p.normal) {
      case NormalKind::bilateral:
        worst = std::max(worst, std::abs(delta) * curvature);
        may_be_open = false;
        may_be_closed = true;
        break;
      case NormalKind::unilateral:
        worst = std::max({worst, delta * curvature, -pressed,
                          std::min(std::abs(pressed), std::abs(delta) * curvature)});
        may_be_open = pressed < small;
        break;
      default: {
        const double stiff = node.weight * node.compliance;
        const double law = depth > 0 ? stiff * std::pow(depth, node.exponent) : 0;
        // or the penetration that this force has
        const double inverse = pressed > 0 ? std::pow(pressed / stiff, 1 / node.exponent) : depth;
        worst = std::max(worst,
                         std::min(std::abs(pressed - law), curvature * std::abs(depth - inverse)));
      }
    }
    const double mu_bound =
        std::clamp(node.cohesion * node.weight + node.mu * pressed, 0., node.limit * node.weight);
    const double bound = p.friction == FrictionKind::tresca ? node.bound * node.weight : mu_bound;
    worst = std::max(worst, lack_of_friction(d.segment(node.offset + 1, p.dim - 1),
                                             force.segment(node.offset + 1, p.dim - 1),
                                             may_be_open ? 0 : bound, may_be_closed ? bound : 0));
  }
  return worst / size;
}

class RandomContacts {
 public:
  RandomContacts(unsigned seed, NormalKind normal, FrictionKind friction, double most_friction = 1)
      : normal_(normal), friction_(friction), most_friction_(most_friction), random_(seed) {}

  ContactProblem next(int dim) { return next(toss(0.6) ? some_block(dim) : random_matrix(dim)); }

  ContactProblem next(const CondensedMatrix &matrix) {
    ContactProblem p;
    p.normal = normal_;
    p.friction = friction_;
    p.dim = matrix.dim;
    p.stiffness = matrix.stiffness;
    p.force = load(p.stiffness, p.dim);
    for (std::size_t i = 0; i < matrix.weights.size(); ++i)
      add_node(p, matrix.weights[i]);
    return p;
  }

  VectorXd vector(Index n) {
    return VectorXd::NullaryExpr(n, [&] { return gauss_(random_); });
  }

 private:
  double uniform(double a, double b) {
    return std::uniform_real_distribution<double>(a, b)(random_);
  }
  bool toss(double chance) { return uniform(0, 1) < chance; }

  const CondensedMatrix &some_block(int dim) {
    static const std::vector<CondensedMatrix> plane{
        condensed_block<2>("{ min = [0, 0], max = [1, 1], cells = [8, 8] }", "top"),
        condensed_block<2>("{ min = [0, 0], max = [4, 1], cells = [20, 4] }", "top"),
        condensed_block<2>("{ min = [0, 0], max = [3, 1], cells = [12, 4] }", "right")};
    static const std::vector<CondensedMatrix> space{
        condensed_block<3>(
            "{ min = [0, 0, 0], max = [1, 1, 1], cells = [2, 2, 2], cell = \"tetrahedron\" }",
            "top"),
        condensed_block<3>(
            "{ min = [0, 0, 0], max = [2, 1, 1], cells = [4, 3, 2], cell = \"hexahedron\" }",
            "right")};
    const auto &all = dim == 2 ? plane : space;
    return all[random_() % all.size()];
  }

  // With condition numbers up to 1e6 and couplings of any sign.
  CondensedMatrix random_matrix(int dim) {
    const int n_nodes = std::uniform_int_distribution<int>(1, 15)(random_);
    const Index n = dim * n_nodes;
    CondensedMatrix m{dim, {}, {}};
    const MatrixXd q = Eigen::HouseholderQR<MatrixXd>(MatrixXd::NullaryExpr(n, n, [&] {
                         return gauss_(random_);
                       })).householderQ();
    const double decades = uniform(0, 6);
    const VectorXd spectrum =
        VectorXd::NullaryExpr(n, [&] { return std::pow(10., uniform(-decades, 0)); });
    const MatrixXd a = q * spectrum.asDiagonal() * q.transpose();
    m.stiffness = (a + a.transpose()) / 2;
    for (int i = 0; i < n_nodes; ++i)
      m.weights.push_back(std::pow(10., uniform(-2, 1)));
    return m;
  }

  // Of a random displacement, which on condensed bodies is as rough as loads can be, or of forces.
  VectorXd load(const MatrixXd &stiffness, int dim) {
    const Index n = stiffness.rows();
    VectorXd given = vector(n);
    const double pressed = uniform(-1, 2);
    for (Index i = 0; i < n; i += dim)
      given[i] += pressed;
    return toss(0.5) ? VectorXd(stiffness * given) : given;
  }

  std::shared_ptr<const contact::NormalLaw> law(ContactProblem::Node &node) {
    if (normal_ == NormalKind::bilateral)
      return std::make_shared<contact::HeldNormal>();
    if (normal_ == NormalKind::unilateral)
      return std::make_shared<contact::Unilateral>();
    node.compliance = std::pow(10., uniform(-2, 4));
    if (normal_ == NormalKind::compliance) {
      node.exponent = toss(0.5) ? 1 : uniform(1, 3);
      return std::make_shared<contact::Compliance>(node.compliance, node.exponent);
    }
    node.before = toss(0.5) ? 0 : uniform(0, 1);
    return std::make_shared<contact::Damped>(node.compliance, 1,
                                             toss(0.5)         ? node.before
                                             : node.before > 0 ? node.before
                                                               : -uniform(0, 1));
  }

  void add_node(ContactProblem &p, double weight) {
    ContactProblem::Node node{static_cast<Index>(p.nodes.size()) * p.dim, weight};
    p.points.push_back({node.offset, 1, weight, contact::NormalPoint(law(node))});
    if (friction_ == FrictionKind::tresca)
      node.bound = toss(0.1) ? 0 : toss(0.1) ? 1e6 : std::pow(10., uniform(-2, 1)) / weight;
    p.points.push_back({node.offset + 1, p.dim - 1, weight, contact::Tresca{node.bound}});
    const bool opens = normal_ != NormalKind::bilateral;
    if (friction_ == FrictionKind::coulomb || (friction_ == FrictionKind::tresca && opens))
      p.couplings.push_back({p.points.size() - 1, p.points.size() - 2, 0, false, bound(node)});
    p.nodes.push_back(node);
  }

  std::shared_ptr<const contact::FrictionBound> bound(ContactProblem::Node &node) {
    if (friction_ != FrictionKind::coulomb)
      return nullptr;
    node.mu = uniform(0, most_friction_);
    if (toss(0.2))
      node.cohesion = std::pow(10., uniform(-2, 0));
    if (toss(0.2))
      node.limit = node.cohesion + std::pow(10., uniform(-1, 1));
    return std::make_shared<contact::Coulomb>(contact::FrictionCoefficient{node.mu, node.mu},
                                              node.cohesion, node.limit);
  }

  NormalKind normal_;
  FrictionKind friction_;
  double most_friction_;
  std::mt19937 random_;
  std::normal_distribution<double> gauss_;
};

}  // namespace tourmaline::solve
