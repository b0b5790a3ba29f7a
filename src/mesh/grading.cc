#include "mesh/grading.h"

#include <deal.II/grid/grid_tools.h>

#include <array>
#include <cmath>

#include "case/sides.h"

namespace tourmaline::mesh {

namespace {

// The map x(s), 0 <= s <= 1, whose slope, the size of the cells, is proportional to
// exp(-((a + b) s - a)^2): the logarithm of the size is a parabola with its top between the ends.
// With a = sqrt(ln at_min) and b = sqrt(ln at_max) it falls from the top by just these factors.
class Map {
 public:
  Map(double at_min, double at_max)
      : a_(std::sqrt(std::log(at_min))), b_(std::sqrt(std::log(at_max))) {}

  double operator()(double s) const {
    const double sum = a_ + b_;
    return sum == 0 ? s : (std::erf(sum * s - a_) + std::erf(a_)) / (std::erf(b_) + std::erf(a_));
  }

 private:
  double a_, b_;
};

double grading_at(const casefile::Box &box, int axis, bool greatest) {
  for (const casefile::Side &side : casefile::sides(static_cast<int>(box.min.size())))
    if (side.axis == axis && side.greatest == greatest)
      if (const auto given = box.grading.find(side.name); given != box.grading.end())
        return given->second;
  return 1;
}

}  // namespace

std::vector<double> graded_line(double min, double max, int cells, double at_min, double at_max) {
  const Map map(at_min, at_max);
  std::vector<double> line{min};
  for (int i = 1; i < cells; ++i)
    line.push_back(min + (max - min) * map(static_cast<double>(i) / cells));
  line.push_back(max);  // the corners stay where the case puts them, to the last bit
  return line;
}

template <int dim>
void grade(dealii::Triangulation<dim> &cells, const casefile::Box &box) {
  if (box.grading.empty())
    return;
  std::array<std::vector<double>, dim> lines;
  for (int axis = 0; axis < dim; ++axis)
    lines[axis] = graded_line(box.min[axis], box.max[axis], box.cells[axis],
                              grading_at(box, axis, false), grading_at(box, axis, true));
  dealii::GridTools::transform(
      [&](const dealii::Point<dim> &equidistant) {
        dealii::Point<dim> moved;
        for (int axis = 0; axis < dim; ++axis) {
          const double share =
              (equidistant[axis] - box.min[axis]) / (box.max[axis] - box.min[axis]);
          moved[axis] = lines[axis][std::lround(share * box.cells[axis])];
        }
        return moved;
      },
      cells);
}

template void grade<2>(dealii::Triangulation<2> &, const casefile::Box &);
template void grade<3>(dealii::Triangulation<3> &, const casefile::Box &);

}  // namespace tourmaline::mesh
