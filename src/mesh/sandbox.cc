#include "sandbox.h"

#include <fcntl.h>
#include <linux/landlock.h>
#include <sched.h>
#include <seccomp.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <sys/mount.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <string>
#include <utility>

namespace tourmaline::mesh {

namespace {

// The folder is gone as soon as it is entered, so that nothing can be put into it and nobody has to
// clear it away.
void enter_empty_folder() {
  std::string name = (std::filesystem::temp_directory_path() / "tourmaline-XXXXXX").string();
  if (mkdtemp(name.data()) && chdir(name.c_str()) == 0)
    rmdir(name.c_str());
  else if (chdir("/") != 0)
    _exit(1);
}

// Landlock of the newest kernels; headers of older ones lack members and names.
struct Ruleset {
  std::uint64_t files = 0, ports = 0, scopes = 0;
};

// By version of the interface, what can be taken away; what a kernel does not know it refuses.
Ruleset all_that_is_known(long version) {
  const auto first = [](int bits) { return (std::uint64_t{1} << bits) - 1; };
  Ruleset all;
  all.files = first(version >= 5 ? 16 : version >= 3 ? 15 : version >= 2 ? 14 : 13);
  all.ports = version >= 4 ? first(2) : 0;
  all.scopes = version >= 6 ? first(2) : 0;
  return all;
}

bool make_readable(long ruleset, const std::filesystem::path &path) {
  std::error_code error;
  const bool folder = std::filesystem::is_directory(path, error);
  landlock_path_beneath_attr rule{};
  rule.allowed_access =
      LANDLOCK_ACCESS_FS_READ_FILE | (folder ? LANDLOCK_ACCESS_FS_READ_DIR : 0ULL);
  rule.parent_fd = open(path.c_str(), O_PATH | O_CLOEXEC);
  if (rule.parent_fd < 0)
    return false;
  const long failed = syscall(SYS_landlock_add_rule, ruleset, LANDLOCK_RULE_PATH_BENEATH, &rule, 0);
  close(rule.parent_fd);
  return failed == 0;
}

bool wall_off_files(const std::vector<std::filesystem::path> &readable) {
  const long version =
      syscall(SYS_landlock_create_ruleset, nullptr, 0, LANDLOCK_CREATE_RULESET_VERSION);
  if (version < 1)
    return false;
  const Ruleset all = all_that_is_known(version);
  const long ruleset = syscall(SYS_landlock_create_ruleset, &all, sizeof all, 0);
  if (ruleset < 0)
    return false;
  bool stands = true;
  for (const std::filesystem::path &path : readable)
    stands = make_readable(ruleset, path) && stands;
  stands = syscall(SYS_landlock_restrict_self, ruleset, 0) == 0 && stands;
  close(static_cast<int>(ruleset));
  return stands;
}

bool write_to(const char *file, const std::string &text) {
  const int out = open(file, O_WRONLY | O_CLOEXEC);
  const bool written =
      out >= 0 && write(out, text.data(), text.size()) == static_cast<ssize_t>(text.size());
  close(out);
  return written;
}

// Mounts and a network of its own, of which it is the master without being more to anybody else.
bool enter_namespaces() {
  const std::string user = std::to_string(getuid()), group = std::to_string(getgid());
  return unshare(CLONE_NEWUSER | CLONE_NEWNS | CLONE_NEWNET | CLONE_NEWIPC) == 0 &&
         write_to("/proc/self/setgroups", "deny") &&
         write_to("/proc/self/uid_map", user + " " + user + " 1") &&
         write_to("/proc/self/gid_map", group + " " + group + " 1") &&
         mount(nullptr, "/", nullptr, MS_REC | MS_PRIVATE, nullptr) == 0;
}

// What a mount forbids, those that are made from it must forbid too.
unsigned long forbidden_by(int file) {
  struct statvfs status {};
  fstatvfs(file, &status);
  unsigned long flags = MS_RDONLY | MS_NOSUID | MS_NODEV;
  for (const auto &[has, keeps] : {std::pair<unsigned long, unsigned long>{ST_NOEXEC, MS_NOEXEC},
                                   {ST_NOATIME, MS_NOATIME},
                                   {ST_NODIRATIME, MS_NODIRATIME},
                                   {ST_RELATIME, MS_RELATIME}})
    flags |= (status.f_flag & has) != 0 ? keeps : 0;
  return flags;
}

// The same file or folder, by the same name below `root`.
bool show(int file, const std::filesystem::path &path, const std::filesystem::path &root) {
  std::error_code error;
  const std::filesystem::path place = root / path.relative_path();
  struct stat status {};
  fstat(file, &status);
  std::filesystem::create_directories(S_ISDIR(status.st_mode) ? place : place.parent_path(), error);
  if (!S_ISDIR(status.st_mode))
    close(open(place.c_str(), O_RDONLY | O_CREAT | O_CLOEXEC, 0400));
  const std::string source = "/proc/self/fd/" + std::to_string(file);
  return mount(source.c_str(), place.c_str(), nullptr, MS_BIND | MS_REC, nullptr) == 0 &&
         mount(nullptr, place.c_str(), nullptr, MS_BIND | MS_REMOUNT | forbidden_by(file),
               nullptr) == 0;
}

// A root of its own that holds what may be read, and nothing else. What is to be shown is opened
// before, as the new root may lie above it.
bool hide_files(std::vector<std::filesystem::path> readable) {
  if (!enter_namespaces())
    return false;
  // Folders before what lies in them.
  std::sort(readable.begin(), readable.end());
  std::vector<int> opened;
  for (const std::filesystem::path &path : readable)
    opened.push_back(open(path.c_str(), O_PATH | O_CLOEXEC));
  const std::filesystem::path root = std::filesystem::temp_directory_path();
  bool stands =
      mount("none", root.c_str(), "tmpfs", MS_NOSUID | MS_NODEV | MS_NOEXEC, "mode=700") == 0;
  for (std::size_t i = 0; i < opened.size(); ++i) {
    // In a folder that is shown already it has its place.
    std::error_code error;
    const bool shown = std::filesystem::exists(root / readable[i].relative_path(), error);
    stands = stands && (shown || show(opened[i], readable[i], root));
    close(opened[i]);
  }
  return stands && chroot(root.c_str()) == 0 && chdir("/") == 0 &&
         mount(nullptr, "/", nullptr, MS_REMOUNT | MS_RDONLY | MS_NOSUID | MS_NODEV | MS_NOEXEC,
               nullptr) == 0;
}

/// A filter of system calls: what it does not name fails with EPERM.
class Filter {
 public:
  Filter() : filter_(seccomp_init(SCMP_ACT_ERRNO(EPERM)), seccomp_release) {}

