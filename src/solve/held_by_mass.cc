#include "solve/held_by_mass.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "case/holding.h"
#include "parallel/ranks.h"
#include "tourmaline/error.h"

namespace tourmaline::solve {

using body::Fields;
using body::Node;
using casefile::Support;

namespace {

// Of this rank.
template <int dim>
std::vector<Vector3> places_with_mass(const Model<dim> &model) {
  std::vector<Vector3> places;
  for (Node node = 0; node < model.body.n_nodes(); ++node)
    if (model.counts(body::unknown<dim>(node, 0)) && model.op.rate_forces()->diagonal()[node] > 0)
      places.push_back(model.body.points()[node]);
  return places;
}

// Of all points three that are as far from a line as any: what they hold all of them hold.
std::vector<Vector3> spanning(const std::vector<Vector3> &points) {
  if (points.empty())
    return {};
  using Point = Eigen::Vector3d;
  const auto at = [&](std::size_t i) { return Point(points[i].data()); };
  const auto farthest = [&](const auto &distance) {
    std::size_t best = 0;
    for (std::size_t i = 1; i < points.size(); ++i)
      if (distance(at(i)) > distance(at(best)))
        best = i;
    return best;
  };
  const Point first = at(0);
  const std::size_t second = farthest([&](const Point &p) { return (p - first).norm(); });
  const Point line = at(second) - first;
  const std::size_t third =
      farthest([&](const Point &p) { return (p - first).cross(line).norm(); });
  return {points[0], points[second], points[third]};
}

// Of the points of all ranks, on all of them.
std::vector<Vector3> spanning_all(const std::vector<Vector3> &mine) {
  std::vector<double> coordinates;
  for (const Vector3 &point : spanning(mine))
    coordinates.insert(coordinates.end(), point.begin(), point.end());
  coordinates = parallel::joined(coordinates);
  std::vector<Vector3> points(coordinates.size() / 3);
  for (std::size_t i = 0; i < points.size(); ++i)
    std::copy_n(&coordinates[3 * i], 3, points[i].begin());
  return spanning(points);
}

template <int dim>
std::vector<Support> supports_beside_mass(const Model<dim> &model) {
  std::vector<Support> supports;
  for (const body::Prescribed &p : model.prescribed)
    if (const std::size_t c = p.unknown % Fields<dim>::count; c < dim) {
      Support &support = supports.emplace_back(Support{p.point, {}});
      support.direction[c] = 1;
    }
  for (const contact::InterfaceNode<dim> &at : model.interface)
    if (!model.laws.of(at).can_open()) {
      Support &support = supports.emplace_back(Support{at.point, {}});
      Eigen::Map<typename Model<dim>::Vector>(support.direction.data()) = at.normal;
    }
  return supports;
}

}  // namespace

template <int dim>
void require_mass_that_holds(const Model<dim> &model) {
  const std::vector<Vector3> mine = places_with_mass(model), points = spanning_all(mine);
  const double count = model.sharing().sum(static_cast<double>(mine.size()));
  if (points.empty())
    return;
  std::vector<Support> supports;
  for (const Vector3 &point : points)
    for (std::size_t c = 0; c < dim; ++c)
      supports.emplace_back(Support{point, {}}).direction[c] = 1;
  if (casefile::free_motions(model.asked, supports).empty())
    return;
  for (const Support &support : supports_beside_mass(model))
    supports.push_back(support);
  if (const std::string free = casefile::free_motions_in_words(model.asked, supports);
      !free.empty())
    throw CaseError(fmt::format(
        "[time] contact_mass: contact nodes give their mass to other nodes of their cells, and of "
        "these there {}, which {} not resist {}; nothing else holds the body against it; take "
        "finer cells, or contact_mass = \"consistent\"",
        count == 1 ? "is one" : fmt::format("are {:.0f}", count), count == 1 ? "does" : "do",
        free));
}

template void require_mass_that_holds<2>(const Model<2> &);
template void require_mass_that_holds<3>(const Model<3> &);

}  // namespace tourmaline::solve
