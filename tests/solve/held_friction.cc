// Friction at contact nodes that other conditions move along the foundation: the traction answers
// the whole slip, S du / |du| (9), and supports bear what is neither friction nor normal.
#include <gtest/gtest.h>

#include <cmath>

#include "../cases/run_case.h"
#include "../contact/ellipse.h"
#include "solve/model.h"
#include "tourmaline/case/case.h"
#include "tourmaline/error.h"

namespace tourmaline::solve {
namespace {

using contact::Tangent;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using verified::Table;

/// The step (31)-(36) written out anew, small and slow: all unknowns in one dense matrix,
/// prescribed values and u_nu = 0 by multipliers, and the whole tangential traction of every
/// contact node, free or not, by (35) in its own words, lambda = P(lambda + r d), node after node
/// until nothing changes. It shares with the program the body's operator and loads, and of the
/// contact nothing but nodes, weights and normals.
template <int dim>
class Reference {
 public:
  using Vector = Eigen::Matrix<double, dim, 1>;
  using Basis = Eigen::Matrix<double, dim, dim - 1>;
  struct Node {
    double weight;
    Vector normal;
    Basis tangent;
    bool is_kept_normal;  // by u_nu = 0, not by prescribed components
    Tangent lambda = Tangent::Zero(dim - 1), slip;
    double normal_force = 0;  // of the foundation on the body
  };

  explicit Reference(const casefile::Case &asked)
      : model_(asked), state_(body::initial_state(model_.body, asked.initial)) {
    const auto n = static_cast<Index>(state_.size());
    std::vector<bool> is_prescribed(state_.size(), false);
    for (const body::Prescribed &p : model_.prescribed)
      is_prescribed[p.unknown] = true;
    for (const auto &at : model_.interface)
      nodes_.push_back(node(at, is_prescribed));
    const auto diagonal = model_.op.diagonal(model_.step);
    scale_ =
        VectorXd::NullaryExpr(n, [&](Index i) { return 1 / std::sqrt(std::abs(diagonal[i])); });
    n_rows_ = n + static_cast<Index>(model_.prescribed.size()) +
              std::count_if(nodes_.begin(), nodes_.end(),
                            [](const Node &at) { return at.is_kept_normal; });
    factorise(n);
    respond(n);
  }

  /// One step; afterwards `state` and `nodes` are those of its end.
  void step(double time) {
    const auto n = static_cast<Index>(state_.size());
    std::vector<double> loads(state_.size(), 0.);
    model_.loads.integrate(time, loads);
    body::add_history<dim>(model_.products_by_field(state_, false), loads);
    VectorXd b = VectorXd::Zero(n_rows_);
    b.head(n) = scale_.cwiseProduct(VectorXd::Map(loads.data(), n));
    for (std::size_t k = 0; k < model_.prescribed.size(); ++k) {
      const body::Prescribed &p = model_.prescribed[k];
      b[n + static_cast<Index>(k)] =
          p.value.value(p.point, time) / scale_[static_cast<Index>(p.unknown)];
    }
    VectorXd x = kkt_.solve(b);
    x += kkt_.solve(b - matrix_ * x);
    const VectorXd before = VectorXd::Map(state_.data(), n);
    answer(slips(scale_.cwiseProduct(x.head(n)) - before));
    for (std::size_t i = 0; i < nodes_.size(); ++i)
      x += response_.middleCols((dim - 1) * static_cast<Index>(i), dim - 1) * nodes_[i].lambda;
    VectorXd::Map(state_.data(), n) = scale_.cwiseProduct(x.head(n));
    Index row = n + static_cast<Index>(model_.prescribed.size());
    for (Node &at : nodes_)
      if (at.is_kept_normal)
        at.normal_force = -x[row++] * normal_scale_;
  }

  const Model<dim> &model() const { return model_; }
  const std::vector<double> &state() const { return state_; }
  const std::vector<Node> &nodes() const { return nodes_; }
  std::function<Tangent(std::size_t, const Tangent &)> projection;

