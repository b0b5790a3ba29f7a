#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "../cases/equal_quantities.h"
#include "../cases/read_table.h"
#include "../output/temporary_folder.h"

namespace tourmaline::verified {

struct Outcome {
  int status;
  std::string said;
};

/// Runs the program as a user would; more ranks than cores are allowed.
inline Outcome run_on(int ranks, const std::string &arguments,
                      const std::filesystem::path &folder) {
  const char *given = std::getenv("TOURMALINE_BINARY");
  const std::string program = given ? given : TOURMALINE_BINARY;
  const std::filesystem::path said = folder.string() + ".stderr";
  const std::string launcher =
      ranks == 1 ? "" : "mpirun --oversubscribe --bind-to none -np " + std::to_string(ranks) + " ";
  const int status = std::system((launcher + program + " run " + arguments + " -q -o '" +
                                  folder.string() + "' > /dev/null 2> '" + said.string() + "'")
                                     .c_str());
  return {WEXITSTATUS(status), output::content_of(said)};
}

inline int count(const std::string &text, const std::string &piece) {
  int found = 0;
  for (std::size_t at = text.find(piece); at != std::string::npos; at = text.find(piece, at + 1))
    ++found;
  return found;
}

inline void expect_equal_tables(const Table &one, const Table &several) {
  ASSERT_FALSE(one.columns.empty());
  for (const auto &[name, values] : one.columns) {
    SCOPED_TRACE(name);
    ASSERT_TRUE(several.columns.contains(name));
    ASSERT_EQ(several.n_rows(), one.n_rows());
    if (name == "status" || name == "contact")
      EXPECT_EQ(several.columns.at(name), values);
    else
      EXPECT_LE(difference(several, one, name), 1e-9);
  }
}

/// What a run leaves in its folder.
struct Results {
  Table nodes, contact, history;
};

inline Results results_in(const std::filesystem::path &folder) {
  return {read_table(folder / "nodes.csv"), read_table(folder / "contact.csv"),
          read_table(folder / "history.csv")};
}

inline void expect_equal_results(const Results &one, const Results &several) {
  expect_equal_tables(one.nodes, several.nodes);
  expect_equal_tables(one.contact, several.contact);
}

/// A case on one rank and on as many as the parameter says; ranks.cc says on how many.
class Ranks : public ::testing::TestWithParam<int> {
 protected:
  std::string file_of(const std::string &text) const {
    std::ofstream(folder_ / "case.toml") << text;
    return folder_ / "case.toml";
  }

  /// Fills `one_` and `several_`.
  void run_twice(const std::string &arguments) {
    const Outcome one = run_on(1, arguments, folder_ / "one");
    ASSERT_EQ(one.status, 0) << one.said;
    const Outcome several = run_on(GetParam(), arguments, folder_ / "several");
    ASSERT_EQ(several.status, 0) << several.said;
    one_ = results_in(folder_ / "one");
    several_ = results_in(folder_ / "several");
  }

  void expect_same(const std::string &arguments) {
    ASSERT_NO_FATAL_FAILURE(run_twice(arguments));
    expect_equal_results(one_, several_);
  }

  void expect_told_once(const std::string &arguments, int status, const std::string &piece) const {
    const Outcome outcome = run_on(GetParam(), arguments, folder_ / "several");
    EXPECT_EQ(outcome.status, status);
    EXPECT_EQ(count(outcome.said, "tourmaline: "), 1) << outcome.said;
    EXPECT_THAT(outcome.said, ::testing::HasSubstr(piece));
  }

  const output::TemporaryFolder folder_;
  Results one_, several_;
  const std::string paper_ = std::string(TOURMALINE_SOURCE_DIR) +
                             "/cases/ouafik-2020/conductive.toml --set mesh.box.cells=[16,16] "
                             "--set time.steps=5 ";
};

}  // namespace tourmaline::verified
