#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "output/checkpoint.h"
#include "output/contact_surface.h"
#include "output/folder_lock.h"
#include "output/growing_table.h"
#include "output/probe_rows.h"
#include "output/pvd.h"
#include "output/records.h"
#include "output/summary.h"
#include "output/vtu.h"

namespace tourmaline::output {

/// Which part of the cells a process writes, of how many.
struct Piece {
  int number = 0, count = 1;
};

/// Throws MachineError where files on which a checkpoint there counts are missing, too short, or of
/// the tables not what was written.
void require_position(const std::filesystem::path &directory, const FolderPosition &position);

/// What stands in summary.json of the files of a complete run: the bytes of each table and of
/// boundaries.json by their names, and those of all field files together as "result_*", of the
/// contact's as "contact_*".
std::map<std::string, std::uint64_t> file_sizes(const std::filesystem::path &directory);

/// The names of a step's field files: of several pieces each of them and the one that joins them.
std::vector<std::string> field_files(int step, int pieces);
/// And that of its contact's.
std::string contact_field_file(int step);

/// The folder that a run leaves behind, and has for itself meanwhile. Every file in it is whole at
/// every moment: one that is being written is called NAME.part. Whatever fails to be written is a
/// MachineError with the file's name and the reason. In a parallel run every rank has one, in turn:
/// the first makes the folder, and alone writes everything but the fields of the others' cells.
class ResultFolder {
 public:
  /// Makes the folder, with its parents, checks that it can be written to, and removes the files
  /// that an earlier run left there (by the names that this program gives them, and no others).
  /// Of several pieces only number 0 does so; the folder of the others must be there. Whoever has
  /// the folder's lock already passes it on.
  ResultFolder(std::filesystem::path directory, int dimension, Piece piece = {},
               std::unique_ptr<FolderLock> lock = nullptr);

  /// Goes on in the folder of an interrupted run as it was at the checkpoint: what was written
  /// after it is taken away.
  ResultFolder(std::filesystem::path directory, int dimension, Piece piece,
               const Checkpoint &checkpoint, std::unique_ptr<FolderLock> lock = nullptr);

  /// resolved.toml: the case with every default filled in.
  void put_case(const std::string &resolved_toml);

  /// boundaries.json: the parts of the boundary by name; nodes are rows of nodes.csv, from 0.
  void put_boundaries(const std::vector<NamedBoundary> &boundaries);

  /// result_NNNN.vtu, of several pieces result_NNNN_PIECE.vtu. The grid is encoded at the first
  /// call: every call of a run passes the same one. Throws std::invalid_argument when sizes
  /// disagree.
  void put_fields(int step, double time, const Grid &grid, const PointFields &points,
                  const CellFields &cells);

  /// result.pvd with all field files so far, and of several pieces result_NNNN.pvtu, when all of
  /// them have been put.
  void list_fields(int step, double time);

  /// Rows of contact.csv. The file exists only if this was called: without a contact boundary, do
  /// not.
  void put_contact(int step, double time, std::span<const ContactRow> rows);

  /// contact_NNNN.vtu with the rows of contact.csv of that step on the facets of the contact, and
  /// contact.pvd with all of these so far. The facets are encoded at the first call: every call of
  /// a run passes the same ones. Throws std::invalid_argument when sizes disagree.
  void put_contact_fields(int step, double time, const ContactFacets &facets,
                          std::span<const ContactRow> rows);

  /// A row of history.csv. Throws std::invalid_argument when its quantities are not those of the
  /// first row.
  void put_history(const HistoryRow &row);

  /// Rows of probe-NAME.csv.
  void put_probe(int step, double time, const ProbeRows &probe);

  /// nodes.csv; rows in the order of the points.
  void put_nodes(const std::vector<Vector3> &points, const PointFields &fields);

  /// summary.json with the sizes of all other files, when all steps and their files are there: only
  /// the page may be missing from now on. So the checkpoint goes, and a page that somebody has made
  /// of the steps so far.
  void put_summary(const Summary &summary);

  /// unfinished.txt: why the run ends before its end, in the words that its user gets.
  void put_reason(const std::string &text);

  /// checkpoint.bin, to which it adds how far the files have come; they are on the disk itself
  /// then.
  void put_checkpoint(Checkpoint checkpoint);

  /// Moves the tables into place; after a failed solve too, so that the steps that were computed
  /// are kept. Without it they are discarded. Idempotent; no rows can follow.
  void finish();

  const std::filesystem::path &directory() const { return directory_; }

 private:
  GrowingTable &table(const std::string &name, const std::function<std::string()> &header);
  void sync_fields();
  void sync_results();
  void remove_checkpoint();

  std::filesystem::path directory_;
  std::unique_ptr<FolderLock> lock_;
  int dimension_;
  Piece piece_;
  std::optional<VtuWriter> vtu_;
  OptionalArrays optional_;
  std::optional<ContactSurface> contact_surface_;
  std::vector<PvdEntry> series_, contact_series_;
  std::vector<std::string> unsynced_;           // field files since the last checkpoint
  std::map<std::string, GrowingTable> tables_;  // by the names of the files
  std::string history_header_;
};

}  // namespace tourmaline::output
