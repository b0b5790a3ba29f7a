#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <initializer_list>
#include <map>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "output/pvd.h"

namespace tourmaline::output {

/// Numbers by name, kept to the last bit: what the parts of a run need of the steps before.
class SavedNumbers {
 public:
  /// A vector of any library.
  template <class Vector3>
  void put(const std::string &name, const Vector3 &values) {
    values_[name].assign(values.data(), values.data() + values.size());
  }
  void put(const std::string &name, std::initializer_list<double> values);
  /// A vector by unknown of the body, of which ranks may have a part each; a checkpoint has it
  /// whole.
  void put_field(const std::string &name, const std::vector<double> &values);
  void for_each_field(const std::function<void(std::vector<double> &)> &visit);
  /// Throws MachineError when nothing of that name, or another number of values, is there.
  std::span<const double> get(const std::string &name, std::size_t size) const;
  /// 0 where nothing of that name is there.
  std::size_t size(const std::string &name) const;
  /// Into a vector of the right size.
  template <class Vector3>
  void fill(const std::string &name, Vector3 &values) const {
    std::ranges::copy(get(name, static_cast<std::size_t>(values.size())), values.data());
  }

  const std::map<std::string, std::vector<double>> &all() const { return values_; }
  bool is_field(const std::string &name) const { return fields_.contains(name); }

 private:
  std::map<std::string, std::vector<double>> values_;
  std::set<std::string> fields_;  // names
};

/// How far a table has come.
struct TablePosition {
  std::uint64_t bytes = 0;     ///< 0: not begun
  std::uint64_t checksum = 0;  ///< of these bytes
};

/// How far the files of a result folder have come.
struct FolderPosition {
  std::map<std::string, TablePosition> tables;  ///< by the names of the files
  std::vector<PvdEntry> series;                 ///< the field files
  std::uint64_t field_bytes = 0;                ///< of those of all pieces together
};

/// A run between two steps: with it a new process continues to the same bytes.
struct Checkpoint {
  std::string program;  ///< its version
  std::string inputs;   ///< what the run was asked for, as lines `key = value` under [tables]
  std::uint64_t ranks = 1;
  std::uint64_t step = 0;  ///< the last one that was computed
  FolderPosition position;
  SavedNumbers numbers;
};

constexpr const char *checkpoint_name = "checkpoint.bin";

/// Replaces the checkpoint at `path`, on the disk itself before it gets its name: whatever happens
/// meanwhile, the old one or the new one is there, whole. Throws MachineError.
///
/// The file: the magic line, the format's version; the members above, texts and lists with their
/// length before them, all integers 64 bits, numbers as they are in memory; at the end the CRC-32
/// of everything before it.
void write_checkpoint(const std::filesystem::path &path, const Checkpoint &checkpoint);

/// Throws MachineError when the file is not there, damaged, or of another version of the format.
Checkpoint read_checkpoint(const std::filesystem::path &path);

/// Throws MachineError where a file on which a checkpoint counts is missing or has fewer bytes.
void require_bytes(const std::filesystem::path &file, std::uint64_t bytes = 0);

}  // namespace tourmaline::output
