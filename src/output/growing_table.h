#pragma once

#include <filesystem>
#include <string_view>

#include "output/atomic_file.h"
#include "output/checkpoint.h"

namespace tourmaline::output {

/// A table that grows line by line as `NAME.part` and knows what a checkpoint can count on.
class GrowingTable {
 public:
  /// A table that has at least its header, also when the disk is full.
  GrowingTable(const std::filesystem::path &path, std::string_view header);

  /// Goes on with one that is as the checkpoint says; what follows that place is cut off.
  GrowingTable(const std::filesystem::path &path, const TablePosition &position);

  void append(std::string_view lines);
  /// Has all of it on the disk itself and lets the `.part` stay from now on.
  void sync() { file_.sync(); }
  /// Moves it into place. Idempotent.
  void finish() { file_.finish(); }

  TablePosition position() const { return {file_.size(), checksum_}; }

 private:
  AtomicFile file_;
  std::uint64_t checksum_ = 0;
};

/// Throws MachineError where the table, as `path`.part or, after an ordered end, as `path`, is
/// missing, is shorter than the checkpoint counts on, or does not begin with the bytes that were
/// written up to there.
void require_table(const std::filesystem::path &path, const TablePosition &position);

}  // namespace tourmaline::output
