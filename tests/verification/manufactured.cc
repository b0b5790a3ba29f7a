// Label: analytic. Manufactured solutions (problem.h) that are linear in time, so that backward
// Euler is exact and only the error of the mesh remains.

#include "study.h"
#include "tourmaline/case/case.h"

namespace tourmaline::verified {
namespace {

using casefile::CellShape;

class ManufacturedSolution : public ::testing::TestWithParam<Study> {};

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
    ::testing::Values(
        Study{"Triangles", CellShape::triangle, 1, {8, 16, 32}},
        Study{"Quadrilaterals", CellShape::quadrilateral, 1, {8, 16, 32}},
        Study{"Tetrahedra", CellShape::tetrahedron, 1, {4, 6, 12}},
        Study{"Hexahedra", CellShape::hexahedron, 1, {3, 6, 12}},
        Study{"QuadrilateralsWithModes", CellShape::quadrilateral, 1, {8, 16, 32}, "incompatible"},
        Study{"HexahedraWithModes", CellShape::hexahedron, 1, {3, 6, 12}, "incompatible"},
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

}  // namespace
}  // namespace tourmaline::verified
