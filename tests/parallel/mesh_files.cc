// Of several ranks one reads the mesh file, and all have its mesh, or its error.

#include <fmt/format.h>

#include "ranks.h"

namespace tourmaline::verified {
namespace {

namespace fs = std::filesystem;

// Bonded halves.
const char *const two_halves = R"toml(
mesh.file = "halves.msh"
region = [ { on = "left half", material.library = "BaTiO3-Liu2014" },
           { on = "right half", material.library = "BaTiO3-Liu2014" } ]
time = { end = 0.2, steps = 2 }
boundary = [ { on = "held", displacement = [0, 0], potential = 0, temperature = 0 },
             { on = "pressed", traction = [0, "-1000*t"] } ]
contact = { on = "rubbed", friction = { law = "tresca", bound = 200 } }
)toml";

// Four squares of 1 cm, two in each half.
const char *const halves = R"msh($MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
5
1 1 "held"
1 2 "pressed"
1 3 "rubbed"
2 4 "left half"
2 5 "right half"
$EndPhysicalNames
$Nodes
9
1 0 0 0
2 0.01 0 0
3 0.02 0 0
4 0 0.01 0
5 0.01 0.01 0
6 0.02 0.01 0
7 0 0.02 0
8 0.01 0.02 0
9 0.02 0.02 0
$EndNodes
$Elements
12
1 1 2 3 1 1 2
2 1 2 3 1 2 3
3 1 2 1 2 3 6
4 1 2 1 2 6 9
5 1 2 2 3 7 8
6 1 2 2 3 8 9
7 1 2 1 4 1 4
8 1 2 1 4 4 7
9 3 2 4 5 1 2 5 4
10 3 2 4 5 4 5 8 7
11 3 2 5 6 2 3 6 5
12 3 2 5 6 5 6 9 8
$EndElements
)msh";

class MeshFileOnRanks : public Ranks {
 protected:
  void SetUp() override {
    case_ = file_of(two_halves);
    std::ofstream(folder_ / "halves.msh") << halves;
  }

  // The other ranks are given another case file than the first one.
  Outcome run_with_another(const fs::path &other) const {
    const fs::path said = folder_ / "said";
    const auto on = [&](int ranks, const std::string &file) {
      return fmt::format("--bind-to none -np {} {} run {} -q -o {}", ranks, TOURMALINE_BINARY, file,
                         (folder_ / "several").string());
    };
    const int status =
        std::system(fmt::format("mpirun --oversubscribe {} : {} > /dev/null 2> {}", on(1, case_),
                                on(GetParam() - 1, other), said.string())
                        .c_str());
    return {WEXITSTATUS(status), output::content_of(said)};
  }

  static void expect_same_body(const Results &one, const Results &several) {
    expect_equal_quantities(several.nodes, one.nodes, {{"u_x", "u_y"}, {"potential"}});
    expect_equal_quantities(several.contact, one.contact,
                            {{"normal_traction", "tangential_traction_y"}});
  }

  fs::path case_;
};

TEST_P(MeshFileOnRanks, IsTheSame) {
  ASSERT_NO_FATAL_FAILURE(run_twice(case_));
  expect_same_body(one_, several_);
}

// As on machines that do not share their disks.
TEST_P(MeshFileOnRanks, IsReadByTheFirstAlone) {
  fs::create_directory(folder_ / "elsewhere");
  fs::copy(case_, folder_ / "elsewhere");
  const Outcome several = run_with_another(folder_ / "elsewhere" / "case.toml");
  ASSERT_EQ(several.status, 0) << several.said;
  ASSERT_EQ(run_on(1, case_, folder_ / "one").status, 0);
  expect_same_body(results_in(folder_ / "one"), results_in(folder_ / "several"));
}

TEST_P(MeshFileOnRanks, ThatIsMissingOrDamagedIsToldOnce) {
  fs::rename(folder_ / "halves.msh", folder_ / "other.msh");
  expect_told_once(case_, 2, "there is no such file");
  std::ofstream(folder_ / "halves.msh") << std::string(halves).substr(0, 300);
  expect_told_once(case_, 2, "halves.msh");
}

// Which takes ten seconds.
using CaseOnRanks = MeshFileOnRanks;

TEST_P(CaseOnRanks, ThatOneAloneDoesNotFindEndsAll) {
  const Outcome several = run_with_another(folder_ / "missing.toml");
  EXPECT_EQ(several.status, 2);
  EXPECT_THAT(several.said, ::testing::HasSubstr("missing.toml"));
  EXPECT_THAT(several.said, ::testing::HasSubstr("other ranks have no such error"));
}

INSTANTIATE_TEST_SUITE_P(Two, MeshFileOnRanks, ::testing::Values(2));
INSTANTIATE_TEST_SUITE_P(Two, CaseOnRanks, ::testing::Values(2));
INSTANTIATE_TEST_SUITE_P(Four, MeshFileOnRanks, ::testing::Values(4));

}  // namespace
}  // namespace tourmaline::verified
