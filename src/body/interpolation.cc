#include "body/interpolation.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "dense/decompositions.h"
#include "parallel/ranks.h"

namespace tourmaline::body {

namespace {

template <int dim>
using Vector = Eigen::Matrix<double, dim, 1>;

template <int dim>
Vector<dim> vector(const Vector3 &place) {
  return Eigen::Map<const Vector<dim>>(place.data());
}

// Of a segment, a triangle or a tetrahedron the point that is nearest: where the one of its plane
// lies outside, it is that of a face.
template <int dim>
Vector<dim> nearest_in_simplex(const std::vector<Vector<dim>> &corners, const Vector<dim> &place) {
  const auto n = static_cast<Eigen::Index>(corners.size()) - 1;
  if (n == 0)
    return corners[0];
  Eigen::MatrixXd edges(dim, n);
  for (Eigen::Index i = 0; i < n; ++i)
    edges.col(i) = corners[i + 1] - corners[0];
  const Eigen::VectorXd along = dense::least_squares(edges, place - corners[0]);
  if (along.minCoeff() >= 0 && along.sum() <= 1)
    return corners[0] + edges * along;
  Vector<dim> best = corners[0];
  for (std::size_t left_out = 0; left_out < corners.size(); ++left_out) {
    std::vector<Vector<dim>> face = corners;
    face.erase(face.begin() + static_cast<std::ptrdiff_t>(left_out));
    const Vector<dim> found = nearest_in_simplex<dim>(face, place);
    if ((found - place).squaredNorm() < (best - place).squaredNorm())
      best = found;
  }
  return best;
}

// The simplices that make up a cell, by its corners: of a quadrilateral or hexahedron those along
// the diagonal from its first corner to its last, one for each order of the axes.
template <int dim>
std::vector<std::vector<std::size_t>> simplices(std::size_t n_corners) {
  std::vector<std::vector<std::size_t>> all;
  if (n_corners == dim + 1) {
    all.emplace_back(n_corners);
    std::iota(all[0].begin(), all[0].end(), std::size_t{0});
    return all;
  }
  std::array<std::size_t, dim> axes;
  std::iota(axes.begin(), axes.end(), std::size_t{0});
  do {
    std::vector<std::size_t> &corners = all.emplace_back(1, 0);
    for (const std::size_t axis : axes)
      corners.push_back(corners.back() + (std::size_t{1} << axis));
  } while (std::next_permutation(axes.begin(), axes.end()));
  return all;
}

/// A cell with straight edges and what it maps from.
template <int dim>
class Cell {
 public:
  Cell(const Discretisation<dim> &body, std::size_t n_corners)
      : body_(body), corners_(n_corners), parts_(simplices<dim>(n_corners)) {}

  void set(std::span<const Node> nodes) {
    for (std::size_t v = 0; v < corners_.size(); ++v)
      corners_[v] = vector<dim>(body_.points()[nodes[v]]);
    low_ = high_ = corners_[0];
    for (const Vector<dim> &corner : corners_) {
      low_ = low_.cwiseMin(corner);
      high_ = high_.cwiseMax(corner);
    }
  }

  double low(std::size_t axis) const { return low_[static_cast<Eigen::Index>(axis)]; }
  double high(std::size_t axis) const { return high_[static_cast<Eigen::Index>(axis)]; }

  /// Whether the box around the cell, so much larger, holds the place.
  bool may_hold(const Vector<dim> &place, double tolerance) const {
    for (int axis = 0; axis < dim; ++axis)
      if (place[axis] < low_[axis] - tolerance || place[axis] > high_[axis] + tolerance)
        return false;
    return true;
  }

  /// At least so far is the cell from the place.
  double least_distance(const Vector<dim> &place) const {
    return (place - place.cwiseMax(low_).cwiseMin(high_)).norm();
  }

  Vector<dim> nearest(const Vector<dim> &place) const {
    Vector<dim> best = corners_[0];
    std::vector<Vector<dim>> simplex;
    for (const std::vector<std::size_t> &part : parts_) {
      simplex.clear();
      for (const std::size_t v : part)
        simplex.push_back(corners_[v]);
      const Vector<dim> found = nearest_in_simplex<dim>(simplex, place);
      if ((found - place).squaredNorm() < (best - place).squaredNorm())
        best = found;
    }
    return best;
  }

