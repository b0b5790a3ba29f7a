// Label: analytic. Fields are chosen; the loads, charges, heat sources and boundary conditions that
// make them the solution follow from (1)-(6), (8), (11), (13). All couplings are active: the poling
// axis is tilted, so every in-plane (2D) or every (3D) entry of the tensors is there, and the
// pyroelectric vector has a part across that axis.
//
// In studies of the mesh the fields are linear in time, so backward Euler is exact and only the
// error of the mesh remains; in the study of the time step they are linear in space, so the mesh is
// exact and only the error of the step remains.

#include <deal.II/grid/grid_tools.h>
#include <fmt/format.h>

#include "../cases/run_case.h"
#include "march.h"
#include "plane_waves.h"

namespace tourmaline::testing {
namespace {

using casefile::CellShape;
using casefile::Formula;

// Courses whose rates are exact in backward Euler; they differ, so that no field's rate follows
// from another's.
const Course of_displacement{"1+2*t", "2", 1}, of_potential{"1.5-0.75*t", "-0.75", 1.5},
    of_temperature{"0.5+1.5*t", "1.5", 0.5};

template <int dim>
Waves<dim> waves(const Profile &profile);

template <>
Waves<2> waves<2>(const Profile &profile) {
  return {{{0.3, {2.1, 0.9}, 0.2, profile, of_displacement},
           {0.25, {-1.3, 2.0}, 0.7, profile, of_displacement},
           {0.4, {1.7, -1.1}, 1.1, profile, of_potential},
           {0.5, {0.8, 2.3}, -0.4, profile, of_temperature}}};
}

template <>
Waves<3> waves<3>(const Profile &profile) {
  return {{{0.3, {1.9, 0.8, -0.6}, 0.2, profile, of_displacement},
           {0.25, {-0.7, 1.6, 1.0}, 0.7, profile, of_displacement},
           {0.2, {0.5, -1.2, 1.7}, -0.3, profile, of_displacement},
           {0.4, {1.4, 0.9, 1.1}, 1.1, profile, of_potential},
           {0.5, {-0.8, 1.5, 1.2}, -0.4, profile, of_temperature}}};
}

// A material whose constants are all about 1, so that every coupling counts.
casefile::MaterialCase coupled_material(int dimension) {
  casefile::MaterialCase asked;
  asked.constants = {{"c11", 3},
                     {"c12", 1},
                     {"c13", 0.8},
                     {"c33", 2.5},
                     {"c44", 0.9},
                     {"e31", -0.3},
                     {"e33", 0.9},
                     {"e15", 0.6},
                     {"beta11", 1.1},
                     {"beta33", 1.4},
                     {"m11", 0.5},
                     {"m33", 0.3},
                     {"k11", 0.7},
                     {"k33", 1.2},
                     {"density", 1},
                     {"specific_heat", 2},
                     {"reference_temperature", 1.5}};
  asked.pyroelectric = std::vector<double>{0.2, 0.1, 0.4};
  asked.poling = {0.3, -0.5, 0.8};
  asked.axis1 = {0.9, 0.2, -0.4};
  if (dimension == 2) {
    asked.pyroelectric = std::vector<double>{0.2, 0.4};
    asked.poling = {0.5, 0.8};
    asked.axis1.clear();
  }
  return asked;
}

struct Side {
  const char *name;
  int axis, sign;
};

std::vector<Side> sides(int dimension) {
  if (dimension == 2)
    return {{"left", 0, -1}, {"right", 0, 1}, {"bottom", 1, -1}, {"top", 1, 1}};
  return {{"left", 0, -1}, {"right", 0, 1},   {"front", 1, -1},
          {"back", 1, 1},  {"bottom", 2, -1}, {"top", 2, 1}};
}

template <int dim>
Vector<dim> normal_of(const Side &side) {
  return side.sign * Vector<dim>::Unit(side.axis);
}

/// A case on n intervals along each axis and the fields that its loads and conditions are to bring
/// about.
template <int dim>
struct Problem {
  Problem(const casefile::MaterialCase &material, const Waves<dim> &waves, double length,
          double end)
      : exact(constants(material), waves) {
    asked.dimension = dim;
    asked.material = material;
    casefile::Box &box = asked.mesh.box.emplace();
    box.min.assign(dim, 0.);
    box.max.assign(dim, length);
    asked.time = {end, 2};
    asked.output.fields = false;
    asked.output.every = 1;
    for (int i = 0; i < dim; ++i) {
      asked.load.force.emplace_back(exact.force(i));
      asked.initial.displacement.emplace_back(exact.at_start(i));
    }
    asked.load.charge = Formula(exact.charge());
    asked.load.heat = Formula(exact.heat());
    asked.initial.potential = Formula(exact.at_start(exact.phi));
    asked.initial.temperature = Formula(exact.at_start(exact.theta));
  }

