#include "condensation/condensed_body.h"

#include <gtest/gtest.h>

#include <random>

#include "body/cell_products.h"
#include "material/composition.h"
#include "mesh/mesh.h"
#include "tourmaline/case/case.h"
#include "tourmaline/error.h"

namespace tourmaline::condensation {
namespace {

using body::Fields;
using body::unknown;
using casefile::CellShape;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double step = 0.01;

template <int dim>
struct Block {
  Block(CellShape shape, int n, double size = 0.1)
      : asked(box(shape, n, size)),
        composition(asked),
        body(mesh::build<dim>(asked), 1),
        op(body, composition, body::Modes::none),
        cells(body, composition, op.modes()) {
    casefile::BoundaryCase clamp;
    clamp.on = {"right"};
    clamp.displacement = std::vector<std::optional<casefile::Formula>>(dim, casefile::Formula(0.));
    clamp.potential = casefile::Formula(0.);
    prescribed = body::prescribed_unknowns(body, {clamp});
    contact = body.nodes_on({"left"});
    for (const body::Node node : contact)
      for (int c = 0; c < dim; ++c)
        kept.push_back(unknown<dim>(node, c));
  }

  static casefile::Case box(CellShape shape, int n, double size) {
    casefile::Case asked;
    asked.dimension = dim;
    asked.material.library = "BaTiO3-Liu2014";
    asked.mesh.box = casefile::Box{std::vector<double>(dim, 0.), std::vector<double>(dim, size),
                                   std::vector<int>(dim, n), shape};
    return asked;
  }

  std::size_t contact_unknown(Eigen::Index i) const { return kept[static_cast<std::size_t>(i)]; }
  CondensedBody<dim> condense() const { return {body, op, step, prescribed, kept, choice}; }

