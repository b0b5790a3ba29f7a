// Label: analytic. What the equations promise of every solution, whatever it is: turned, mirrored,
// renumbered or measured in other units, the same body does the same. Tests start from the paper's
// conductive case, made richer: both components of traction, a pyroelectric vector with a part
// across the poling axis, a bound at which some nodes stick and others slip.

#include <deal.II/grid/grid_tools.h>
#include <fmt/format.h>

#include "../cases/run_case.h"
#include "march.h"

namespace tourmaline::testing {
namespace {

using casefile::Formula;

// Seen: at most 1e-13, in the slip rate, which is a difference of displacements; a changed sign or
// term is of order 1.
constexpr double round_off = 1e-11;

std::vector<std::string> richer(std::vector<std::string> more) {
  std::vector<std::string> overrides{"mesh.box.cells=[12,12]",
                                     "time.steps=10",
                                     "material.pyroelectric=[5e-5, 1e-4]",
                                     "contact.friction.bound=12",
                                     "boundary[2].traction=['3*t', '-5*t']",
                                     "output.fields=false"};
  overrides.insert(overrides.end(), more.begin(), more.end());
  return overrides;
}

casefile::Case paper(const std::vector<std::string> &more = {}) {
  return casefile::read_file(
      std::filesystem::path(TOURMALINE_SOURCE_DIR) / "cases/ouafik-2020/conductive.toml",
      richer(more));
}

template <class Status>
bool contains(const std::vector<Status> &all, const Status &one) {
  return std::count(all.begin(), all.end(), one) > 3;
}

bool sticks_and_slips(const std::vector<std::string> &status) {
  return contains<std::string>(status, "stick") && contains<std::string>(status, "slip");
}

// ---- one case and its image ----

/// How the tables of a case follow from those of another: places and displacements by `turn` (a
/// signed permutation), then `shift`; numbers by the ratios of units.
struct Image {
  Eigen::Matrix2d turn = Eigen::Matrix2d::Identity();
  Eigen::Vector2d shift = Eigen::Vector2d::Zero();
  double potential = 1, length = 1, stress = 1, heat_flux = 1;

  Eigen::Vector2d place(double x, double y) const {
    return length * (turn * Eigen::Vector2d(x, y)) + shift;
  }
};

struct Column {
  std::string original, image;
  double factor;
};
/// Components that are measured by the largest of them.
using Quantity = std::vector<Column>;

Quantity vector_quantity(const Image &image, const std::string &name, double factor) {
  Quantity quantity;
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j)
      if (image.turn(i, j) != 0)
        quantity.push_back({name + "xy"[j], name + "xy"[i], factor * image.turn(i, j)});
  return quantity;
}

std::vector<Quantity> of_nodes(const Image &image) {
  return {vector_quantity(image, "u_", image.length),
          {{"potential", "potential", image.potential}},
          {{"temperature", "temperature", 1}}};
}

std::vector<Quantity> of_contact(const Image &image) {
  return {vector_quantity(image, "tangential_traction_", image.stress),
          {{"normal_traction", "normal_traction", image.stress}},
          vector_quantity(image, "slip_", image.length),
          {{"slip_rate", "slip_rate", image.length}},
          {{"potential", "potential", image.potential}},
          {{"temperature", "temperature", 1}},
          {{"heat_flux", "heat_flux", image.heat_flux}}};
}

std::vector<std::size_t> rows_of_step(const Table &table, const std::string &step) {
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < table.n_rows(); ++i)
    if (step.empty() || table.columns.at("step")[i] == step)
      rows.push_back(i);
  return rows;
}

// Row of `other` at the image of each row's place, by the least distance; each row is met once.
std::map<std::size_t, std::size_t> partners(const Table &table, const Table &other,
                                            const Image &image, const std::string &step) {
  const std::vector<double> x = table.numbers("x"), y = table.numbers("y"),
                            to_x = other.numbers("x"), to_y = other.numbers("y");
  std::map<std::size_t, std::size_t> partner;
  std::vector<std::size_t> candidates = rows_of_step(other, step);
  for (const std::size_t i : rows_of_step(table, step)) {
    const Eigen::Vector2d place = image.place(x[i], y[i]);
    const auto distance = [&](std::size_t j) {
      return std::hypot(to_x[j] - place.x(), to_y[j] - place.y());
    };
    const auto nearest =
        std::min_element(candidates.begin(), candidates.end(),
                         [&](std::size_t a, std::size_t b) { return distance(a) < distance(b); });
    partner[i] = *nearest;
    candidates.erase(nearest);
  }
  return partner;
}

