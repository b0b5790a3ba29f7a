#include "report/result.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>

#include "case/resolved.h"
#include "contact/kinds.h"
#include "output/probe_rows.h"
#include "report/field_file.h"
#include "report/moment.h"
#include "report/number_text.h"
#include "report/recorded_boundaries.h"
#include "report/recorded_mesh.h"
#include "report/text_file.h"
#include "tourmaline/case/reader.h"
#include "tourmaline/error.h"

namespace tourmaline::report {
namespace {

namespace fs = std::filesystem;

constexpr const char *recovered = "recovered_";

void check_folder(const fs::path &folder) {
  if (!fs::is_directory(folder))
    throw CaseError(folder.string() + ": there is no such folder");
  for (const char *file : {"resolved.toml", "history.csv", "result.pvd"})
    if (fs::exists(folder / file))
      return;
  throw CaseError(folder.string() +
                  ": is no result folder; it holds neither resolved.toml nor history.csv nor "
                  "result.pvd. `tourmaline run CASE.toml -o DIR` leaves one");
}

std::string name_of(const fs::path &folder) {
  const fs::path plain = fs::absolute(folder).lexically_normal();
  return (plain.has_filename() ? plain : plain.parent_path()).filename().string();
}

void read_case(Result &result, const fs::path &folder) {
  if (!fs::exists(folder / "resolved.toml"))
    return;
  result.resolved = read_text_file(folder / "resolved.toml");
  result.friction_name = casefile::friction_name_in(result.resolved);
  try {
    result.asked =
        casefile::read_file(folder / "resolved.toml", {},
                            [&](const casefile::MeshCase &) { return recorded_mesh(folder); });
    result.dimension = result.asked->dimension;
    if (result.asked->model.plane == "stress")
      result.remarks.emplace_back("Plane stress: the body is a sheet whose faces are free.");
    if (result.asked->model.is_axisymmetric())
      result.remarks.emplace_back(
          "Axisymmetric: x is the radius, y the axis, zz goes around; forces, charges and heats "
          "are "
          "those of the whole body.");
  } catch (const CaseError &error) {
    // The numbers can be shown without: a case of another version, or a run that failed.
    result.remarks.push_back(std::string("The conditions are not shown: ") + error.what());
  }
}

void read_summary(Result &result, const fs::path &file) {
  result.summary = read_text_file(file);
  if (nlohmann::json::parse(result.summary, nullptr, false).is_object())
    return;
  result.summary.clear();
  result.remarks.emplace_back(
      "summary.json is damaged: what it held is not shown, and nothing says whether the tables are "
      "whole.");
}

// As summary.json says how long the tables were.
void remark_on_lost_tables(Result &result, const fs::path &folder) {
  const nlohmann::json summary = nlohmann::json::parse(result.summary, nullptr, false);
  const nlohmann::json files =
      summary.is_object() && summary.contains("files") ? summary["files"] : nlohmann::json();
  for (const char *name : {"history.csv", "contact.csv"}) {
    if (!files.is_object() || !files.contains(name))
      continue;
    const bool is_there = fs::exists(folder / name);
    if (!is_there || files[name] != fs::file_size(folder / name))
      result.remarks.push_back(fmt::format(
          "{} {}, and had {} bytes when the run was complete: what it held is not all shown.", name,
          is_there ? fmt::format("has {} bytes", fs::file_size(folder / name)) : "is missing",
          files[name].dump()));
  }
}

// In the words that the terminal had; a run that was killed could leave none.
void remark_on_unfinished(Result &result, const fs::path &folder) {
  std::string text = "The run did not finish, or has not yet: there is no summary.json.";
  if (fs::exists(folder / "unfinished.txt")) {
    std::string reason = read_text_file(folder / "unfinished.txt");
    while (!reason.empty() && (reason.back() == '\n' || reason.back() == '.'))
      reason.pop_back();
    text = "The run did not finish: " + reason + ".";
  }
  if (result.asked)
    text += fmt::format(" It was to end at t = {} s", number_text(result.asked->time.end, 6));
  const std::vector<double> *time = result.history ? result.history->find("time") : nullptr;
  if (result.asked && time && !time->empty())
    text += fmt::format("; the last step that is recorded ends at t = {} s",
                        number_text(time->back(), 6));
  result.remarks.insert(result.remarks.begin(), text + (result.asked ? "." : ""));
}

void read_tables(Result &result, const fs::path &folder) {
  if (fs::exists(folder / "history.csv"))
    result.history = read_table(folder / "history.csv");
  if (fs::exists(folder / "contact.csv"))
    result.contact = read_table(folder / "contact.csv", "contact", result.contact_names());
  if (result.asked)
    for (const casefile::ProbeCase &probe : result.asked->probes)
      if (const fs::path file = folder / output::probe_file(probe.name); fs::exists(file))
        result.probes.push_back({probe.name, probe.from.has_value(), read_table(file)});
  if (fs::exists(folder / "summary.json"))
    read_summary(result, folder / "summary.json");
  else
    remark_on_unfinished(result, folder);
  remark_on_lost_tables(result, folder);
}

bool has_known_bound(const casefile::ContactCase &asked) {
  return asked.friction.resists() && contact::kind_of(asked.friction).bound == nullptr;
}

// Of a row of contact.csv, which names its contact where there are several.
const casefile::ContactCase &contact_at(const Result &result, std::size_t row) {
  const std::vector<double> *number = result.contact->find("contact");
  const std::vector<casefile::ContactCase> &all = result.asked->contacts;
  const double found = number ? (*number)[row] : 0;
  return all[found >= 0 && found < static_cast<double>(all.size()) ? static_cast<std::size_t>(found)
                                                                   : 0];
}

// Where it depends on the pressure, the table has it; elsewhere it is known without the run.
void evaluate_friction_bound(Result &result) {
  const std::vector<double> *recorded =
      result.contact ? result.contact->find("friction_bound") : nullptr;
  if (recorded) {
    result.friction_bound = *recorded;
    return;
  }
  if (!result.asked || !result.contact || !result.friction_name.empty() ||
      std::none_of(result.asked->contacts.begin(), result.asked->contacts.end(), has_known_bound))
    return;
  const std::vector<double> *time = result.contact->find("time"), *x = result.contact->find("x"),
                            *y = result.contact->find("y"), *z = result.contact->find("z");
  if (!time || !x || !y)
    return;
  for (std::size_t i = 0; i < result.contact->n_rows(); ++i)
    // It is 0 where there is no friction.
    result.friction_bound.push_back(contact_at(result, i).friction.bound.value(
        {(*x)[i], (*y)[i], z ? (*z)[i] : 0}, (*time)[i]));
}

/// result_0012.vtu: 12
int step_of(const fs::path &file) {
  const std::string stem = file.stem().string();
  const std::size_t digits = stem.find_last_not_of("0123456789") + 1;
  int step = 0;
  std::from_chars(stem.data() + digits, stem.data() + stem.size(), step);
  return step;
}

/// What stands in the files twice is shown once.
void drop_means_of_recovered(FieldFile &file) {
  const auto has = [&](const std::string &name) {
    return std::any_of(file.arrays.begin(), file.arrays.end(),
                       [&](const FieldArray &array) { return array.name == name; });
  };
  for (const char *name : {"stress", "principal_stress", "von_mises"})
    if (has(recovered + std::string(name)))
      std::erase_if(file.arrays, [&](const FieldArray &array) { return array.name == name; });
}

FieldFile read_state(const fs::path &path, const States &states) {
  FieldFile file = read_field_file(path);
  if (!states.means_of_recovered)
    drop_means_of_recovered(file);
  return file;
}

std::size_t numbers_of(const FieldFile &file, const Skin &skin) {
  std::size_t numbers = 0;
  for (const FieldArray &array : file.arrays)
    numbers += array.components * (array.on_points ? skin.nodes.size() : skin.cells.size());
  return numbers;
}

std::size_t inner_numbers_of(const FieldFile &file, const Skin &skin) {
  std::size_t numbers = 0;
  for (const FieldArray &array : file.arrays)
    numbers += array.components * (array.on_points ? file.grid.points.size() - skin.nodes.size()
                                                   : file.grid.n_cells() - skin.cells.size());
  return numbers;
}

std::vector<RecordedMoment> thinned(const std::vector<RecordedMoment> &series, std::size_t most) {
  if (series.size() <= most || series.empty())
    return series;
  std::vector<RecordedMoment> kept;
  for (std::size_t i = 1; i < most; ++i)
    kept.push_back(series[(i - 1) * (series.size() - 1) / (most - 1)]);
  kept.push_back(series.back());
  return kept;
}

std::vector<std::string> component_names(const std::string &field, std::size_t n) {
  if (n == 1)
    return {""};
  if (n == 3 && !field.ends_with("principal_stress"))
    return {"x", "y", "z"};
  if (n == 6)
    return {"xx", "yy", "zz", "xy", "yz", "xz"};
  std::vector<std::string> names;
  for (std::size_t i = 1; i <= n; ++i)
    names.push_back(std::to_string(i));
  return names;
}

std::string unit_of(const std::string &field) {
  static const std::map<std::string, std::string> units{{"displacement", "m"},
                                                        {"potential", "V"},
                                                        {"temperature", "K"},
                                                        {"stress", "Pa"},
                                                        {"principal_stress", "Pa"},
                                                        {"von_mises", "Pa"},
                                                        {"recovered_stress", "Pa"},
                                                        {"recovered_principal_stress", "Pa"},
                                                        {"recovered_von_mises", "Pa"},
                                                        {"electric_field", "V/m"},
                                                        {"electric_displacement", "C/m²"},
                                                        {"heat_flux", "W/m²"}};
  const auto found = units.find(field);
  return found == units.end() ? "" : found->second;
}

void begin_fields(Result &result, const FieldFile &file) {
  result.dimension = file.grid.dimension;
  result.n_points = file.grid.points.size();
  result.n_cells = file.grid.n_cells();
  result.skin = skin_of(file.grid);
  for (const std::uint32_t node : result.skin.nodes)
    result.points.push_back(file.grid.points[node]);
  for (const FieldArray &array : file.arrays)
    result.fields.push_back({array.name, unit_of(array.name), array.on_points,
                             component_names(array.name, array.components),
                             std::vector<std::vector<float>>(array.components),
                             std::vector<std::vector<float>>(array.components)});
}

void append(const FieldArray &array, const std::vector<std::uint32_t> &places,
            std::vector<std::vector<float>> &values) {
  for (std::size_t c = 0; c < array.components; ++c)
    for (const std::uint32_t place : places)
      values[c].push_back(static_cast<float>(array.values.at(place * array.components + c)));
}

void add_state(Result &result, const FieldFile &file, const fs::path &path) {
  const bool alike =
      file.grid.points.size() == result.n_points && file.grid.n_cells() == result.n_cells &&
      std::equal(file.arrays.begin(), file.arrays.end(), result.fields.begin(), result.fields.end(),
                 [](const FieldArray &array, const Field &field) {
                   return array.name == field.name && array.on_points == field.on_points &&
                          array.components == field.values.size();
                 });
  if (!alike)
    throw CaseError(path.string() + ": does not hold the arrays of the other field files");
  for (std::size_t i = 0; i < file.arrays.size(); ++i) {
    const FieldArray &array = file.arrays[i];
    append(array, array.on_points ? result.skin.nodes : result.skin.cells, result.fields[i].values);
    if (result.solid)
      append(array, array.on_points ? result.solid->nodes : result.solid->cells,
             result.fields[i].inner);
  }
}

/// A plane body has no out-of-plane components, but the files have room for them.
void drop_empty_components(Field &field) {
  if (field.components.size() == 1)
    return;
  for (std::size_t c = field.components.size(); c-- > 0;) {
    const bool in_plane = field.components[c].find('z') == std::string::npos;
    const auto &values = field.values[c];
    if (in_plane || std::any_of(values.begin(), values.end(), [](float v) { return v != 0; }))
      continue;
    field.components.erase(field.components.begin() + static_cast<std::ptrdiff_t>(c));
    field.values.erase(field.values.begin() + static_cast<std::ptrdiff_t>(c));
  }
}

void say_why_no_fields(Result &result) {
  const bool off = result.asked && !result.asked->output.fields;
  result.remarks.push_back(off ? "There are no fields: the case says output.fields = false."
                               : "There are no fields: the folder holds no result.pvd.");
}

/// The state whose time is nearest, alone.
std::vector<RecordedMoment> nearest(const std::vector<RecordedMoment> &series, double time) {
  require_moment(time, series.back().time);
  return {*std::min_element(series.begin(), series.end(),
                            [&](const RecordedMoment &a, const RecordedMoment &b) {
                              return std::abs(a.time - time) < std::abs(b.time - time);
                            })};
}

void read_fields(Result &result, const fs::path &folder, const States &states) {
  std::vector<RecordedMoment> series = recorded_moments(folder, "result.pvd");
  if (series.empty())
    return say_why_no_fields(result);
  result.n_states = series.size();
  if (states.time)
    series = nearest(series, *states.time);
  const FieldFile last = read_state(series.back().file, states);
  begin_fields(result, last);
  const std::size_t most =
      std::max<std::size_t>(1, states.most_numbers / numbers_of(last, result.skin));
  const std::vector<RecordedMoment> kept = thinned(series, most);
  if (kept.size() < series.size() && kept.size() > 1)
    result.remarks.push_back(fmt::format(
        "Of {} field files {} are shown, to keep the page small; `tourmaline report DIR --size MB` "
        "takes as many as fit. Curves, contact and tables have all steps.",
        series.size(), kept.size()));
  if (result.dimension == 3 &&
      inner_numbers_of(last, result.skin) * kept.size() <= states.most_inner)
    result.solid = solid_of(last.grid, result.skin);
  for (const RecordedMoment &state : kept) {
    result.times.push_back(state.time);
    result.steps.push_back(step_of(state.file));
    add_state(result, &state == &kept.back() ? last : read_state(state.file, states), state.file);
  }
  if (result.dimension == 2)
    for (Field &field : result.fields)
      drop_empty_components(field);
}

double greatest(const Table &history, const std::string &name) {
  const std::vector<double> *column = history.find(name);
  double most = 0;
  for (std::size_t i = 0; column && i < column->size(); ++i)
    most = std::max(most, std::abs((*column)[i]));
  return most;
}

/// A field's energy is a quadratic form in its values, so an energy of 1e-28 of all energies says
/// that the values are 1e-14 of those that the others would need for theirs: what is left of the
/// linear solve.
void judge_round_off(Result &result) {
  if (!result.history)
    return;
  double all = 0;
  for (const char *name : {"elastic_energy", "electric_energy", "thermal_energy"})
    all = std::max(all, greatest(*result.history, name));
  const std::map<std::string, const char *> energies{{"potential", "electric_energy"},
                                                     {"electric_field", "electric_energy"},
                                                     {"temperature", "thermal_energy"},
                                                     {"heat_flux", "thermal_energy"}};
  for (Field &field : result.fields)
    if (const auto found = energies.find(field.name); found != energies.end())
      field.below_round_off = result.history->find(found->second) &&
                              greatest(*result.history, found->second) < 1e-28 * all;
}

// The files have room for the fields that a model does without.
void drop_left_out(Result &result) {
  if (!result.asked)
    return;
  const std::map<std::string, std::string> made_of{{"potential", "potential"},
                                                   {"electric_field", "potential"},
                                                   {"electric_displacement", "potential"},
                                                   {"temperature", "temperature"},
                                                   {"heat_flux", "temperature"}};
  std::erase_if(result.fields, [&](const Field &field) {
    const auto found = made_of.find(field.name);
    return found != made_of.end() && !result.asked->model.has(found->second);
  });
}

}  // namespace

std::string Field::origin() const {
  if (name.starts_with(recovered))
    return "recovered at the nodes";
  return on_points || name == "region" || name == "poling" ? "" : "mean of each cell";
}

std::vector<std::string> Result::contact_names() const {
  std::vector<std::string> names;
  for (std::size_t i = 0; asked && i < asked->contacts.size(); ++i)
    names.push_back(asked->contacts[i].called());
  return names;
}

const Field *Result::field(const std::string &wanted) const {
  for (const Field &f : fields)
    if (f.name == wanted)
      return &f;
  return nullptr;
}

Result read_result(const fs::path &folder, const States &states) {
  check_folder(folder);
  Result result;
  result.name = name_of(folder);
  read_case(result, folder);
  read_tables(result, folder);
  evaluate_friction_bound(result);
  read_fields(result, folder, states);
  read_boundaries(result, folder);
  remark_on_contact(result);
  judge_round_off(result);
  drop_left_out(result);
  return result;
}

}  // namespace tourmaline::report
