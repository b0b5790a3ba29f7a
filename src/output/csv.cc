#include "output/csv.h"

#include <fmt/compile.h>
#include <fmt/format.h>

#include <cmath>
#include <concepts>
#include <initializer_list>
#include <iterator>
#include <stdexcept>
#include <string_view>

namespace tourmaline::output {
namespace {

/// Appends one line, cell by cell.
class Line {
 public:
  explicit Line(std::string &text) : text_(text) {}

  Line &operator<<(std::string_view name) {
    separate();
    text_ += name;
    return *this;
  }
  Line &operator<<(double number) {
    // The sign of a NaN, and of a zero, is an accident of how it was computed.
    if (std::isnan(number))
      return *this << std::string_view("nan");
    separate();
    fmt::format_to(std::back_inserter(text_), FMT_COMPILE("{:.17g}"), number == 0 ? 0 : number);
    return *this;
  }
  template <std::integral Integer>
  Line &operator<<(Integer number) {
    separate();
    fmt::format_to(std::back_inserter(text_), FMT_COMPILE("{}"), number);
    return *this;
  }
  /// The first `dimension` components.
  Line &put(int dimension, const Vector3 &vector) {
    for (int i = 0; i < dimension; ++i)
      *this << vector[i];
    return *this;
  }
  /// x, y[, z] behind a prefix.
  Line &put_names(int dimension, std::string_view prefix) {
    constexpr std::string_view axes[] = {"x", "y", "z"};
    for (int i = 0; i < dimension; ++i)
      *this << fmt::format("{}{}", prefix, axes[i]);
    return *this;
  }
  void end() { text_ += '\n'; }

 private:
  void separate() {
    if (!first_)
      text_ += ',';
    first_ = false;
  }

  std::string &text_;
  bool first_ = true;
};

void check_sizes(const std::vector<Vector3> &points, const PointFields &fields) {
  for (const std::size_t size :
       {fields.displacement.size(), fields.potential.size(), fields.temperature.size()})
    if (size != points.size())
      throw std::invalid_argument(
          fmt::format("nodes.csv: {} values for {} points", size, points.size()));
}

}  // namespace

std::string nodes_header(int dimension) {
  std::string text;
  Line line(text);
  line.put_names(dimension, "").put_names(dimension, "u_") << "potential"
                                                           << "temperature";
  line.end();
  return text;
}

std::string nodes_lines(int dimension, const std::vector<Vector3> &points,
                        const PointFields &fields, std::size_t first, std::size_t end) {
  check_sizes(points, fields);
  std::string text;
  for (std::size_t i = first; i < end; ++i) {
    Line line(text);
    line.put(dimension, points[i]).put(dimension, fields.displacement[i])
        << fields.potential[i] << fields.temperature[i];
    line.end();
  }
  return text;
}

std::string contact_header(int dimension, const ContactRow &row) {
  std::string text;
  Line line(text);
  line << "step"
       << "time";
  line.put_names(dimension, "") << "normal_traction";
  line.put_names(dimension, "tangential_traction_") << "normal_displacement";
  line.put_names(dimension, "slip_") << "slip_rate"
                                     << "status"
                                     << "temperature"
                                     << "potential"
                                     << "heat_flux"
                                     << "gap"
                                     << "charge_flux";
  for (const auto &[name, value] : row.quantities)
    line << name;
  if (!row.contact.empty())
    line << "contact";
  line.end();
  return text;
}

std::string contact_lines(int dimension, int step, double time, std::span<const ContactRow> rows) {
  std::string text;
  for (const ContactRow &row : rows) {
    Line line(text);
    line << step << time;
    line.put(dimension, row.point) << row.normal_traction;
    line.put(dimension, row.tangential_traction) << row.normal_displacement;
    line.put(dimension, row.slip) << row.slip_rate << name_of(row.status) << row.temperature
                                  << row.potential << row.heat_flux << row.gap << row.charge_flux;
    for (const auto &[name, value] : row.quantities)
      line << value;
    if (!row.contact.empty())
      line << row.contact;
    line.end();
  }
  return text;
}

std::string history_header(const HistoryRow &row) {
  std::string text;
  Line line(text);
  for (const char *name :
       {"step", "time", "newton_iterations", "residual", "stick", "slip", "open"})
    line << name;
  for (const auto &[name, value] : row.quantities)
    line << name;
  line.end();
  return text;
}

std::string history_line(const HistoryRow &row) {
  std::string text;
  Line line(text);
  line << row.step << row.time << row.newton_iterations << row.residual << row.stick << row.slip
       << row.open;
  for (const auto &[name, value] : row.quantities)
    line << value;
  line.end();
  return text;
}

std::string probe_header(const ProbeRows &probe) {
  std::string text;
  Line line(text);
  line << "step"
       << "time";
  for (const std::string &name : probe.columns)
    line << name;
  line.end();
  return text;
}

std::string probe_lines(int step, double time, const ProbeRows &probe) {
  std::string text;
  for (const std::vector<double> &row : probe.rows) {
    Line line(text);
    line << step << time;
    for (const double value : row)
      line << value;
    line.end();
  }
  return text;
}

}  // namespace tourmaline::output