  void on_mesh(CellShape shape, int degree, int n) {
    asked.mesh.degree = degree;
    asked.mesh.box->cell = shape;
    asked.mesh.box->cells.assign(dim, n);
  }
  void prescribe_displacement(const Side &side) {
    casefile::BoundaryCase &boundary = on(side);
    boundary.displacement.emplace();
    for (int i = 0; i < dim; ++i)
      boundary.displacement->emplace_back(exact.value(i));
  }
  void prescribe_potential(const Side &side) {
    on(side).potential = Formula(exact.value(exact.phi));
  }
  void prescribe_temperature(const Side &side) {
    on(side).temperature = Formula(exact.value(exact.theta));
  }
  void prescribe(const Side &side) {
    prescribe_displacement(side);
    prescribe_potential(side);
    prescribe_temperature(side);
  }
  void pull(const Side &side) {
    casefile::BoundaryCase &boundary = on(side);
    boundary.traction.emplace();
    for (int i = 0; i < dim; ++i)
      boundary.traction->emplace_back(exact.traction(i, normal_of<dim>(side)));
  }
  void charge(const Side &side) {
    on(side).surface_charge = Formula(exact.surface_charge(normal_of<dim>(side)));
  }
  void draw_heat(const Side &side) {
    on(side).heat_flux = Formula(exact.heat_flux(normal_of<dim>(side)));
  }

  casefile::Case asked;
  Manufactured<dim> exact;

 private:
  static material::BodyConstants<dim> constants(const casefile::MaterialCase &material) {
    casefile::Case asked;
    asked.dimension = dim;
    asked.material = material;
    return material::restricted<dim>(solve::body_material(asked));
  }
  casefile::BoundaryCase &on(const Side &side) {
    for (casefile::BoundaryCase &boundary : asked.boundaries)
      if (boundary.on.front() == side.name)
        return boundary;
    asked.boundaries.emplace_back().on = {side.name};
    return asked.boundaries.back();
  }
};

/// Norms of the error over those of the solution, for u, phi and theta: of the values (L2) and of
/// the gradients (H1).
struct Errors {
  std::array<double, 3> l2{}, h1{};
};

template <int dim>
class ErrorNorms {
 public:
  ErrorNorms(const Manufactured<dim> &exact, double time) : time_(time) {
    for (int c = 0; c < dim + 2; ++c) {
      value_.emplace_back(exact.value(c));
      for (int axis = 0; axis < dim; ++axis)
        slope_.emplace_back(exact.slope(c, axis));
    }
  }

  // The rule has one point more than the degree along each axis: no point where the gradient
  // superconverges.
  Errors of(const body::Discretisation<dim> &body, const std::vector<double> &state) {
    body.for_each_cell([&](const body::Quadrature<dim> &cell) {
      for (std::size_t q = 0; q < cell.jxw.size(); ++q)
        for (int c = 0; c < dim + 2; ++c)
          add(cell, q, c, state);
    });
    Errors errors;
    for (int f = 0; f < 3; ++f) {
      errors.l2[f] = std::sqrt(l2_[f].error / l2_[f].size);
      errors.h1[f] = std::sqrt(h1_[f].error / h1_[f].size);
    }
    return errors;
  }

 private:
  struct Squares {
    double error = 0, size = 0;

    void add(double weight, double exact, double computed) {
      error += weight * (computed - exact) * (computed - exact);
      size += weight * exact * exact;
    }
  };

  void add(const body::Quadrature<dim> &cell, std::size_t q, int c,
           const std::vector<double> &state) {
    double value = 0;
    Vector<dim> gradient = Vector<dim>::Zero();
    for (std::size_t a = 0; a < cell.nodes.size(); ++a) {
      const double nodal = state[body::unknown<dim>(cell.nodes[a], c)];
      value += nodal * cell.value(q, a);
      gradient += nodal * Eigen::Map<const Vector<dim>>(cell.gradient(q, a).data());
    }
    const int field = std::max(0, c - dim + 1);
    l2_[field].add(cell.jxw[q], value_[c].value(cell.points[q], time_), value);
    for (int axis = 0; axis < dim; ++axis)
      h1_[field].add(cell.jxw[q], slope_[dim * c + axis].value(cell.points[q], time_),
                     gradient[axis]);
  }

