#include "run/recorded_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "body/fields.h"
#include "case/place_of_key.h"
#include "case/toml_text.h"
#include "report/field_file.h"
#include "report/recorded_mesh.h"
#include "tourmaline/case/reader.h"
#include "tourmaline/error.h"

namespace tourmaline::run {

namespace fs = std::filesystem;
using body::Fields;
using body::unknown;
using casefile::InitialCase;

[[noreturn]] void fail_from(const InitialCase &initial, const std::string &reason) {
  throw CaseError(fmt::format("{} = {}: {}", casefile::place_of_key(initial.places, "", "from"),
                              casefile::toml_text(*initial.from), reason));
}

namespace {

template <int dim>
RecordedState of_nodes(const fs::path &file) {
  const report::Table table = report::read_table(file);
  RecordedState found;
  found.points.resize(table.n_rows());
  found.unknowns.resize(table.n_rows() * Fields<dim>::count);
  const auto column = [&](const std::string &name) -> const std::vector<double> & {
    const std::vector<double> *values = table.find(name);
    if (!values)
      throw CaseError(fmt::format("{} has no column {} and is of no body of {} dimensions",
                                  file.string(), name, dim));
    return *values;
  };
  for (std::size_t i = 0; i < table.n_rows(); ++i) {
    for (int c = 0; c < dim; ++c)
      found.points[i][static_cast<std::size_t>(c)] = column(std::string(1, "xyz"[c]))[i];
    for (int c = 0; c < Fields<dim>::count; ++c)
      found.unknowns[unknown<dim>(static_cast<body::Node>(i), c)] =
          column(body::column_of<dim>(c))[i];
  }
  return found;
}

template <int dim>
RecordedState of_fields(const fs::path &file) {
  const report::FieldFile fields = report::read_field_file(file);
  RecordedState found{fields.grid.points,
                      std::vector<double>(fields.grid.points.size() * Fields<dim>::count, 0.)};
  const auto put = [&](const report::FieldArray &array, int first, int count) {
    for (std::size_t i = 0; i < found.points.size(); ++i)
      for (int c = 0; c < count; ++c)
        found.unknowns[unknown<dim>(static_cast<body::Node>(i), first + c)] =
            array.values[i * array.components + static_cast<std::size_t>(c)];
  };
  const auto put_called = [&](const std::string &name, int first, std::size_t components) {
    const auto array = std::ranges::find_if(fields.arrays, [&](const report::FieldArray &one) {
      return one.on_points && one.name == name && one.components == components;
    });
    if (array == fields.arrays.end())
      throw CaseError(fmt::format("{} has no array {} with {} component{} at its points",
                                  file.string(), name, components, components == 1 ? "" : "s"));
    put(*array, first, components == 1 ? 1 : dim);
  };
  put_called("displacement", 0, 3);
  put_called("potential", Fields<dim>::potential, 1);
  put_called("temperature", Fields<dim>::temperature, 1);
  return found;
}

bool is_file(const fs::path &file) {
  std::error_code ignored;
  return fs::is_regular_file(file, ignored);
}

report::Table history_of(const InitialCase &initial) {
  try {
    return report::read_table(fs::path(*initial.from) / "history.csv");
  } catch (const CaseError &error) {
    fail_from(initial, error.what());
  }
}

}  // namespace

fs::path recorded_file(const InitialCase &initial) {
  const fs::path folder = *initial.from;
  if (!initial.step)
    return folder / "nodes.csv";
  for (const char *ending : {"vtu", "pvtu"})
    if (fs::path file = folder / fmt::format("result_{:04}.{}", *initial.step, ending);
        is_file(file))
      return file;
  return folder / fmt::format("result_{:04}.vtu", *initial.step);
}

void require_recorded_file(const InitialCase &initial) {
  std::error_code ignored;
  if (!fs::is_directory(*initial.from, ignored))
    fail_from(initial, "there is no such folder");
  if (!is_file(fs::path(*initial.from) / "resolved.toml"))
    fail_from(initial, "holds no run: it has no resolved.toml");
  if (const fs::path file = recorded_file(initial); !is_file(file))
    fail_from(initial,
              initial.step
                  ? fmt::format("has no fields of step {} ({}); see its result.pvd for the "
                                "steps that it has",
                                *initial.step, file.filename().string())
                  : "has no nodes.csv, as that run has not been completed; name one of its "
                    "steps by initial.step");
}

// A run that was stopped has a nodes.csv, of the step at which it was.
void require_finished(const InitialCase &initial) {
  const fs::path file = fs::path(*initial.from) / "unfinished.txt";
  if (initial.step || !is_file(file))
    return;
  std::string reason;
  std::getline(std::ifstream(file), reason);
  fail_from(initial,
            fmt::format("that run has not been completed ({}); let it end with --resume, or name "
                        "one of its steps by initial.step",
                        reason));
}

template <int dim>
RecordedState recorded_state(const InitialCase &initial) {
  const fs::path file = recorded_file(initial);
  try {
    RecordedState found = initial.step ? of_fields<dim>(file) : of_nodes<dim>(file);
    if (!std::ranges::all_of(found.unknowns, [](double value) { return std::isfinite(value); }))
      throw CaseError(file.string() + " holds what is no number");
    return found;
  } catch (const CaseError &error) {
    fail_from(initial, error.what());
  }
}

casefile::Case recorded_case(const InitialCase &initial) {
  const fs::path folder = *initial.from;
  try {
    return casefile::read_file(folder / "resolved.toml", {}, [&](const casefile::MeshCase &) {
      return report::recorded_mesh(folder);
    });
  } catch (const CaseError &error) {
    fail_from(initial, fmt::format("its case cannot be read again: {}", error.what()));
  }
}

RecordedRow::RecordedRow(const InitialCase &initial) : table_(history_of(initial)) {
  const std::vector<double> *steps = table_.find("step");
  for (std::size_t i = 0; steps && i < steps->size(); ++i)
    if (!initial.step || (*steps)[i] == *initial.step)
      row_ = i;
}

std::optional<double> RecordedRow::value(const std::string &column) const {
  const std::vector<double> *values = table_.find(column);
  return row_ && values ? std::optional((*values)[*row_]) : std::nullopt;
}

template RecordedState recorded_state<2>(const InitialCase &);
template RecordedState recorded_state<3>(const InitialCase &);

}  // namespace tourmaline::run
