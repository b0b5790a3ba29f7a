#pragma once

#include <cstddef>
#include <filesystem>
#include <string_view>

namespace tourmaline::output {

/// A file that appears under its name only when it is whole. It grows beside its place as
/// `NAME.part`, and `finish()` renames it. Every failure is a MachineError with the file's name and
/// the system's reason.
class AtomicFile {
 public:
  /// Opens `path`.part, emptied. The folder must exist.
  explicit AtomicFile(std::filesystem::path path);

  /// Goes on with a file that an earlier process left as `path`.part or `path`, behind its first
  /// `size` bytes; what follows them is cut off. Its `.part` stays, as after `sync()`.
  AtomicFile(std::filesystem::path path, std::size_t size);

  AtomicFile(const AtomicFile &) = delete;
  AtomicFile &operator=(const AtomicFile &) = delete;

  /// Without finish(): removes the `.part`, unless it is to stay, and leaves whatever stood under
  /// the final name.
  ~AtomicFile();

  /// Hands `text` to the system at once, so that a full disk shows here. When it fails, none of
  /// `text` stays in the file: what was appended before is whole and may still be finished.
  void append(std::string_view text);

  /// Has everything appended so far on the disk itself, where a checkpoint can count on it: from
  /// now on the `.part` stays, whatever happens.
  void sync();

  /// Bytes appended so far.
  std::size_t size() const { return size_; }

  /// Closes the file and moves it to its place, where it replaces what was there. Idempotent.
  void finish();

 private:
  void give_up();
  [[noreturn]] void fail(int error_number) const;

  std::filesystem::path path_, part_;
  int descriptor_ = -1;
  std::size_t size_ = 0;  // bytes, up to the end of the last whole append
  bool stays_ = false;    // whether the .part outlives an error
};

/// Replaces the file at `path` by `content`: afterwards it holds either the old content or all of
/// the new.
void write_file(const std::filesystem::path &path, std::string_view content);

/// Has a file's content, or a folder's list of names, on the disk itself.
void sync_path(const std::filesystem::path &path);

}  // namespace tourmaline::output