  /// The place of the reference cell that is mapped there, by Newton's method, which takes one step
  /// in affine cells; if it is not in the reference cell, the nearest along each axis.
  std::array<double, dim> reference(const Vector<dim> &place) const {
    constexpr int enough = 30;
    std::array<double, dim> at;
    at.fill(is_simplex() ? 1. / (dim + 1) : 0.5);
    for (int i = 0; i < enough; ++i) {
      const ReferenceShapes<dim> shapes = body_.shapes_at(at);
      Vector<dim> lacks = place - mapped(shapes);
      Eigen::Matrix<double, dim, dim> jacobian = Eigen::Matrix<double, dim, dim>::Zero();
      for (std::size_t v = 0; v < corners_.size(); ++v)
        jacobian += corners_[v] * vector_of(shapes.corner_gradients[v]).transpose();
      const Vector<dim> step = jacobian.inverse() * lacks;
      for (int axis = 0; axis < dim; ++axis)
        at[axis] += std::clamp(step[axis], -1., 1.);
      if (step.norm() < 1e-15)
        break;
    }
    return inside(at);
  }

  Vector<dim> mapped(const ReferenceShapes<dim> &shapes) const {
    Vector<dim> place = Vector<dim>::Zero();
    for (std::size_t v = 0; v < corners_.size(); ++v)
      place += shapes.corners[v] * corners_[v];
    return place;
  }

 private:
  bool is_simplex() const { return corners_.size() == dim + 1; }

  static Vector<dim> vector_of(const std::array<double, dim> &values) {
    return Eigen::Map<const Vector<dim>>(values.data());
  }

  std::array<double, dim> inside(std::array<double, dim> at) const {
    double sum = 0;
    for (double &coordinate : at)
      sum += coordinate = std::clamp(coordinate, 0., 1.);
    if (is_simplex() && sum > 1)
      for (double &coordinate : at)
        coordinate /= sum;
    return at;
  }

  const Discretisation<dim> &body_;
  std::vector<Vector<dim>> corners_;
  std::vector<std::vector<std::size_t>> parts_;
  Vector<dim> low_, high_;
};

/// The axis along which nodes are farthest apart, and by how much [m].
struct Extent {
  std::size_t axis = 0;
  double length = 0;
};

Extent extent(const std::array<Vector3, 2> &bounds) {
  Extent most;
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (const double length = bounds[1][axis] - bounds[0][axis]; length > most.length)
      most = {axis, length};
  return most;
}

/// Places by their coordinate along one axis, as a cell is far from most of them.
class Along {
 public:
  Along(const std::vector<Vector3> &places, std::size_t axis) : axis_(axis), order_(places.size()) {
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    std::sort(order_.begin(), order_.end(),
              [&](std::size_t a, std::size_t b) { return places[a][axis] < places[b][axis]; });
    for (const std::size_t i : order_)
      coordinates_.push_back(places[i][axis]);
  }

  std::size_t axis() const { return axis_; }
  /// Numbers of the places between.
  std::span<const std::size_t> between(double low, double high) const {
    const auto begin = std::lower_bound(coordinates_.begin(), coordinates_.end(), low),
               end = std::upper_bound(begin, coordinates_.end(), high);
    return std::span(order_).subspan(static_cast<std::size_t>(begin - coordinates_.begin()),
                                     static_cast<std::size_t>(end - begin));
  }

