#include "contact/interface.h"

#include <gtest/gtest.h>

#include <functional>
#include <map>

#include "mesh/mesh.h"
#include "tourmaline/case/case.h"
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

// Two sides of a square, in either order.
TEST(Interface, AnEdgeOfTwoContactsBelongsToTheFirst) {
  const auto body = box<2>(casefile::CellShape::triangle, {4, 6}, 1);
  const auto one = interface_of(body, {{"left"}, {"bottom"}}),
             other = interface_of(body, {{"bottom"}, {"left"}});
  ASSERT_EQ(one.nodes.size(), 7u + 4u);
  const auto &corner = one.nodes.front(), &same = other.nodes.front();
  EXPECT_EQ(one.edges, std::vector<body::Node>{corner.node});
  EXPECT_NEAR(corner.weight, 0.25, 1e-15);
  EXPECT_LT((corner.normal - Eigen::Vector2d(-1, 0)).norm(), 1e-15);
  EXPECT_NEAR(same.weight, 0.25, 1e-15);
  EXPECT_LT((same.normal - Eigen::Vector2d(0, -1)).norm(), 1e-15);
  for (const auto &node : one.nodes)
    EXPECT_EQ(node.contact, node.point[0] == 0 ? 0u : 1u);
  for (const auto &node : other.nodes)
    EXPECT_EQ(node.contact, node.point[1] == 0 ? 0u : 1u);
}

// The mean of the normals is 14 degrees from that of the long facets, 76 from that of the short
// ones.
TEST(Interface, AnEdgeIsOneWhereTheFacetsOfTheContactThatIsAddedAreShort) {
  const auto body = box<2>(casefile::CellShape::triangle, {4, 24}, 1);
  const auto found = interface_of(body, {{"bottom"}, {"left"}});
  const auto &corner = found.nodes.front();
  EXPECT_EQ(found.edges, std::vector<body::Node>{corner.node});
  EXPECT_NEAR(corner.weight, 0.25, 1e-15);
  EXPECT_LT((corner.normal - Eigen::Vector2d(0, -1)).norm(), 1e-15);
}

TEST(Interface, ContactsThatDoNotMeetHaveNoEdges) {
  const auto found =
      interface_of(box<3>(casefile::CellShape::hexahedron, {2, 3, 2}, 1), {{"left"}, {"right"}});
  EXPECT_TRUE(found.edges.empty());
  EXPECT_EQ(found.nodes.size(), 24u);
  EXPECT_TRUE(std::is_sorted(found.nodes.begin(), found.nodes.end(),
                             [](const auto &a, const auto &b) { return a.node < b.node; }));
}

// Round-off leaves 1e-17 of a cell's shape functions on the facets that their nodes are not on.
TEST(Interface, BothFacesOfAPlateOneCellThickHaveTheirOwnNormals) {
  using casefile::CellShape;
  const auto vertical = [](const auto &nodes, double top) {
    for (const auto &node : nodes)
      EXPECT_NEAR(node.normal[node.normal.size() - 1],
                  node.point[node.normal.size() - 1] == top ? 1 : -1, 1e-14);
    return nodes.size();
  };
  for (const int degree : {1, 2})
    for (const CellShape shape : {CellShape::triangle, CellShape::quadrilateral})
      EXPECT_EQ(vertical(interface_nodes(box<2>(shape, {7, 1}, degree), {"top", "bottom"}), 3),
                2u * (7u * static_cast<unsigned>(degree) + 1));
  for (const CellShape shape : {CellShape::tetrahedron, CellShape::hexahedron})
    EXPECT_EQ(vertical(interface_nodes(box<3>(shape, {5, 5, 1}, 1), {"top", "bottom"}), 5), 72u);
  EXPECT_EQ(
      vertical(interface_nodes(box<3>(CellShape::hexahedron, {2, 2, 1}, 2), {"top", "bottom"}), 5),
      50u);
}

template <int dim>
body::Discretisation<dim> ring(casefile::CellShape shape, std::vector<int> cells) {
  casefile::MeshCase mesh;
  mesh.annulus = casefile::Annulus{1, 2, dim == 3 ? 1. : 0, std::move(cells), shape};
  return {mesh::build<dim>(mesh), 1};
}

