// Label: analytic. The temperature of a static case, beside the steady problem assembled directly
// and beside closed forms.

#include "solve/steady_heat.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "tourmaline/case/reader.h"
#include "tourmaline/error.h"

namespace tourmaline::solve {
namespace {

using ::testing::HasSubstr;

casefile::Case read(const std::string &text, const std::vector<std::string> &overrides = {}) {
  return casefile::read_text("time = { end = 2, steps = 4, regime = \"static\" }\n" + text,
                             "static.toml", overrides);
}

// A given temperature on two sides, exchange on a third, heat through the fourth and inside.
std::string plate(int dimension) {
  const bool plane = dimension == 2;
  return fmt::format(R"(
mesh.box = {{ min = [0, 0{0}], max = [0.3, 0.1{1}], cells = [9, 7{2} }}
material.library = "BaTiO3-Liu2014"
material.poling = [1, 2{0}]
load.heat = "1e4*t*x"
boundary = [
  {{ on = "right", displacement = [0, 0{0}], potential = 0, temperature = "3*t" }},
  {{ on = "bottom", temperature = "y + 5*x*t" }},
  {{ on = "top", heat_flux = "-100*t" }} ]
[contact]
on = "left"
friction = "none"
heat = {{ law = "exchange", coefficient = "20 + 100*y", foundation_temperature = "-4*t" }}
)",
                     plane ? "" : ", 0", plane ? "" : ", 0.2",
                     plane ? "]" : ", 4], cell = \"tetrahedron\"");
}

double temperature(std::span<const double> state, std::size_t node, int dimension) {
  return state[node * (dimension + 2) + dimension + 1];
}

// The steady problem by its definition, dense.
template <int dim>
Eigen::VectorXd assembled(const Model<dim> &model, double time) {
  using Vector = Eigen::Matrix<double, dim, 1>;
  const auto n = static_cast<Eigen::Index>(model.body.n_nodes());
  Eigen::MatrixXd g = Eigen::MatrixXd::Zero(n, n);
  Eigen::VectorXd q = Eigen::VectorXd::Zero(n);
  model.body.for_each_cell([&](const body::Quadrature<dim> &cell) {
    const auto conductivity = model.composition.at(cell.region, cell.centre()).conductivity;
    for (std::size_t p = 0; p < cell.jxw.size(); ++p)
      for (std::size_t a = 0; a < cell.nodes.size(); ++a) {
        q[cell.nodes[a]] +=
            cell.jxw[p] * cell.value(p, a) * model.asked.load.heat.value(cell.points[p], time);
        for (std::size_t b = 0; b < cell.nodes.size(); ++b)
          g(cell.nodes[a], cell.nodes[b]) +=
              cell.jxw[p] * Vector::Map(cell.gradient(p, a).data())
                                .dot(conductivity * Vector::Map(cell.gradient(p, b).data()));
      }
  });
  const auto add_facets = [&](const std::string &name, const auto &add) {
    model.body.for_each_facet({name}, [&](const body::Quadrature<dim> &facet) {
      for (std::size_t p = 0; p < facet.jxw.size(); ++p)
        for (std::size_t a = 0; a < facet.nodes.size(); ++a)
          add(facet, p, a);
    });
  };
  add_facets("top", [&](const auto &facet, std::size_t p, std::size_t a) {
    q[facet.nodes[a]] += 100 * time * facet.jxw[p] * facet.value(p, a);
  });
  add_facets("left", [&](const auto &facet, std::size_t p, std::size_t a) {
    const double k = 20 + 100 * facet.points[p][1];
    q[facet.nodes[a]] += k * -4 * time * facet.jxw[p] * facet.value(p, a);
    for (std::size_t b = 0; b < facet.nodes.size(); ++b)
      g(facet.nodes[a], facet.nodes[b]) += k * facet.jxw[p] * facet.value(p, a) * facet.value(p, b);
  });
  Eigen::VectorXd theta = Eigen::VectorXd::Zero(n);
  std::vector<bool> is_given(static_cast<std::size_t>(n), false);
  for (const body::Prescribed &p : model.prescribed)
    if (p.is_given() && p.unknown % (dim + 2) == dim + 1) {
      is_given[p.unknown / (dim + 2)] = true;
      theta[static_cast<Eigen::Index>(p.unknown / (dim + 2))] = p.value.value(p.point, time);
    }
  std::vector<Eigen::Index> free;
  for (Eigen::Index node = 0; node < n; ++node)
    if (!is_given[static_cast<std::size_t>(node)])
      free.push_back(node);
  const Eigen::VectorXd right_side = q - g * theta;
  const Eigen::MatrixXd inside = g(free, free);
  const Eigen::VectorXd of_free = right_side(free), found = inside.llt().solve(of_free);
  theta(free) = found;
  return theta;
}

template <int dim>
void expect_as_assembled(const casefile::Case &asked) {
  const Model<dim> model(asked);
  for (const bool iteratively : {false, true}) {
    SteadyHeat<dim> heat(model, iteratively);
    for (const double time : {0.5, 2.}) {
      const Eigen::VectorXd exact = assembled(model, time);
      std::vector<double> state(model.n_unknowns(), 0.);
      heat.fill(time, state);
      for (std::size_t node = 0; node < model.body.n_nodes(); ++node)
        EXPECT_NEAR(temperature(state, node, dim), exact[static_cast<Eigen::Index>(node)],
                    1e-13 * exact.cwiseAbs().maxCoeff());
    }
  }
}

TEST(SteadyHeat, IsThatOfTheProblemAssembledDirectly) {
  expect_as_assembled<2>(read(plate(2)));
  expect_as_assembled<2>(read(plate(2), {"mesh.degree=2"}));
  expect_as_assembled<3>(read(plate(3)));
}

// In a bar it is linear between its ends, whatever acts on it otherwise.
TEST(SteadyHeat, IsLinearInABarWhoseSidesAreInsulated) {
  const Model<2> model(read(R"(
mesh.box = { min = [0, 0], max = [2, 1], cells = [8, 3] }
material.library = "BaTiO3-Liu2014"
boundary = [ { on = "left", displacement = [0, 0], potential = 0, temperature = 1 },
             { on = "right", temperature = "1 + 6*t", traction = [1e9, 0] } ]
)"));
  SteadyHeat<2> heat(model, false);
  std::vector<double> state(model.n_unknowns(), 0.);
  heat.fill(1, state);
  for (std::size_t node = 0; node < model.body.n_nodes(); ++node)
    EXPECT_NEAR(temperature(state, node, 2), 1 + 3 * model.body.points()[node][0], 1e-13 * 7);
}

const std::string unheld = R"(
mesh.box = { min = [0, 0], max = [2, 1], cells = [4, 3] }
material.library = "BaTiO3-Liu2014"
boundary = [ { on = "left", displacement = [0, 0], potential = 0 } ]
)";

TEST(SteadyHeat, OfABodyThatNothingHoldsIsTheInitialOne) {
  for (const double initial : {0., 5.}) {
    const Model<2> model(read(unheld, {fmt::format("initial.temperature={}", initial)}));
    SteadyHeat<2> heat(model, false);
    std::vector<double> state(model.n_unknowns(), 7.);
    heat.fill(1, state);
    for (std::size_t node = 0; node < model.body.n_nodes(); ++node)
      EXPECT_EQ(temperature(state, node, 2), initial);
  }
}

// Also where a contact exchanges heat by its name alone: its coefficient is 0 everywhere.
TEST(SteadyHeat, OfABodyThatNothingHoldsIsRefusedWhereItWasNotUniform) {
  EXPECT_THROW(read(unheld, {"initial.temperature='x'"}), CaseError);
  const Model<2> model(
      read(unheld, {"initial.temperature='x'",
                    "contact={on='right',friction='none',heat={law='exchange',coefficient=0,"
                    "foundation_temperature=0}}"}));
  try {
    SteadyHeat<2> heat(model, false);
    FAIL();
  } catch (const CaseError &error) {
    EXPECT_THAT(error.what(), HasSubstr("its initial temperature is not uniform"));
  }
}

TEST(SteadyHeat, OfABodyThatNothingHoldsIsRefusedWhereItIsWarmed) {
  for (const char *source : {"load.heat=1", "boundary[0].heat_flux='t'"})
    EXPECT_THROW(read(unheld, {source}), CaseError) << source;
  EXPECT_NO_THROW(read(unheld, {"load.heat=0"}));
}

}  // namespace
}  // namespace tourmaline::solve
