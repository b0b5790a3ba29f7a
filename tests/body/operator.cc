#include "body/operator.h"

#include <gtest/gtest.h>

#include <numeric>
#include <random>

#include "body/derived.h"
#include "body/loads.h"
#include "body/prescribed.h"
#include "material/orientation.h"
#include "mesh/mesh.h"
#include "tourmaline/case/case.h"

namespace tourmaline::body {
namespace {

using casefile::CellShape;

casefile::MaterialCase material_case() {
  casefile::MaterialCase asked;
  asked.library = "BaTiO3-Liu2014";
  return asked;
}

material::Constants constants(int dimension) {
  return material::rotated(material::constants_of(material_case()),
                           material::crystal_axes(material_case(), dimension));
}

template <int dim>
Discretisation<dim> box(CellShape shape, int degree, int n = 3) {
  casefile::MeshCase mesh;
  mesh.box = casefile::Box{std::vector<double>(dim, 0.), std::vector<double>(dim, 0.1),
                           std::vector<int>(dim, n), shape};
  return {mesh::build<dim>(mesh), degree};
}

template <int dim>
Operator<dim> assemble(const Discretisation<dim> &body) {
  return {body, material::restricted<dim>(constants(dim))};
}

std::vector<double> random_state(std::size_t n, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  std::vector<double> x(n);
  for (double &v : x)
    v = normal(random);
  return x;
}

double dot(const std::vector<double> &a, const std::vector<double> &b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.);
}

// State with displacement h x, potential -E.x, temperature theta.
template <int dim>
std::vector<double> uniform_state(const Discretisation<dim> &body, const Eigen::Matrix3d &h,
                                  const Eigen::Vector3d &field, double theta) {
  std::vector<double> x(body.n_nodes() * Fields<dim>::count);
  for (Node i = 0; i < body.n_nodes(); ++i) {
    const Eigen::Vector3d p(body.points()[i].data());
    for (int c = 0; c < dim; ++c)
      x[unknown<dim>(i, c)] = h.row(c).dot(p);
    x[unknown<dim>(i, Fields<dim>::potential)] = -field.dot(p);
    x[unknown<dim>(i, Fields<dim>::temperature)] = theta;
  }
  return x;
}

template <int dim>
void expect_symmetric(CellShape shape, int degree) {
  const auto body = box<dim>(shape, degree);
  const auto op = assemble(body);
  const std::size_t n = body.n_nodes() * Fields<dim>::count;
  const std::vector<double> x = random_state(n, 1), y = random_state(n, 2);
  std::vector<double> kx(n), ky(n);
  op.multiply(0.01, x, kx);
  op.multiply(0.01, y, ky);
  EXPECT_NEAR(dot(y, kx), dot(x, ky), 1e-11 * std::sqrt(dot(kx, kx) * dot(y, y)));
}

TEST(Operator, IsSymmetricOnEveryShapeOfCellAndDegree) {
  for (const int degree : {1, 2}) {
    expect_symmetric<2>(CellShape::triangle, degree);
    expect_symmetric<2>(CellShape::quadrilateral, degree);
    expect_symmetric<3>(CellShape::tetrahedron, degree);
    expect_symmetric<3>(CellShape::hexahedron, degree);
  }
}

// The forms of a uniform state are the energies by hand: volume times the quadratic forms of (1),
// (2), (6).
template <int dim>
void expect_energies_by_hand(CellShape shape, int degree) {
  const auto body = box<dim>(shape, degree);
  const auto op = assemble(body);
  const auto c = material::restricted<dim>(constants(dim));
  Eigen::Matrix3d h;
  h << 1, 2, 0.5, -1, 3, 0.2, 0.7, -0.4, 2;
  const Eigen::Vector3d field(2, -3, 1.5);
  const double theta = 1.7, volume = std::pow(0.1, dim);
  const std::vector<double> x = uniform_state(body, h, field, theta);
  Eigen::Matrix<double, material::n_strains<dim>, 1> strain;
  if constexpr (dim == 2)
    strain << h(0, 0), h(1, 1), 0, h(0, 1) + h(1, 0);
  else
    strain << h(0, 0), h(1, 1), h(2, 2), h(1, 2) + h(2, 1), h(0, 2) + h(2, 0), h(0, 1) + h(1, 0);
  const Eigen::Matrix<double, dim, 1> e = field.head<dim>();
  FieldProducts products;
  op.multiply_by_field(x, products);
  std::array<std::array<double, 3>, 3> f{};  // x_a . K_ab x_b by field
  for (std::size_t i = 0; i < x.size(); ++i)
    for (std::size_t b = 0; b < 3; ++b)
      f[std::max<std::size_t>(i % Fields<dim>::count, dim - 1) - (dim - 1)][b] +=
          x[i] * products.of[b][i];
  const auto close = [](double a, double b) { EXPECT_NEAR(a, b, 1e-10 * std::abs(b)); };
  close(f[0][0], volume * strain.dot(c.stiffness * strain));
  close(f[1][1], -volume * e.dot(c.permittivity * e));
  close(f[2][2], -volume * c.heat_capacity * theta * theta);
  close(f[0][1], -volume * e.dot(c.piezoelectric * strain));
  close(f[1][2], -volume * c.pyroelectric.dot(e) * theta);
  close(f[0][2], -volume * c.thermal_stress.dot(strain) * theta);
  close(f[1][0], f[0][1]);
  close(f[2][1], f[1][2]);
  close(f[2][0], f[0][2]);
}

TEST(Operator, FormsOfAUniformStateAreTheEnergiesByHand) {
  expect_energies_by_hand<2>(CellShape::triangle, 1);
  expect_energies_by_hand<2>(CellShape::quadrilateral, 2);
  expect_energies_by_hand<3>(CellShape::tetrahedron, 1);
  expect_energies_by_hand<3>(CellShape::tetrahedron, 2);
  expect_energies_by_hand<3>(CellShape::hexahedron, 1);
}

TEST(Operator, ARigidMotionAndAConstantPotentialCostNothing) {
  const auto body = box<3>(CellShape::tetrahedron, 1);
  const auto op = assemble(body);
  Eigen::Matrix3d spin;
  spin << 0, 1, -2, -1, 0, 3, 2, -3, 0;
  std::vector<double> x = uniform_state<3>(body, spin, Eigen::Vector3d::Zero(), 0);
  for (Node i = 0; i < body.n_nodes(); ++i)
    x[unknown<3>(i, 3)] = 5;
  std::vector<double> kx(x.size());
  op.multiply(0.01, x, kx);
  EXPECT_LT(std::sqrt(dot(kx, kx)), 1e-12 * 166e9 * 0.1);
}

TEST(Operator, RowsColumnsAndHistoryArePartsOfTheSameMatrix) {
  const auto body = box<2>(CellShape::triangle, 1);
  auto op = assemble(body);
  op.add_exchange(body, {"left"}, 3.);
  const std::size_t n = body.n_nodes() * 4;
  const std::vector<double> x = random_state(n, 3);
  std::vector<double> kx(n), storage_x(n), history(n, 0.);
  op.multiply(0.01, x, kx);
  op.multiply(0, x, storage_x);
  FieldProducts products;
  op.multiply_by_field(x, products);
  add_history<2>(products, history);
  const double size = std::sqrt(dot(kx, kx));
  for (std::size_t i = 0; i < n; ++i) {
    EXPECT_NEAR(op.row_times(i, 0.01, x), kx[i], 1e-13 * size);
    EXPECT_NEAR(history[i], i % 4 == 3 ? storage_x[i] : 0, 1e-13 * size);
  }
  std::vector<double> minus_column(n, 0.);
  std::vector<double> unit(n, 0.), column(n);
  unit[7] = 2;
  op.subtract_columns(std::vector<std::size_t>{7}, 0.01, unit, minus_column);
  op.multiply(0.01, unit, column);
  for (std::size_t i = 0; i < n; ++i)
    EXPECT_NEAR(minus_column[i], -column[i], 1e-13 * size);
}

TEST(Operator, TheExchangeTermIsTheBoundaryMassOfThatSide) {
  const auto body = box<2>(CellShape::triangle, 1);
  auto with = assemble(body);
  const auto without = assemble(body);
  with.add_exchange(body, {"left"}, 3.);
  const std::vector<double> one =
      uniform_state<2>(body, Eigen::Matrix3d::Zero(), Eigen::Vector3d::Zero(), 1);
  std::vector<double> a(one.size()), b(one.size());
  with.multiply(1, one, a);
  without.multiply(1, one, b);
  // Summed over all nodes: -(k / theta_ref) k_c length.
  EXPECT_NEAR(dot(one, a) - dot(one, b), -3 * 0.1 / 293, 1e-12);
}

TEST(Loads, AddUpToTheirResultants) {
  const auto body = box<2>(CellShape::triangle, 1);
  casefile::Case asked;
  asked.load.force = {casefile::Formula("2*t*x"), 3.};
  asked.load.charge = casefile::Formula("t");
  asked.load.heat = 7.;
  casefile::BoundaryCase top;
  top.on = {"top"};
  top.traction = casefile::FormulaVector{casefile::Formula("x*t"), casefile::Formula("-0.5*t")};
  top.surface_charge = casefile::Formula("4*x");
  top.heat_flux = casefile::Formula(5.);
  asked.boundaries = {top};
  const Loads<2> loads(body, asked, 0.01, 293);
  std::vector<double> b(body.n_nodes() * 4, 0.);
  loads.integrate(2, b);
  std::array<double, 4> sum{};
  for (std::size_t i = 0; i < b.size(); ++i)
    sum[i % 4] += b[i];
  const double area = 0.01, side = 0.1;
  EXPECT_NEAR(sum[0], 4 * 0.05 * area + 2 * 0.05 * side, 1e-15);
  EXPECT_NEAR(sum[1], 3 * area - 1 * side, 1e-15);
  EXPECT_NEAR(sum[2], -2 * area + 4 * 0.05 * side, 1e-15);  // electric rows times -1
  EXPECT_NEAR(sum[3], -0.01 / 293 * (7 * area - 5 * side),
              1e-18);  // heat rows times -k / theta_ref
}

TEST(DerivedFields, OfAUniformStateFollowTheConstitutiveLaw) {
  const auto body = box<2>(CellShape::triangle, 1);
  const material::Constants c = constants(2);
  Eigen::Matrix3d h = Eigen::Matrix3d::Zero();
  h.topLeftCorner<2, 2>() << 1e-6, 2e-6, 4e-6, -3e-6;
  const Eigen::Vector3d field(2, -3, 0);
  const auto fields = derived_fields(body, c, uniform_state(body, h, field, 0.5));
  ASSERT_EQ(fields.stress.size(), 18u);
  const output::SymmetricTensor &s = fields.stress[5];
  EXPECT_NEAR(s[0], 166e9 * 1e-6 - 78e9 * 3e-6 - (-4.4) * -3 - 2.24e6 * 0.5,
              1e-5);                                                               // xx: crystal 11
  EXPECT_NEAR(s[1], 78e9 * 1e-6 - 162e9 * 3e-6 - 18.6 * -3 - 1.89e6 * 0.5, 1e-5);  // yy: crystal 33
  EXPECT_NEAR(s[2], 77e9 * 1e-6 - 78e9 * 3e-6 - (-4.4) * -3 - 2.24e6 * 0.5,
              1e-5);  // zz: plane strain
  EXPECT_NEAR(s[3], 43e9 * 6e-6 - 11.6 * 2, 1e-5);
  EXPECT_NEAR(fields.electric_displacement[5][0], 11.6 * 6e-6 + 11.2e-9 * 2, 1e-15);
  EXPECT_NEAR(fields.electric_displacement[5][1],
              -4.4 * 1e-6 - 18.6 * 3e-6 + 12.6e-9 * -3 - 1e-4 * 0.5, 1e-15);
  EXPECT_NEAR(fields.strain[5][3], 3e-6, 1e-18);
}

TEST(DerivedFields, VonMisesOfUniaxialStressIsThatStressAndOfPressureZero) {
  EXPECT_DOUBLE_EQ(von_mises({-7, 0, 0, 0, 0, 0}), 7);
  EXPECT_DOUBLE_EQ(von_mises({3, 3, 3, 0, 0, 0}), 0);
  EXPECT_DOUBLE_EQ(von_mises({0, 0, 0, 0, 2, 0}), 2 * std::sqrt(3.));
}

// A tension along (1, 1, 1) under a pressure, and Mohr's circle in each plane.
TEST(DerivedFields, PrincipalStressesAreThoseOfTheirOwnAxes) {
  const Vector3 tension = principal_stresses({0, 0, 0, 1, 1, 1});
  EXPECT_NEAR(tension[0], 2, 1e-15);
  EXPECT_NEAR(tension[1], -1, 1e-15);
  EXPECT_NEAR(tension[2], -1, 1e-15);
  const Vector3 circles[] = {principal_stresses({1, 7, 20, 4, 0, 0}),
                             principal_stresses({20, 1, 7, 0, 4, 0}),
                             principal_stresses({1, 20, 7, 0, 0, 4})};
  for (const Vector3 &circle : circles) {
    EXPECT_NEAR(circle[0], 20, 1e-14);
    EXPECT_NEAR(circle[1], 9, 1e-14);
    EXPECT_NEAR(circle[2], -1, 1e-14);
  }
}

TEST(DerivedFields, HeatFlowsAgainstTheGradientOfTemperature) {
  const auto body = box<2>(CellShape::quadrilateral, 1);
  std::vector<double> x(body.n_nodes() * 4, 0.);
  for (Node i = 0; i < body.n_nodes(); ++i)
    x[unknown<2>(i, 3)] = 10 * body.points()[i][0];
  const auto fields = derived_fields(body, constants(2), x);
  EXPECT_NEAR(fields.heat_flux[0][0], -500, 1e-9);  // k11 = 50
  EXPECT_NEAR(fields.heat_flux[0][1], 0, 1e-9);
}

TEST(Prescribed, WhereTwoBoundariesMeetTheFirstEntryOfTheCaseHolds) {
  const auto body = box<2>(CellShape::triangle, 1);
  casefile::BoundaryCase right, top;
  right.on = {"right"};
  right.temperature = casefile::Formula(1.);
  top.on = {"top"};
  top.temperature = casefile::Formula(2.);
  const auto prescribed = prescribed_unknowns(body, {right, top});
  EXPECT_EQ(prescribed.size(), 7u);
  for (const Prescribed &p : prescribed)
    EXPECT_EQ(p.value.value(p.point, 0), p.point[0] > 0.0999 ? 1 : 2);
}

}  // namespace
}  // namespace tourmaline::body