  casefile::Case asked;
  material::Composition<dim> composition;
  body::Discretisation<dim> body;
  body::Operator<dim> op;
  body::CellProducts<dim> cells;
  std::vector<body::Prescribed> prescribed;
  std::vector<body::Node> contact;
  FactorisationChoice choice;
  std::vector<std::size_t> kept;  // what the body is condensed onto
};

// Column by column: the forces at the contact of a body in which one contact displacement is 1 m,
// all others 0, and the inside follows.
template <int dim>
MatrixXd stiffness_by_products(const Block<dim> &block, CondensedBody<dim> &condensed) {
  const std::vector<double> zero(block.body.n_nodes() * Fields<dim>::count, 0.);
  const Eigen::Index n = condensed.stiffness().rows();
  MatrixXd columns(n, n);
  for (Eigen::Index j = 0; j < n; ++j) {
    std::vector<double> x = zero, product = zero;
    condensed.reduce(zero, x);
    condensed.expand(VectorXd::Unit(n, j), x);
    block.op.multiply(step, x, product);
    for (Eigen::Index i = 0; i < n; ++i)
      columns(i, j) = product[block.contact_unknown(i)];
  }
  return columns;
}

template <int dim>
void expect_inertia_and_definiteness(Factoriser by, CellShape shape, int n, double size = 0.1) {
  Block<dim> block(shape, n, size);
  block.choice.by = by;
  CondensedBody<dim> condensed = block.condense();
  EXPECT_EQ(condensed.statistics().negative_pivots,
            static_cast<int>(condensed.n_electric_and_thermal()));
  const Eigen::SelfAdjointEigenSolver<MatrixXd> spectrum(condensed.stiffness());
  EXPECT_GT(spectrum.eigenvalues()(0), 1e-6 * spectrum.eigenvalues().tail(1)(0));
  // Both triangles, as MUMPS computes one.
  const MatrixXd &stiffness = condensed.stiffness();
  EXPECT_LT((stiffness - stiffness_by_products(block, condensed)).cwiseAbs().maxCoeff(),
            1e-8 * stiffness.cwiseAbs().maxCoeff());
}

TEST(CondensedBody,
     HasAsManyNegativePivotsAsElectricAndThermalUnknownsAndASymmetricPositiveDefiniteStiffness) {
  for (const Factoriser by : {Factoriser::own, Factoriser::mumps}) {
    expect_inertia_and_definiteness<2>(by, CellShape::triangle, 12);
    expect_inertia_and_definiteness<2>(by, CellShape::quadrilateral, 7);
    expect_inertia_and_definiteness<2>(by, CellShape::triangle, 12, 100);   // metres
    expect_inertia_and_definiteness<2>(by, CellShape::triangle, 12, 1e-6);  // micrometres
    expect_inertia_and_definiteness<3>(by, CellShape::tetrahedron, 3);
    expect_inertia_and_definiteness<3>(by, CellShape::hexahedron, 3);
  }
}

template <int dim>
void expect_planned(const Block<dim> &block) {
  const auto plan = CondensedBody<dim>::plan(block.op, step, block.prescribed, block.kept);
  const CondensedBody<dim> condensed = block.condense();
  EXPECT_EQ(plan.unknowns, condensed.n_unknowns());
  EXPECT_EQ(plan.kept, block.kept.size());
  EXPECT_GT(plan.entries, static_cast<long long>(plan.unknowns));
  EXPECT_EQ(plan.entries, condensed.statistics().factor_entries);
  EXPECT_EQ(plan.operations, condensed.statistics().flops);
}

TEST(CondensedBody, TellsBeforeAnyNumberWhatItsFactorWillTake) {
  expect_planned(Block<2>(CellShape::triangle, 20));
  expect_planned(Block<2>(CellShape::quadrilateral, 9));
  expect_planned(Block<3>(CellShape::tetrahedron, 4));
  expect_planned(Block<3>(CellShape::hexahedron, 4));
}

// By dense algebra in the unscaled unknowns; entries of different fields are compared in units in
// which the diagonal is one.
void expect_schur_complement(const Block<2> &block) {
  const CondensedBody<2> condensed = block.condense();
  const std::size_t n = block.body.n_nodes() * 4;
  MatrixXd k(n, n);
  for (std::size_t j = 0; j < n; ++j) {
    std::vector<double> unit(n, 0.), column(n);
    unit[j] = 1;
    block.op.multiply(step, unit, column);
    k.col(j) = Eigen::Map<VectorXd>(column.data(), n);
  }
  std::vector<bool> taken(n, false);
  for (const auto &p : block.prescribed)
    taken[p.unknown] = true;
  std::vector<int> interface, interior;
  for (const std::size_t unknown : block.kept) {
    interface.push_back(static_cast<int>(unknown));
    taken[unknown] = true;
  }
  for (std::size_t i = 0; i < n; ++i)
    if (!taken[i])
      interior.push_back(static_cast<int>(i));
  const MatrixXd kii = k(interior, interior), kic = k(interior, interface);
  const MatrixXd schur =
      MatrixXd(k(interface, interface)) - kic.transpose() * kii.partialPivLu().solve(kic);
  const auto scale = schur.diagonal().cwiseAbs().cwiseSqrt().cwiseInverse().asDiagonal();
  EXPECT_LT((scale * (schur - condensed.stiffness()) * scale).cwiseAbs().maxCoeff(), 1e-8);
}

TEST(CondensedBody, IsTheSchurComplementOfTheOperator) {
  expect_schur_complement(Block<2>(CellShape::triangle, 3));
}

// All potentials of the contact and the temperatures of some of its nodes.
void keep_more(Block<2> &block) {
  for (std::size_t i = 0; i < block.contact.size(); ++i) {
    block.kept.push_back(unknown<2>(block.contact[i], Fields<2>::potential));
    if (i % 2 == 0)
      block.kept.push_back(unknown<2>(block.contact[i], Fields<2>::temperature));
  }
}

TEST(CondensedBody, OntoAnySubsetOfFieldsItIsTheSchurComplementAndQuasiDefinite) {
  Block<2> block(CellShape::triangle, 4);
  const auto n_u = static_cast<Eigen::Index>(block.kept.size());
  keep_more(block);
  expect_schur_complement(block);
  const CondensedBody<2> condensed = block.condense();
  const Eigen::Index n_x = condensed.stiffness().rows() - n_u;
  EXPECT_EQ(n_x, 5 + 3);
  EXPECT_EQ(condensed.n_electric_and_thermal_inside() + static_cast<std::size_t>(n_x),
            condensed.n_electric_and_thermal());
  EXPECT_EQ(condensed.statistics().negative_pivots,
            static_cast<int>(condensed.n_electric_and_thermal_inside()));
  const MatrixXd &s = condensed.stiffness();
  EXPECT_EQ(MatrixXd(s.topLeftCorner(n_u, n_u)).llt().info(), Eigen::Success);
  EXPECT_EQ(MatrixXd(-s.bottomRightCorner(n_x, n_x)).llt().info(), Eigen::Success);
}

TEST(CondensedBody, OntoAnySubsetOfFieldsStatesSolveTheSystemRefinedOrNot) {
  Block<2> block(CellShape::quadrilateral, 6);
  keep_more(block);
  CondensedBody<2> condensed = block.condense();
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  std::vector<double> b(block.body.n_nodes() * 4), x(b.size(), 0.);
  for (std::size_t i = 0; i < b.size(); ++i)
    b[i] = normal(random) * (i % 4 < 2 ? 1 : 1e-9);
  for (const bool refined : {false, true}) {
    if (refined)
      condensed.refine(block.cells);
    const VectorXd s = condensed.reduce(b, x);
    const VectorXd c = condensed.stiffness().partialPivLu().solve(s);
    condensed.expand(c, x);
    EXPECT_LT(condensed.backward_error(b, x, VectorXd::Zero(c.size())), 1e-12) << refined;
  }
}

TEST(CondensedBody, ReducedAndExpandedStatesSolveTheWholeSystemToRoundOff) {
  const Block<2> block(CellShape::triangle, 10);
  CondensedBody<2> condensed = block.condense();
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  std::vector<double> b(block.body.n_nodes() * 4), x(b.size(), 0.);
  for (std::size_t i = 0; i < b.size(); ++i)
    b[i] = normal(random) * (i % 4 < 2 ? 1 : 1e-9);
  for (const auto &p : block.prescribed)
    x[p.unknown] = p.unknown % 4 == 2 ? 3. : 1e-10;  // lifted, not zero
  for (int repeat = 0; repeat < 2; ++repeat) {
    const VectorXd s = condensed.reduce(b, x);
    const VectorXd c = condensed.stiffness().llt().solve(s);
    condensed.expand(c, x);
    for (Eigen::Index i = 0; i < c.size(); ++i)
      EXPECT_EQ(x[block.contact_unknown(i)], c[i]) << "decided, not computed";
    const VectorXd no_contact_forces = VectorXd::Zero(c.size());
    EXPECT_LT(condensed.backward_error(b, x, no_contact_forces), 1e-12);
    // A held contact: the difference between S c and s is the force it takes.
    const VectorXd held = VectorXd::Zero(c.size()), again = condensed.reduce(b, x);
    condensed.expand(held, x);
    EXPECT_LT(condensed.backward_error(b, x, condensed.stiffness() * held - again), 1e-12);
  }
}

// Of a body that needs no refinement its answers are the same, by products of cells alone.
TEST(CondensedBody, RefinedItGivesTheSameStiffnessForcesAndStates) {
  const Block<2> block(CellShape::triangle, 8);
  CondensedBody<2> plain = block.condense(), refined = block.condense();
  refined.refine(block.cells);
  const double size = plain.stiffness().cwiseAbs().maxCoeff();
  EXPECT_LT((refined.stiffness() - plain.stiffness()).cwiseAbs().maxCoeff(), 1e-8 * size);
  std::vector<double> b(block.body.n_nodes() * 4, 0.), x(b.size(), 0.);
  for (std::size_t i = 0; i < b.size(); i += 4)
    b[i] = b[i + 1] = 1;
  for (const auto &p : block.prescribed)
    x[p.unknown] = p.unknown % 4 == 2 ? 3. : 1e-10;
  std::vector<double> y = x;
  const VectorXd s = plain.reduce(b, x), t = refined.reduce(b, y);
  EXPECT_LT((s - t).norm(), 1e-8 * s.norm());
  const VectorXd c = VectorXd::Constant(s.size(), 1e-10);
  plain.expand(c, x);
  refined.expand(c, y);
  EXPECT_LT(refined.backward_error(b, y, refined.stiffness() * c - t), 1e-12);
  EXPECT_LT(refined.left_by_refinement(), 1e-12);
  EXPECT_LT(refined.forward_error(block.cells, b, y), 1e-12);
}

TEST(CondensedBody, WithoutContactReduceAndExpandSolveTheBody) {
  Block<2> block(CellShape::triangle, 6);
  block.kept.clear();
  CondensedBody<2> condensed = block.condense();
  std::vector<double> b(block.body.n_nodes() * 4, 0.), x(b.size(), 0.);
  b[unknown<2>(0, 1)] = 1;
  condensed.reduce(b, x);
  condensed.expand(VectorXd(), x);
  EXPECT_LT(condensed.backward_error(b, x, VectorXd()), 1e-12);
  EXPECT_GT(x[unknown<2>(0, 1)], 0);
}

}  // namespace
}  // namespace tourmaline::condensation