 private:
  std::size_t axis_;
  std::vector<std::size_t> order_;
  std::vector<double> coordinates_;
};

template <int dim>
Vector3 in_space(const Vector<dim> &v) {
  Vector3 plain{};
  std::copy(v.begin(), v.end(), plain.begin());
  return plain;
}

// Looks for the place in one cell.
template <int dim>
void look_inside(const Discretisation<dim> &body, const Cell<dim> &cell,
                 std::span<const Node> nodes, const Vector<dim> &place, double tolerance,
                 Interpolation &found) {
  if (found.distance == 0 || !cell.may_hold(place, tolerance))
    return;
  const ReferenceShapes<dim> shapes = body.shapes_at(cell.reference(place));
  if ((cell.mapped(shapes) - place).norm() <= tolerance)
    found = {in_space<dim>(place), {nodes.begin(), nodes.end()}, shapes.values, 0};
}

// Looks for a place in one cell that is nearer than the best so far.
template <int dim>
void look_nearby(const Cell<dim> &cell, const Vector<dim> &place, double tolerance,
                 Interpolation &best) {
  if (cell.least_distance(place) > best.distance)
    return;
  const Vector<dim> found = cell.nearest(place);
  if (const double distance = std::max((found - place).norm(), tolerance); distance < best.distance)
    best = {in_space<dim>(found), {}, {}, distance};
}

// Whoever has no cell, or none that holds it, is infinitely far away.
template <int dim>
std::vector<Interpolation> on_this_rank(const Discretisation<dim> &body,
                                        const std::vector<Vector3> &places, bool inside) {
  const std::size_t n_corners = body.has_simplices() ? dim + 1 : std::size_t{1} << dim;
  const Extent size = extent(body.bounds());
  const double tolerance = 1e-9 * size.length;
  const Along sorted(places, size.axis);
  constexpr double nowhere = std::numeric_limits<double>::infinity();
  std::vector<Interpolation> found(places.size(), Interpolation{{}, {}, {}, nowhere});
  Cell<dim> cell(body, n_corners);
  body.for_each_cell_nodes([&](std::span<const Node> nodes) {
    cell.set(nodes);
    if (inside)
      for (const std::size_t i : sorted.between(cell.low(sorted.axis()) - tolerance,
                                                cell.high(sorted.axis()) + tolerance))
        look_inside(body, cell, nodes, vector<dim>(places[i]), tolerance, found[i]);
    else
      for (std::size_t i = 0; i < places.size(); ++i)
        look_nearby(cell, vector<dim>(places[i]), tolerance, found[i]);
  });
  return found;
}

// As numbers, each of the same size: its distance, its place, how many nodes, these, their weights.
std::vector<double> packed(const std::vector<Interpolation> &all, std::size_t most_nodes) {
  std::vector<double> numbers;
  for (const Interpolation &one : all) {
    const std::size_t end = numbers.size() + 5 + 2 * most_nodes;
    numbers.push_back(one.distance);
    numbers.insert(numbers.end(), one.place.begin(), one.place.end());
    numbers.push_back(static_cast<double>(one.nodes.size()));
    numbers.insert(numbers.end(), one.nodes.begin(), one.nodes.end());
    numbers.insert(numbers.end(), one.weights.begin(), one.weights.end());
    numbers.resize(end, 0.);
  }
  return numbers;
}

Interpolation unpacked(std::span<const double> numbers) {
  Interpolation one;
  one.distance = numbers[0];
  std::copy_n(&numbers[1], 3, one.place.begin());
  const auto n = static_cast<std::size_t>(numbers[4]);
  for (std::size_t a = 0; a < n; ++a) {
    one.nodes.push_back(static_cast<Node>(numbers[5 + a]));
    one.weights.push_back(numbers[5 + n + a]);
  }
  return one;
}

// Of several ranks that have a place the first one's cell counts. Only that rank has the nodes of
// its cell, where these are shared out.
template <int dim>
std::vector<Interpolation> on_all_ranks(const Discretisation<dim> &body,
                                        const std::vector<Vector3> &places, bool inside) {
  const std::size_t n_nodes = body.shapes_at({}).values.size(), size = 5 + 2 * n_nodes;
  const std::vector<double> all =
      parallel::joined(packed(on_this_rank(body, places, inside), n_nodes));
  const auto rank = static_cast<std::size_t>(parallel::rank());
  std::vector<Interpolation> best(places.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    std::size_t nearest = i;
    for (std::size_t other = i; other * size < all.size(); other += places.size())
      if (all[other * size] < all[nearest * size])
        nearest = other;
    best[i] = unpacked(std::span(all).subspan(nearest * size, size));
    if (!body.sharing().is_whole() && nearest / places.size() != rank)
      best[i] = {best[i].place, {}, {}, best[i].distance};
  }
  return best;
}

}  // namespace

// Most places are inside; only of the others every cell may have to be measured.
template <int dim>
std::vector<Interpolation> nearest_places(const Discretisation<dim> &body,
                                          const std::vector<Vector3> &places) {
  std::vector<Interpolation> best = on_all_ranks(body, places, true);
  std::vector<Vector3> outside;
  for (std::size_t i = 0; i < places.size(); ++i)
    if (best[i].distance > 0)
      outside.push_back(places[i]);
  if (outside.empty())
    return best;
  const std::vector<Interpolation> near = on_all_ranks(body, outside, false);
  auto next = near.begin();
  for (Interpolation &one : best)
    if (one.distance > 0)
      one = *next++;
  return best;
}

template std::vector<Interpolation> nearest_places(const Discretisation<2> &,
                                                   const std::vector<Vector3> &);
template std::vector<Interpolation> nearest_places(const Discretisation<3> &,
                                                   const std::vector<Vector3> &);

}  // namespace tourmaline::body