 private:
  Node node(const contact::InterfaceNode<dim> &at, const std::vector<bool> &is_prescribed) const {
    Vector free_normal = at.normal;
    for (int c = 0; c < dim; ++c)
      if (is_prescribed[body::unknown<dim>(at.node, c)])
        free_normal[c] = 0;
    const MatrixXd q = Eigen::HouseholderQR<MatrixXd>(MatrixXd(at.normal)).householderQ();
    return {at.weight,
            at.normal,
            q.rightCols(dim - 1),
            free_normal.norm() > 1e-8,
            Tangent::Zero(dim - 1),
            Tangent::Zero(dim - 1)};
  }

  void factorise(Index n) {
    matrix_ = MatrixXd::Zero(n_rows_, n_rows_);
    std::vector<double> x(state_.size(), 0.), y(state_.size());
    for (Index i = 0; i < n; ++i) {
      x[static_cast<std::size_t>(i)] = scale_[i];
      model_.op.multiply(model_.step, x, y);
      matrix_.col(i).head(n) = scale_.cwiseProduct(VectorXd::Map(y.data(), n));
      x[static_cast<std::size_t>(i)] = 0;
    }
    Index row = n;
    for (const body::Prescribed &p : model_.prescribed)
      matrix_(row++, static_cast<Index>(p.unknown)) = 1;
    normal_scale_ =
        1 / scale_[static_cast<Index>(body::unknown<dim>(model_.interface.front().node, 0))];
    for (std::size_t i = 0; i < nodes_.size(); ++i)
      if (nodes_[i].is_kept_normal) {
        for (int c = 0; c < dim; ++c) {
          const Index at = unknown(i, c);
          matrix_(row, at) = nodes_[i].normal[c] * scale_[at] * normal_scale_;
        }
        ++row;
      }
    matrix_.topRightCorner(n, n_rows_ - n) = matrix_.bottomLeftCorner(n_rows_ - n, n).transpose();
    kkt_.compute(matrix_);
  }

  // x by unit of each lambda: friction -w t lambda on the body.
  void respond(Index n) {
    const auto n_lambda = (dim - 1) * static_cast<Index>(nodes_.size());
    MatrixXd forces = MatrixXd::Zero(n_rows_, n_lambda);
    for (std::size_t i = 0; i < nodes_.size(); ++i)
      for (int c = 0; c < dim; ++c)
        for (int k = 0; k < dim - 1; ++k)
          forces(unknown(i, c), (dim - 1) * static_cast<Index>(i) + k) =
              -nodes_[i].weight * nodes_[i].tangent(c, k) * scale_[unknown(i, c)];
    response_ = kkt_.solve(forces);
    response_ += kkt_.solve(forces - matrix_ * response_);
    compliance_.resize(n_lambda, n_lambda);
    for (Index k = 0; k < n_lambda; ++k)
      compliance_.col(k) = slips(scale_.cwiseProduct(response_.col(k).head(n)));
  }

  Index unknown(std::size_t i, int c) const {
    return static_cast<Index>(body::unknown<dim>(model_.interface[i].node, c));
  }

  VectorXd slips(const VectorXd &change) const {
    VectorXd d((dim - 1) * static_cast<Index>(nodes_.size()));
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      Vector u;
      for (int c = 0; c < dim; ++c)
        u[c] = change[unknown(i, c)];
      d.segment<dim - 1>((dim - 1) * static_cast<Index>(i)) = nodes_[i].tangent.transpose() * u;
    }
    return d;
  }

