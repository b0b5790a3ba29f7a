#include "report/plot.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>

#include "report/number_text.h"
#include "report/ticks.h"

namespace tourmaline::report {
namespace {

// All lengths in points.
constexpr double frame_width = 210, frame_height = 140, panel_left = 46, panel_right = 14,
                 panel_top = 24, panel_axes = 34, legend_line = 12, edge = 8;
constexpr double panel_width = panel_left + frame_width + panel_right,
                 panel_height = panel_top + frame_height + panel_axes;

constexpr Colour axis_grey{120, 126, 134}, light{226, 229, 233};

/// Okabe and Ito's, which people with any colour vision tell apart; of many lines viridis.
Colour line_colour(std::size_t line, std::size_t n) {
  static const std::array<Colour, 7> few{{{0, 114, 178},
                                          {213, 94, 0},
                                          {0, 158, 115},
                                          {204, 121, 167},
                                          {230, 159, 0},
                                          {86, 180, 233},
                                          {60, 60, 60}}};
  return n <= few.size() ? few[line] : viridis()[line * (viridis().size() - 1) / (n - 1)];
}

// As many as tell neighbouring ticks apart.
int digits_of(double size, double step) {
  return std::clamp(static_cast<int>(std::ceil(std::log10(size / step))) + 1, 2, 12);
}

/// What a frame shows along one side, with room at both ends.
class Axis {
 public:
  Axis(const std::vector<double> &values, bool logarithmic) : logarithmic_(logarithmic) {
    for (const double value : values)
      if (std::isfinite(value)) {
        low_ = std::min(low_, scaled(value));
        high_ = std::max(high_, scaled(value));
      }
    widen();
  }

  /// Where the value stands, from 0 to 1.
  double part(double value) const { return (scaled(value) - low_) / (high_ - low_); }

  std::vector<double> ticks() const {
    // The room at the ends may reach where no numbers are.
    return logarithmic_ ? logarithmic_ticks(std::pow(10, std::max(low_, -307.)),
                                            std::pow(10, std::min(high_, 308.)))
                        : report::ticks(low_, high_);
  }
  /// The power of ten by which the ticks' numbers are shown.
  int power() const { return logarithmic_ ? 0 : shown_power(size()); }
  int digits() const {
    const std::vector<double> marks = ticks();
    return logarithmic_ || marks.size() < 2 ? 4 : digits_of(size(), marks[1] - marks[0]);
  }

 private:
  double scaled(double value) const { return logarithmic_ ? std::log10(value) : value; }
  double size() const { return std::max(std::abs(low_), std::abs(high_)); }

  // One value gets room around it; of none 0 to 1 is shown.
  void widen() {
    if (!(low_ <= high_)) {
      low_ = 0;
      high_ = 1;
    }
    double room = 0.06 * (high_ - low_);
    if (room <= 1e-12 * size())
      room = size() > 0 ? 0.1 * size() : 1;
    low_ -= room;
    high_ += room;
  }

  bool logarithmic_;
  double low_ = std::numeric_limits<double>::infinity(),
         high_ = -std::numeric_limits<double>::infinity();
};

/// All values of a panel.
std::vector<double> values_in(const Plot::Panel &panel) {
  std::vector<double> all;
  for (const auto &line : panel.lines)
    std::copy_if(line.begin(), line.end(), std::back_inserter(all),
                 [](double value) { return std::isfinite(value); });
  return all;
}

// Powers of the abscissa are seen as straight lines.
bool spans_decades(const std::vector<double> &values) {
  if (values.empty())
    return false;
  const auto [least, greatest] = std::minmax_element(values.begin(), values.end());
  return *least > 0 && *greatest / *least > 30;
}

class Drawing {
 public:
  Drawing(const Plot &plot, FigureFormat format)
      : plot_(plot),
        columns_(std::min<std::size_t>(plot.panels.size(), 2)),
        rows_((plot.panels.size() + 1) / 2),
        legend_rows_(plot.line_names.size() > 1 ? legend_places().second : 0),
        canvas_(format, panel_width * static_cast<double>(columns_),
                panel_height * static_cast<double>(rows_) + edge +
                    legend_line * static_cast<double>(legend_rows_)),
        x_(plot.abscissae, plot.logarithmic) {}

  void draw() {
    for (std::size_t i = 0; i < plot_.panels.size(); ++i) {
      const std::size_t row = i / 2;
      panel(plot_.panels[i], {panel_left + panel_width * static_cast<double>(i % 2),
                              panel_top + panel_height * static_cast<double>(row)});
    }
    if (legend_rows_ > 0)
      legend();
  }

  void write(const std::filesystem::path &path) { canvas_.write(path); }

 private:
  using Point = Canvas::Point;

  double x_at(const Point &corner, double abscissa) const {
    return corner[0] + frame_width * x_.part(abscissa);
  }
  static double y_at(const Point &corner, const Axis &y, double value) {
    return corner[1] + frame_height * (1 - y.part(value));
  }

  void panel(const Plot::Panel &panel, const Point &corner) {
    std::vector<double> values = values_in(panel);
    for (const auto &word : panel.words)
      values.push_back(word.first);
    // Counts, which have no unit, are not seen by their ratio.
    const Axis y(values, plot_.logarithmic && !panel.unit.empty() && spans_decades(values));
    ordinate(panel, corner, y);
    abscissa(corner);
    for (std::size_t i = 0; i < panel.lines.size(); ++i)
      line(panel.lines[i], corner, y, line_colour(i, panel.lines.size()));
  }

