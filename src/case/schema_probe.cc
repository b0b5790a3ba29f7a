#include <fmt/format.h>

#include <algorithm>

#include "case/toml_text.h"
#include "schema_parts.h"
#include "sense.h"
#include "tourmaline/case/case.h"

namespace tourmaline::casefile {

namespace {

std::string name_complaint(const std::string &name, const std::vector<ProbeCase> &all) {
  const auto allowed = [](unsigned char c) {
    return c < 128 && (std::isalnum(c) || c == '_' || c == '-');
  };
  if (name.empty() || !std::all_of(name.begin(), name.end(), allowed))
    return "must consist of letters, digits, _ and -, as a file is named by it";
  const auto same = [&](const ProbeCase &other) { return other.name == name; };
  return std::count_if(all.begin(), all.end(), same) > 1 ? "another probe has this name already"
                                                         : "";
}

void declare(Visitor &v, ProbeCase &probe, const std::vector<ProbeCase> &all, int dimension) {
  v.place(probe.where);
  v.places(probe.places);
  v.key({.name = "name",
         .description = "its table is called probe-NAME.csv; letters, digits, _ and -",
         .required = true},
        &probe.name);
  v.check("name", [&] { return name_complaint(probe.name, all); });
  v.optional({.name = "at",
              .description = "a point of the body, at which fields are interpolated",
              .unit = "m",
              .range = any(sense::coordinate),
              .length = one_each_axis(dimension)},
             probe.at);
  v.optional({.name = "from",
              .description = "one end of a line of points, instead of `at`",
              .unit = "m",
              .range = any(sense::coordinate),
              .length = one_each_axis(dimension)},
             probe.from);
  v.optional({.name = "to",
              .description = "its other end",
              .unit = "m",
              .range = any(sense::coordinate),
              .length = one_each_axis(dimension)},
             probe.to);
  v.key({.name = "points",
         .description = "how many points the line has, its ends among them, all equally far apart",
         .range = from_to(2, 10000),
         .used = with("from", probe.is_line())},
        &probe.points);
  v.check("", [&]() -> std::string {
    if (probe.at.has_value() == probe.from.has_value())
      return "give either `at`, a point, or `from` and `to`, the ends of a line";
    if (probe.from.has_value() != probe.to.has_value())
      return "a line has two ends, `from` and `to`";
    if (probe.is_line() && probe.from == probe.to)
      return "`from` and `to` are one point; give it as `at`";
    return "";
  });
}

}  // namespace

void declare_probes(Visitor &v, std::vector<ProbeCase> &probes, int dimension) {
  const Key key = {.name = "probe",
                   .description =
                       "Displacement, potential and temperature at points of the body in every "
                       "step, in a table of their own"};
  v.entries(key, probes,
            [&](Visitor &inner, ProbeCase &probe) { declare(inner, probe, probes, dimension); });
}

}  // namespace tourmaline::casefile