  void answer(VectorXd d) {
    const VectorXd at_rest = d;
    const double size = compliance_.diagonal().cwiseAbs().maxCoeff();
    VectorXd lambda(d.size());
    for (std::size_t i = 0; i < nodes_.size(); ++i)
      lambda.segment<dim - 1>((dim - 1) * static_cast<Index>(i)) = nodes_[i].lambda;
    double change = 1;
    for (int sweep = 0; change > 1e-14; ++sweep) {
      ASSERT_LT(sweep, 2000000) << change;
      change = 0;
      for (std::size_t i = 0; i < nodes_.size(); ++i) {
        const Index at = (dim - 1) * static_cast<Index>(i);
        const double own = compliance_.block(at, at, dim - 1, dim - 1).norm();
        const double r = 1 / (own > 1e-6 * size ? own : size);
        const Tangent now = lambda.segment<dim - 1>(at);
        const Tangent next =
            projection(i, now + r * (at_rest + compliance_ * lambda).segment<dim - 1>(at));
        change = std::max(change, (next - now).norm() / (next.norm() + 1e-300));
        lambda.segment<dim - 1>(at) = next;
      }
    }
    d = at_rest + compliance_ * lambda;
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      nodes_[i].lambda = lambda.segment<dim - 1>((dim - 1) * static_cast<Index>(i));
      nodes_[i].slip = d.segment<dim - 1>((dim - 1) * static_cast<Index>(i));
    }
  }

  const Model<dim> model_;
  std::vector<double> state_;
  std::vector<Node> nodes_;
  VectorXd scale_;
  double normal_scale_ = 1;
  Index n_rows_ = 0;
  MatrixXd matrix_, response_, compliance_;
  Eigen::PartialPivLU<MatrixXd> kkt_;
};

// A block of 36 nodes in contact on the left, pulled upwards along it. All its nodes stand on front
// and back.
constexpr const char *block = R"toml(
mesh.box = { min = [0, 0, 0], max = [0.1, 0.1, 0.1], cells = [5, 1, 2], cell = "hexahedron" }
material = { library = "BaTiO3-Liu2014", pyroelectric = [0, 0, 1e-4] }
time = { end = 0.3, steps = 3 }
boundary = [
  { on = "right", displacement = [0, 0, "4e-10*t"], potential = 0, temperature = 0 },
  { on = "top", traction = ["20*t", "30*sin(9*t)", "100*t"] },
  { on = ["front", "back"], displacement = ["free", "3e-10*t", "free"] } ]
contact = { on = "left", friction = { law = "tresca", bound = 40 }, heat = { law = "exchange", coefficient = 1, foundation_temperature = -27 } }
output = { fields = false, report = false }
)toml";

// A sleeve on a shaft, its lower end moved along y: on the tilted foundation that moves it along x
// as well.
constexpr const char *sleeve = R"toml(
mesh.annulus = { inner = 0.02, outer = 0.04, height = 0.02, cells = [1, 8, 1], cell = "hexahedron" }
material = { library = "BaTiO3-Liu2014", pyroelectric = [0, 0, 1e-4] }
time = { end = 0.3, steps = 3 }
boundary = [
  { on = "outer", displacement = ["-4e-8*y*t", "4e-8*x*t", "1e-9*t"], potential = 0, temperature = 0 },
  { on = "bottom", displacement = ["free", "1e-9*t", "free"] } ]
contact = { on = "inner", friction = { law = "tresca", bound = 1000 }, heat = { law = "exchange", coefficient = 1, foundation_temperature = -27 } }
output = { fields = false, report = false }
)toml";

// A plane block that is dragged over its foundation from its right side.
constexpr const char *plane = R"toml(
mesh.box = { min = [0, 0], max = [0.1, 0.1], cells = [6, 4] }
material = { library = "BaTiO3-Liu2014", pyroelectric = [0, 1e-4] }
time = { end = 3, steps = 3 }
boundary = [
  { on = "right", displacement = ["1e-7*t", "free"], potential = 0, temperature = 0 },
  { on = "top", displacement = ["free", 0] } ]
contact = { on = "bottom", friction = { law = "tresca", bound = 1e4 }, heat = { law = "exchange", coefficient = 1, foundation_temperature = -27 } }
output = { fields = false, report = false }
)toml";

using Overrides = std::vector<std::string>;

casefile::Case asked(const std::string &text, Overrides overrides, const Overrides &more) {
  overrides.insert(overrides.end(), more.begin(), more.end());
  return casefile::read_text(text, "case.toml", overrides);
}

