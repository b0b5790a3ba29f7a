#include "output/atomic_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <stdexcept>
#include <utility>

#include "tourmaline/error.h"

namespace tourmaline::output {
namespace {

/// Writes all of `text`; 0, or the system's error number.
int write_all(int descriptor, std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = ::write(descriptor, text.data(), text.size());
    if (written >= 0)
      text.remove_prefix(static_cast<std::size_t>(written));
    else if (errno != EINTR)
      return errno;
  }
  return 0;
}

/// Takes back what a failed write left behind `size`.
bool cut(int descriptor, std::size_t size) {
  const auto end = static_cast<off_t>(size);
  return ::ftruncate(descriptor, end) == 0 && ::lseek(descriptor, end, SEEK_SET) == end;
}

[[noreturn]] void fail_to_write(const std::filesystem::path &path, int error_number) {
  throw MachineError(
      fmt::format("cannot write {}: {}{}", path.string(), std::strerror(error_number),
                  error_number == EFBIG ? "; raise the limit of file sizes (ulimit -f)" : ""));
}

}  // namespace

AtomicFile::AtomicFile(std::filesystem::path path) : path_(std::move(path)), part_(path_) {
  part_ += ".part";
  descriptor_ = ::open(part_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (descriptor_ < 0)
    fail(errno);
}

AtomicFile::AtomicFile(std::filesystem::path path, std::size_t size)
    : path_(std::move(path)), part_(path_), size_(size), stays_(true) {
  part_ += ".part";
  // What an ordered end has moved into place grows beside it again.
  if (::access(part_.c_str(), F_OK) != 0 && std::rename(path_.c_str(), part_.c_str()) != 0)
    fail(errno);
  if (std::filesystem::file_size(part_) < size)
    throw MachineError(fmt::format("{} is shorter than the {} bytes that the checkpoint counts on",
                                   part_.string(), size));
  descriptor_ = ::open(part_.c_str(), O_WRONLY | O_CLOEXEC);
  if (descriptor_ < 0)
    fail(errno);
  if (!cut(descriptor_, size)) {
    const int error_number = errno;
    give_up();
    fail(error_number);
  }
}

AtomicFile::~AtomicFile() {
  if (descriptor_ >= 0)
    give_up();
}

void AtomicFile::give_up() {
  ::close(std::exchange(descriptor_, -1));
  if (!stays_)
    ::unlink(part_.c_str());
}

void AtomicFile::fail(int error_number) const {
  fail_to_write(path_, error_number);
}

void AtomicFile::append(std::string_view text) {
  if (descriptor_ < 0)
    throw std::logic_error(path_.string() + ": append after finish");
  if (const int error_number = write_all(descriptor_, text); error_number != 0) {
    // Where the torn end cannot be taken back the file must not be finished.
    if (!cut(descriptor_, size_))
      give_up();
    fail(error_number);
  }
  size_ += text.size();
}

void AtomicFile::sync() {
  if (::fsync(descriptor_) != 0)
    fail(errno);
  stays_ = true;
}

void AtomicFile::finish() {
  if (descriptor_ < 0)
    return;
  // Some file systems (NFS, quotas) report a failed write only here.
  if (::close(std::exchange(descriptor_, -1)) != 0 ||
      std::rename(part_.c_str(), path_.c_str()) != 0) {
    const int error_number = errno;
    if (!stays_)
      ::unlink(part_.c_str());
    fail(error_number);
  }
}

void write_file(const std::filesystem::path &path, std::string_view content) {
  AtomicFile file(path);
  file.append(content);
  file.finish();
}

void sync_path(const std::filesystem::path &path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  // Some file systems have nothing to do for a folder and say EINVAL.
  const bool done = descriptor >= 0 && (::fsync(descriptor) == 0 || errno == EINVAL);
  const int error_number = errno;
  if (descriptor >= 0)
    ::close(descriptor);
  if (!done)
    fail_to_write(path, error_number);
}

}  // namespace tourmaline::output
