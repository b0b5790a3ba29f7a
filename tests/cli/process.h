#pragma once

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <iterator>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "program.h"

/// A process of the program, at work while the test goes on.
class Process {
 public:
  Process(const std::string &arguments, const std::filesystem::path &folder,
          const std::filesystem::path &said) {
    std::istringstream words(arguments);
    std::vector<std::string> all{std::istream_iterator<std::string>(words), {}};
    all.insert(all.begin(), binary());
    std::vector<char *> argv;
    for (std::string &argument : all)
      argv.push_back(argument.data());
    argv.push_back(nullptr);
    id_ = fork();
    if (id_ == 0) {
      // Jobs in the background of a script, and those under nohup, ignore them.
      for (const int ignored : {SIGINT, SIGHUP})
        signal(ignored, SIG_DFL);
      const int out = open(said.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
      dup2(out, STDOUT_FILENO);
      dup2(out, STDERR_FILENO);
      if (chdir(folder.c_str()) == 0)
        execv(argv[0], argv.data());
      _exit(127);
    }
  }
  ~Process() {
    if (id_ > 0) {
      kill(id_, SIGKILL);
      wait();
    }
  }
  Process(const Process &) = delete;
  Process &operator=(const Process &) = delete;

  pid_t id() const { return id_; }
  void send(int signal) const { kill(id_, signal); }
  bool is_at_work() const {
    return waitid(P_PID, id_, &info_, WEXITED | WNOHANG | WNOWAIT) == 0 && info_.si_pid == 0;
  }
  /// The exit status, or minus the signal that ended it.
  int wait() {
    int status = 0;
    waitpid(id_, &status, 0);
    id_ = -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  }
  /// Whether the file was there before the process ended.
  bool leaves(const std::filesystem::path &file) const {
    while (is_at_work()) {
      if (std::filesystem::exists(file))
        return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return std::filesystem::exists(file);
  }

 private:
  pid_t id_ = -1;
  mutable siginfo_t info_{};
};