struct Variant {
  std::string name, text;
  Overrides overrides;
  bool own_law = false;  // an ellipse instead of Tresca's ball
};

void PrintTo(const Variant &variant, std::ostream *out) {
  *out << variant.name;
}

// Half axes of 50 and 20 N/m^2 along (0, 2, 1) and (0, -1, 2).
Eigen::Matrix2d ellipse_in(const Eigen::MatrixXd &basis) {
  const Eigen::Vector3d strong = Eigen::Vector3d(0, 2, 1).normalized(),
                        weak = Eigen::Vector3d(0, -1, 2).normalized();
  return basis.transpose() * (2500 * strong * strong.transpose() + 400 * weak * weak.transpose()) *
         basis;
}

contact::Friction ellipse_at(const contact::ContactPlace &place) {
  return contact::OwnLaw{std::make_shared<verified::Ellipse>(ellipse_in(place.directions))};
}

double largest_of(const std::vector<double> &values) {
  return verified::largest(values);
}

template <int dim>
void expect_rows_of_a_step(const Reference<dim> &reference, const Table &contact,
                           std::size_t first) {
  const char *axes[] = {"_x", "_y", "_z"};
  double size = 0, speed = 0, moved = 0;
  for (std::size_t i = 0; i < reference.state().size(); ++i)
    if (body::field_of<dim>(i) == 0)
      moved = std::max(moved, std::abs(reference.state()[i]));
  for (const auto &at : reference.nodes()) {
    size = std::max({size, at.lambda.norm(), std::abs(at.normal_force / at.weight)});
    speed = std::max(speed, at.slip.norm() / reference.model().step);
  }
  const std::vector<double> normal = contact.numbers("normal_traction"),
                            rate = contact.numbers("slip_rate");
  for (std::size_t i = 0; i < reference.nodes().size(); ++i) {
    SCOPED_TRACE("node " + std::to_string(i));
    const auto &at = reference.nodes()[i];
    const bool slips = at.slip.norm() > 1e-9 * speed * reference.model().step;
    EXPECT_EQ(contact.columns.at("status")[first + i], slips ? "slip" : "stick");
    EXPECT_NEAR(rate[first + i], at.slip.norm() / reference.model().step, 1e-9 * speed);
    if (at.is_kept_normal) {
      EXPECT_NEAR(normal[first + i], at.normal_force / at.weight, 1e-9 * size);
    }
    // Not tighter where a point is moved across by a hair: lambda = S d/|d| turns by as much of S
    // as the error of d is of |d|, and d is the difference of displacements certain to 1e-13.
    const double turned = slips ? at.lambda.norm() * 1e-13 * moved / at.slip.norm() : 0;
    const typename Reference<dim>::Vector traction = -at.tangent * at.lambda;
    for (int c = 0; c < dim; ++c)
      EXPECT_NEAR(contact.numbers(std::string("tangential_traction") + axes[c])[first + i],
                  traction[c], 1e-9 * size + turned);
  }
}

