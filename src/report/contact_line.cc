#include "report/contact_line.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "report/number_text.h"

namespace tourmaline::report {
namespace {

using Row = std::uint32_t;
using Places = std::vector<std::pair<double, double>>;

/// Lines between neighbours, each with the boundary it belongs to.
class Lines {
 public:
  Lines(const std::vector<NamedFacets> &boundaries, const std::map<std::uint32_t, Row> &row_of) {
    for (const NamedFacets &boundary : boundaries)
      for (const auto &facet : boundary.facets)
        for (std::size_t i = 1; i < facet.size(); ++i)
          add(row_of.at(facet[i - 1]), row_of.at(facet[i]), boundary.name);
  }

  /// Neighbours of a row along lines that are left.
  std::size_t degree(Row row) const {
    const auto found = left_.find(row);
    return found == left_.end() ? 0 : found->second.size();
  }

  /// From a row along lines that are left, which are then taken, to where the way ends or forks.
  ContactPiece walk(Row start, const std::set<Row> &forks) {
    ContactPiece piece;
    std::set<std::string> names;
    piece.rows.push_back(start);
    for (Row at = start; degree(at) > 0;) {
      const auto [next, name] = *left_[at].begin();
      left_[at].erase(next);
      left_[next].erase(at);
      names.insert(name);
      piece.rows.push_back(at = next);
      if (at == start || forks.count(at))
        break;
    }
    for (const std::string &name : names)
      piece.name += (piece.name.empty() ? "" : ", ") + name;
    return piece;
  }

  std::vector<Row> rows() const {
    std::vector<Row> rows;
    for (const auto &entry : left_)
      rows.push_back(entry.first);
    return rows;
  }

 private:
  void add(Row a, Row b, const std::string &name) {
    if (a == b)
      return;
    left_[a].emplace(b, name);
    left_[b].emplace(a, name);
  }

