#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace tourmaline::sweep {

/// What `tourmaline sweep` was asked for.
struct Request {
  std::filesystem::path file;           ///< the case
  std::vector<std::string> overrides;   ///< as after `--set`
  std::vector<std::string> variations;  ///< as after `--vary`
  std::vector<std::string> outputs;     ///< empty: the usual ones
  std::filesystem::path folder;         ///< of the study
  /// The program, in a copy of this process and with these words behind its name: its exit status.
  std::function<int(std::vector<std::string>)> program;
  int jobs = 0;  ///< members side by side; 0: as many as cores, their threads and memory allow
  bool quiet = false;
  bool trust = false;  ///< of scripts of geometries: mesh::Reading::trusted
};

/// A member that failed, with the exit status and the error of its run.
struct Failure {
  std::string member, reason;
  int status = 0;
};

/// What a study came to.
struct Outcome {
  std::size_t members = 0;
  std::size_t kept = 0;     ///< were done before
  std::size_t missing = 0;  ///< were not run to their end because of the signal
  int signal = 0;           ///< SIGHUP, SIGINT or SIGTERM when one stopped it
  std::vector<Failure> failures;
  std::map<std::string, std::vector<std::string>> warnings;  ///< and the members that have them
  std::vector<std::filesystem::path> files;  ///< the table, and the plot when a member is done
  std::string unwritten;                     ///< why these could not be written

  /// Of the command: 128 + signal; the greatest of the failures, 4 where files are unwritten; 0.
  int exit_status() const;
};

/// Runs the members of a study, each as a copy of this process in a folder of its own, and leaves
/// sweep.csv and sweep.svg. A member whose folder holds the finished run of the same case, of files
/// with the same content, is not run again; one that was interrupted goes on, or starts from the
/// beginning where it cannot. Every member is read and checked before the first runs. A failed one
/// does not stop the others. SIGHUP, SIGINT and SIGTERM end those that run, what is done stays.
/// Throws CaseError, MachineError.
Outcome run(const Request &request);

}  // namespace tourmaline::sweep
