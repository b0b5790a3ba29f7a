#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <set>
#include <string>

#include "../output/temporary_folder.h"

using tourmaline::output::content_of;

inline std::set<std::string> files_below(const std::filesystem::path &folder) {
  std::set<std::string> files;
  for (const auto &entry : std::filesystem::recursive_directory_iterator(folder))
    files.insert(entry.path().lexically_relative(folder).string());
  return files;
}

inline std::string binary() {
  const char *given = std::getenv("TOURMALINE_BINARY");
#ifdef TOURMALINE_BINARY
  return given ? given : TOURMALINE_BINARY;
#else
  return given ? given : "tourmaline";
#endif
}

/// An empty folder to run the program in, and what it said there.
class Program : public testing::Test {
 protected:
  Program() { std::filesystem::create_directory(here()); }

  std::filesystem::path here() const { return folder_ / "here"; }

  /// `before`: shell commands that it is run behind.
  int run(const std::string &arguments, const std::string &before = "") {
    const std::string command = "cd '" + here().string() + "' && { " + before + " '" + binary() +
                                "' " + arguments + "; } > ../stdout 2> ../stderr < /dev/null";
    const int status = std::system(command.c_str());
    said_ = content_of(folder_ / "stdout");
    complained_ = content_of(folder_ / "stderr");
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  tourmaline::output::TemporaryFolder folder_;
  std::string said_, complained_;
};
