// Label: analytic. What the equations promise of every solution, whatever it is: mirrored,
// poled the other way, moved or renumbered, the same body does the same.

#include <deal.II/grid/grid_tools.h>

#include "image.h"
#include "march.h"
#include "mesh/mesh.h"
#include "tourmaline/case/case.h"

namespace tourmaline::verified {
namespace {

// On quadrilaterals: squares cut into triangles have no mirror image among the meshes.
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
  mesh::Mesh<2> backwards{std::make_unique<dealii::Triangulation<2>>(), mesh.boundaries, mesh.inner,
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

}  // namespace
}  // namespace tourmaline::verified