  std::map<Row, std::map<Row, std::string>> left_;
};

double area_of(const ContactPiece &piece, const Places &places) {
  double twice = 0;
  for (std::size_t i = 1; i < piece.rows.size(); ++i) {
    const auto &[x, y] = places[piece.rows[i - 1]];
    const auto &[next_x, next_y] = places[piece.rows[i]];
    twice += x * next_y - next_x * y;
  }
  return twice / 2;
}

double spread(const ContactPiece &piece, const Places &places,
              double std::pair<double, double>::*c) {
  double low = places[piece.rows.front()].*c, high = low;
  for (const Row row : piece.rows) {
    low = std::min(low, places[row].*c);
    high = std::max(high, places[row].*c);
  }
  return high - low;
}

void measure_straight(ContactPiece &piece, const Places &places,
                      double std::pair<double, double>::*c) {
  if (places[piece.rows.front()].*c > places[piece.rows.back()].*c)
    std::reverse(piece.rows.begin(), piece.rows.end());
  for (const Row row : piece.rows)
    piece.along.push_back(places[row].*c);
}

void measure_curve(ContactPiece &piece, const Places &places) {
  const bool closed = piece.rows.front() == piece.rows.back();
  if (closed ? area_of(piece, places) < 0 : piece.rows.front() > piece.rows.back())
    std::reverse(piece.rows.begin(), piece.rows.end());
  const auto &[x, y] = places[piece.rows.front()];
  const double size = std::max(spread(piece, places, &std::pair<double, double>::first),
                               spread(piece, places, &std::pair<double, double>::second));
  const auto coordinate = [&](double at) {
    return number_text(std::abs(at) <= 1e-12 * size ? 0 : at, 4);
  };
  piece.abscissa = "length along the contact [m]";
  piece.origin = fmt::format("{}from ({}, {}) m{}", closed ? "closed, " : "", coordinate(x),
                             coordinate(y), closed ? " counter-clockwise" : "");
  piece.along.push_back(0);
  for (std::size_t i = 1; i < piece.rows.size(); ++i) {
    const auto &[ax, ay] = places[piece.rows[i - 1]];
    const auto &[bx, by] = places[piece.rows[i]];
    piece.along.push_back(piece.along.back() + std::hypot(bx - ax, by - ay));
  }
}

void measure(ContactPiece &piece, const Places &places) {
  const double wide = spread(piece, places, &std::pair<double, double>::first),
               high = spread(piece, places, &std::pair<double, double>::second);
  const double thin = 1e-6 * std::max(wide, high);
  if (wide <= thin) {
    piece.abscissa = "y [m]";
    measure_straight(piece, places, &std::pair<double, double>::second);
  } else if (high <= thin) {
    piece.abscissa = "x [m]";
    measure_straight(piece, places, &std::pair<double, double>::first);
  } else {
    measure_curve(piece, places);
  }
}

/// Nodes by number: contact.csv lists them in this order.
std::map<std::uint32_t, Row> rows_of(const std::vector<NamedFacets> &boundaries) {
  std::map<std::uint32_t, Row> row_of;
  for (const NamedFacets &boundary : boundaries)
    for (const auto &facet : boundary.facets)
      for (const std::uint32_t node : facet)
        row_of[node] = 0;
  Row next = 0;
  for (auto &entry : row_of)
    entry.second = next++;
  return row_of;
}

/// The rows at which contacts meet.
std::vector<Row> meetings(const std::vector<NamedFacets> &boundaries,
                          const std::map<std::uint32_t, Row> &row_of) {
  std::map<Row, std::size_t> contact_at;
  std::set<Row> rows;
  for (const NamedFacets &boundary : boundaries)
    for (const auto &facet : boundary.facets)
      for (const std::uint32_t node : facet) {
        const Row row = row_of.at(node);
        if (contact_at.try_emplace(row, boundary.contact).first->second != boundary.contact)
          rows.insert(row);
      }
  return {rows.begin(), rows.end()};
}

/// Takes away the ends that belong to another contact than what lies between.
void cut(ContactPiece &piece, const std::vector<std::size_t> &contacts) {
  if (contacts.empty() || piece.rows.size() < 4)
    return;
  const std::size_t own = contacts[piece.rows[piece.rows.size() / 2]];
  if (contacts[piece.rows.front()] != own)
    piece.rows.erase(piece.rows.begin());
  if (contacts[piece.rows.back()] != own)
    piece.rows.pop_back();
}

}  // namespace

std::vector<ContactPiece> contact_pieces(const std::vector<NamedFacets> &boundaries,
                                         const Places &places,
                                         const std::vector<std::size_t> &contacts) {
  const std::map<std::uint32_t, Row> row_of = rows_of(boundaries);
  if (row_of.empty() || row_of.size() != places.size())
    return {};
  Lines lines(boundaries, row_of);
  const std::vector<Row> all = lines.rows();
  std::set<Row> ends, forks;
  for (const Row row : all) {
    if (lines.degree(row) != 2)
      ends.insert(row);
    if (lines.degree(row) > 2)
      forks.insert(row);
  }
  for (const Row row : meetings(boundaries, row_of)) {
    ends.insert(row);
    forks.insert(row);
  }
  std::vector<ContactPiece> pieces;
  const auto take = [&](Row start) {
    while (lines.degree(start) > 0)
      pieces.push_back(lines.walk(start, forks));
  };
  std::for_each(ends.begin(), ends.end(), take);
  std::for_each(all.begin(), all.end(), take);  // what is left is closed
  for (ContactPiece &piece : pieces) {
    cut(piece, contacts);
    measure(piece, places);
  }
  std::sort(pieces.begin(), pieces.end(), [](const ContactPiece &a, const ContactPiece &b) {
    return *std::min_element(a.rows.begin(), a.rows.end()) <
           *std::min_element(b.rows.begin(), b.rows.end());
  });
  return pieces;
}

}  // namespace tourmaline::report
