#include "sweep/read_outputs.h"

#include <algorithm>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#include "output/probe_rows.h"
#include "report/table.h"
#include "report/text_file.h"
#include "tourmaline/error.h"

namespace tourmaline::sweep {

namespace {

// by name, the coordinates of the extremes
std::map<std::string, double> places_in(const std::filesystem::path &file) {
  std::map<std::string, double> places;
  try {
    const auto summary = nlohmann::json::parse(report::read_text_file(file));
    for (const auto &extreme : summary.at("extremes"))
      for (const char *which : {"minimum", "maximum"}) {
        const auto &point = extreme.at(std::string("at_") + which);
        for (std::size_t c = 0; c < std::min<std::size_t>(point.size(), 3); ++c)
          places[std::string(of_place) + std::string(which).substr(0, 3) + "_" +
                 extreme.at("field").get<std::string>() + "_" + "xyz"[c]] = point[c].get<double>();
      }
  } catch (const nlohmann::json::exception &) {
    throw CaseError(file.string() + ": is no summary of a run");
  }
  return places;
}

/// A column and the time of each of its rows.
struct Series {
  const std::vector<double> *times = nullptr, *values = nullptr;
};

/// The tables of a run's folder, of its probes those that somebody asks for.
class Tables {
 public:
  explicit Tables(std::filesystem::path folder)
      : folder_(std::move(folder)), history_(report::read_table(folder_ / "history.csv")) {
    if (!history_.find("time"))
      throw CaseError((folder_ / "history.csv").string() + ": is no history of a run");
  }

  /// Nothing where the run has no such column.
  Series find(const std::string &name) {
    if (const std::vector<double> *column = history_.find(name))
      return {history_.find("time"), column};
    const auto dot = name.rfind('.');
    if (dot == std::string::npos)
      return {};
    const report::Table *probe = table_of(name.substr(0, dot));
    return probe ? Series{probe->find("time"), probe->find(name.substr(dot + 1))} : Series{};
  }

 private:
  const report::Table *table_of(const std::string &probe) {
    const std::filesystem::path file = folder_ / output::probe_file(probe);
    if (!probes_.contains(probe) && std::filesystem::exists(file))
      probes_[probe] = report::read_table(file);
    const auto found = probes_.find(probe);
    return found == probes_.end() ? nullptr : &found->second;
  }

  std::filesystem::path folder_;
  report::Table history_;
  std::map<std::string, report::Table> probes_;
};

}  // namespace

std::vector<double> read_outputs(const std::filesystem::path &folder,
                                 const std::vector<Output> &outputs) {
  Tables tables(folder);
  const std::map<std::string, double> places = places_in(folder / "summary.json");
  std::vector<double> values;
  for (const Output &output : outputs) {
    const Series series = tables.find(output.column.empty() ? output.name : output.column);
    const auto place = places.find(output.name);
    values.push_back(series.times && series.values
                         ? reduced(output.reduction, *series.times, *series.values)
                     : place != places.end() ? place->second
                                             : std::numeric_limits<double>::quiet_NaN());
  }
  return values;
}

}  // namespace tourmaline::sweep
