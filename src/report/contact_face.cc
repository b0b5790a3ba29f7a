#include "report/contact_face.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <optional>

#include "report/number_text.h"

namespace tourmaline::report {
namespace {

constexpr const char *axis_names[] = {"x", "y", "z"};

/// Facets that lean less than this towards an axis, as a cosine, are too foreshortened to be seen
/// along it.
constexpr double least_facing = 0.25;
/// A cylinder's facets face its axis less than this, and its radii differ by less than that share.
constexpr double most_along_axis = 0.1, same_radius = 0.02;

struct Facet {
  const ContactFacet *nodes;
  Vector3 normal, centre;
  std::size_t contact = 0;
};

using Patch = std::vector<Facet>;

Vector3 extent_between(const Vector3 &low, const Vector3 &high) {
  return {high[0] - low[0], high[1] - low[1], high[2] - low[2]};
}

Facet facet_of(const ContactFacet &nodes, const std::vector<Vector3> &places,
               const std::vector<std::size_t> &contacts) {
  Facet facet{&nodes, {}, {}};
  const std::size_t n = corners_of(nodes.size());
  std::map<std::size_t, std::size_t> votes;
  for (std::size_t i = 0; i < n; ++i) {
    const Vector3 &a = places.at(nodes[i]), &b = places.at(nodes[(i + 1) % n]);
    for (int c = 0; c < 3; ++c) {
      const int d = (c + 1) % 3, e = (c + 2) % 3;
      facet.normal[c] += (a[d] - b[d]) * (a[e] + b[e] - 2 * places.at(nodes[0])[e]);
      facet.centre[c] += a[c] / static_cast<double>(n);
    }
    if (!contacts.empty())
      ++votes[contacts.at(nodes[i])];
  }
  const double length =
      std::max(std::hypot(facet.normal[0], facet.normal[1], facet.normal[2]), 1e-300);
  for (double &component : facet.normal)
    component /= length;
  if (!votes.empty())
    facet.contact = std::max_element(votes.begin(), votes.end(), [](auto &a, auto &b) {
                      return a.second < b.second;
                    })->first;
  return facet;
}

/// Facets that have nodes in common and are of one contact, by the least of their rows.
std::vector<Patch> connected(const Patch &facets) {
  std::vector<std::size_t> root(facets.size());
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&](std::size_t i) {
    while (root[i] != i)
      i = root[i] = root[root[i]];
    return i;
  };
  std::map<std::pair<std::uint32_t, std::size_t>, std::size_t> first_with;
  for (std::size_t i = 0; i < facets.size(); ++i)
    for (const std::uint32_t row : *facets[i].nodes)
      root[find(i)] = find(first_with.try_emplace({row, facets[i].contact}, i).first->second);
  std::map<std::size_t, Patch> parts;
  std::map<std::size_t, std::uint32_t> least;
  for (std::size_t i = 0; i < facets.size(); ++i) {
    const std::size_t part = find(i);
    parts[part].push_back(facets[i]);
    const std::uint32_t row = *std::min_element(facets[i].nodes->begin(), facets[i].nodes->end());
    const auto known = least.try_emplace(part, row).first;
    known->second = std::min(known->second, row);
  }
  std::map<std::pair<std::uint32_t, std::size_t>, Patch> ordered;
  for (auto &[part, members] : parts)
    ordered[{least[part], part}] = std::move(members);
  std::vector<Patch> result;
  for (auto &entry : ordered)
    result.push_back(std::move(entry.second));
  return result;
}

std::string metres(double value, double size) {
  return number_text(std::abs(value) <= 1e-9 * size ? 0 : value, 4) + " m";
}

void add(ContactFace &face, std::uint32_t row, double x, double y) {
  face.rows.push_back(row);
  face.x.push_back(x);
  face.y.push_back(y);
}

/// Seen along an axis.
ContactFace plan(const Patch &part, const std::vector<Vector3> &places, int axis) {
  const int a = axis == 0 ? 1 : 0, b = axis == 2 ? 1 : 2;
  ContactFace face;
  face.across = fmt::format("{} [m]", axis_names[a]);
  face.up = fmt::format("{} [m]", axis_names[b]);
  Vector3 low = places[part.front().nodes->front()], high = low;
  for (const Facet &facet : part) {
    face.sizes.push_back(static_cast<std::uint32_t>(facet.nodes->size()));
    for (const std::uint32_t row : *facet.nodes) {
      const Vector3 &place = places[row];
      add(face, row, place[a], place[b]);
      for (int c = 0; c < 3; ++c) {
        low[c] = std::min(low[c], place[c]);
        high[c] = std::max(high[c], place[c]);
      }
    }
  }
  const Vector3 extent = extent_between(low, high);
  const double size = std::max({extent[0], extent[1], extent[2]});
  face.place = extent[axis] <= 1e-6 * size
                   ? fmt::format("{} = {}", axis_names[axis], metres(low[axis], size))
                   : fmt::format("seen along {}", axis_names[axis]);
  return face;
}

/// The axis along which nothing of a part is hidden.
std::optional<int> open_axis(const Patch &part) {
  std::optional<int> best;
  double most = least_facing;
  for (int axis = 0; axis < 3; ++axis) {
    double least = 1;
    for (const Facet &facet : part)
      least = std::min(least, std::abs(facet.normal[axis]));
    if (least > most) {
      most = least;
      best = axis;
    }
  }
  return best;
}

struct Cylinder {
  int axis, a, b;  ///< `a` to `b` is counter-clockwise, seen from the end of `axis`
  double centre_a, centre_b, radius;