  template <class... Conditions>
  void rule(std::uint32_t action, int call, Conditions... conditions) {
    if (call == __NR_SCMP_ERROR || !filter_)
      return;
    const std::initializer_list<scmp_arg_cmp> all{conditions...};
    complete_ &= seccomp_rule_add_array(filter_.get(), action, call,
                                        static_cast<unsigned int>(all.size()), all.begin()) == 0;
  }
  void allow(std::initializer_list<int> calls) {
    for (const int call : calls)
      rule(SCMP_ACT_ALLOW, call);
  }
  bool load() const { return filter_ && complete_ && seccomp_load(filter_.get()) == 0; }

 private:
  std::unique_ptr<void, decltype(&seccomp_release)> filter_;
  bool complete_ = true;
};

scmp_arg_cmp is(unsigned int argument, std::uint64_t value) {
  return {argument, SCMP_CMP_EQ, value, 0};
}

scmp_arg_cmp has_bits(unsigned int argument, std::uint64_t mask, std::uint64_t bits) {
  return {argument, SCMP_CMP_MASKED_EQ, mask, bits};
}

#define CALL(name) SCMP_SYS(name)

void allow_computing(Filter &filter) {
  filter.allow({CALL(brk),          CALL(munmap),
                CALL(mremap),       CALL(madvise),
                CALL(futex),        CALL(set_robust_list),
                CALL(rseq),         CALL(membarrier),
                CALL(sched_yield),  CALL(sched_getaffinity),
                CALL(getcpu),       CALL(exit),
                CALL(exit_group),   CALL(restart_syscall),
                CALL(rt_sigaction), CALL(rt_sigprocmask),
                CALL(rt_sigreturn), CALL(sigaltstack),
                CALL(getpid),       CALL(getppid),
                CALL(gettid),       CALL(getuid),
                CALL(geteuid),      CALL(getgid),
                CALL(getegid),      CALL(getrusage),
                CALL(getrlimit),    CALL(uname),
                CALL(sysinfo),      CALL(getrandom),
                CALL(gettimeofday), CALL(time),
                CALL(times),        CALL(clock_gettime),
                CALL(clock_getres), CALL(clock_nanosleep),
                CALL(nanosleep)});
  // Memory that can be run as a program comes from files of programs alone.
  filter.rule(SCMP_ACT_ALLOW, CALL(mmap), has_bits(2, PROT_EXEC, 0));
  filter.rule(SCMP_ACT_ALLOW, CALL(mprotect), has_bits(2, PROT_EXEC, 0));
  filter.rule(SCMP_ACT_ALLOW, CALL(prlimit64), is(0, 0), is(2, 0));  // asks, does not set
  filter.rule(SCMP_ACT_ALLOW, CALL(prctl), is(0, PR_SET_NAME));
  // abort(), and nobody else's end.
  const auto own = static_cast<std::uint64_t>(getpid());
  filter.rule(SCMP_ACT_ALLOW, CALL(tgkill), is(0, own));
  filter.rule(SCMP_ACT_ALLOW, CALL(kill), is(0, own));
}

// Threads yes, processes no. The flags of clone3 cannot be seen; without it clone is taken.
void allow_threads_only(Filter &filter) {
  filter.rule(SCMP_ACT_ALLOW, CALL(clone), has_bits(0, CLONE_THREAD, CLONE_THREAD));
  filter.rule(SCMP_ACT_KILL_PROCESS, CALL(clone), has_bits(0, CLONE_THREAD, 0));
  filter.rule(SCMP_ACT_ERRNO(ENOSYS), CALL(clone3));
  for (const int call : {CALL(fork), CALL(vfork), CALL(execve), CALL(execveat)})
    filter.rule(SCMP_ACT_KILL_PROCESS, call);
}

void allow_reading(Filter &filter) {
  filter.allow({CALL(read),       CALL(readv),     CALL(pread64),    CALL(write),
                CALL(writev),     CALL(close),     CALL(lseek),      CALL(fstat),
                CALL(stat),       CALL(lstat),     CALL(newfstatat), CALL(statx),
                CALL(access),     CALL(faccessat), CALL(faccessat2), CALL(readlink),
                CALL(readlinkat), CALL(getcwd),    CALL(getdents64), CALL(dup),
                CALL(poll),       CALL(ppoll),     CALL(select)});
  constexpr std::uint64_t writing = O_WRONLY | O_RDWR | O_CREAT | O_TRUNC | O_APPEND;
  filter.rule(SCMP_ACT_ALLOW, CALL(open), has_bits(1, writing, 0));
  filter.rule(SCMP_ACT_ALLOW, CALL(openat), has_bits(2, writing, 0));
  filter.rule(SCMP_ACT_ERRNO(ENOSYS), CALL(openat2));
  filter.rule(SCMP_ACT_ALLOW, CALL(ioctl), is(1, TCGETS));  // whether it is a terminal
  for (const int command : {F_GETFD, F_SETFD, F_GETFL, F_SETFL, F_DUPFD, F_DUPFD_CLOEXEC})
    filter.rule(SCMP_ACT_ALLOW, CALL(fcntl), is(1, static_cast<std::uint64_t>(command)));
}

#undef CALL

bool wall_off_calls() {
  Filter filter;
  allow_computing(filter);
  allow_threads_only(filter);
  allow_reading(filter);
  return filter.load();
}

}  // namespace

Walls confine(const std::vector<std::filesystem::path> &readable, Walls asked) {
  enter_empty_folder();
  const rlimit nothing{0, 0};
  setrlimit(RLIMIT_FSIZE, &nothing);
  std::signal(SIGXFSZ, SIG_IGN);  // a library that writes what nobody asked for gets an error
  prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
  Walls stand;
  stand.landlock = asked.landlock && wall_off_files(readable);
  stand.namespaces = !stand.landlock && asked.namespaces && hide_files(readable);
  stand.seccomp = asked.seccomp && wall_off_calls();
  return stand;
}

}  // namespace tourmaline::mesh
