// Label: analytic. Turned by any angle, mesh, material and loads, the same body does the same.
// Boxes are parallel to the axes, so the mesh is turned and marched directly.

#include <deal.II/grid/grid_tools.h>
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <numbers>

#include "march.h"
#include "mesh/mesh.h"
#include "richer_paper.h"
#include "tourmaline/case/case.h"

namespace tourmaline::verified {
namespace {

template <int dim>
using Matrix = Eigen::Matrix<double, dim, dim>;
template <int dim>
using Vector = Eigen::Matrix<double, dim, 1>;

std::vector<double> turned(const std::vector<double> &direction, const Eigen::MatrixXd &rotation) {
  const Eigen::VectorXd v =
      rotation * Eigen::Map<const Eigen::VectorXd>(direction.data(),
                                                   static_cast<Eigen::Index>(direction.size()));
  return {v.begin(), v.end()};
}

// Formulas must not depend on place.
casefile::FormulaVector turned(const casefile::FormulaVector &load,
                               const Eigen::MatrixXd &rotation) {
  casefile::FormulaVector result;
  for (Eigen::Index i = 0; i < rotation.rows(); ++i) {
    std::string text;
    for (std::size_t j = 0; j < load.size(); ++j)
      text +=
          fmt::format("+({:.17g})*({})", rotation(i, static_cast<Eigen::Index>(j)), load[j].text());
    result.emplace_back(text);
  }
  return result;
}

// Poling and axis 1 must be given; displacements must be prescribed in full.
casefile::Case turned(casefile::Case asked, const Eigen::MatrixXd &rotation) {
  asked.material.poling = turned(asked.material.poling, rotation);
  asked.material.axis1 = turned(asked.material.axis1, rotation);
  for (casefile::BoundaryCase &boundary : asked.boundaries) {
    if (boundary.traction)
      boundary.traction = turned(*boundary.traction, rotation);
    if (!boundary.displacement)
      continue;
    casefile::FormulaVector displacement;
    for (const auto &component : *boundary.displacement)
      displacement.push_back(component.value());
    displacement = turned(displacement, rotation);
    boundary.displacement->assign(displacement.begin(), displacement.end());
  }
  if (!asked.contacts.empty() && !asked.contacts.front().foundation_displacement.empty())
    asked.contacts.front().foundation_displacement =
        turned(asked.contacts.front().foundation_displacement, rotation);
  return asked;
}

template <int dim>
mesh::Mesh<dim> turned(mesh::Mesh<dim> mesh, const Matrix<dim> &rotation) {
  dealii::GridTools::transform(
      [&rotation](const dealii::Point<dim> &p) {
        const Vector<dim> place = rotation * Eigen::Map<const Vector<dim>>(p.begin_raw());
        dealii::Point<dim> image;
        std::copy(place.begin(), place.end(), image.begin_raw());
        return image;
      },
      *mesh.cells);
  return mesh;
}

template <int dim>
Vector<dim> place(const Vector3 &point) {
  return Eigen::Map<const Vector<dim>>(point.data());
}

// For each point the one of `others` nearest to its image: both sets hold the same nodes in
// different orders.
template <int dim>
std::vector<body::Node> partners(const std::vector<Vector3> &points,
                                 const std::vector<Vector3> &others, const Matrix<dim> &rotation) {
  std::vector<body::Node> partner;
  for (const Vector3 &point : points) {
    const Vector<dim> image = rotation * place<dim>(point);
    const auto nearest =
        std::min_element(others.begin(), others.end(), [&](const auto &a, const auto &b) {
          return (place<dim>(a) - image).squaredNorm() < (place<dim>(b) - image).squaredNorm();
        });
    partner.push_back(static_cast<body::Node>(nearest - others.begin()));
  }
  return partner;
}

template <int dim>
void expect_turned_state(const March &original, const March &image,
                         const std::vector<body::Node> &partner, const Matrix<dim> &rotation) {
  constexpr int n = dim + 2;
  Eigen::Vector3d worst = Eigen::Vector3d::Zero(), size = Eigen::Vector3d::Zero();  // u, phi, theta
  for (std::size_t i = 0; i < partner.size(); ++i) {
    const Eigen::Map<const Vector<n>> a(&original.state[n * i]),
        b(&image.state[std::size_t{n} * partner[i]]);
    const Vector<dim> u = rotation * a.template head<dim>();
    const Eigen::Vector3d error((b.template head<dim>() - u).norm(), b[dim] - a[dim],
                                b[dim + 1] - a[dim + 1]);
    worst = worst.cwiseMax(error.cwiseAbs());
    size = size.cwiseMax(Eigen::Vector3d(u.norm(), std::abs(a[dim]), std::abs(a[dim + 1])));
  }
  for (int field = 0; field < 3; ++field)
    EXPECT_LT(worst[field], round_off * size[field]) << field;
}

template <int dim>
std::vector<Vector3> contact_points(const solve::Model<dim> &model) {
  std::vector<Vector3> points;
  for (const auto &node : model.interface)
    points.push_back(node.point);
  return points;
}

template <int dim>
void expect_turned_contact(const solve::StepOutcome &original, const solve::StepOutcome &image,
                           const std::vector<body::Node> &partner, const Matrix<dim> &rotation) {
  double worst = 0;
  for (std::size_t i = 0; i < partner.size(); ++i) {
    const auto offset = dim * static_cast<Eigen::Index>(i);
    const auto image_offset = dim * static_cast<Eigen::Index>(partner[i]);
    const Vector<dim> force = rotation * original.contact_forces.segment<dim>(offset);
    worst = std::max(worst, (image.contact_forces.segment<dim>(image_offset) - force).norm());
    EXPECT_EQ(original.status[i], image.status[partner[i]]);
  }
  EXPECT_LT(worst, round_off * original.contact_forces.cwiseAbs().maxCoeff());
}

template <int dim>
void expect_turned(const casefile::Case &asked, const Matrix<dim> &rotation) {
  const solve::Model<dim> model(asked);
  const solve::Model<dim> image(turned(asked, rotation),
                                turned<dim>(mesh::build<dim>(asked.mesh), rotation));
  const March a = march(model), b = march(image);
  EXPECT_TRUE(contains(a.statuses(), ContactStatus::stick));
  EXPECT_TRUE(contains(a.statuses(), ContactStatus::slip));
  expect_turned_state<dim>(a, b, partners<dim>(model.body.points(), image.body.points(), rotation),
                           rotation);
  const auto contact = partners<dim>(contact_points(model), contact_points(image), rotation);
  for (std::size_t step = 0; step < a.steps.size(); ++step)
    expect_turned_contact<dim>(a.steps[step], b.steps[step], contact, rotation);
}

class Rotation : public ::testing::TestWithParam<double> {};

TEST_P(Rotation, OfMeshMaterialAndLoadsRotatesTheResult) {
  const Matrix<2> rotation = Eigen::Rotation2Dd(GetParam()).toRotationMatrix();
  const std::vector<std::string> axes{"material.poling=[0.6,0.8]", "material.axis1=[0.8,-0.6]"};
  expect_turned<2>(paper(axes), rotation);
  std::vector<std::string> quadratic = axes;
  quadratic.insert(quadratic.end(),
                   {"mesh.box.cell=quadrilateral", "mesh.degree=2", "mesh.box.cells=[6,6]"});
  expect_turned<2>(paper(quadratic), rotation);
}

INSTANTIATE_TEST_SUITE_P(Angles, Rotation, ::testing::Values(0.3, 1.5707963267948966, 2.5, -1));

// Each law that can open or that rubs by its pressure, with a gap, on a foundation that moves.
std::vector<std::string> rubbing_laws() {
  return {"contact.normal=unilateral",
          "contact.normal={law='compliance', coefficient=3e16, exponent=1.5}",
          "contact.normal={law='damped', coefficient=1e13}", "contact.normal=bilateral"};
}

casefile::Case rubbed(const std::string &body, const std::vector<std::string> &overrides) {
  return casefile::read_text(body + R"(
gap = 1e-8
normal = "unilateral"
friction = { law = "coulomb", coefficient = { static = 0.8, kinetic = 0.6, distance = 1e-6 }, cohesion = 1e3 }
heat = { law = "exchange", coefficient = 5e3, foundation_temperature = 10 }
)",
                             "rubbed", overrides);
}

const std::string rubbed_plane = R"toml(
mesh.box = { min = [0, 0], max = [0.02, 0.01], cells = [8, 4], cell = "quadrilateral" }
material = { library = "BaTiO3-Liu2014", pyroelectric = [5e-5, 1e-4], poling = [0.6, 0.8], axis1 = [0.8, -0.6] }
time = { end = 1, steps = 4 }
boundary = [ { on = "top", displacement = ["1e-7*t", "-2e-7*sin(3*t)"], potential = 0, temperature = 0 },
             { on = "left", traction = ["-3e6*t", "4e6*t"] } ]
[contact]
on = "bottom"
foundation_displacement = ["2e-7*sin(5*t)", "2e-8*t"]
)toml";

