// Nodes that are shared out to the ranks: every part is that of the whole. The same tests run on
// one rank, two and four (CMakeLists.txt).
#include "body/node_sharing.h"

#include <gtest/gtest.h>

#include <cmath>

#include "body/derived.h"
#include "body/interpolation.h"
#include "body/operator.h"
#include "body/recovery.h"
#include "mesh/distribute.h"
#include "mesh/mesh.h"
#include "parallel/ranks.h"
#include "tourmaline/case/case.h"

namespace tourmaline::body {
namespace {

using casefile::CellShape;

/// A box, whole on every rank and shared out.
template <int dim>
class Bodies {
 public:
  Bodies(CellShape shape, int degree) : whole(made(shape, degree)), part(made(shape, degree)) {
    part.share_nodes(whole.nodes_on({"left"}));
  }

  static casefile::Case asked(CellShape shape = CellShape::quadrilateral) {
    casefile::Case asked;
    asked.dimension = dim;
    asked.material.library = "BaTiO3-Liu2014";
    asked.mesh.box = casefile::Box{std::vector<double>(dim, 0.), std::vector<double>(dim, 1.),
                                   std::vector<int>(dim, 4), shape};
    return asked;
  }

  const NodeSharing &sharing() const { return part.sharing(); }

  /// Of so many entries for each node, by its number.
  std::vector<double> vector(std::size_t entries) const {
    std::vector<double> values;
    for (std::size_t i = 0; i < entries * whole.n_nodes(); ++i)
      values.push_back(1e-3 * std::sin(1. + 7.3 * static_cast<double>(i)));
    return values;
  }

  /// This rank's part of `of_whole` is `found`.
  void expect_part(const std::vector<double> &of_whole, const std::vector<double> &found) const {
    const std::vector<double> wanted = sharing().part_of(of_whole);
    ASSERT_EQ(found.size(), wanted.size());
    double size = 0;
    for (const double value : of_whole)
      size = std::max(size, std::abs(value));
    for (std::size_t i = 0; i < wanted.size(); ++i)
      ASSERT_NEAR(found[i], wanted[i], 1e-13 * size) << i;
  }

  Discretisation<dim> whole, part;