void expect_image(const Table &table, const Table &other, const Image &image,
                  const std::vector<Quantity> &quantities, const std::string &step,
                  double tolerance) {
  const auto partner = partners(table, other, image, step);
  for (const Quantity &quantity : quantities) {
    double size = 0, worst = 0;
    for (const Column &column : quantity) {
      const std::vector<double> from = table.numbers(column.original),
                                to = other.numbers(column.image);
      for (const auto &[i, j] : partner) {
        size = std::max(size, std::abs(column.factor * from[i]));
        worst = std::max(worst, std::abs(to[j] - column.factor * from[i]));
      }
    }
    EXPECT_LE(worst, tolerance * size) << quantity.front().original << " " << step;
  }
}

void expect_image(const RunCase &run, const RunCase &other, const Image &image,
                  double tolerance = round_off) {
  expect_image(run.nodes(), other.nodes(), image, of_nodes(image), "", tolerance);
  const Table contact = run.contact(), other_contact = other.contact();
  ASSERT_TRUE(sticks_and_slips(contact.columns.at("status")));
  for (const std::string step : {"1", "5", "10"}) {
    expect_image(contact, other_contact, image, of_contact(image), step, tolerance);
    for (const auto &[i, j] : partners(contact, other_contact, image, step))
      EXPECT_EQ(contact.columns.at("status")[i], other_contact.columns.at("status")[j]);
  }
}

// ---- mirror images, on quadrilaterals: squares cut into triangles have no mirror image among the
// meshes ----

const std::string squares = "mesh.box.cell=quadrilateral";

TEST(MirrorImage, UpsideDownWithThePolingReversedTheBodyDoesTheSameUpsideDown) {
  const RunCase upright(paper({squares}));
  // The image's pyroelectric vector is (p1, -p3). Poling down turns both crystal axes, so p1
  // changes its sign here.
  const RunCase mirrored(
      paper({squares, "material.poling=[0,-1]", "material.pyroelectric=[-5e-5,1e-4]",
             "boundary[2].on=bottom", "boundary[2].traction=['3*t','5*t']"}));
  Image image;
  image.turn(1, 1) = -1;
  image.shift = {0, 0.1};
  expect_image(upright, mirrored, image);
}

TEST(MirrorImage, WithContactAndClampExchangedTheBodyDoesTheSameTheOtherWayRound) {
  const RunCase original(paper({squares}));
  const RunCase mirrored(
      paper({squares, "material.pyroelectric=[-5e-5,1e-4]", "boundary[0].on=left",
             "contact.on=right", "boundary[2].traction=['-3*t','-5*t']"}));
  Image image;
  image.turn(0, 0) = -1;
  image.shift = {0.1, 0};
  expect_image(original, mirrored, image);
}

TEST(Poling, ReversedReversesThePotentialAndNothingElse) {
  Image image;
  image.potential = -1;
  expect_image(RunCase(paper()), RunCase(paper({"material.poling=[0,-1]"})), image);
}

// ---- other numberings and places ----

TEST(Numbering, WithTheAxesExchangedAndSoAllNodesNumberedAnewOnlyTheAxesAreExchanged) {
  const RunCase original(paper({"mesh.box.max=[0.1,0.07]", "mesh.box.cells=[12,9]"}));
  const RunCase exchanged(
      paper({"mesh.box.max=[0.07,0.1]", "mesh.box.cells=[9,12]", "material.poling=[1,0]",
             "material.axis1=[0,1]", "boundary[0].on=top", "boundary[1].on=['left','right']",
             "boundary[2].on=right", "boundary[2].traction=['-5*t','3*t']", "contact.on=bottom"}));
  Image image;
  image.turn << 0, 1, 1, 0;
  expect_image(original, exchanged, image);
}

TEST(Numbering, ABodyMovedFarAwayDoesTheSameThere) {
  // Coordinates near 20 are known to 4e-15, so the shape of cells of 0.008 to 4e-13. Seen: 4e-13.
  Image image;
  image.shift = {10, -20};
  expect_image(RunCase(paper()),
               RunCase(paper({"mesh.box.min=[10,-20]", "mesh.box.max=[10.1,-19.9]"})), image,
               10 * round_off);
}