// The two facets of a node are mirror images in the plane through the node and the axis.
TEST(Interface, NormalsOfACircleAreRadialAndPointOutOfTheBody) {
  using casefile::CellShape;
  for (const CellShape shape : {CellShape::triangle, CellShape::quadrilateral}) {
    const auto body = ring<2>(shape, {2, 9});
    for (const auto &[side, sign] : {std::pair{"inner", -1.}, std::pair{"outer", 1.}})
      for (const auto &node : interface_nodes(body, {side})) {
        const Eigen::Vector2d place(node.point[0], node.point[1]);
        EXPECT_LT((node.normal - sign * place.normalized()).norm(), 1e-14);
      }
  }
  const auto tube = ring<3>(CellShape::hexahedron, {1, 9, 2});
  for (const auto &node : interface_nodes(tube, {"inner"})) {
    const Eigen::Vector3d place(node.point[0], node.point[1], 0);
    EXPECT_LT((node.normal + place.normalized()).norm(), 1e-14);
  }
}

// The integral of N_i nu over a closed curve, or tube, sums to zero, as that of nu does: no net
// volume passes a side of which u_nu = 0 at all nodes.
TEST(Interface, NormalsOnUnequalFacetsAreWeightedByAreaAsTheNodesAre) {
  const auto tube = ring<3>(casefile::CellShape::tetrahedron, {1, 8, 2});
  std::map<body::Node, Eigen::Vector3d> flow;
  tube.for_each_facet({"inner"}, [&](const body::Quadrature<3> &facet) {
    for (std::size_t a = 0; a < facet.nodes.size(); ++a)
      for (std::size_t q = 0; q < facet.jxw.size(); ++q) {
        flow.try_emplace(facet.nodes[a], Eigen::Vector3d::Zero());
        flow[facet.nodes[a]] += facet.jxw[q] * facet.value(q, a) *
                                Eigen::Map<const Eigen::Vector3d>(facet.normals[q].data());
      }
  });
  int skew = 0;
  for (const auto &node : interface_nodes(tube, {"inner"})) {
    EXPECT_LT((node.normal - flow.at(node.node).normalized()).norm(), 1e-14);
    const Eigen::Vector3d place(node.point[0], node.point[1], 0);
    skew += (node.normal + place.normalized()).norm() > 1e-3;
  }
  EXPECT_GT(skew, 0);  // at the ends of the tube one side of a node has two triangles, one has one
}

std::string refusal(const std::function<void()> &build) {
  try {
    build();
  } catch (const CaseError &error) {
    return error.what();
  }
  return "nothing refused";
}

TEST(Interface, WhereTheNormalIsNotUniqueTheRefusalSaysPreciselyWhere) {
  const auto body = box<3>(casefile::CellShape::hexahedron, {2, 2, 4}, 1);
  const std::string edge = refusal([&] { interface_nodes(body, {"right", "back"}); });
  // Five nodes stand along the edge x = 2, y = 3.
  EXPECT_NE(edge.find("at (2, 3, 0) and 4 further nodes"), std::string::npos);
  EXPECT_NE(edge.find("facets of back and right stand at"), std::string::npos);
  const auto coarse = ring<2>(casefile::CellShape::quadrilateral, {1, 4});
  EXPECT_NE(refusal([&] {
              interface_nodes(coarse, {"inner"});
            }).find("facets of inner stand at 45 degrees"),
            std::string::npos);
}

TEST(Interface, OppositeSidesMayBothBeInContact) {
  const auto body = box<3>(casefile::CellShape::hexahedron, {2, 2, 2}, 1);
  EXPECT_EQ(interface_nodes(body, {"bottom", "top"}).size(), 18u);
}

TEST(Interface, AnUnknownBoundaryIsNamed) {
  const auto body = box<2>(casefile::CellShape::triangle, {1, 1}, 1);
  EXPECT_THROW(interface_nodes(body, {"lft"}), CaseError);
}

}  // namespace
}  // namespace tourmaline::contact