  double time_;
  std::vector<Formula> value_, slope_;
  std::array<Squares, 3> l2_, h1_;
};

template <int dim>
std::vector<double> last_state(const Table &nodes) {
  std::vector<std::string> columns{"u_x", "u_y", "u_z"};
  columns.resize(dim);
  columns.insert(columns.end(), {"potential", "temperature"});
  std::vector<double> state(nodes.n_rows() * columns.size());
  for (std::size_t c = 0; c < columns.size(); ++c) {
    const std::vector<double> values = nodes.numbers(columns[c]);
    for (std::size_t i = 0; i < values.size(); ++i)
      state[columns.size() * i + c] = values[i];
  }
  return state;
}

template <int dim>
Errors errors_of_run(const Problem<dim> &problem, const RunCase &run) {
  const body::Discretisation<dim> body(mesh::build<dim>(problem.asked.mesh),
                                       problem.asked.mesh.degree);
  return ErrorNorms<dim>(problem.exact, problem.asked.time.end)
      .of(body, last_state<dim>(run.nodes()));
}

/// One kind of element on a sequence of meshes, by their intervals along an axis.
struct Study {
  std::string name;
  CellShape shape;
  int degree;
  std::vector<int> cells;
};

void PrintTo(const Study &study, std::ostream *out) {
  *out << study.name;
}

std::string name_of(const ::testing::TestParamInfo<Study> &study) {
  return study.param.name;
}

// Without optimisation the finest mesh in space takes half a minute; the rates of the coarser ones
// lie in the same windows.
std::vector<int> affordable_cells(const Study &study) {
  std::vector<int> cells = study.cells;
#ifndef NDEBUG
  if (casefile::dimension_of(study.shape) == 3)
    cells.pop_back();
#endif
  return cells;
}

// Leaves "L2_u@16 = 1.234e-03 (1.99)" and its like in the test's XML or JSON report; tables are
// made of them.
void record(const char *norm, const char *field, int cells, double error, double rate) {
  ::testing::Test::RecordProperty(
      fmt::format("{}_{}@{}", norm, field, cells),
      rate > 0 ? fmt::format("{:.3e} ({:.2f})", error, rate) : fmt::format("{:.3e}", error));
}

// Of errors on n and then m intervals.
double order_between(int n, double error_n, int m, double error_m) {
  return std::log(error_n / error_m) / std::log(double(m) / n);
}

using Window = std::pair<double, double>;

// Records all errors and expects the last rate of each to lie in its window.
void expect_rates(const std::vector<int> &cells, const std::vector<Errors> &errors,
                  const Window &l2, const Window &h1) {
  const std::array<const char *, 3> fields{"u", "phi", "theta"};
  const auto check = [&](const char *norm, auto member, const Window &window) {
    for (std::size_t f = 0; f < 3; ++f) {
      double rate = 0;
      for (std::size_t i = 0; i < cells.size(); ++i) {
        if (i > 0)
          rate = order_between(cells[i - 1], (errors[i - 1].*member)[f], cells[i],
                               (errors[i].*member)[f]);
        record(norm, fields[f], cells[i], (errors[i].*member)[f], rate);
      }
      EXPECT_GT(rate, window.first) << norm << " of " << fields[f];
      EXPECT_LT(rate, window.second) << norm << " of " << fields[f];
    }
  };
  check("L2", &Errors::l2, l2);
  check("H1", &Errors::h1, h1);
}

// Rates on meshes that are still coarse differ from the orders by terms of the next order. A wrong
// term or a missing coupling leaves an error that does not fall, rate 0; a wrong quadrature or
// boundary term costs half an order or more.
void expect_orders_of_the_element(const Study &study, const std::vector<Errors> &errors) {
  expect_rates(affordable_cells(study), errors, {study.degree + 0.9, study.degree + 1.2},
               {study.degree - 0.1, study.degree + 0.2});
}

template <int dim>
void expect_orders(const Study &study, Problem<dim> problem) {
  std::vector<Errors> errors;
  for (const int n : affordable_cells(study)) {
    problem.on_mesh(study.shape, study.degree, n);
    errors.push_back(errors_of_run(problem, RunCase(problem.asked)));
  }
  expect_orders_of_the_element(study, errors);
}

class ManufacturedSolution : public ::testing::TestWithParam<Study> {};

template <int dim>
Problem<dim> coupled(const Profile &profile) {
  return {coupled_material(dim), waves<dim>(profile), 1, 1};
}

template <int dim>
Problem<dim> held_on_all_sides(const Profile &profile) {
  Problem<dim> problem = coupled<dim>(profile);
  for (const Side &side : sides(dim))
    problem.prescribe(side);
  return problem;
}

TEST_P(ManufacturedSolution, HeldOnAllSidesErrorsFallWithTheOrdersOfTheElement) {
  if (casefile::dimension_of(GetParam().shape) == 2)
    expect_orders<2>(GetParam(), held_on_all_sides<2>(sine));
  else
    expect_orders<3>(GetParam(), held_on_all_sides<3>(sine));
}

// The first side is held; every other one has one to three natural conditions.
template <int dim>
Problem<dim> loaded_through_sides() {
  Problem<dim> problem = coupled<dim>(sine);
  const std::vector<Side> all = sides(dim);
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (i % 3 == 0)
      problem.prescribe_displacement(all[i]);
    else
      problem.pull(all[i]);
    if (i % 3 != 1)
      problem.prescribe_potential(all[i]);
    else
      problem.charge(all[i]);
    if (i % 2 == 0)
      problem.prescribe_temperature(all[i]);
    else
      problem.draw_heat(all[i]);
  }
  return problem;
}

TEST_P(ManufacturedSolution, UnderTractionsSurfaceChargesAndHeatFlowsErrorsFallAsWell) {
  if (casefile::dimension_of(GetParam().shape) == 2)
    expect_orders<2>(GetParam(), loaded_through_sides<2>());
  else
    expect_orders<3>(GetParam(), loaded_through_sides<3>());
}

INSTANTIATE_TEST_SUITE_P(
    Elements, ManufacturedSolution,
    ::testing::Values(Study{"Triangles", CellShape::triangle, 1, {8, 16, 32}},
                      Study{"Quadrilaterals", CellShape::quadrilateral, 1, {8, 16, 32}},
                      Study{"Tetrahedra", CellShape::tetrahedron, 1, {4, 6, 12}},
                      Study{"Hexahedra", CellShape::hexahedron, 1, {3, 6, 12}},
                      Study{"TrianglesOfDegree2", CellShape::triangle, 2, {4, 8, 16}},
                      Study{"QuadrilateralsOfDegree2", CellShape::quadrilateral, 2, {4, 8, 16}},
                      Study{"TetrahedraOfDegree2", CellShape::tetrahedron, 2, {2, 4, 6}},
                      Study{"HexahedraOfDegree2", CellShape::hexahedron, 2, {2, 3, 4}}),
    name_of);

// The material of the paper on a block of its size, with fields of the size that make stresses,
// charges and heat flows of the couplings comparable: strains of 1e-5, some 1e4 V/m, 1 K.
Problem<2> barium_titanate() {
  casefile::MaterialCase material;
  material.library = "BaTiO3-Liu2014";
  material.poling = {0.5, 0.8};
  const Course displacement{"1+0.02*t", "0.02", 1}, potential{"1.5-0.0075*t", "-0.0075", 1.5},
      temperature{"0.5+0.015*t", "0.015", 0.5};
  return {material,
          {{{3e-7, {21, 9}, 0.2, sine, displacement},
            {2.5e-7, {-13, 20}, 0.7, sine, displacement},
            {4e3, {17, -11}, 1.1, sine, potential},
            {0.5, {8, 23}, -0.4, sine, temperature}}},
          0.1,
          100};
}

TEST(ManufacturedSolutionInBariumTitanate, InSiUnitsErrorsFallWithTheOrdersOfTheElement) {
  Problem<2> problem = barium_titanate();
  for (const Side &side : sides(2))
    problem.prescribe(side);
  expect_orders<2>({"", CellShape::triangle, 1, {8, 16, 32}}, problem);
}

// Bilateral contact on the left, x = 0, with slip along y everywhere: u_x = 0 there and the bound S
// is the exact tangential traction, which opposes the slip as u_y grows and sigma_xy > 0.
template <int dim>
Problem<dim> sliding_fields();

template <>
Problem<2> sliding_fields<2>() {
  return {coupled_material(2),
          {{{0.3, {2.1, 0}, 0, sine, of_displacement},
            {0.6, {1.6, 0.3}, 0.3, sine, of_displacement},
            {0.1, {1.7, -1.1}, 1.1, sine, of_potential},
            {0.1, {0.8, 2.3}, -0.4, sine, of_temperature}}},
          1,
          1};
}

// The crystal's axes are the body's, phi and u_z do not depend on x and u_z does not move: then
// sigma_xz and the slip along z vanish at x = 0.
template <>
Problem<3> sliding_fields<3>() {
  casefile::MaterialCase material = coupled_material(3);
  material.poling.clear();
  material.axis1.clear();
  return {material,
          {{{0.3, {2.1, 0, 0}, 0, sine, of_displacement},
            {0.6, {1.6, 0.3, 0.2}, 0.3, sine, of_displacement},
            {0.2, {0, -1.2, 1.7}, -0.3, sine, {"1", "0", 1}},
            {0.1, {0, -1.1, 1.3}, 1.1, sine, of_potential},
            {0.1, {0.8, 1.5, 1.2}, -0.4, sine, of_temperature}}},
          1,
          1};
}

// The foundation's temperature follows from (13).
template <int dim>
Problem<dim> sliding_block() {
  Problem<dim> problem = sliding_fields<dim>();
  const std::vector<Side> all = sides(dim);
  for (std::size_t i = 1; i < all.size(); ++i)
    problem.prescribe(all[i]);
  problem.charge(all[0]);
  const Vector<dim> normal = normal_of<dim>(all[0]);
  casefile::ContactCase &contact = problem.asked.contact.emplace();
  contact.on = {"left"};
  contact.friction = {"tresca", Formula("-(" + problem.exact.traction(1, normal) + ")")};
  const double k_c = 2;
  contact.heat = {"exchange", k_c,
                  Formula(problem.exact.value(problem.exact.theta) +
                          fmt::format("-({})/{}", problem.exact.heat_flux(normal), k_c))};
  return problem;
}

// Root of the mean square of the error of the normal traction over that of the traction, at
// slipping nodes.
template <int dim>
double error_of_normal_traction(const Problem<dim> &problem, const Table &contact) {
  const Formula exact(problem.exact.traction(0, -Vector<dim>::Unit(0)));
  const std::vector<double> y = contact.numbers("y"), time = contact.numbers("time"),
                            traction = contact.numbers("normal_traction");
  const std::vector<double> z = dim == 3 ? contact.numbers("z") : std::vector<double>(y.size(), 0.);
  double error = 0, size = 0;
  for (std::size_t i = 0; i < y.size(); ++i) {
    if (contact.columns.at("status")[i] != "slip")
      continue;
    const double sigma = -exact.value({0, y[i], z[i]}, time[i]);
    error += (traction[i] - sigma) * (traction[i] - sigma);
    size += sigma * sigma;
  }
  return std::sqrt(error / size);
}

// All nodes but those at the edge of Gamma_C, where u is prescribed.
template <int dim>
std::size_t slipping_nodes(int n) {
  return static_cast<std::size_t>(dim == 2 ? n - 1 : (n - 1) * (n - 1));
}

template <int dim>
void expect_orders_in_sliding(const Study &study) {
  Problem<dim> problem = sliding_block<dim>();
  std::vector<Errors> errors;
  std::vector<double> traction;
  const std::vector<int> cells = affordable_cells(study);
  double rate = 0;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    problem.on_mesh(study.shape, study.degree, cells[i]);
    const RunCase run(problem.asked);
    const Table contact = run.contact();
    const std::vector<std::string> &status = contact.columns.at("status");
    EXPECT_EQ(std::count(status.begin(), status.end(), "slip"),
              problem.asked.time.steps * slipping_nodes<dim>(cells[i]));
    errors.push_back(errors_of_run(problem, run));
    traction.push_back(error_of_normal_traction(problem, contact));
    if (i > 0)
      rate = order_between(cells[i - 1], traction[i - 1], cells[i], traction[i]);
    record("nodes", "normal_traction", cells[i], traction[i], rate);
  }
  expect_orders_of_the_element(study, errors);
  // Order 1 is what can be expected of a traction; these uniform meshes give 2, not quite reached
  // on tetrahedra.
  EXPECT_GT(rate, 1.5);
}

