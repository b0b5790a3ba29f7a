#include "report/contact_curves.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <string_view>

#include "output/records.h"
#include "report/moment.h"
#include "report/number_text.h"
#include "report/plot.h"
#include "tourmaline/error.h"

namespace tourmaline::report {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view prefix = "contact.";

struct Quantity {
  const char *title, *unit;
};

/// What stands above a curve; of vectors without the component.
const std::map<std::string, Quantity> &quantities() {
  static const std::map<std::string, Quantity> all{
      {"status", {"Status of the contact", ""}},
      {"pressure", {"Contact pressure", "N/m²"}},
      {"gap", {"Opening of the contact", "m"}},
      {"normal_traction", {"Normal traction", "N/m²"}},
      {"tangential_traction", {"Tangential traction", "N/m²"}},
      {"friction_bound", {"Friction bound", "N/m²"}},
      {"normal_displacement", {"Normal displacement", "m"}},
      {"slip", {"Slip", "m"}},
      {"slip_rate", {"Slip rate", "m/s"}},
      {"accumulated_slip", {"Accumulated slip", "m"}},
      {"temperature", {"Temperature", "K"}},
      {"potential", {"Electric potential", "V"}},
      {"heat_flux", {"Heat flux", "W/m²"}},
      {"charge_flux", {"Normal electric displacement", "C/m²"}}};
  return all;
}

/// "slip_x" to "Slip x", and its unit.
std::pair<std::string, std::string> title_and_unit(const std::string &column) {
  const auto whole = quantities().find(column);
  if (whole != quantities().end())
    return {whole->second.title, whole->second.unit};
  const std::size_t end = column.rfind('_');
  const auto vector = quantities().find(column.substr(0, end));
  if (vector != quantities().end())
    return {vector->second.title + (" " + column.substr(end + 1)), vector->second.unit};
  return {column, ""};
}

/// The numbers at every row of contact.csv; empty where there is no such curve.
std::vector<double> values_of(const Result &result, const std::string &column) {
  static const std::vector<std::string> no_curves{"step", "time", "x", "y", "z", "contact"};
  if (!result.contact || std::find(no_curves.begin(), no_curves.end(), column) != no_curves.end())
    return {};
  if (column == "friction_bound")
    return result.friction_bound;
  const bool is_pressure = column == "pressure";
  const std::vector<double> *found = result.contact->find(is_pressure ? "normal_traction" : column);
  if (!found)
    return {};
  std::vector<double> values = *found;
  if (is_pressure)
    std::transform(values.begin(), values.end(), values.begin(), std::negate());
  return values;
}

std::vector<std::string> columns_of(const Result &result) {
  std::vector<std::string> columns{"pressure"};
  if (result.contact)
    columns.insert(columns.end(), result.contact->names.begin(), result.contact->names.end());
  if (std::find(columns.begin(), columns.end(), "friction_bound") == columns.end())
    columns.emplace_back("friction_bound");
  std::erase_if(columns,
                [&](const std::string &column) { return values_of(result, column).empty(); });
  return columns;
}

/// The first row of the step whose end is nearest.
std::size_t first_row(const std::vector<double> &times, std::optional<double> time) {
  if (time)
    require_moment(*time, times.back());
  const double wanted = time.value_or(times.back());
  const auto nearest = std::min_element(times.begin(), times.end(), [&](double a, double b) {
    return std::abs(a - wanted) < std::abs(b - wanted);
  });
  return static_cast<std::size_t>(nearest - times.begin());
}

/// "length along the contact [m]" to name and unit
std::pair<std::string, std::string> name_and_unit(const std::string &abscissa) {
  const std::size_t at = abscissa.rfind(" [");
  return {abscissa.substr(0, at), abscissa.substr(at + 2, abscissa.size() - at - 3)};
}

// What a status is called, by its number in the table.
std::vector<std::pair<double, std::string>> words_of(const std::string &column) {
  std::vector<std::pair<double, std::string>> words;
  if (column == "status")
    for (const auto status : {ContactStatus::open, ContactStatus::stick, ContactStatus::slip})
      words.emplace_back(static_cast<double>(status), name_of(status));
  return words;
}

Plot plot_of(const ContactPiece &piece, const std::vector<double> &values, std::size_t first,
             const std::string &title, const std::string &unit) {
  Plot plot;
  std::tie(plot.abscissa_name, plot.abscissa_unit) = name_and_unit(piece.abscissa);
  plot.abscissae = piece.along;
  Plot::Panel panel{title, unit, {{}}};
  for (const std::uint32_t row : piece.rows)
    panel.lines.front().push_back(values.at(first + row));
  plot.panels.push_back(std::move(panel));
  return plot;
}

void require_curves(const Result &result, const std::string &name) {
  if (!result.contact || result.contact->n_rows() == 0)
    throw CaseError(fmt::format("\"{}\" is not there: the results hold no contact", name));
  if (result.dimension == 3)
    throw CaseError(
        fmt::format("\"{}\" is a curve along the contact, which only a plane body has; of a solid "
                    "body contact.pvd (ParaView) and report.html show it",
                    name));
  if (result.contact_pieces.empty())
    throw CaseError(
        fmt::format("\"{}\" cannot be drawn: the folder does not tell the facets of the contact "
                    "(boundaries.json, resolved.toml)",
                    name));
}

}  // namespace

bool is_contact_curve(const std::string &name) {
  return name.starts_with(prefix);
}

std::string contact_curve_names(const Result &result) {
  std::string list;
  if (result.contact_pieces.empty())
    return list;
  for (const std::string &column : columns_of(result))
    list += (list.empty() ? "" : ", ") + (std::string(prefix) + column);
  return list;
}

std::vector<fs::path> write_contact_curves(const Result &result, const std::string &name,
                                           std::optional<double> time, const fs::path &directory,
                                           FigureFormat format) {
  require_curves(result, name);
  const std::string column = name.substr(prefix.size());
  const std::vector<double> values = values_of(result, column);
  const std::vector<double> *times = result.contact->find("time");
  if (values.empty() || !times)
    throw CaseError(fmt::format("there is no curve \"{}\" along the contact; there are {}", name,
                                contact_curve_names(result)));
  const std::size_t first = first_row(*times, time);
  const auto [title, unit] = title_and_unit(column);
  const bool several = result.contact_pieces.size() > 1;
  std::vector<fs::path> files;
  for (const ContactPiece &piece : result.contact_pieces) {
    const std::string moment = ", t = " + number_text((*times)[first], 4) + " s";
    const std::string number = several ? fmt::format("_{}", files.size() + 1) : "";
    files.push_back(directory / fmt::format("contact_{}{}.{}", column, number, name_of(format)));
    Plot plot = plot_of(piece, values, first, title + moment, unit);
    plot.panels.front().words = words_of(column);
    if (several)
      plot.abscissa_name += " on " + piece.name;
    write_plot(plot, format, files.back());
  }
  return files;
}

}  // namespace tourmaline::report