  void ordinate(const Plot::Panel &panel, const Point &corner, const Axis &y) {
    std::vector<std::vector<Point>> across;
    for (const auto &[value, text] : ordinate_ticks(panel, y)) {
      const double at = y_at(corner, y, value);
      across.push_back({{corner[0], at}, {corner[0] + frame_width, at}});
      canvas_.text(text, {corner[0] - 4, at + 2.5}, Canvas::Align::right, 7);
    }
    canvas_.lines(across, light, 0.5);
    const std::string unit = panel.words.empty() ? unit_text(y.power(), panel.unit) : "";
    canvas_.text(panel.name + (unit.empty() ? "" : " [" + unit + "]"), {corner[0], corner[1] - 7},
                 Canvas::Align::left, 8.5, true);
  }

  static std::vector<std::pair<double, std::string>> ordinate_ticks(const Plot::Panel &panel,
                                                                    const Axis &y) {
    std::vector<std::pair<double, std::string>> marks = panel.words;
    const double power = std::pow(10, y.power());
    for (const double value : marks.empty() ? y.ticks() : std::vector<double>())
      marks.emplace_back(value, number_text(value / power, y.digits()));
    return marks;
  }

  std::vector<std::pair<double, std::string>> abscissa_ticks() const {
    std::vector<std::pair<double, std::string>> marks;
    for (std::size_t i = 0; i < plot_.words.size(); ++i)
      marks.emplace_back(plot_.abscissae[i], plot_.words[i]);
    if (!marks.empty())
      return marks;
    for (const double value : x_.ticks())
      marks.emplace_back(value, number_text(value, 6));
    return marks;
  }

  void abscissa(const Point &corner) {
    const double foot = corner[1] + frame_height;
    std::vector<std::vector<Point>> frame{
        {{corner[0], corner[1]}, {corner[0], foot}, {corner[0] + frame_width, foot}}};
    for (const auto &[value, text] : abscissa_ticks()) {
      const double at = x_at(corner, value);
      frame.push_back({{at, foot}, {at, foot + 3}});
      canvas_.text(text, {at, foot + 11}, Canvas::Align::middle, 7);
    }
    canvas_.lines(frame, axis_grey, 0.6);
    const std::string unit = plot_.abscissa_unit.empty() ? "" : " [" + plot_.abscissa_unit + "]";
    canvas_.text(plot_.abscissa_name + unit, {corner[0] + frame_width / 2, foot + 22},
                 Canvas::Align::middle, 7.5);
  }

  void line(const std::vector<double> &values, const Point &corner, const Axis &y,
            const Colour &colour) {
    std::vector<std::vector<Point>> pieces(1);
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (!std::isfinite(values[i])) {
        pieces.emplace_back();
        continue;
      }
      pieces.back().push_back({x_at(corner, plot_.abscissae[i]), y_at(corner, y, values[i])});
      mark(pieces.back().back(), colour);
    }
    canvas_.lines(pieces, colour, 1.1);
  }

  void mark(const Point &at, const Colour &colour) {
    constexpr int corners = 12;
    std::vector<Point> circle;
    for (int i = 0; i < corners; ++i) {
      const double angle = 2 * std::numbers::pi * i / corners;
      circle.push_back({at[0] + 1.8 * std::cos(angle), at[1] + 1.8 * std::sin(angle)});
    }
    canvas_.area(circle, colour);
  }

  // Width of a legend's entry, by the longest name, and how many rows they fill.
  std::pair<double, std::size_t> legend_places() const {
    std::size_t longest = 0;
    for (const std::string &name : plot_.line_names)
      longest = std::max(longest, name.size());
    const double width = 30 + 4.2 * static_cast<double>(longest);
    const double room = panel_width * static_cast<double>(columns_) - panel_left;
    const auto each = std::max<std::size_t>(1, static_cast<std::size_t>(room / width));
    return {width, (plot_.line_names.size() + each - 1) / each};
  }

  void legend() {
    const double width = legend_places().first;
    const std::size_t n = plot_.line_names.size(), each = (n + legend_rows_ - 1) / legend_rows_;
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t row = i / each;
      const Point at{panel_left + width * static_cast<double>(i % each),
                     panel_height * static_cast<double>(rows_) +
                         legend_line * (static_cast<double>(row) + 0.5)};
      canvas_.lines({{at, {at[0] + 14, at[1]}}}, line_colour(i, n), 1.1);
      mark({at[0] + 7, at[1]}, line_colour(i, n));
      canvas_.text(plot_.line_names[i], {at[0] + 19, at[1] + 2.5}, Canvas::Align::left, 7.5);
    }
  }

  const Plot &plot_;
  std::size_t columns_, rows_, legend_rows_;
  Canvas canvas_;
  Axis x_;
};

}  // namespace

void write_plot(const Plot &plot, FigureFormat format, const std::filesystem::path &path) {
  Drawing drawing(plot, format);
  drawing.draw();
  drawing.write(path);
}

}  // namespace tourmaline::report