class ManufacturedSliding : public ::testing::TestWithParam<Study> {};

TEST_P(ManufacturedSliding,
       OverATrescaFoundationThatExchangesHeatErrorsFallWithTheOrdersOfTheElement) {
  if (casefile::dimension_of(GetParam().shape) == 2)
    expect_orders_in_sliding<2>(GetParam());
  else
    expect_orders_in_sliding<3>(GetParam());
}

INSTANTIATE_TEST_SUITE_P(
    Elements, ManufacturedSliding,
    ::testing::Values(Study{"Triangles", CellShape::triangle, 1, {8, 16, 32}},
                      Study{"Quadrilaterals", CellShape::quadrilateral, 1, {8, 16, 32}},
                      Study{"Tetrahedra", CellShape::tetrahedron, 1, {4, 6, 12}},
                      Study{"Hexahedra", CellShape::hexahedron, 1, {3, 6, 12}}),
    name_of);

// Fields that the elements contain, on cells that are no boxes: nothing but round-off may remain.
// Seen: at most 6e-15.
template <int dim>
void expect_reproduction(const Study &study) {
  Problem<dim> problem = held_on_all_sides<dim>(study.degree == 1 ? line : square);
  problem.on_mesh(study.shape, study.degree, study.cells.front());
  mesh::Mesh<dim> mesh = mesh::build<dim>(problem.asked.mesh);
  dealii::GridTools::distort_random(0.15, *mesh.cells, true, 7);
  const solve::Model<dim> model(problem.asked, std::move(mesh));
  const Errors errors = ErrorNorms<dim>(problem.exact, 1).of(model.body, march(model).state);
  for (std::size_t f = 0; f < 3; ++f) {
    EXPECT_LT(errors.l2[f], 1e-12) << f;
    EXPECT_LT(errors.h1[f], 1e-12) << f;
  }
}