class RotationOfRubbing : public ::testing::TestWithParam<std::string> {};

TEST_P(RotationOfRubbing, RotatesTheResult) {
  const Matrix<2> rotation = Eigen::Rotation2Dd(std::numbers::pi / 6).toRotationMatrix();
  expect_turned<2>(rubbed(rubbed_plane, {GetParam()}), rotation);
  expect_turned<2>(rubbed(rubbed_plane, {GetParam(), "mesh.degree=2"}), rotation);
}

TEST_P(RotationOfRubbing, InSpaceRotatesTheResult) {
  const std::string solid = R"toml(
mesh.box = { min = [0, 0, 0], max = [0.02, 0.015, 0.01], cells = [4, 3, 2], cell = "hexahedron" }
material = { library = "BaTiO3-Liu2014", pyroelectric = [5e-5, -3e-5, 1e-4], poling = [0.2, -0.4, 0.9], axis1 = [1, 0.3, 0] }
time = { end = 1, steps = 3 }
boundary = [ { on = "top", displacement = ["1e-7*t", "2e-8*t*t", "-2e-7*sin(3*t)"], potential = 0, temperature = 0 },
             { on = "left", traction = ["-3e6*t", 1e6, "4e6*t"] } ]
[contact]
on = "bottom"
foundation_displacement = ["2e-7*sin(5*t)", "3e-8*t", "2e-8*t"]
)toml";
  const Eigen::Vector3d axis = Eigen::Vector3d(1, -2, 0.7).normalized();
  expect_turned<3>(rubbed(solid, {GetParam()}), Eigen::AngleAxisd(1.1, axis).toRotationMatrix());
}

