#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "mesh/shapes.h"

namespace tourmaline::mesh {

namespace {

// Intervals along the radius, around, along z; the vertices of a bent box whose ends meet.
template <int dim>
class Ring {
 public:
  explicit Ring(const casefile::Annulus &asked) : asked_(asked) {
    for (int axis = 0; axis < dim; ++axis)
      n_[axis] = asked.cells[axis];
  }

  using Place = std::array<int, 3>;

  unsigned int vertex(const Place &at) const {
    return static_cast<unsigned int>(at[0] +
                                     (n_[0] + 1) * (at[1] % n_[1] + n_[1] * std::size_t(at[2])));
  }
  std::vector<dealii::Point<dim>> vertices() const;
  template <class Visit>
  void for_each_block(const Visit &visit) const;

 private:
  const casefile::Annulus &asked_;
  Place n_{1, 1, 0};
};

template <int dim>
std::vector<dealii::Point<dim>> Ring<dim>::vertices() const {
  std::vector<dealii::Point<dim>> all;
  for (int k = 0; k <= n_[2]; ++k)
    for (int j = 0; j < n_[1]; ++j)
      for (int i = 0; i <= n_[0]; ++i) {
        const double radius = asked_.inner + (asked_.outer - asked_.inner) * i / n_[0];
        const double angle = 2 * std::numbers::pi * j / n_[1];
        dealii::Point<dim> &p = all.emplace_back();
        p[0] = radius * std::cos(angle);
        p[1] = radius * std::sin(angle);
        if (dim == 3)
          p[dim - 1] = asked_.height * k / n_[2];
      }
  return all;
}

template <int dim>
template <class Visit>
void Ring<dim>::for_each_block(const Visit &visit) const {
  for (int k = 0; k < std::max(n_[2], 1); ++k)
    for (int j = 0; j < n_[1]; ++j)
      for (int i = 0; i < n_[0]; ++i)
        visit(Place{i, j, k});
}

// The corners of each cell of a block, as steps along the axes from the block's first corner.
using Corners = std::vector<std::array<int, 3>>;

template <int dim>
std::vector<Corners> whole_block() {
  Corners corners;
  for (int corner = 0; corner < 1 << dim; ++corner)
    corners.push_back({corner & 1, corner >> 1 & 1, corner >> 2 & 1});
  return {corners};
}

// One simplex for each order in which one can walk along the axes to the opposite corner. All
// blocks are split alike, so neighbours fit, around the ring as well, whatever their number.
template <int dim>
std::vector<Corners> split_block() {
  std::vector<Corners> simplices;
  std::array<int, dim> axes;
  for (int axis = 0; axis < dim; ++axis)
    axes[axis] = axis;
  do {
    Corners corners{{0, 0, 0}};
    for (const int axis : axes) {
      corners.push_back(corners.back());
      ++corners.back()[axis];
    }
    // An odd order of the axes turns the simplex inside out.
    const bool is_even = dim == 2 ? axes[0] == 0 : axes[1] == (axes[0] + 1) % 3;
    if (!is_even)
      std::swap(corners[dim - 1], corners[dim]);
    simplices.push_back(corners);
  } while (std::next_permutation(axes.begin(), axes.end()));
  return simplices;
}

enum Side : dealii::types::boundary_id { inner, outer, bottom, top };

template <int dim>
void name_sides(dealii::Triangulation<dim> &cells, const casefile::Annulus &asked) {
  const double middle = (asked.inner + asked.outer) / 2;
  for (const auto &cell : cells.active_cell_iterators())
    for (const unsigned int f : cell->face_indices()) {
      const auto face = cell->face(f);
      if (!face->at_boundary())
        continue;
      double least = asked.height, greatest = 0;
      for (const unsigned int v : face->vertex_indices()) {
        least = std::min(least, face->vertex(v)[dim - 1]);
        greatest = std::max(greatest, face->vertex(v)[dim - 1]);
      }
      if (dim == 3 && greatest - least < 1e-9 * asked.height)
        face->set_boundary_id(least < asked.height / 2 ? bottom : top);
      else
        face->set_boundary_id(std::hypot(face->vertex(0)[0], face->vertex(0)[1]) < middle ? inner
                                                                                          : outer);
    }
}

}  // namespace

template <int dim>
Mesh<dim> annulus(const casefile::Annulus &asked) {
  Mesh<dim> mesh;
  mesh.simplices =
      asked.cell == casefile::CellShape::triangle || asked.cell == casefile::CellShape::tetrahedron;
  const Ring<dim> ring(asked);
  const std::vector<Corners> parts = mesh.simplices ? split_block<dim>() : whole_block<dim>();
  std::vector<dealii::CellData<dim>> cells;
  ring.for_each_block([&](const std::array<int, 3> &at) {
    for (const Corners &corners : parts) {
      dealii::CellData<dim> cell(static_cast<unsigned int>(corners.size()));
      for (std::size_t c = 0; c < corners.size(); ++c)
        cell.vertices[c] =
            ring.vertex({at[0] + corners[c][0], at[1] + corners[c][1], at[2] + corners[c][2]});
      cells.push_back(cell);
    }
  });
  mesh.cells = std::make_unique<dealii::Triangulation<dim>>();
  mesh.cells->create_triangulation(ring.vertices(), cells, {});
  name_sides(*mesh.cells, asked);
  mesh.boundaries = {{"inner", {inner}}, {"outer", {outer}}};
  if (dim == 3)
    mesh.boundaries.insert({{"bottom", {bottom}}, {"top", {top}}});
  return mesh;
}

template Mesh<2> annulus<2>(const casefile::Annulus &);
template Mesh<3> annulus<3>(const casefile::Annulus &);

}  // namespace tourmaline::mesh
