#include "tourmaline/output/result_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <regex>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <utility>

#include "tourmaline/error.h"
#include "tourmaline/output/boundaries.h"
#include "tourmaline/output/csv.h"

namespace tourmaline::output {
namespace {

namespace fs = std::filesystem;

void make(const fs::path &directory) {
  std::error_code error;
  fs::create_directories(directory, error);
  if (error)
    throw MachineError(
        fmt::format("cannot make the result folder {}: {}", directory.string(), error.message()));
}

/// Opening a file is the only sure test of permissions and read-only file systems; it leaves
/// nothing.
void check_writable(const fs::path &directory) {
  AtomicFile probe(directory / "tourmaline-probe");
}

std::string piece_name(int step, int piece, int pieces) {
  return pieces == 1 ? fmt::format("result_{:04}.vtu", step)
                     : fmt::format("result_{:04}_{}.vtu", step, piece);
}

/// result_NNNN.vtu, result_NNNN.pvtu or result_NNNN_PIECE.vtu, with at least four digits.
bool is_field_file(const std::string &name) {
  static const std::regex pattern("result_[0-9]{4,}(\\.p?vtu|_[0-9]+\\.vtu)");
  return std::regex_match(name, pattern);
}

/// Whether a run gives a file this name, in its place or while it is being written.
bool is_ours(std::string_view name) {
  constexpr std::string_view part = ".part";
  constexpr std::array<std::string_view, 8> others{
      "result.pvd",   "nodes.csv",     "contact.csv",     "history.csv",
      "summary.json", "resolved.toml", "boundaries.json", "report.html"};
  if (name.ends_with(part))
    name.remove_suffix(part.size());
  return is_field_file(std::string(name)) ||
         std::find(others.begin(), others.end(), name) != others.end();
}

void remove_file(const fs::path &file) {
  std::error_code error;
  fs::remove(file, error);
  if (error)
    throw MachineError(fmt::format("cannot remove {}, which an earlier run left: {}", file.string(),
                                   error.message()));
}

/// The files of an earlier run: mixed with those of this one they would be read as one series.
void remove_old_results(const fs::path &directory) {
  std::error_code error;
  std::vector<fs::path> old;
  for (fs::directory_iterator entry(directory, error), end; !error && entry != end;
       entry.increment(error))
    if (is_ours(entry->path().filename().string()) && !entry->is_directory(error))
      old.push_back(entry->path());
  if (error)
    throw MachineError(
        fmt::format("cannot read the result folder {}: {}", directory.string(), error.message()));
  std::for_each(old.begin(), old.end(), remove_file);
}

/// A table that has at least its header, also when the disk is full.
std::unique_ptr<AtomicFile> begin_table(const fs::path &path, const std::string &header) {
  auto table = std::make_unique<AtomicFile>(path);
  table->append(header);
  return table;
}

}  // namespace

ResultFolder::ResultFolder(fs::path directory, int dimension, Piece piece)
    : directory_(std::move(directory)), dimension_(dimension), piece_(piece) {
  if (piece.number > 0)
    return;
  make(directory_);
  check_writable(directory_);
  remove_old_results(directory_);
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
  constant_ = {!cells.region.empty(), !cells.poling.empty()};
  vtu_->write(directory_ / piece_name(step, piece_.number, piece_.count), time, points, cells);
}

void ResultFolder::list_fields(int step, double time) {
  std::string name = piece_name(step, 0, 1);
  if (piece_.count > 1) {
    std::vector<std::string> pieces;
    for (int i = 0; i < piece_.count; ++i)
      pieces.push_back(piece_name(step, i, piece_.count));
    name = fmt::format("result_{:04}.pvtu", step);
    write_file(directory_ / name, pvtu_text(time, pieces, constant_));
  }
  series_.push_back({time, name});
  write_file(directory_ / "result.pvd", pvd_text(series_));
}

void ResultFolder::put_contact(int step, double time, std::span<const ContactRow> rows) {
  if (!contact_)
    contact_ = begin_table(directory_ / "contact.csv", contact_header(dimension_));
  contact_->append(contact_lines(dimension_, step, time, rows));
}

void ResultFolder::put_history(const HistoryRow &row) {
  const std::string header = history_header(row);
  if (!history_) {
    history_ = begin_table(directory_ / "history.csv", header);
    history_header_ = header;
  }
  if (header != history_header_)
    throw std::invalid_argument("put_history: not the quantities of the first row");
  history_->append(history_line(row));
}

void ResultFolder::put_nodes(const std::vector<Vector> &points, const PointFields &fields) {
  write_file(directory_ / "nodes.csv", nodes_table(dimension_, points, fields));
}

void ResultFolder::put_summary(const Summary &summary) {
  write_file(directory_ / "summary.json", summary_text(dimension_, summary));
}

void ResultFolder::finish() {
  if (contact_)
    contact_->finish();
  if (history_)
    history_->finish();
}

}  // namespace tourmaline::output
