#include "sweep/results.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace tourmaline::sweep {

namespace {

// RFC 4180
std::string cell(const std::string &text) {
  if (text.find_first_of(",\"\n") == std::string::npos)
    return text;
  std::string quoted = "\"";
  for (const char c : text)
    quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

std::string cell(double number) {
  return std::isnan(number) ? "nan" : fmt::format("{:.17g}", number == 0 ? 0 : number);
}

// Numbers where all values are, otherwise 0, 1, ... with the values as words.
void put_abscissae(const Variation &variation, report::Plot &plot) {
  for (const std::string &value : variation.values)
    if (const std::optional<double> number = number_in(value))
      plot.abscissae.push_back(*number);
  if (plot.abscissae.size() == variation.values.size())
    return;
  plot.words = variation.values;
  plot.abscissae.clear();
  for (std::size_t i = 0; i < plot.words.size(); ++i)
    plot.abscissae.push_back(static_cast<double>(i));
}

// Lines are joined from left to right, in whatever order the values were given.
std::vector<std::size_t> order_of(const std::vector<double> &abscissae) {
  std::vector<std::size_t> order(abscissae.size());
  for (std::size_t i = 0; i < order.size(); ++i)
    order[i] = i;
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return abscissae[a] < abscissae[b]; });
  return order;
}

std::string line_name(const Results &results, const Member &member) {
  std::string name;
  for (std::size_t i = 1; i < results.variations.size(); ++i)
    name += (i == 1 ? "" : ", ") + results.variations[i].key + " = " + member.values[i];
  return name;
}

}  // namespace

std::string table_text(const Results &results) {
  std::string text = "member";
  for (const Variation &variation : results.variations)
    text += "," + cell(variation.key);
  text += ",status";
  for (const Output &output : results.outputs)
    text += "," + cell(output.name);
  for (std::size_t i = 0; i < results.members.size(); ++i) {
    text += "\n" + cell(results.members[i].name);
    for (const std::string &value : results.members[i].values)
      text += "," + cell(value);
    text += "," + results.rows[i].status;
    for (const double value : results.rows[i].values)
      text += "," + cell(value);
  }
  return text + "\n";
}

report::Plot plot_of(const Results &results) {
  const Variation &first = results.variations.front();
  report::Plot plot{.abscissa_name = first.key,
                    .abscissa_unit = results.key_unit,
                    .abscissae = {},
                    .logarithmic = first.logarithmic,
                    .line_names = {},
                    .panels = {}};
  put_abscissae(first, plot);
  // The first variation turns slowest: the members of a line lie n_lines apart.
  const std::size_t n_lines = results.members.size() / first.values.size();
  for (std::size_t line = 0; line < n_lines; ++line)
    plot.line_names.push_back(line_name(results, results.members[line]));
  const std::vector<std::size_t> order = order_of(plot.abscissae);
  for (std::size_t output = 0; output < results.outputs.size(); ++output) {
    report::Plot::Panel panel{results.outputs[output].name, results.outputs[output].unit, {}};
    for (std::size_t line = 0; line < n_lines; ++line) {
      panel.lines.emplace_back();
      for (const std::size_t i : order)
        panel.lines.back().push_back(results.rows[i * n_lines + line].values[output]);
    }
    plot.panels.push_back(panel);
  }
  std::sort(plot.abscissae.begin(), plot.abscissae.end());
  return plot;
}

}  // namespace tourmaline::sweep
