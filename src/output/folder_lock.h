#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

namespace tourmaline::output {

/// The file that a run keeps in its result folder, or a study in its own, while it writes there.
constexpr std::string_view lock_name = "run.lock";

/// Keeps a folder for one run, or one study. The lock is the system's (flock) and ends with the
/// process, however that ends; a `run.lock` that a killed process left locks nothing. Whoever looks
/// at a folder to decide what to do there has the lock first.
class FolderLock {
 public:
  /// Makes the folder, with its parents, when it is missing; folders that were made and are empty
  /// at the end go again. Throws MachineError when another process has the folder, with its number,
  /// or when the folder cannot be made or written to.
  explicit FolderLock(const std::filesystem::path &directory);
  FolderLock(const FolderLock &) = delete;
  FolderLock &operator=(const FolderLock &) = delete;
  ~FolderLock();

 private:
  void take();
  bool is_in_place() const;
  void note_process() const;
  void remove_empty_folders() const;

  std::vector<std::filesystem::path> made_;  // folders, the innermost first
  std::filesystem::path path_;
  int descriptor_ = -1;
};

/// Throws MachineError when another process has the folder at this moment. Leaves everything there
/// as it is.
void require_unused(const std::filesystem::path &directory);

}  // namespace tourmaline::output
