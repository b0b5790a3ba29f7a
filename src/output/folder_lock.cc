#include "output/folder_lock.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <string>
#include <system_error>
#include <thread>
#include <utility>

#include "tourmaline/error.h"

namespace tourmaline::output {
namespace {

/// False when another process has it. Where the file system knows no locks, everybody has it.
bool lock(int descriptor, int kind = LOCK_EX) {
  return ::flock(descriptor, kind | LOCK_NB) == 0 || errno != EWOULDBLOCK;
}

/// Who only asks whether the folder is in use holds the lock for a moment, which is no reason to
/// refuse a run.
bool lock_patiently(int descriptor) {
  for (int attempt = 0; attempt < 20; ++attempt) {
    if (lock(descriptor))
      return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return false;
}

/// Makes the folder; which folders that were, the innermost first.
std::vector<std::filesystem::path> make(const std::filesystem::path &directory) {
  std::vector<std::filesystem::path> missing;
  std::error_code error;
  for (std::filesystem::path at = directory; !at.empty() && !exists(at, error);
       at = at.parent_path())
    if (at.has_filename())  // "a/" names the same folder as "a"
      missing.push_back(at);
  create_directories(directory, error);
  if (error)
    throw MachineError(
        fmt::format("cannot make the folder {}: {}", directory.string(), error.message()));
  return missing;
}

/// The number that the process wrote which has the lock.
std::string process_in(int descriptor) {
  std::array<char, 32> text{};
  const ssize_t size = ::pread(descriptor, text.data(), text.size(), 0);
  const std::string number(text.data(), size > 0 ? static_cast<std::size_t>(size) : 0);
  return number.substr(0, number.find_first_not_of("0123456789"));
}

[[noreturn]] void refuse(const std::filesystem::path &path, int descriptor) {
  const std::string process = process_in(descriptor);
  ::close(descriptor);
  throw MachineError(fmt::format(
      "another run{} is writing to {}; wait for its end, or choose another folder with -o",
      process.empty() ? "" : " (process " + process + ")", path.parent_path().string()));
}

}  // namespace

FolderLock::FolderLock(const std::filesystem::path &directory) : path_(directory / lock_name) {
  try {
    take();
  } catch (const MachineError &) {
    remove_empty_folders();
    throw;
  }
  note_process();
}

// A run that ends removes its file, and the folder where it is empty. Whoever has opened the file
// before and locks it after holds a file without a name, and must try again.
void FolderLock::take() {
  for (int attempt = 0;; ++attempt) {
    for (std::filesystem::path &folder : make(path_.parent_path()))
      made_.push_back(std::move(folder));
    descriptor_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (descriptor_ < 0 && errno == ENOENT && attempt < 100)
      continue;
    if (descriptor_ < 0)
      throw MachineError(fmt::format("cannot write {}: {}", path_.string(), std::strerror(errno)));
    if (!lock_patiently(descriptor_))
      refuse(path_, descriptor_);
    if (is_in_place())
      return;
    ::close(descriptor_);
  }
}

bool FolderLock::is_in_place() const {
  struct stat held {
  }, named{};
  return ::fstat(descriptor_, &held) == 0 && ::stat(path_.c_str(), &named) == 0 &&
         held.st_ino == named.st_ino && held.st_dev == named.st_dev;
}

// Only for the text of an error: a disk without room for it is no reason to stop here.
void FolderLock::note_process() const {
  const std::string number = fmt::format("{}\n", ::getpid());
  if (::ftruncate(descriptor_, 0) != 0 ||
      ::pwrite(descriptor_, number.data(), number.size(), 0) < 0)
    return;
}

void FolderLock::remove_empty_folders() const {
  for (const std::filesystem::path &folder : made_)
    if (::rmdir(folder.c_str()) != 0)
      return;
}

FolderLock::~FolderLock() {
  ::unlink(path_.c_str());
  ::close(descriptor_);
  remove_empty_folders();
}

void require_unused(const std::filesystem::path &directory) {
  const std::filesystem::path path = directory / lock_name;
  const int descriptor = ::open(path.c_str(), O_RDWR | O_CLOEXEC);
  if (descriptor < 0)
    return;
  if (!lock(descriptor, LOCK_SH))
    refuse(path, descriptor);
  ::close(descriptor);
}

}  // namespace tourmaline::output