  double angle(const Vector3 &place) const {
    return std::atan2(place[b] - centre_b, place[a] - centre_a);
  }
};

/// The point in which the normals of all facets meet, if the nodes are all as far from it.
std::optional<Cylinder> cylinder_of(const Patch &part, const std::vector<Vector3> &places,
                                    int axis) {
  Cylinder found{axis, (axis + 1) % 3, (axis + 2) % 3, 0, 0, 0};
  const auto [a, b] = std::pair(found.a, found.b);
  double aa = 0, ab = 0, bb = 0, right_a = 0, right_b = 0;
  for (const Facet &facet : part) {
    if (std::abs(facet.normal[axis]) > most_along_axis)
      return {};
    const double ta = -facet.normal[b], tb = facet.normal[a];
    const double at = ta * facet.centre[a] + tb * facet.centre[b];
    aa += ta * ta;
    ab += ta * tb;
    bb += tb * tb;
    right_a += ta * at;
    right_b += tb * at;
  }
  const double determinant = aa * bb - ab * ab;
  if (determinant <= 1e-6 * (aa + bb) * (aa + bb))
    return {};
  found.centre_a = (bb * right_a - ab * right_b) / determinant;
  found.centre_b = (aa * right_b - ab * right_a) / determinant;
  double least = 1e300, most = 0;
  for (const Facet &facet : part)
    for (const std::uint32_t row : *facet.nodes) {
      const double radius =
          std::hypot(places[row][a] - found.centre_a, places[row][b] - found.centre_b);
      least = std::min(least, radius);
      most = std::max(most, radius);
    }
  found.radius = (least + most) / 2;
  return most - least <= same_radius * most ? std::optional(found) : std::nullopt;
}

/// Where the greatest gap between nodes ends; of equal ones that at the least angle from 0 on.
double seam_of(const Patch &part, const std::vector<Vector3> &places, const Cylinder &cylinder) {
  constexpr double turn = 2 * std::numbers::pi, same = 1e-6;
  std::vector<double> angles;
  for (const Facet &facet : part)
    for (const std::uint32_t row : *facet.nodes) {
      const double angle = cylinder.angle(places[row]);
      angles.push_back(angle < -same ? angle + turn : angle);
    }
  std::sort(angles.begin(), angles.end());
  double seam = angles.front(), greatest = angles.front() + turn - angles.back();
  for (std::size_t i = 1; i < angles.size(); ++i)
    if (angles[i] - angles[i - 1] > greatest + same) {
      greatest = angles[i] - angles[i - 1];
      seam = angles[i];
    }
  return seam;
}

ContactFace unrolled(const Patch &part, const std::vector<Vector3> &places,
                     const Cylinder &cylinder) {
  constexpr double turn = 2 * std::numbers::pi;
  const double seam = seam_of(part, places, cylinder);
  const auto wrapped = [](double angle, double around) {
    return angle - turn * std::round((angle - around) / turn);
  };
  ContactFace face;
  const char *axis = axis_names[cylinder.axis];
  face.across = fmt::format("length around {} [m]", axis);
  face.up = fmt::format("{} [m]", axis);
  face.place = fmt::format("around {}, radius {}", axis, metres(cylinder.radius, cylinder.radius));
  face.origin = fmt::format(
      "unrolled from {} = {}, {} = {}, counter-clockwise seen from the end of {}",
      axis_names[cylinder.a],
      metres(cylinder.centre_a + cylinder.radius * std::cos(seam), cylinder.radius),
      axis_names[cylinder.b],
      metres(cylinder.centre_b + cylinder.radius * std::sin(seam), cylinder.radius), axis);
  for (const Facet &facet : part) {
    face.sizes.push_back(static_cast<std::uint32_t>(facet.nodes->size()));
    const double middle = wrapped(cylinder.angle(facet.centre), seam + turn / 2);
    for (const std::uint32_t row : *facet.nodes)
      add(face, row, cylinder.radius * (wrapped(cylinder.angle(places[row]), middle) - seam),
          places[row][cylinder.axis]);
  }
  return face;
}

std::vector<ContactFace> laid_out(const Patch &part, const std::vector<Vector3> &places) {
  if (const auto axis = open_axis(part))
    return {plan(part, places, *axis)};
  for (int axis = 0; axis < 3; ++axis)
    if (const auto cylinder = cylinder_of(part, places, axis))
      return {unrolled(part, places, *cylinder)};
  std::vector<ContactFace> faces;
  for (int axis = 0; axis < 3; ++axis) {
    Patch side;
    for (const Facet &facet : part) {
      int most = 0;
      for (int c = 1; c < 3; ++c)
        if (std::abs(facet.normal[c]) > std::abs(facet.normal[most]) + 1e-9)
          most = c;
      if (most == axis)
        side.push_back(facet);
    }
    for (const Patch &piece : connected(side))
      faces.push_back(plan(piece, places, axis));
  }
  return faces;
}

}  // namespace

std::size_t corners_of(std::size_t nodes) {
  return nodes == 9 ? 4 : nodes == 6 ? 3 : nodes;
}

std::vector<ContactFace> contact_faces(const std::vector<ContactFacet> &facets,
                                       const std::vector<Vector3> &places,
                                       const std::vector<std::size_t> &contacts,
                                       const std::vector<std::string> &names) {
  Patch all;
  for (const ContactFacet &facet : facets)
    all.push_back(facet_of(facet, places, contacts));
  std::vector<ContactFace> faces;
  for (const Patch &part : connected(all))
    for (ContactFace &face : laid_out(part, places)) {
      if (names.size() > 1)
        face.contact = names.at(part.front().contact);
      faces.push_back(std::move(face));
    }
  return faces;
}

}  // namespace tourmaline::report
