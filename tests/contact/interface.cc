#include "tourmaline/contact/interface.h"

#include <gtest/gtest.h>

#include "tourmaline/error.h"

namespace tourmaline::contact {
namespace {

template <int dim>
body::Discretisation<dim> box(casefile::CellShape shape, std::vector<int> cells, int degree) {
  casefile::MeshCase mesh;
  mesh.box = casefile::Box{std::vector<double>(dim, 0.), {2, 3, 5}, std::move(cells), shape};
  mesh.box->max.resize(dim);
  return {mesh::build<dim>(mesh), degree};
}

TEST(Interface, WeightsOfASideAreHAndHalfAtItsEnds) {
  const auto body = box<2>(casefile::CellShape::triangle, {4, 6}, 1);
  const auto nodes = interface_nodes(body, {"left"});
  ASSERT_EQ(nodes.size(), 7u);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    EXPECT_NEAR(nodes[i].weight, i == 0 || i == 6 ? 0.25 : 0.5, 1e-15);
    EXPECT_NEAR(nodes[i].point[1], 0.5 * static_cast<double>(i), 1e-14);
    EXPECT_LT((nodes[i].normal - Eigen::Vector2d(-1, 0)).norm(), 1e-15);
  }
}

TEST(Interface, WeightsAddUpToTheAreaOnEveryShapeOfCell) {
  const auto area = [](const auto &nodes) {
    double sum = 0;
    for (const auto &node : nodes)
      sum += node.weight;
    return sum;
  };
  using casefile::CellShape;
  EXPECT_NEAR(area(interface_nodes(box<2>(CellShape::quadrilateral, {3, 4}, 2), {"top"})), 2,
              1e-14);
  EXPECT_NEAR(area(interface_nodes(box<3>(CellShape::tetrahedron, {2, 3, 2}, 1), {"bottom"})), 6,
              1e-13);
  EXPECT_NEAR(area(interface_nodes(box<3>(CellShape::hexahedron, {2, 3, 2}, 2), {"left"})), 15,
              1e-13);
}

TEST(Interface, InThreeDimensionsBottomAndTopAreTheEndsOfTheLastAxis) {
  for (const auto &node :
       interface_nodes(box<3>(casefile::CellShape::tetrahedron, {2, 2, 2}, 1), {"top"})) {
    EXPECT_DOUBLE_EQ(node.point[2], 5);
    EXPECT_LT((node.normal - Eigen::Vector3d(0, 0, 1)).norm(), 1e-14);
  }
}

TEST(Interface, QuadraticTetrahedraAreRefusedBecauseTheirCornersHaveNoWeight) {
  EXPECT_THROW(interface_nodes(box<3>(casefile::CellShape::tetrahedron, {1, 1, 1}, 2), {"left"}),
               CaseError);
}

TEST(Interface, ContactAroundACornerIsRefusedBecauseTheNormalIsNotUnique) {
  EXPECT_THROW(
      interface_nodes(box<2>(casefile::CellShape::triangle, {2, 2}, 1), {"left", "bottom"}),
      CaseError);
}

TEST(Interface, AnUnknownBoundaryIsNamed) {
  const auto body = box<2>(casefile::CellShape::triangle, {1, 1}, 1);
  EXPECT_THROW(interface_nodes(body, {"lft"}), CaseError);
}

}  // namespace
}  // namespace tourmaline::contact