INSTANTIATE_TEST_SUITE_P(Laws, RotationOfRubbing, ::testing::ValuesIn(rubbing_laws()));

casefile::Case sliding_block() {
  return casefile::read_text(R"(
[mesh]
box = { min = [0,0,0], max = [0.1,0.08,0.05], cells = [4,4,3], cell = "tetrahedron" }
[material]
library = "BaTiO3-Liu2014"
pyroelectric = [5e-5, -3e-5, 1e-4]
poling = [0.2, -0.4, 0.9]
axis1 = [1, 0.3, 0]
[time]
end = 0.2
steps = 4
[[boundary]]
on = "top"
displacement = ["1e-9*t", "2e-9*t*t", "-1e-9*t"]
potential = 0
temperature = 0
[[boundary]]
on = "left"
traction = ["100*t", 40, 0]
[contact]
on = "bottom"
friction = { law = "tresca", bound = 60 }
heat = { law = "exchange", coefficient = 5, foundation_temperature = -10 }
)",
                             "block");
}

TEST(RotationInSpace, OfMeshMaterialAndLoadsRotatesTheResult) {
  for (const double angle : {1.1, -2.3}) {
    const Eigen::Vector3d axis = Eigen::Vector3d(1, -2, 0.5 + angle).normalized();
    expect_turned<3>(sliding_block(), Eigen::AngleAxisd(angle, axis).toRotationMatrix());
  }
}

}  // namespace
}  // namespace tourmaline::verified