// The same triangulation with cells and vertices listed from last to first.
mesh::Mesh<2> listed_backwards(const mesh::Mesh<2> &mesh) {
  auto [vertices, cells, facets] = dealii::GridTools::get_coarse_mesh_description(*mesh.cells);
  const auto last = static_cast<unsigned int>(vertices.size() - 1);
  std::reverse(vertices.begin(), vertices.end());
  std::reverse(cells.begin(), cells.end());
  for (auto &cell : cells)
    for (unsigned int &vertex : cell.vertices)
      vertex = last - vertex;
  for (auto &facet : facets.boundary_lines)
    for (unsigned int &vertex : facet.vertices)
      vertex = last - vertex;
  mesh::Mesh<2> backwards{std::make_unique<dealii::Triangulation<2>>(), mesh.boundaries,
                          mesh.simplices};
  backwards.cells->create_triangulation(vertices, cells, facets);
  return backwards;
}

double largest_difference(const std::vector<double> &a, const std::vector<double> &b,
                          std::size_t component, std::size_t stride) {
  double worst = 0, size = 0;
  for (std::size_t i = component; i < a.size(); i += stride) {
    worst = std::max(worst, std::abs(a[i] - b[i]));
    size = std::max(size, std::abs(a[i]));
  }
  return worst / size;
}

TEST(Numbering, CellsListedInAnotherOrderChangeNothingButRoundOff) {
  const casefile::Case asked = paper();
  const solve::Model<2> model(asked);
  const solve::Model<2> backwards(asked, listed_backwards(mesh::build<2>(asked.mesh)));
  const March a = march(model), b = march(backwards);
  for (std::size_t component = 0; component < 4; ++component)
    EXPECT_LT(largest_difference(a.state, b.state, component, 4), round_off) << component;
  EXPECT_EQ(a.statuses(), b.statuses());
}

// ---- rotations: boxes are parallel to the axes, so the mesh is turned and marched directly ----

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
Vector<dim> place(const output::Vector &point) {
  return Eigen::Map<const Vector<dim>>(point.data());
}

