#include "tourmaline/output/folder_lock.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <string>

#include "tourmaline/error.h"

namespace tourmaline::output {
namespace {

/// False when another process has it. Where the file system knows no locks, everybody has it.
bool lock(int descriptor) {
  return ::flock(descriptor, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK;
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

// A run that ends removes its file. Whoever has opened it before and locks it after holds a file
// without a name, and must try again.
FolderLock::FolderLock(const std::filesystem::path &directory) : path_(directory / lock_name) {
  while (true) {
    descriptor_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (descriptor_ < 0)
      throw MachineError(fmt::format("cannot write {}: {}", path_.string(), std::strerror(errno)));
    if (!lock(descriptor_))
      refuse(path_, descriptor_);
    if (is_in_place())
      break;
    ::close(descriptor_);
  }
  note_process();
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

FolderLock::~FolderLock() {
  ::unlink(path_.c_str());
  ::close(descriptor_);
}

void require_unused(const std::filesystem::path &directory) {
  const std::filesystem::path path = directory / lock_name;
  const int descriptor = ::open(path.c_str(), O_RDWR | O_CLOEXEC);
  if (descriptor < 0)
    return;
  if (!lock(descriptor))
    refuse(path, descriptor);
  ::close(descriptor);
}

void remove_stale_lock(const std::filesystem::path &directory) {
  const std::filesystem::path path = directory / lock_name;
  const int descriptor = ::open(path.c_str(), O_RDWR | O_CLOEXEC);
  if (descriptor < 0)
    return;
  if (lock(descriptor))
    ::unlink(path.c_str());
  ::close(descriptor);
}

}  // namespace tourmaline::output