class HeldFriction : public ::testing::TestWithParam<std::tuple<Variant, const char *>> {
 protected:
  template <int dim>
  void expect_the_reference() const {
    const Variant &variant = std::get<0>(GetParam());
    const casefile::Case c = asked(variant.text, variant.overrides, {std::get<1>(GetParam())});
    Reference<dim> reference(c);
    const output::TemporaryFolder folder;
    run::RunOptions options{.quiet = true};
    if (variant.own_law) {
      options.friction = ellipse_at;
      options.friction_name = "ellipse";
    }
    run::simulate(c, folder.path(), options);
    const Table contact = verified::read_table(folder / "contact.csv"),
                nodes = verified::read_table(folder / "nodes.csv"),
                history = verified::read_table(folder / "history.csv");
    const std::size_t n = reference.nodes().size();
    for (int k = 1; k <= c.time.steps; ++k) {
      SCOPED_TRACE("step " + std::to_string(k));
      const double time = reference.model().time(k);
      std::vector<std::shared_ptr<verified::Ellipse>> own;
      for (const auto &at : reference.nodes())
        if constexpr (dim == 3)
          own.push_back(std::make_shared<verified::Ellipse>(ellipse_in(at.tangent)));
      const double bound = c.contacts.front().friction.bound.value({}, time);
      reference.projection = [&](std::size_t i, const Tangent &x) -> Tangent {
        if (variant.own_law)
          return own[i]->traction(x);
        return x.norm() > bound ? Tangent(bound * x.normalized()) : x;
      };
      reference.step(time);
      expect_rows_of_a_step(reference, contact, n * (k - 1));
      double power = 0;
      for (const auto &at : reference.nodes())
        power += at.weight * at.lambda.dot(at.slip) / reference.model().step;
      EXPECT_GT(power, 0);
      EXPECT_NEAR(history.numbers("friction_dissipation")[k - 1], power, 1e-9 * power);
      for (const char *column : {"energy_imbalance", "force_imbalance"})
        EXPECT_LT(std::abs(history.numbers(column)[k - 1]), 1e-10) << column;
    }
    const char *names[] = {"u_x", "u_y", "u_z"};
    double size = 0;
    for (int component = 0; component < dim; ++component)
      size = std::max(size, largest_of(nodes.numbers(names[component])));
    for (body::Node node = 0; node < nodes.n_rows(); ++node)
      for (int component = 0; component < dim; ++component)
        EXPECT_NEAR(nodes.numbers(names[component])[node],
                    reference.state()[body::unknown<dim>(node, component)], 1e-9 * size);
  }
};

TEST_P(HeldFriction, IsThatOfAProgramThatKnowsTheWholeTractionAlone) {
  asked(std::get<0>(GetParam()).text, {}, {}).dimension == 2 ? expect_the_reference<2>()
                                                             : expect_the_reference<3>();
}

const std::string bottom = "boundary[2].on=bottom";

INSTANTIATE_TEST_SUITE_P(
    Cases, HeldFriction,
    ::testing::Combine(
        ::testing::Values(
            Variant{"WholeSideMovedAcross", block, {}},
            Variant{"MovedAcrossByAHair",
                    block,
                    {"boundary[2].displacement=['free','3e-14*t','free']"}},
            Variant{"OneEdgeMovedAcross", block, {bottom}},
            Variant{"OneEdgeMovedAlong",
                    block,
                    {bottom, "boundary[2].displacement=['free','free','3e-10*t']"}},
            Variant{"OneEdgeMovedBothWays",
                    block,
                    {bottom, "boundary[2].displacement=['free','3e-10*t','-2e-10*t']"}},
            Variant{"OneEdgeMovedAwayAsWell",
                    block,
                    {bottom, "boundary[2].displacement=['-1e-10*t','3e-10*t','free']"}},
            Variant{"AllMovedBothWays",
                    block,
                    {"boundary[2].displacement=['free','3e-10*t','2e-10*t*t']"}},
            Variant{"Tetrahedra", block, {bottom, "mesh.box.cell=tetrahedron"}},
            Variant{"AnotherLaw", block, {}, true},
            Variant{"AnotherLawOneEdge", block, {bottom}, true}, Variant{"DraggedPlane", plane, {}},
            Variant{"DraggedPlaneOfQuadraticQuadrilaterals",
                    plane,
                    {"mesh.degree=2", "mesh.box.cell=quadrilateral"}},
            Variant{"TiltedSleeve", sleeve, {}},
            Variant{"TiltedSleeveMovedEndwise",
                    sleeve,
                    {"boundary[1].displacement=['free','free','-3e-9*t']"}}),
        ::testing::Values("solver.method=condensed", "solver.method=monolithic")),
    [](const auto &p) {
      return std::get<0>(p.param).name + (std::string(std::get<1>(p.param)).ends_with("condensed")
                                              ? "Condensed"
                                              : "Monolithic");
    });

}  // namespace
}  // namespace tourmaline::solve