// For each point the one of `others` nearest to its image: both sets hold the same nodes in
// different orders.
template <int dim>
std::vector<body::Node> partners(const std::vector<output::Vector> &points,
                                 const std::vector<output::Vector> &others,
                                 const Matrix<dim> &rotation) {
  std::vector<body::Node> partner;
  for (const output::Vector &point : points) {
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
std::vector<output::Vector> contact_points(const solve::Model<dim> &model) {
  std::vector<output::Vector> points;
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
  EXPECT_TRUE(contains(a.statuses(), output::ContactStatus::stick));
  EXPECT_TRUE(contains(a.statuses(), output::ContactStatus::slip));
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
  quadratic.insert(quadratic.end(), {squares, "mesh.degree=2", "mesh.box.cells=[6,6]"});
  expect_turned<2>(paper(quadratic), rotation);
}

INSTANTIATE_TEST_SUITE_P(Angles, Rotation, ::testing::Values(0.3, 1.5707963267948966, 2.5, -1));

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

// ---- units ----

// The paper's case in millimetres, newtons, seconds, kelvins and volts. Energy is then in N mm = mJ
// and charge in mJ/V = mC; a density times a specific heat is in mJ/(mm^3 K).
std::vector<std::string> in_millimetres() {
  return {"mesh.box.max=[100,100]",
          "material.c11=166e3",  // N/mm^2
          "material.c12=77e3",
          "material.c13=78e3",
          "material.c33=162e3",
          "material.c44=43e3",
          "material.e31=-4.4e-3",  // mC/mm^2
          "material.e33=18.6e-3",
          "material.e15=11.6e-3",
          "material.beta11=11.2e-9",  // mC/(V mm)
          "material.beta33=12.6e-9",
          "material.m11=2.24",  // N/(K mm^2)
          "material.m33=1.89",
          "material.pyroelectric=[5e-8,1e-7]",  // mC/(K mm^2)
          "material.k11=50",                    // N/(s K)
          "material.k33=75",
          "material.density=5500e-12",     // N s^2/mm^4
          "material.specific_heat=420e6",  // mm^2/(s^2 K)
          "boundary[2].traction=['3e-6*t','-5e-6*t']",
          "contact.friction.bound=12e-6",
          "contact.heat.coefficient=1e-3"};  // N/(s K mm)
}

TEST(Units, MillimetresInsteadOfMetresChangeNothingButTheNumbers) {
  Image image;
  image.length = 1e3;
  image.stress = 1e-6;
  image.heat_flux = 1e-3;
  expect_image(RunCase(paper()), RunCase(paper(in_millimetres())), image);
}

TEST(Units, EnergiesOfOneMillimetreOfDepthInMillijoulesAreThoseOfOneMetreInJoules) {
  const Table metres = RunCase(paper()).history(),
              millimetres = RunCase(paper(in_millimetres())).history();
  for (const char *energy : {"elastic_energy", "electric_energy", "thermal_energy"})
    EXPECT_LT(difference(millimetres, metres, energy), round_off) << energy;
}

// ---- heat at the contact ----

const std::string no_exchange = "contact.heat.coefficient=0";

TEST(HeatAtTheContact, ExchangeWithACoefficientOfZeroIsInsulation) {
  const RunCase zero(paper({no_exchange}));
  const RunCase insulated(paper({"contact.heat={law='insulated'}"}));
  // Zeros are added to the same numbers, so even the last digit agrees.
  for (const char *column : {"u_x", "u_y", "potential", "temperature"})
    EXPECT_EQ(zero.nodes().columns.at(column), insulated.nodes().columns.at(column)) << column;
  for (const double flux : zero.contact().numbers("heat_flux"))
    EXPECT_EQ(flux, 0);
}

// Entropy of a state: the integral of M:eps(u) + P.E(phi) + alpha theta (6), from the heat rows,
// which carry the sign -.
double entropy(const solve::Model<2> &model, const std::vector<double> &state) {
  std::vector<double> product(state.size());
  model.op.multiply(0, state, product);
  double sum = 0;
  for (std::size_t i = 3; i < product.size(); i += 4)
    sum -= product[i];
  return sum;
}

// The parts of u, phi and theta in the entropy of the last state, with no temperature prescribed.
Eigen::Vector3d entropies(casefile::Case asked) {
  for (casefile::BoundaryCase &boundary : asked.boundaries)
    boundary.temperature.reset();
  const solve::Model<2> model(asked);
  const std::vector<double> state = march(model).state;
  Eigen::Vector3d parts;
  for (std::size_t field = 0; field < 3; ++field) {
    std::vector<double> alone = state;
    for (std::size_t i = 0; i < alone.size(); ++i)
      if (std::max<std::size_t>(i % 4, 1) - 1 != field)
        alone[i] = 0;
    parts[static_cast<Eigen::Index>(field)] = entropy(model, alone);
  }
  return parts;
}

TEST(HeatAtTheContact, WhereNoHeatCrossesAnyBoundaryTheEntropyStaysWhatItWas) {
  const Eigen::Vector3d insulated = entropies(paper({no_exchange}));
  EXPECT_LT(std::abs(insulated.sum()), round_off * insulated.cwiseAbs().maxCoeff());
  EXPECT_GT(insulated.cwiseAbs().minCoeff(), 1e-6 * insulated.cwiseAbs().maxCoeff());
  const Eigen::Vector3d cooled = entropies(paper());
  EXPECT_LT(cooled.sum(), -0.5 * cooled.cwiseAbs().maxCoeff());
}

// ---- time ----

// Loads grow smoothly from nothing. Nodes change from stick to slip between two steps, which lets
// the ratio scatter about 2.
TEST(TimeStep, HalvedHalvesTheErrorOfASlidingBody) {
  std::vector<Table> nodes;
  for (const int steps : {20, 40, 80, 160}) {
    const RunCase run(paper({fmt::format("time.steps={}", steps),
                             "contact.heat.foundation_temperature='-27*(t/0.2)^2'",
                             "boundary[2].traction=['75*t^2','-125*t^2']"}));
    EXPECT_TRUE(sticks_and_slips(run.contact().columns.at("status")));
    nodes.push_back(run.nodes());
  }
  for (const char *column : {"u_x", "u_y", "potential", "temperature"}) {
    std::vector<double> change;
    for (std::size_t i = 0; i + 1 < nodes.size(); ++i)
      change.push_back(difference(nodes[i], nodes[i + 1], column, 1));
    RecordProperty(column,
                   fmt::format("{:.3e} {:.3e} {:.3e}, ratios {:.3f} {:.3f}", change[0], change[1],
                               change[2], change[0] / change[1], change[1] / change[2]));
    EXPECT_NEAR(change[0] / change[1], 2, 0.2) << column;
    EXPECT_NEAR(change[1] / change[2], 2, 0.1) << column;
  }
}

}  // namespace
}  // namespace tourmaline::testing
