// Label: analytic. Manufactured solutions (problem.h) that are linear in space, so that the mesh
// is exact and only the error of the time step remains.

#include "study.h"

namespace tourmaline::verified {
namespace {

using casefile::CellShape;

// Linear in space, so the mesh adds no error; exp(t), so every backward difference has one. What
// remains is k times a constant and terms of k^2: the last rate is 1 within a few percent.
template <int dim>
void expect_first_order_in_time(CellShape shape) {
  Waves<dim> exact = waves<dim>(line);
  for (Wave<dim> &wave : exact)
    wave.course = {"exp(t)", "exp(t)", 1};
  casefile::MaterialCase material = coupled_material(dim);
  material.constants["reference_temperature"] = 2;  // exp(t) comes below -1.5
  Problem<dim> problem(material, exact, 1, 1);
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
}  // namespace tourmaline::verified
