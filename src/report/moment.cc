#include "report/moment.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "report/text_file.h"
#include "report/xml.h"
#include "tourmaline/error.h"

namespace tourmaline::report {

namespace fs = std::filesystem;

void require_moment(double asked, double last) {
  constexpr double rounding = 1e-9;
  if (!(asked >= -rounding * last && asked <= (1 + rounding) * last))
    throw CaseError(
        fmt::format("--time {}: is not in the results, which go from t = 0 to {} s", asked, last));
}

namespace {

double time_of(const std::string &text, const fs::path &path) {
  double time = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), time);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(time))
    throw CaseError(fmt::format("{}: the time \"{}\" is no number", path.string(), text));
  return time;
}

}  // namespace

std::vector<RecordedMoment> recorded_moments(const fs::path &folder, const char *list) {
  std::vector<RecordedMoment> series;
  const fs::path path = folder / list;
  if (!fs::exists(path))
    return series;
  const std::string text = read_text_file(path);
  for_each_element(text, path.string(), [&](const XmlElement &e) {
    if (e.name == "DataSet")
      series.push_back({time_of(e.attribute("timestep"), path), folder / e.attribute("file")});
  });
  return series;
}

}  // namespace tourmaline::report
