#include "output/result_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <limits>
#include <regex>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <utility>

#include "output/atomic_file.h"
#include "output/boundaries.h"
#include "output/csv.h"
#include "tourmaline/error.h"

namespace tourmaline::output {
namespace {

namespace fs = std::filesystem;

// How the names of field files begin.
const std::string of_body = "result_", of_contact = "contact_";

bool is_of_contact(const std::string &field_file) {
  return field_file.starts_with(of_contact);
}

std::string piece_name(int step, int piece, int pieces) {
  return pieces == 1 ? fmt::format("result_{:04}.vtu", step)
                     : fmt::format("result_{:04}_{}.vtu", step, piece);
}

/// The step of result_NNNN.vtu, result_NNNN.pvtu, result_NNNN_PIECE.vtu or contact_NNNN.vtu, with
/// at least four digits.
std::optional<unsigned long long> step_of_field_file(const std::string &name) {
  static const std::regex pattern(
      "(?:result_([0-9]{4,})(?:\\.p?vtu|_[0-9]+\\.vtu)|contact_([0-9]{4,})\\.vtu)");
  std::smatch parts;
  if (!std::regex_match(name, parts, pattern))
    return std::nullopt;
  return std::strtoull(parts[parts[1].matched ? 1 : 2].str().c_str(), nullptr, 10);
}

constexpr std::string_view part = ".part";
constexpr const char *reason_name = "unfinished.txt";

bool is_of_probe(std::string_view name) {
  return name.starts_with("probe-") && name.ends_with(".csv");
}

/// Whether a run gives a file this name, in its place or while it is being written.
bool is_ours(std::string_view name) {
  constexpr std::array<std::string_view, 11> others{
      "result.pvd",  "contact.pvd",  "nodes.csv",     "contact.csv",
      "history.csv", "summary.json", "resolved.toml", "boundaries.json",
      "report.html", reason_name,    checkpoint_name};
  if (name.ends_with(part))
    name.remove_suffix(part.size());
  return step_of_field_file(std::string(name)) ||
         std::find(others.begin(), others.end(), name) != others.end() || is_of_probe(name);
}

void remove_file(const fs::path &file) {
  std::error_code error;
  fs::remove(file, error);
  if (error)
    throw MachineError(fmt::format("cannot remove {}, which an earlier run left: {}", file.string(),
                                   error.message()));
}

void remove_if_there(const fs::path &file) {
  if (std::error_code error; fs::exists(file, error))
    remove_file(file);
}

template <class Which>
void remove_files(const fs::path &directory, const Which &which) {
  std::error_code error;
  std::vector<fs::path> old;
  for (fs::directory_iterator entry(directory, error), end; !error && entry != end;
       entry.increment(error))
    if (which(entry->path().filename().string()) && !entry->is_directory(error))
      old.push_back(entry->path());
  if (error)
    throw MachineError(
        fmt::format("cannot read the result folder {}: {}", directory.string(), error.message()));
  std::for_each(old.begin(), old.end(), remove_file);
}

/// What an interrupted run wrote after its checkpoint, and what its end left besides the tables.
bool is_later(const std::string &name, const Checkpoint &checkpoint) {
  const bool unfinished =
      name.ends_with(part) && is_ours(name) &&
      !checkpoint.position.tables.contains(name.substr(0, name.size() - part.size()));
  const auto of_step = step_of_field_file(name);
  return unfinished || (of_step && *of_step > checkpoint.step) || name == "nodes.csv" ||
         name == "report.html" || name == "summary.json" || name == reason_name;
}

/// Of the field files up to that step whose names begin so, of all pieces.
std::uint64_t field_bytes(const fs::path &directory, std::uint64_t last_step,
                          std::string_view beginning = "") {
  std::uint64_t bytes = 0;
  std::error_code error;
  for (fs::directory_iterator entry(directory, error), end; !error && entry != end;
       entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    const auto step = step_of_field_file(name);
    std::error_code gone;
    if (const std::uint64_t size = entry->file_size(gone);
        step && *step <= last_step && name.starts_with(beginning) && !gone)
      bytes += size;
  }
  return bytes;
}

}  // namespace

void require_position(const fs::path &directory, const FolderPosition &position) {
  for (const PvdEntry &entry : position.series)
    require_bytes(directory / entry.file);
  if (!position.series.empty()) {
    const auto last = step_of_field_file(position.series.back().file);
    if (last && field_bytes(directory, *last) != position.field_bytes)
      throw MachineError(fmt::format(
          "the field files in {} do not have the {} bytes that the checkpoint counts on; start "
          "again without --resume",
          directory.string(), position.field_bytes));
  }
  for (const auto &[name, table] : position.tables)
    require_table(directory / name, table);
}

std::map<std::string, std::uint64_t> file_sizes(const fs::path &directory) {
  std::map<std::string, std::uint64_t> sizes;
  std::vector<std::string> names{"boundaries.json", "contact.csv", "history.csv", "nodes.csv"};
  std::error_code unread;
  for (fs::directory_iterator entry(directory, unread), end; !unread && entry != end;
       entry.increment(unread))
    if (const std::string name = entry->path().filename().string(); is_of_probe(name))
      names.push_back(name);
  for (const std::string &name : names) {
    std::error_code missing;
    if (const std::uint64_t size = fs::file_size(directory / name, missing); !missing)
      sizes[name] = size;
  }
  for (const std::string &beginning : {of_body, of_contact})
    if (const std::uint64_t bytes =
            field_bytes(directory, std::numeric_limits<std::uint64_t>::max(), beginning);
        bytes > 0)
      sizes[beginning + "*"] = bytes;
  return sizes;
}

std::vector<std::string> field_files(int step, int pieces) {
  std::vector<std::string> names;
  for (int i = 0; i < pieces; ++i)
    names.push_back(piece_name(step, i, pieces));
  if (pieces > 1)
    names.push_back(fmt::format("result_{:04}.pvtu", step));
  return names;
}

std::string contact_field_file(int step) {
  return fmt::format("{}{:04}.vtu", of_contact, step);
}

ResultFolder::ResultFolder(fs::path directory, int dimension, Piece piece,
                           std::unique_ptr<FolderLock> lock)
    : directory_(std::move(directory)),
      lock_(std::move(lock)),
      dimension_(dimension),
      piece_(piece) {
  if (piece.number > 0)
    return;
  if (!lock_)
    lock_ = std::make_unique<FolderLock>(directory_);
  // First: they count on the others.
  remove_if_there(directory_ / "summary.json");
  remove_checkpoint();
  // Files of an earlier run, mixed with those of this one, would be read as one series.
  remove_files(directory_, is_ours);
}

ResultFolder::ResultFolder(fs::path directory, int dimension, Piece piece,
                           const Checkpoint &checkpoint, std::unique_ptr<FolderLock> lock)
    : directory_(std::move(directory)),
      lock_(std::move(lock)),
      dimension_(dimension),
      piece_(piece) {
  if (piece.number > 0)
    return;
  const FolderPosition &position = checkpoint.position;
  if (!lock_)
    lock_ = std::make_unique<FolderLock>(directory_);
  require_position(directory_, position);
  remove_if_there(directory_ / "summary.json");  // first: it counts on the others
  for (const auto &[name, table] : position.tables)
    tables_.try_emplace(name, directory_ / name, table);
  remove_files(directory_, [&](const std::string &name) { return is_later(name, checkpoint); });
  for (const PvdEntry &entry : position.series)
    (is_of_contact(entry.file) ? contact_series_ : series_).push_back(entry);
  for (const auto &[series, name] :
       {std::pair{&series_, "result.pvd"}, std::pair{&contact_series_, "contact.pvd"}})
    if (series->empty())
      remove_if_there(directory_ / name);
    else
      write_file(directory_ / name, pvd_text(*series));
}

void ResultFolder::put_case(const std::string &resolved_toml) {
  write_file(directory_ / "resolved.toml", resolved_toml);
}

void ResultFolder::put_boundaries(const std::vector<NamedBoundary> &boundaries) {
  write_file(directory_ / "boundaries.json", boundaries_text(boundaries));
}

void ResultFolder::put_fields(int step, double time, const Grid &grid, const PointFields &points,
                              const CellFields &cells) {
  if (!vtu_)
    vtu_.emplace(grid);
  else if (grid.points.size() != vtu_->n_points() || grid.n_cells() != vtu_->n_cells())
    throw std::invalid_argument("put_fields: not the grid of the first call");
  optional_ = {!cells.region.empty(), !cells.poling.empty(), !points.stress.empty()};
  vtu_->write(directory_ / piece_name(step, piece_.number, piece_.count), time, points, cells);
}

void ResultFolder::list_fields(int step, double time) {
  const std::vector<std::string> names = field_files(step, piece_.count);
  if (piece_.count > 1)
    write_file(directory_ / names.back(),
               pvtu_text(time, {names.begin(), names.end() - 1}, optional_));
  unsynced_.insert(unsynced_.end(), names.begin(), names.end());
  series_.push_back({time, names.back()});
  write_file(directory_ / "result.pvd", pvd_text(series_));
}

GrowingTable &ResultFolder::table(const std::string &name,
                                  const std::function<std::string()> &header) {
  if (const auto found = tables_.find(name); found != tables_.end())
    return found->second;
  return tables_.try_emplace(name, directory_ / name, header()).first->second;
}

void ResultFolder::put_contact(int step, double time, std::span<const ContactRow> rows) {
  table("contact.csv", [&] {
    return contact_header(dimension_, rows.empty() ? ContactRow{} : rows.front());
  }).append(contact_lines(dimension_, step, time, rows));
}

void ResultFolder::put_contact_fields(int step, double time, const ContactFacets &facets,
                                      std::span<const ContactRow> rows) {
  if (!contact_surface_)
    contact_surface_.emplace(dimension_, rows, facets);
  const std::string name = contact_field_file(step);
  contact_surface_->write(directory_ / name, time, rows);
  contact_series_.push_back({time, name});
  unsynced_.push_back(name);
  write_file(directory_ / "contact.pvd", pvd_text(contact_series_));
}

void ResultFolder::put_history(const HistoryRow &row) {
  const std::string header = history_header(row);
  if (history_header_.empty())
    history_header_ = header;
  if (header != history_header_)
    throw std::invalid_argument("put_history: not the quantities of the first row");
  table("history.csv", [&] { return history_header_; }).append(history_line(row));
}

void ResultFolder::put_probe(int step, double time, const ProbeRows &probe) {
  table(probe_file(probe.name), [&] {
    return probe_header(probe);
  }).append(probe_lines(step, time, probe));
}

void ResultFolder::put_nodes(const std::vector<Vector3> &points, const PointFields &fields) {
  constexpr std::size_t lines_at_once = 10000;  // a megabyte or two of text
  AtomicFile file(directory_ / "nodes.csv");
  file.append(nodes_header(dimension_));
  for (std::size_t first = 0; first < points.size(); first += lines_at_once)
    file.append(nodes_lines(dimension_, points, fields, first,
                            std::min(first + lines_at_once, points.size())));
  file.finish();
}

void ResultFolder::put_summary(const Summary &summary) {
  std::error_code error;
  const bool replaces_checkpoint = fs::exists(directory_ / checkpoint_name, error);
  const fs::path file = directory_ / "summary.json";
  if (replaces_checkpoint)
    sync_results();
  remove_if_there(directory_ / "report.html");  // of the steps so far, made by `tourmaline report`
  Summary whole = summary;
  whole.files = file_sizes(directory_);
  write_file(file, summary_text(dimension_, whole));
  if (!replaces_checkpoint)
    return;
  sync_path(file);
  sync_path(directory_);
  remove_checkpoint();
}

void ResultFolder::put_reason(const std::string &text) {
  write_file(directory_ / reason_name, text + "\n");
}

void ResultFolder::sync_results() {
  sync_fields();
  for (const auto &[name, size] : file_sizes(directory_))
    if (std::error_code error; name != "boundaries.json" && fs::exists(directory_ / name, error))
      sync_path(directory_ / name);
}

void ResultFolder::sync_fields() {
  for (const std::string &name : unsynced_)
    sync_path(directory_ / name);
  unsynced_.clear();
}

void ResultFolder::put_checkpoint(Checkpoint checkpoint) {
  sync_fields();
  std::vector<PvdEntry> all = contact_series_;
  all.insert(all.end(), series_.begin(), series_.end());
  checkpoint.position = {{}, all, field_bytes(directory_, checkpoint.step)};
  for (auto &[name, table] : tables_) {
    table.sync();
    checkpoint.position.tables[name] = table.position();
  }
  write_checkpoint(directory_ / checkpoint_name, checkpoint);
}

void ResultFolder::remove_checkpoint() {
  remove_if_there(directory_ / checkpoint_name);
}

void ResultFolder::finish() {
  for (auto &[name, table] : tables_)
    table.finish();
}

}  // namespace tourmaline::output
