#include "report/poling.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "report/raster.h"

namespace tourmaline::report {
namespace {

using Triple = std::array<double, 3>;

constexpr double wanted = 36;  // arrows in all parts
constexpr std::size_t fewest = 6;
constexpr double pixels = 400;                        // along the largest side of the picture
constexpr double shortest = 0.045 * pixels;           // an arrow that can still be read
constexpr double smallest = shortest * shortest / 4;  // a part beside larger ones [pixels]
constexpr std::size_t most_parts = 36;
constexpr double of_box = 0.7, of_part = 0.85;  // how much of its room an arrow fills

constexpr int nothing = -1;

struct Pixel {
  int x, y;
};
using Area = std::vector<Pixel>;  // of one part, from top to bottom, each line from left to right

struct PoledPart {
  int region;
  Area area;
};

/// What a cell of the skin has of a field in the last state, 0 where there is no such component.
double value_at(const Result &result, const char *name, const char *component, std::size_t cell) {
  const Field *field = result.field(name);
  for (std::size_t c = 0; field && c < field->components.size(); ++c)
    if (field->components[c] == component)
      return field->values[c].at(field->values[c].size() - result.skin.cells.size() + cell);
  return 0;
}

/// By the cells of the skin.
std::vector<Triple> polings_of(const Result &result) {
  std::vector<Triple> polings;
  for (std::size_t cell = 0; cell < result.skin.cells.size(); ++cell)
    polings.push_back({value_at(result, "poling", "x", cell), value_at(result, "poling", "y", cell),
                       value_at(result, "poling", "z", cell)});
  return polings;
}

/// By the cells of the skin: the region, or `nothing` where nothing is poled.
std::vector<int> regions_of(const Result &result, const std::vector<Triple> &polings) {
  std::vector<int> regions;
  for (std::size_t cell = 0; cell < polings.size(); ++cell)
    regions.push_back(polings[cell] == Triple{}
                          ? nothing
                          : static_cast<int>(value_at(result, "region", "", cell)));
  return regions;
}

double product(const Triple &a, const Triple &b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// Which triangle is seen at each pixel, and what stands in its cell.
class Picture {
 public:
  explicit Picture(const Result &result)
      : result_(result),
        polings_(polings_of(result)),
        regions_(regions_of(result, polings_)),
        view_(view_of(result, 0)),
        per_metre_(pixels / std::max({view_.width(), view_.height(), 1e-300})),
        raster_(view_, per_metre_) {
    for (std::size_t i = 0; i < result.skin.triangles.size(); ++i) {
      const auto &t = result.skin.triangles[i];
      const Colour number{static_cast<std::uint8_t>(i >> 16), static_cast<std::uint8_t>(i >> 8),
                          static_cast<std::uint8_t>(i)};
      raster_.triangle(view_.places[t[0]], view_.places[t[1]], view_.places[t[2]],
                       [&](double, double, double) { return number; });
    }
  }

  /// Pixels of one region that hang together and whose poling turns nowhere by a right angle or
  /// more from one pixel to the next: where a formula turns it over, each side is a part. Of many
  /// only the largest, and one for each region; what is smaller than an arrow's head is no part.
  std::vector<PoledPart> parts() {
    std::vector<PoledPart> all;
    of_pixel_.assign(raster_.pixels().size(), nothing);
    for (int y = 0; y < raster_.height(); ++y)
      for (int x = 0; x < raster_.width(); ++x)
        if (region_at({x, y}) != nothing && part_at({x, y}) == nothing)
          all.push_back(grown_from({x, y}, static_cast<int>(all.size())));
    return worth_showing(std::move(all));
  }

  const Triple &poling_at(const Pixel &at) const {
    return polings_[result_.skin.triangle_cells[triangle_at(at)]];
  }

  /// The place on the body that is seen there.
  Triple place_at(const Pixel &at) const {
    const auto &t = result_.skin.triangles[triangle_at(at)];
    const auto &a = view_.places[t[0]], &b = view_.places[t[1]], &c = view_.places[t[2]];
    const double x = view_.low[0] + (at.x + 0.5) / per_metre_ - a[0],
                 y = view_.high[1] - (at.y + 0.5) / per_metre_ - a[1];
    const double area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    const double v = (x * (c[1] - a[1]) - y * (c[0] - a[0])) / area,
                 w = ((b[0] - a[0]) * y - (b[1] - a[1]) * x) / area;
    Triple place;
    for (int i = 0; i < 3; ++i)
      place[i] = (1 - v - w) * result_.points[t[0]][i] + v * result_.points[t[1]][i] +
                 w * result_.points[t[2]][i];
    return place;
  }

  /// How long an arrow amid that place can be until an end leaves its part, at most `most`
  /// [pixels].
  double room_at(const Pixel &at, double most) const {
    const Triple along = seen(result_.dimension, poling_at(at));
    const int part = part_at(at);
    for (int half = 0; half < most / 2; ++half)
      for (const int side : {-half, half})
        if (part_at({static_cast<int>(std::floor(at.x + 0.5 + side * along[0])),
                     static_cast<int>(std::floor(at.y + 0.5 - side * along[1]))}) != part)
          return 2 * half;
    return most;
  }

  double per_metre() const { return per_metre_; }

 private:
  bool is_inside(const Pixel &at) const {
    return at.x >= 0 && at.y >= 0 && at.x < raster_.width() && at.y < raster_.height();
  }
  std::size_t place_of(const Pixel &at) const {
    return static_cast<std::size_t>(at.y) * raster_.width() + at.x;
  }
  std::size_t triangle_at(const Pixel &at) const {
    return raster_.pixels()[place_of(at)] & 0xffffffU;
  }
  /// `nothing` also beside the body.
  int region_at(const Pixel &at) const {
    if (!is_inside(at) || raster_.pixels()[place_of(at)] == 0)
      return nothing;
    return regions_[result_.skin.triangle_cells[triangle_at(at)]];
  }
  int part_at(const Pixel &at) const { return is_inside(at) ? of_pixel_[place_of(at)] : nothing; }

  bool continues(const Pixel &from, const Pixel &to) const {
    return region_at(to) == region_at(from) && part_at(to) == nothing &&
           product(poling_at(from), poling_at(to)) > 0;
  }

  PoledPart grown_from(const Pixel &first, int number) {
    PoledPart part{region_at(first), {first}};
    of_pixel_[place_of(first)] = number;
    for (std::size_t i = 0; i < part.area.size(); ++i) {
      const Pixel at = part.area[i];
      for (const Pixel next : {Pixel{at.x + 1, at.y}, Pixel{at.x - 1, at.y}, Pixel{at.x, at.y + 1},
                               Pixel{at.x, at.y - 1}})
        if (continues(at, next)) {
          of_pixel_[place_of(next)] = number;
          part.area.push_back(next);
        }
    }
    std::sort(part.area.begin(), part.area.end(),
              [](const Pixel &a, const Pixel &b) { return a.y != b.y ? a.y < b.y : a.x < b.x; });
    return part;
  }

  static std::vector<PoledPart> worth_showing(std::vector<PoledPart> all) {
    std::stable_sort(all.begin(), all.end(), [](const PoledPart &a, const PoledPart &b) {
      return a.area.size() > b.area.size();
    });
    std::vector<PoledPart> kept;
    std::set<int> regions;
    for (PoledPart &part : all)
      if (regions.insert(part.region).second ||
          (static_cast<double>(part.area.size()) >= smallest && kept.size() < most_parts))
        kept.push_back(std::move(part));
    std::stable_sort(kept.begin(), kept.end(),
                     [](const PoledPart &a, const PoledPart &b) { return a.region < b.region; });
    return kept;
  }

  const Result &result_;
  std::vector<Triple> polings_;
  std::vector<int> regions_;
  View view_;
  double per_metre_;
  Raster raster_;
  std::vector<int> of_pixel_;  // the number of its part
};

/// A part of a picture in boxes of about `size` pixels, all alike, that fill its frame.
class Boxes {
 public:
  /// Of an odd part they begin half a box earlier, so that arrows of neighbours do not meet.
  Boxes(const Area &part, double size, bool odd) {
    int right = 0, bottom = 0;
    left_ = top_ = std::numeric_limits<int>::max();
    for (const Pixel &p : part) {
      left_ = std::min(left_, p.x);
      right = std::max(right, p.x + 1);
      top_ = std::min(top_, p.y);
      bottom = std::max(bottom, p.y + 1);
    }
    const double across = std::max(1., std::round((right - left_) / size)),
                 down = std::max(1., std::round((bottom - top_) / size));
    width_ = (right - left_) / across;
    height_ = (bottom - top_) / down;
    shift_x_ = odd && across > 1 ? 0.5 : 0;
    shift_y_ = odd && down > 1 ? 0.5 : 0;
    for (const Pixel &p : part)
      boxes_[{static_cast<int>((p.y + 0.5 - top_) / height_ + shift_y_),
              static_cast<int>((p.x + 0.5 - left_) / width_ + shift_x_)}]
          .push_back(p);
  }

  std::size_t size() const { return boxes_.size(); }
  double side() const { return std::max(width_, height_); }

  /// The middle of what lies in each box, without those that hold little.
  std::vector<Pixel> middles() const {
    std::size_t most = 0;
    for (const auto &[at, inside] : boxes_)
      most = std::max(most, inside.size());
    std::vector<Pixel> middles;
    for (const auto &[at, inside] : boxes_)
      if (4 * inside.size() >= most)
        middles.push_back(middle_of(inside));
    return middles;
  }

 private:
  /// The pixel of the part nearest to the mean, which may lie beside a curved one.
  static Pixel middle_of(const Area &inside) {
    double x = 0, y = 0;
    for (const Pixel &p : inside) {
      x += p.x;
      y += p.y;
    }
    x /= static_cast<double>(inside.size());
    y /= static_cast<double>(inside.size());
    const auto away = [&](const Pixel &p) { return std::hypot(p.x - x, p.y - y); };
    return *std::min_element(inside.begin(), inside.end(),
                             [&](auto &a, auto &b) { return away(a) < away(b); });
  }

  int left_, top_;
  double width_, height_, shift_x_, shift_y_;
  std::map<std::pair<int, int>, Area> boxes_;
};

/// The longer side of the part's frame.
double extent_of(const Area &part) {
  const auto side = [&](int Pixel::*axis) {
    const auto [low, high] = std::minmax_element(
        part.begin(), part.end(), [&](auto &a, auto &b) { return a.*axis < b.*axis; });
    return (*high).*axis + 1 - (*low).*axis;
  };
  return std::max(side(&Pixel::x), side(&Pixel::y));
}

Boxes boxes_of(const Area &part, double number, bool odd) {
  const double most = extent_of(part) / static_cast<double>(fewest);
  double size = std::max(std::sqrt(static_cast<double>(part.size()) / number),
                         std::min(1.5 * shortest, most));  // beside an arrow there is room
  while (true) {
    Boxes boxes(part, size, odd);
    if (static_cast<double>(boxes.size()) <= 1.6 * number)
      return boxes;
    size *= 1.1;  // a thin, curved part touches many
  }
}

/// Arrows of one part have one length, for which three of four have room.
void add_arrows(const Picture &picture, const Area &part, double number, bool odd,
                std::vector<PolingArrow> &arrows) {
  const Boxes boxes = boxes_of(part, number, odd);
  const std::vector<Pixel> middles = boxes.middles();
  std::vector<double> rooms;
  rooms.reserve(middles.size());
  for (const Pixel &p : middles)
    rooms.push_back(picture.room_at(p, boxes.side() * of_box / of_part));
  std::nth_element(rooms.begin(), rooms.begin() + rooms.size() / 4, rooms.end());
  const double room = of_part * rooms[rooms.size() / 4];
  const double length = std::max(room, shortest) / picture.per_metre();
  // One that is longer than its part is thick begins in the part to which it belongs.
  const double before = room < shortest ? 0 : 0.5;
  for (const Pixel &p : middles) {
    const Triple place = picture.place_at(p), along = picture.poling_at(p);
    PolingArrow arrow;
    for (int i = 0; i < 3; ++i) {
      arrow.tail[i] = place[i] - before * length * along[i];
      arrow.tip[i] = arrow.tail[i] + length * along[i];
    }
    arrows.push_back(arrow);
  }
}

}  // namespace

std::vector<PolingArrow> poling_arrows(const Result &result) {
  std::vector<PolingArrow> arrows;
  if (!result.field("poling") || result.skin.triangles.size() > 0xffffffU)
    return arrows;
  Picture picture(result);
  const std::vector<PoledPart> parts = picture.parts();
  double all = 0;
  for (const PoledPart &part : parts)
    all += static_cast<double>(part.area.size());
  const double least =
      std::clamp<double>(2 * wanted / static_cast<double>(parts.size()), 1, fewest);
  int number = 0;  // of the part in its region
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const auto &[region, area] = parts[i];
    number = i > 0 && parts[i - 1].region == region ? number + 1 : 0;
    add_arrows(picture, area, std::max(least, wanted * static_cast<double>(area.size()) / all),
               (region + number) % 2 == 1, arrows);
  }
  return arrows;
}

}  // namespace tourmaline::report
