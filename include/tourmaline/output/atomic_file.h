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
  AtomicFile(const AtomicFile &) = delete;
  AtomicFile &operator=(const AtomicFile &) = delete;

  /// Without finish(): removes the `.part` and leaves whatever stood under the final name.
  ~AtomicFile();

  /// Hands `text` to the system at once, so that a full disk shows here. When it fails, none of
  /// `text` stays in the file: what was appended before is whole and may still be finished.
  void append(std::string_view text);

  /// Closes the file and moves it to its place, where it replaces what was there. Idempotent.
  void finish();

 private:
  [[noreturn]] void fail(int error_number) const;

  std::filesystem::path path_, part_;
  int descriptor_ = -1;
  std::size_t size_ = 0;  // bytes, up to the end of the last whole append
};

/// Replaces the file at `path` by `content`: afterwards it holds either the old content or all of
/// the new.
void write_file(const std::filesystem::path &path, std::string_view content);

}  // namespace tourmaline::output
