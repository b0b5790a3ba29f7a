#include "body/rate_forces.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>

#include "body/operator.h"
#include "mesh/mesh.h"
#include "tourmaline/case/case.h"
#include "tourmaline/error.h"

namespace tourmaline::body {
namespace {

using casefile::CellShape;

constexpr double density = 5700;  // of BaTiO3-Liu2014 [kg/m^3]

template <int dim>
Discretisation<dim> box(CellShape shape, int degree, int n = 4) {
  casefile::MeshCase mesh;
  mesh.box = casefile::Box{std::vector<double>(dim, 0.), std::vector<double>(dim, 1.),
                           std::vector<int>(dim, n), shape};
  return {mesh::build<dim>(mesh), degree};
}

template <int dim>
material::Composition<dim> composition() {
  casefile::Case asked;
  asked.dimension = dim;
  asked.material.library = "BaTiO3-Liu2014";
  asked.material.constants = {
      {"density", density}, {"stiffness_damping", 1e-6}, {"mass_damping", 10.}};
  return material::Composition<dim>(asked);
}

template <int dim>
std::vector<bool> on(const Discretisation<dim> &body, const std::vector<std::string> &boundaries) {
  std::vector<bool> massless(body.n_nodes(), false);
  for (const Node node : body.nodes_on(boundaries))
    massless[node] = true;
  return massless;
}

// The form's product with a field u_c = value(point).
template <int dim, class Value>
std::vector<double> product(const Discretisation<dim> &body, const RateForces<dim> &forces,
                            typename RateForces<dim>::Kind kind, int c, const Value &value) {
  std::vector<double> x(body.n_nodes() * Fields<dim>::count, 0.), y(x);
  for (Node i = 0; i < body.n_nodes(); ++i)
    x[unknown<dim>(i, c)] = value(body.points()[i]);
  forces.add(kind, body.graph(), x, y);
  return y;
}

template <int dim>
void expect_redistributed(CellShape shape, int degree) {
  using Kind = typename RateForces<dim>::Kind;
  const Discretisation<dim> body = box<dim>(shape, degree);
  const std::vector<bool> massless = on(body, {"bottom"});
  const RateForces<dim> forces(body, composition<dim>(), Modes::none, true, massless);
  const auto inertia = product(body, forces, Kind::inertia, 0, [](const Vector3 &) { return 1.; });
  double total = 0, moment = 0;
  for (Node i = 0; i < body.n_nodes(); ++i) {
    const double mass = inertia[unknown<dim>(i, 0)];
    total += mass;
    moment += mass * body.points()[i][0];
    EXPECT_NEAR(mass, forces.node_masses()[i], 1e-12 * density);
    EXPECT_EQ(forces.diagonal()[i] > 0, !massless[i]);
  }
  EXPECT_NEAR(total, density, 1e-10 * density);
  const bool has_parallels = shape == CellShape::quadrilateral || shape == CellShape::hexahedron;
  EXPECT_NEAR(moment, density / 2, has_parallels ? 1e-10 * density : 0.1 * density);
}

TEST(RateForces, MassIsKeptAndItsCentreAlongTheContactToo) {
  for (const int degree : {1, 2}) {
    SCOPED_TRACE(degree);
    expect_redistributed<2>(CellShape::triangle, degree);
    expect_redistributed<2>(CellShape::quadrilateral, degree);
    expect_redistributed<3>(CellShape::tetrahedron, degree);
    expect_redistributed<3>(CellShape::hexahedron, degree);
  }
}

// Contact on neighbouring sides leaves a cell in the corner without any other node, of triangles.
TEST(RateForces, CornersOfTheContactGiveTheirMassToTheCellsAround) {
  const Discretisation<2> body = box<2>(CellShape::triangle, 1);
  const RateForces<2> forces(body, composition<2>(), Modes::none, true,
                             on(body, {"bottom", "left", "right", "top"}));
  const std::vector<double> &masses = forces.node_masses();
  EXPECT_NEAR(std::accumulate(masses.begin(), masses.end(), 0.), density, 1e-10 * density);
}

TEST(RateForces, AMeshOfNothingButContactIsRefused) {
  const Discretisation<2> body = box<2>(CellShape::quadrilateral, 1, 1);
  EXPECT_THROW(
      RateForces<2>(body, composition<2>(), Modes::none, true, on(body, {"bottom", "top"})),
      CaseError);
}

// All damping is by backward differences in the quasistatic regime; of a rigid motion it is that of
// the mass alone, a M.
TEST(RateForces, ARigidMotionIsResistedByMassDampingAlone) {
  using Kind = RateForces<2>::Kind;
  const Discretisation<2> body = box<2>(CellShape::quadrilateral, 1);
  const RateForces<2> forces(body, composition<2>(), Modes::incompatible, false,
                             std::vector<bool>(body.n_nodes(), false));
  const auto rigid = [](const Vector3 &) { return 1.; };
  const auto none = product(body, forces, Kind::damping, 1, rigid),
             damping = product(body, forces, Kind::backward_damping, 1, rigid),
             inertia = product(body, forces, Kind::inertia, 1, rigid);
  for (std::size_t i = 0; i < damping.size(); ++i) {
    EXPECT_EQ(none[i], 0);
    EXPECT_NEAR(damping[i], 10 * inertia[i], 1e-10 * density);
  }
}

// The same stiffness times eta, with modes of its own, where nothing is piezoelectric.
TEST(RateForces, ViscosityIsTheStiffnessOfAnUncoupledBody) {
  using Kind = RateForces<2>::Kind;
  casefile::Case asked;
  asked.material.symmetry = "isotropic";
  asked.material.constants = {{"young", 2e11},
                              {"poisson", 0.3},
                              {"eps11", 10.},
                              {"k11", 1.},
                              {"density", 1.},
                              {"specific_heat", 1.},
                              {"stiffness_damping", 0.5},
                              {"reference_temperature", 293.}};
  const material::Composition<2> composition(asked);
  const Discretisation<2> body = box<2>(CellShape::quadrilateral, 1);
  const Operator<2> op(body, composition, Modes::incompatible);
  const RateForces<2> forces(body, composition, Modes::incompatible, false,
                             std::vector<bool>(body.n_nodes(), false));
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  std::vector<double> x(body.n_nodes() * Fields<2>::count, 0.), stiff(x), viscous(x);
  for (std::size_t i = 0; i < x.size(); ++i)
    x[i] = i % 4 < 2 ? normal(random) : 0;
  op.multiply(0, x, stiff);
  forces.add(Kind::backward_damping, body.graph(), x, viscous);
  for (std::size_t i = 0; i < x.size(); ++i)
    if (i % 4 < 2) {
      EXPECT_NEAR(viscous[i], 0.5 * stiff[i], 1e-3);  // of 1e11
    }
}

// What a step's matrix is made of.
TEST(RateForces, AStepWeighsThemByItsScheme) {
  using Kind = RateForces<2>::Kind;
  const Discretisation<2> body = box<2>(CellShape::quadrilateral, 1);
  const RateForces<2> forces(body, composition<2>(), Modes::none, true, on(body, {"bottom"}));
  constexpr double k = 1e-3;
  std::vector<double> x(body.n_nodes() * Fields<2>::count, 0.), sum(x), m(x), c(x), b(x);
  for (std::size_t i = 0; i < x.size(); ++i)
    x[i] = std::sin(static_cast<double>(i));
  forces.add_of_step(body.graph(), k, x, sum);
  forces.add(Kind::inertia, body.graph(), x, m);
  forces.add(Kind::damping, body.graph(), x, c);
  forces.add(Kind::backward_damping, body.graph(), x, b);
  double size = 0, backward = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    size = std::max(size, std::abs(sum[i]));
    backward = std::max(backward, std::abs(b[i]));
  }
  EXPECT_GT(backward, 0);
  for (std::size_t i = 0; i < x.size(); ++i)
    EXPECT_NEAR(sum[i], 4 / (k * k) * m[i] + 2 / k * c[i] + 1 / k * b[i], 1e-12 * size);
}

}  // namespace
}  // namespace tourmaline::body
