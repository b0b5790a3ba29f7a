#pragma once

#include <filesystem>
#include <string_view>

namespace tourmaline::output {

/// The file that a run keeps in its result folder while it writes there.
constexpr std::string_view lock_name = "run.lock";

/// Keeps a result folder for one run. The lock is the system's (flock) and ends with the process,
/// however that ends; a `run.lock` that a killed process left locks nothing.
class FolderLock {
 public:
  /// Throws MachineError when another run has the folder, with its process number, or when the
  /// folder cannot be written to.
  explicit FolderLock(const std::filesystem::path &directory);
  FolderLock(const FolderLock &) = delete;
  FolderLock &operator=(const FolderLock &) = delete;
  ~FolderLock();

 private:
  bool is_in_place() const;
  void note_process() const;

  std::filesystem::path path_;
  int descriptor_ = -1;
};

/// Throws MachineError when a run has the folder at this moment. Leaves everything there as it is.
void require_unused(const std::filesystem::path &directory);

/// Removes the file that a killed process left, if there is one.
void remove_stale_lock(const std::filesystem::path &directory);

}  // namespace tourmaline::output