class PatchTest : public ::testing::TestWithParam<Study> {};

TEST_P(PatchTest, OnADistortedMeshFieldsOfTheElementsDegreeAreReproducedToRoundOff) {
  if (casefile::dimension_of(GetParam().shape) == 2)
    expect_reproduction<2>(GetParam());
  else
    expect_reproduction<3>(GetParam());
}

INSTANTIATE_TEST_SUITE_P(
    Elements, PatchTest,
    ::testing::Values(Study{"Triangles", CellShape::triangle, 1, {5}},
                      Study{"Quadrilaterals", CellShape::quadrilateral, 1, {5}},
                      Study{"Tetrahedra", CellShape::tetrahedron, 1, {3}},
                      Study{"Hexahedra", CellShape::hexahedron, 1, {3}},
                      Study{"TrianglesOfDegree2", CellShape::triangle, 2, {4}},
                      Study{"QuadrilateralsOfDegree2", CellShape::quadrilateral, 2, {4}},
                      Study{"TetrahedraOfDegree2", CellShape::tetrahedron, 2, {2}},
                      Study{"HexahedraOfDegree2", CellShape::hexahedron, 2, {2}}),
    name_of);

// Linear in space, so the mesh adds no error; exp(t), so every backward difference has one. What
// remains is k times a constant and terms of k^2: the last rate is 1 within a few percent.
template <int dim>
void expect_first_order_in_time(CellShape shape) {
  Waves<dim> exact = waves<dim>(line);
  for (Wave<dim> &wave : exact)
    wave.course = {"exp(t)", "exp(t)", 1};
  Problem<dim> problem(coupled_material(dim), exact, 1, 1);
  for (const Side &side : sides(dim))
    problem.prescribe(side);
  problem.on_mesh(shape, 1, dim == 2 ? 8 : 4);
  const std::vector<int> steps{8, 16, 32, 64};
  std::vector<Errors> errors;
  for (const int n : steps) {
    problem.asked.time.steps = n;
    errors.push_back(errors_of_run(problem, RunCase(problem.asked)));
  }
  expect_rates(steps, errors, {0.97, 1.03}, {0.97, 1.03});
}

TEST(ManufacturedInTime, HalvingTheStepHalvesTheErrorOfEveryField) {
  expect_first_order_in_time<2>(CellShape::triangle);
}

TEST(ManufacturedInTime, HalvingTheStepHalvesTheErrorOfEveryFieldInThreeDimensions) {
  expect_first_order_in_time<3>(CellShape::hexahedron);
}

}  // namespace
}  // namespace tourmaline::testing