 private:
  static Discretisation<dim> made(CellShape shape, int degree) {
    return {mesh::shared_out<dim>([&] { return mesh::build<dim>(asked(shape)); }), degree};
  }
};

template <class Check>
void for_each_body(const Check &check) {
  for (const int degree : {1, 2}) {
    check(Bodies<2>(CellShape::triangle, degree));
    check(Bodies<2>(CellShape::quadrilateral, degree));
    check(Bodies<3>(CellShape::tetrahedron, degree));
    check(Bodies<3>(CellShape::hexahedron, degree));
  }
}

template <int dim>
Operator<dim> operator_of(const Discretisation<dim> &body) {
  return {body, material::Composition<dim>(Bodies<dim>::asked())};
}

TEST(OnRanks, EveryNodeIsSomeonesAndCountsOnce) {
  for_each_body([](const auto &bodies) {
    const NodeSharing &sharing = bodies.sharing();
    double own = 0;
    for (Node node = 0; node < sharing.n_nodes(); ++node) {
      own += sharing.counts(node);
      EXPECT_EQ(sharing.node(sharing.number(node)), node);
      EXPECT_EQ(bodies.part.points()[node], bodies.whole.points()[sharing.number(node)]);
    }
    EXPECT_EQ(sharing.sum(own), static_cast<double>(bodies.whole.n_nodes()));
    EXPECT_EQ(sharing.n_all(), bodies.whole.n_nodes());
    if (parallel::n_ranks() > 1) {
      EXPECT_FALSE(sharing.is_whole());
      EXPECT_LT(sharing.n_nodes(), sharing.n_all());
    }
  });
}

TEST(OnRanks, EveryRankHasWhatIsKnownToAll) {
  for_each_body([](const auto &bodies) {
    const std::vector<Node> known = bodies.whole.nodes_on({"left"}),
                            here = bodies.part.nodes_on({"left"});
    EXPECT_EQ(bodies.sharing().numbers(here), known);
  });
}

TEST(OnRanks, APartComesFromTheWholeAndTheWholeFromItsParts) {
  for_each_body([](const auto &bodies) {
    const std::vector<double> whole = bodies.vector(3);
    const std::vector<double> found = bodies.sharing().on_first(bodies.sharing().part_of(whole));
    if (parallel::is_first()) {
      EXPECT_EQ(found, whole);
    }
  });
}

TEST(OnRanks, WhatBelongsToOthersComesFromThem) {
  for_each_body([](const auto &bodies) {
    const std::vector<double> whole = bodies.vector(2);
    for (const NodeSharing *sharing : {&bodies.sharing(), &bodies.whole.sharing()}) {
      std::vector<double> mine = sharing->part_of(whole);
      for (Node node = 0; node < sharing->n_nodes(); ++node)
        if (!sharing->is_own(node))
          mine[2 * node] = mine[2 * node + 1] = 77;
      sharing->take_from_owners(mine);
      EXPECT_EQ(mine, sharing->part_of(whole));
    }
  });
}

TEST(OnRanks, TheLargestOfAllRanksIsFoundAndWhatIsNoNumberToo) {
  const Bodies<2> bodies(CellShape::triangle, 1);
  const double rank = parallel::rank(), last = parallel::n_ranks() - 1;
  EXPECT_EQ(bodies.sharing().largest(-rank), 0);
  EXPECT_EQ(bodies.sharing().largest(rank), last);
  EXPECT_TRUE(std::isnan(bodies.sharing().largest(rank == last ? std::nan("") : 1.)));
  std::vector<double> sizes(bodies.sharing().n_nodes(), rank);
  bodies.sharing().find_largest(sizes);
  const std::vector<Node> known = bodies.part.nodes_on({"left"});
  EXPECT_EQ(sizes[known[1]], last);
}

TEST(OnRanks, ProductsWithTheOperatorAreThoseOfTheWhole) {
  for_each_body([]<int dim>(const Bodies<dim> &bodies) {
    const Operator<dim> whole = operator_of(bodies.whole), part = operator_of(bodies.part);
    const std::vector<double> all = bodies.vector(Fields<dim>::count),
                              x = bodies.sharing().part_of(all);
    std::vector<double> of_whole(all.size()), found(x.size());
    whole.multiply(0.1, all, of_whole);
    part.multiply(0.1, x, found);
    bodies.expect_part(of_whole, found);
    bodies.expect_part(whole.diagonal(0.1), part.diagonal(0.1));
    bodies.expect_part(whole.sizes(0.1, all), part.sizes(0.1, x));
    bodies.expect_part(whole.conducted(all), part.conducted(x));
    FieldProducts by_field, by_field_found;
    whole.multiply_by_field(all, by_field);
    part.multiply_by_field(x, by_field_found);
    for (std::size_t f = 0; f < 3; ++f)
      bodies.expect_part(by_field.of[f], by_field_found.of[f]);
    const auto scales = whole.scales(0.1), scales_found = part.scales(0.1);
    for (std::size_t c = 0; c < scales.size(); ++c)
      EXPECT_NEAR(scales_found[c], scales[c], 1e-13 * scales[c]);
  });
}

TEST(OnRanks, StressesAtTheNodesAreThoseOfTheWhole) {
  for_each_body([]<int dim>(const Bodies<dim> &bodies) {
    const material::Composition<dim> composition(Bodies<dim>::asked());
    const std::vector<double> all = bodies.vector(Fields<dim>::count),
                              x = bodies.sharing().part_of(all);
    const auto recovered = [&](const Discretisation<dim> &body, const std::vector<double> &state) {
      return Recovery<dim>(body)(composition, state,
                                 derived_fields(body, composition, state).stress);
    };
    const auto whole = recovered(bodies.whole, all), part = recovered(bodies.part, x);
    double size = 0;
    for (const auto &tensor : whole)
      size = std::max(size, std::abs(tensor[0]));
    bodies.part.for_each_cell_nodes([&](std::span<const Node> nodes) {
      for (const Node node : nodes)
        for (std::size_t c = 0; c < 6; ++c)
          ASSERT_NEAR(part[node][c], whole[bodies.sharing().number(node)][c], 1e-9 * size);
    });
  });
}

TEST(OnRanks, APlaceHasTheValueOfTheWhole) {
  for_each_body([]<int dim>(const Bodies<dim> &bodies) {
    const std::vector<double> all = bodies.vector(Fields<dim>::count),
                              x = bodies.sharing().part_of(all);
    const std::vector<Vector3> places{{0.3, 0.7, dim == 3 ? 0.2 : 0.}, {0, 0, 0}, {1, 1, dim - 2.}};
    const auto whole = nearest_places(bodies.whole, places),
               part = nearest_places(bodies.part, places);
    for (std::size_t i = 0; i < places.size(); ++i) {
      EXPECT_EQ(part[i].distance, 0);
      EXPECT_NEAR(bodies.sharing().sum(part[i].template value<dim>(x, 0)),
                  whole[i].template value<dim>(all, 0), 1e-15);
    }
  });
}

}  // namespace
}  // namespace tourmaline::body
