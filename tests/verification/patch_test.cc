// Label: analytic. Manufactured solutions (problem.h) that the elements contain.

#include <deal.II/grid/grid_tools.h>

#include "march.h"
#include "mesh/mesh.h"
#include "study.h"

namespace tourmaline::verified {
namespace {

using casefile::CellShape;

// Incompatible modes are to leave alone what is uniform: strain, field and temperature. (A linear
// temperature bends a cell, and they follow.)
template <int dim>
Problem<dim> uniformly_warm() {
  Waves<dim> uniform = waves<dim>(line);
  uniform.back().direction.setZero();
  Problem<dim> problem(coupled_material(dim), uniform, 1, 1);
  for (const Side &side : sides(dim))
    problem.prescribe(side);
  return problem;
}

// Fields that the elements contain, on cells that are no boxes: nothing but round-off may remain.
// Seen: at most 6e-15.
template <int dim>
void expect_reproduction(const Study &study) {
  Problem<dim> problem = study.modes == "none"
                             ? held_on_all_sides<dim>(study.degree == 1 ? line : square)
                             : uniformly_warm<dim>();
  problem.on_mesh(study.shape, study.degree, study.cells.front());
  problem.asked.mesh.modes = study.modes;
  mesh::Mesh<dim> mesh = mesh::build<dim>(problem.asked.mesh);
  dealii::GridTools::distort_random(0.15, *mesh.cells, true, 7);
  const solve::Model<dim> model(problem.asked, std::move(mesh));
  const Errors errors = ErrorNorms<dim>(problem.exact, 1).of(model.body, march(model).state);
  for (std::size_t f = 0; f < 3; ++f) {
    EXPECT_LT(errors.l2[f], 1e-12) << f;
    if (study.modes == "none" || f < 2) {  // a uniform temperature has no gradient to compare with
      EXPECT_LT(errors.h1[f], 1e-12) << f;
    }
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
    ::testing::Values(
        Study{"Triangles", CellShape::triangle, 1, {5}},
        Study{"Quadrilaterals", CellShape::quadrilateral, 1, {5}},
        Study{"Tetrahedra", CellShape::tetrahedron, 1, {3}},
        Study{"Hexahedra", CellShape::hexahedron, 1, {3}},
        Study{"QuadrilateralsWithModes", CellShape::quadrilateral, 1, {5}, "incompatible"},
        Study{"HexahedraWithModes", CellShape::hexahedron, 1, {3}, "incompatible"},
        Study{"TrianglesOfDegree2", CellShape::triangle, 2, {4}},
        Study{"QuadrilateralsOfDegree2", CellShape::quadrilateral, 2, {4}},
        Study{"TetrahedraOfDegree2", CellShape::tetrahedron, 2, {2}},
        Study{"HexahedraOfDegree2", CellShape::hexahedron, 2, {2}}),
    name_of);

}  // namespace
}  // namespace tourmaline::verified
