#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <string>

inline std::string contents(const std::filesystem::path &file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

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
  void SetUp() override {
    std::string name = testing::TempDir() + "/tourmaline-XXXXXX";
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    folder_ = name;
    std::filesystem::create_directory(folder_ / "here");
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path here() const { return folder_ / "here"; }

  /// `before`: shell commands that it is run behind.
  int run(const std::string &arguments, const std::string &before = "") {
    const std::string command = "cd '" + here().string() + "' && { " + before + " '" + binary() +
                                "' " + arguments + "; } > ../stdout 2> ../stderr < /dev/null";
    const int status = std::system(command.c_str());
    said_ = contents(folder_ / "stdout");
    complained_ = contents(folder_ / "stderr");
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  std::filesystem::path folder_;
  std::string said_, complained_;
};
