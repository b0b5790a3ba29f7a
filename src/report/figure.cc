#include "figure.h"

#include <algorithm>
#include <cmath>

#include "report/feature_edges.h"
#include "report/figure_measures.h"
#include "report/number_text.h"
#include "report/poling.h"
#include "report/scale.h"
#include "report/setting.h"
#include "report/ticks.h"

namespace tourmaline::report {
namespace {

double points_per_metre(const View &view) {
  return body_size / std::max({view.width(), view.height(), 1e-300});
}

constexpr double number_size = 7, label_size = 7.5;

// Of a flat body's marks only as many as their numbers do not cover each other.
std::vector<double> sparse_ticks(double low, double high, double per_metre, double apart) {
  std::vector<double> values = ticks(low, high);
  if (values.size() < 2)
    return values;
  const double step = values[1] - values[0];
  const auto every = std::max(1L, static_cast<long>(std::ceil(apart / (step * per_metre))));
  std::erase_if(values, [&](double value) { return std::lround(value / step) % every != 0; });
  return values;
}

/// Marks of an axis with their numbers.
std::vector<std::pair<double, std::string>> marks_of(const View &view, int direction) {
  const double low = view.low[direction], high = view.high[direction];
  const int power = shown_power(std::max(std::abs(low), std::abs(high)));
  std::vector<std::pair<double, std::string>> marks;
  for (const double value :
       sparse_ticks(low, high, points_per_metre(view), direction == 0 ? 18 : 8))
    marks.emplace_back(value, number_text(value / std::pow(10, power), 4));
  return marks;
}

/// From the ordinate to the foot of its label, which stands left of the numbers.
double label_distance(const View &view, Canvas &canvas) {
  double widest = 0;
  for (const auto &[value, text] : marks_of(view, 1))
    widest = std::max(widest, canvas.text_width(text, number_size));
  return std::max(29., 10 + widest + 3);
}

/// What the ordinate needs beyond the margin [pt].
double room_for_numbers(const Result &result, FigureFormat format, const View &view) {
  if (result.dimension == 3)
    return 0;
  Canvas scratch(format, 1, 1);
  const double left = left_margin + (body_size - view.width() * points_per_metre(view)) / 2;
  return std::max(0., label_distance(view, scratch) + label_size + 1 - left);
}

}  // namespace

Figure::Figure(const Result &result, FigureFormat format, double scale, double below)
    : result_(result),
      scale_(scale),
      view_(view_of(result, scale)),
      shift_(room_for_numbers(result, format, view_)),
      left_(left_margin + shift_ + (body_size - view_.width() * points_per_metre(view_)) / 2),
      top_(top_margin),
      width_(view_.width() * points_per_metre(view_)),
      height_(view_.height() * points_per_metre(view_)),
      per_metre_(points_per_metre(view_)),
      canvas_(format, left_margin + shift_ + body_size + right_margin,
              top_margin + view_.height() * points_per_metre(view_) + axis_room + below) {
  if (result.dimension == 2)
    axes();
  else
    solid_axes_cross();
}

Canvas::Point Figure::on_paper(std::uint32_t node) const {
  const auto &place = view_.places[node];
  return {left_ + (place[0] - view_.low[0]) * per_metre_,
          top_ + (view_.high[1] - place[1]) * per_metre_};
}

Canvas::Point Figure::on_paper(const Vector3 &place) const {
  const auto at = seen(result_.dimension, place);
  return {left_ + (at[0] - view_.low[0]) * per_metre_, top_ + (view_.high[1] - at[1]) * per_metre_};
}

void Figure::title(const std::string &text) {
  canvas_.text(text, {left_margin, 15}, Canvas::Align::left, 9.5, true);
}

void Figure::say_scale() {
  canvas_.text(scale_ == 0 ? "not deformed" : "displacement × " + number_text(scale_, 1),
               {left_margin + body_size, top_ + height_ + (result_.dimension == 2 ? 26 : 30)},
               Canvas::Align::right, 7);
}

void Figure::say_origin(const std::string &text) {
  canvas_.text(text, {left_margin - 20, top_ + height_ + (result_.dimension == 2 ? 26 : 30)},
               Canvas::Align::left, 7);
}

void Figure::axes() {
  axis(0, "x");
  axis(1, "y");
}

// Coordinates are those of the undeformed body.
void Figure::axis(int direction, const char *label) {
  const double low = view_.low[direction], high = view_.high[direction];
  const int power = shown_power(std::max(std::abs(low), std::abs(high)));
  const double foot = top_ + height_ + 5, side = left_ - 5;
  std::vector<std::vector<Canvas::Point>> marks;
  for (const auto &[value, text] : marks_of(view_, direction)) {
    const double at = (value - low) * per_metre_;
    if (direction == 0) {
      marks.push_back({{left_ + at, foot}, {left_ + at, foot + 3}});
      canvas_.text(text, {left_ + at, foot + 11}, Canvas::Align::middle, number_size);
    } else {
      const double y = top_ + height_ - at;
      marks.push_back({{side, y}, {side - 3, y}});
      canvas_.text(text, {side - 5, y + 2.5}, Canvas::Align::right, number_size);
    }
  }
  if (direction == 0)
    marks.push_back({{left_, foot}, {left_ + width_, foot}});
  else
    marks.push_back({{side, top_}, {side, top_ + height_}});
  canvas_.lines(marks, grey, 0.5);
  const std::string name = std::string(label) + " [" + unit_text(power, "m") + "]";
  if (direction == 0)
    canvas_.text(name, {left_ + width_ / 2, foot + 21}, Canvas::Align::middle, label_size);
  else
    canvas_.text(name, {left_ - label_distance(view_, canvas_), top_ + height_ / 2},
                 Canvas::Align::middle, label_size, false, true);
}

void Figure::solid_axes_cross() {
  const Canvas::Point origin{22, top_ + height_ + 14};
  const char *const names[] = {"x", "y", "z"};
  const auto axes = report::solid_axes();
  for (int i = 0; i < 3; ++i) {
    const Canvas::Point end{origin[0] + 16 * axes[i][0], origin[1] - 16 * axes[i][1]};
    canvas_.lines({{origin, end}}, ink, 0.8);
    canvas_.text(names[i], {origin[0] + 22 * axes[i][0], origin[1] - 22 * axes[i][1] + 2.5},
                 Canvas::Align::middle, 7);
  }
  canvas_.text("largest extent " + number_text(size_of(result_), 3) + " m",
               {left_margin + body_size, top_ + height_ + 20}, Canvas::Align::right, 7);
}

namespace {

Colour shaded(const Colour &colour, double light) {
  return {static_cast<std::uint8_t>(colour[0] * light),
          static_cast<std::uint8_t>(colour[1] * light),
          static_cast<std::uint8_t>(colour[2] * light)};
}

}  // namespace

Raster Figure::bare_surface() const {
  Raster raster(view_, per_metre_ * raster_pixels);
  for (std::size_t i = 0; i < result_.skin.triangles.size(); ++i) {
    const auto &t = result_.skin.triangles[i];
    raster.triangle(view_.places[t[0]], view_.places[t[1]], view_.places[t[2]],
                    [&](double, double, double) { return shaded(body_colour, view_.light[i]); });
  }
  return raster;
}

void Figure::put(const Raster &raster) {
  canvas_.picture(raster, {left_, top_}, raster.width() / raster_pixels);
}

void Figure::field(const Field &field, std::size_t component) {
  const std::vector<float> &all = field.values[component];
  const std::size_t first =
      all.size() - (field.on_points ? result_.skin.nodes : result_.skin.cells).size();
  const ShownRange shown = shown_range(result_, field, component);
  if (!shown.instead.empty()) {
    put(bare_surface());
    return say_instead_of_bar(shown.instead);
  }
  const ColourRange range = colour_range(shown.low, shown.high);
  Raster raster(view_, per_metre_ * raster_pixels);
  for (std::size_t i = 0; i < result_.skin.triangles.size(); ++i) {
    const auto &t = result_.skin.triangles[i];
    const auto value = [&](int corner) {
      return all[first + (field.on_points ? t[corner] : result_.skin.triangle_cells[i])];
    };
    raster.triangle(
        view_.places[t[0]], view_.places[t[1]], view_.places[t[2]],
        [&, v = std::array<double, 3>{value(0), value(1), value(2)}](double a, double b, double c) {
          return colour_of(a * v[0] + b * v[1] + c * v[2], range);
        });
  }
  // Colours are those of the bar, without a light; edges show the shape.
  if (result_.dimension == 3)
    for (const auto &edge : feature_edges(result_))
      raster.line(view_.places[edge[0]], view_.places[edge[1]], 0.004 * size_of(result_));
  put(raster);
  colour_bar(range, field.unit, shown);
}

namespace {

using Path = std::vector<std::uint32_t>;

/// Lines from node to node as few long paths, which makes files half as large.
std::vector<Path> chained(const std::vector<std::array<std::uint32_t, 2>> &edges,
                          std::size_t n_nodes) {
  std::vector<std::vector<std::uint32_t>> left(n_nodes);  // ends of the lines not drawn yet
  for (const auto &[a, b] : edges) {
    left[a].push_back(b);
    left[b].push_back(a);
  }
  std::vector<Path> paths;
  for (std::uint32_t start = 0; start < n_nodes; ++start)
    while (!left[start].empty()) {
      Path path{start};
      for (std::uint32_t at = start; !left[at].empty();) {
        const std::uint32_t next = left[at].back();
        left[at].pop_back();
        left[next].erase(std::find(left[next].begin(), left[next].end(), at));
        path.push_back(at = next);
      }
      paths.push_back(std::move(path));
    }
  return paths;
}

}  // namespace

void Figure::mesh() {
  Raster raster = bare_surface();
  if (result_.dimension == 3)
    for (const auto &edge : result_.skin.edges)
      raster.line(view_.places[edge[0]], view_.places[edge[1]], 0.004 * size_of(result_));
  put(raster);
  if (result_.dimension == 3)
    return;
  std::vector<std::vector<Canvas::Point>> lines;
  for (const Path &path : chained(result_.skin.edges, result_.points.size())) {
    lines.emplace_back();
    for (const std::uint32_t node : path)
      lines.back().push_back(on_paper(node));
  }
  canvas_.lines(lines, ink, 0.18);
}

void Figure::outline() {
  if (result_.dimension == 3)
    return;
  std::vector<std::vector<Canvas::Point>> sides;
  for (const Boundary &boundary : result_.boundaries)
    for (const auto &facet : boundary.facets) {
      sides.emplace_back();
      for (const std::uint32_t node : facet)
        sides.back().push_back(on_paper(node));
    }
  canvas_.lines(sides, ink, 0.5);
}

void Figure::setting() {
  // What has no name stays as it is.
  Raster raster = bare_surface();
  if (result_.dimension == 2)
    put(raster);
  // A facet may be in several groups; the first one, the contact, is painted last.
  std::vector<SettingGroup> groups = groups_of(result_);
  std::reverse(groups.begin(), groups.end());
  for (const SettingGroup &group : groups)
    for (const Boundary *boundary : group.boundaries)
      if (result_.dimension == 2)
        paint_sides(*boundary, group.colour);
      else
        paint_faces(raster, *boundary, group.colour);
  if (result_.dimension == 3)
    put(raster);
  poling();
  legend();
}

void Figure::poling() {
  for (const PolingArrow &one : poling_arrows(result_))
    arrow(on_paper(one.tail), on_paper(one.tip));
}

/// With a light rim, as it may lie on any colour.
void Figure::arrow(const Canvas::Point &tail, const Canvas::Point &tip) {
  const double length = std::max(std::hypot(tip[0] - tail[0], tip[1] - tail[1]), 1e-9);
  const double x = (tip[0] - tail[0]) / length, y = (tip[1] - tail[1]) / length;
  const double head = std::min(4.5, 0.55 * length);
  const auto beside = [&](double side) {
    return Canvas::Point{tip[0] - head * (x - 0.42 * side * y),
                         tip[1] - head * (y + 0.42 * side * x)};
  };
  const std::vector<Canvas::Point> shaft{tail, beside(0)}, point{tip, beside(1), beside(-1), tip};
  canvas_.lines({shaft, point}, {255, 255, 255}, 2);
  canvas_.lines({shaft}, ink, 0.8);
  canvas_.area(point, ink);
}

void Figure::paint_sides(const Boundary &boundary, const Colour &colour) {
  std::vector<std::vector<Canvas::Point>> sides;
  for (const auto &facet : boundary.facets) {
    sides.emplace_back();
    for (const std::uint32_t node : facet)
      sides.back().push_back(on_paper(node));
  }
  canvas_.lines(sides, colour, 3);
}

void Figure::paint_faces(Raster &raster, const Boundary &boundary, const Colour &colour) const {
  const double slack = 1e-6 * size_of(result_);  // over what was painted there before
  for (const auto &facet : boundary.facets)
    for (std::size_t i = 2; i < facet.size(); ++i)
      raster.triangle(
          view_.places[facet[0]], view_.places[facet[i - 1]], view_.places[facet[i]],
          [&](double, double, double) { return colour; }, slack);
}

namespace {

/// value / 10^power to three digits of `size`: beside 1.24 the end of a bar is 0, not 9.6e-5.
double rounded(double value, double size, int power) {
  const double step = size > 0 ? std::pow(10, std::floor(std::log10(size)) - 2) : 1;
  return std::round(value / step) * step / std::pow(10, power);
}

}  // namespace

void Figure::say_instead_of_bar(const std::string &text) {
  canvas_.text(text, {left_margin, top_ + height_ + axis_room + 10}, Canvas::Align::left, 7.5);
}

void Figure::colour_bar(const ColourRange &range, const std::string &unit,
                        const ShownRange &shown) {
  const double top = top_ + height_ + axis_room, width = body_size - 40;
  const double size = std::max(std::abs(range.low), std::abs(range.high));
  const int power = shown_power(size);
  canvas_.colour_strip(range.diverging ? blue_red() : viridis(), {left_margin, top}, width, 7);
  for (int i = 0; i <= 4; ++i) {
    const double at = i / 4., value = range.low + at * (range.high - range.low);
    canvas_.lines({{{left_margin + at * width, top + 7}, {left_margin + at * width, top + 10}}},
                  grey, 0.5);
    const char *beyond = i == 4 && shown.cut_above ? "≥ " : i == 0 && shown.cut_below ? "≤ " : "";
    canvas_.text(beyond + number_text(rounded(value, size, power), 3),
                 {left_margin + at * width, top + 18}, Canvas::Align::middle, 7);
  }
  canvas_.text(unit_text(power, unit), {left_margin + width + 8, top + 6.5}, Canvas::Align::left,
               7.5);
}

}  // namespace tourmaline::report
