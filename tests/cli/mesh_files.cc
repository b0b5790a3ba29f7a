#include <gmock/gmock.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <fstream>
#include <iterator>
#include <thread>
#include <vector>

#include "program.h"

namespace {

using testing::HasSubstr;

const std::string square = R"(
Point(1) = {0, 0, 0, 0.5}; Point(2) = {1, 0, 0, 0.5}; Point(3) = {1, 1, 0, 0.5}; Point(4) = {0, 1, 0, 0.5};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
Physical Curve("held") = {2}; Physical Curve("rest") = {1, 3, 4}; Physical Surface("body") = {1};
)";

/// Cases with a mesh file, as somebody may send them.
class MeshFileFromAStranger : public Program {
 protected:
  void put(const std::string &name, const std::string &text) const {
    std::ofstream(here() / name, std::ios::binary) << text;
  }
  void put_case(const std::string &mesh_file, const std::string &title = "a square") const {
    put("case.toml", "title = \"" + title + "\"\nmesh.file = \"" + mesh_file + R"("
material.library = "BaTiO3-Liu2014"
time = { end = 1, steps = 1 }
boundary = [ { on = "held", displacement = [0, 0], potential = 0, temperature = 0 } ]
output.fields = false
output.report = false
)");
  }
};

TEST_F(MeshFileFromAStranger, StartsProgramsOnlyWhenItIsTrusted) {
  put("body.geo", square + "SystemCall \"touch " + (here() / "started").string() + "\";\n");
  put_case("body.geo");
  for (const char *command : {"check case.toml", "run case.toml -o results",
                              "sweep case.toml --vary time.steps=1,2 -o study"}) {
    EXPECT_EQ(run(command), 2) << command;
    EXPECT_THAT(complained_, HasSubstr("--trust")) << command;
    EXPECT_FALSE(std::filesystem::exists(here() / "started")) << command;
    EXPECT_EQ(run(std::string(command) + " --trust"), 0) << command << complained_;
    EXPECT_TRUE(std::filesystem::remove(here() / "started")) << command;
  }
}

// Numbers of the processes that have a text on their command line.
std::vector<pid_t> processes_with(const std::string &text) {
  std::vector<pid_t> found;
  for (const auto &entry : std::filesystem::directory_iterator("/proc")) {
    std::ifstream in(entry.path() / "cmdline");
    const std::string line{std::istreambuf_iterator<char>(in), {}};
    if (line.find(text) != std::string::npos)
      found.push_back(std::stoi(entry.path().filename()));
  }
  return found;
}

TEST_F(MeshFileFromAStranger, EndsWithTheProgram) {
  put("body.geo", square + "For i In {1:1e12}\nEndFor\n");
  put_case("body.geo");
  const std::string file = (here() / "case.toml").string();
  std::thread program([&] { run("check " + file); });
  // The program and its child; a shell has a space between the words.
  const auto readers = [&] { return processes_with(std::string("check\0", 6) + file); };
  const auto wait_until = [&](std::size_t n) {
    for (int i = 0; i < 400 && readers().size() != n; ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    return readers();
  };
  const std::vector<pid_t> both = wait_until(2);
  EXPECT_EQ(both.size(), 2u);
  if (!both.empty())
    kill(*std::min_element(both.begin(), both.end()), SIGKILL);
  program.join();
  EXPECT_TRUE(wait_until(0).empty());
}

TEST_F(MeshFileFromAStranger, IsRefusedWhenItsTextIsNotUtf8) {
  put("body.geo", square);
  const auto refuses = [&](const std::string &piece) {
    for (const char *command : {"check case.toml", "run case.toml -o results"}) {
      EXPECT_EQ(run(command), 2) << piece;
      EXPECT_THAT(complained_, testing::AllOf(HasSubstr("not UTF-8"), HasSubstr(piece)));
      EXPECT_EQ(std::count(complained_.begin(), complained_.end(), '\n'), 1);
    }
  };
  put_case("body.geo", "R\xE4nder");
  refuses("case.toml:1: is not UTF-8: there is the byte 0xE4");
  put("latin1.geo", square + "Physical Curve(\"R\xE4nder\") = {1};\n");
  put_case("latin1.geo");
  refuses("R\\xE4nder");
  put_case("body.geo");
  put("m.toml", "# R\xE4nder\n");
  EXPECT_EQ(run("check case.toml --set material.file=m.toml"), 2);
  EXPECT_THAT(complained_, HasSubstr("m.toml:1: is not UTF-8"));
  EXPECT_EQ(run("check case.toml --set title=$(printf 'R\\344nder')"), 2);
  EXPECT_THAT(complained_, HasSubstr("--set title=R\\xE4nder: is not UTF-8"));
  EXPECT_EQ(
      run("check case.toml", "mkdir $(printf 'R\\344nder'); cp case.toml body.geo R*; cd R*;"), 2);
  EXPECT_THAT(complained_, HasSubstr("R\\xE4nder/body.geo); rename the folder"));
}

}  // namespace
