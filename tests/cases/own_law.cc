// Friction laws that a caller brings along.
#include <gmock/gmock.h>

#include <algorithm>

#include "run_case.h"
#include "tourmaline/case/case.h"
#include "tourmaline/error.h"
#include "tourmaline/run/simulation.h"

namespace tourmaline::verified {
namespace {

using contact::Tangent;
using contact::TangentMatrix;

/// Tresca's law as somebody else's.
class Borrowed : public contact::FrictionLaw {
 public:
  explicit Borrowed(double bound) : law_{bound} {}
  double dissipation(const Tangent &d) const override { return law_.dissipation(d); }
  Tangent traction(const Tangent &trial) const override { return law_.traction(trial); }
  TangentMatrix traction_derivative(const Tangent &trial) const override {
    return law_.traction_derivative(trial);
  }
  ContactStatus status(const Tangent &trial) const override { return law_.status(trial); }
  bool is_smooth_at(const Tangent &d) const override { return law_.is_smooth_at(d); }
  Tangent gradient(const Tangent &d) const override { return law_.gradient(d); }
  TangentMatrix hessian(const Tangent &d) const override { return law_.hessian(d); }

 private:
  contact::Tresca law_;
};

/// Other bounds for the two senses of a line.
class OneWay : public contact::FrictionLaw {
 public:
  OneWay(double forwards, double backwards) : forwards_(forwards), backwards_(backwards) {}
  double dissipation(const Tangent &d) const override { return d[0] * gradient(d)[0]; }
  Tangent traction(const Tangent &trial) const override {
    return Tangent::Constant(1, std::clamp(trial[0], -backwards_, forwards_));
  }
  TangentMatrix traction_derivative(const Tangent &trial) const override {
    return TangentMatrix::Constant(1, 1, traction(trial) == trial);
  }
  ContactStatus status(const Tangent &trial) const override {
    return traction(trial) == trial ? ContactStatus::stick : ContactStatus::slip;
  }
  bool is_smooth_at(const Tangent &d) const override { return d[0] != 0; }
  Tangent gradient(const Tangent &d) const override {
    return Tangent::Constant(1, d[0] > 0 ? forwards_ : -backwards_);
  }
  TangentMatrix hessian(const Tangent &) const override { return TangentMatrix::Zero(1, 1); }

 private:
  double forwards_, backwards_;
};

casefile::Case asked_for(const std::string &file, const std::vector<std::string> &overrides) {
  return casefile::read_file(std::filesystem::path(TOURMALINE_SOURCE_DIR) / file, overrides,
                             mesh::read_mesh_file);
}

class OwnLaw : public ::testing::TestWithParam<const char *> {
 protected:
  std::vector<std::string> with(std::vector<std::string> overrides) const {
    overrides.push_back(GetParam());
    return overrides;
  }
};

TEST_P(OwnLaw, ThatIsTrescasGivesWhatTrescasGives) {
  const output::TemporaryFolder own, shipped;
  const casefile::Case asked =
      asked_for("cases/block-3d/twisted.toml", with({"mesh.box.cells=[4,4,4]", "time.steps=4"}));
  run::simulate(asked, shipped.path(), {.quiet = true});
  run::simulate(asked, own.path(),
                {.quiet = true,
                 .friction =
                     [](const contact::ContactPlace &) {
                       return contact::OwnLaw{std::make_shared<Borrowed>(15.)};
                     },
                 .friction_name = "Tresca's, 15 N/m^2"});
  EXPECT_EQ(output::content_of(own / "contact.csv"), output::content_of(shipped / "contact.csv"));
}

// The sensor's pad is sheared back and forth until it slips in both senses.
TEST_P(OwnLaw, MayHaveOtherBoundsForTheTwoSenses) {
  const double right = 5e4, left = 2e4;
  const output::TemporaryFolder folder;
  run::simulate(asked_for("cases/devices/friction-sensor.toml", with({"output.fields=false"})),
                folder.path(),
                {.quiet = true,
                 .friction =
                     [=](const contact::ContactPlace &place) {
                       const bool along = place.directions(0, 0) > 0;
                       return contact::OwnLaw{along ? std::make_shared<OneWay>(right, left)
                                                    : std::make_shared<OneWay>(left, right)};
                     },
                 .friction_name = "one way"});
  const std::vector<double> traction =
      read_table(folder / "contact.csv").numbers("tangential_traction_x");
  const auto [least, greatest] = std::minmax_element(traction.begin(), traction.end());
  EXPECT_NEAR(*least, -right, 1e-9 * right);
  EXPECT_NEAR(*greatest, left, 1e-9 * left);
}

INSTANTIATE_TEST_SUITE_P(Routes, OwnLaw,
                         ::testing::Values("solver.body=direct", "solver.body=iterative",
                                           "solver.method=monolithic"));

TEST(SeveralContacts, AProgramsLawIsToldWhichContactItIsAskedFor) {
  const output::TemporaryFolder own, shipped;
  const casefile::Case asked =
      asked_for("cases/clamped-block/block.toml",
                {"contact[1].normal=bilateral", "contact[1].friction={law='tresca', bound=1e5}",
                 "output={fields=false, report=false}", "time.steps=5"});
  run::simulate(asked, shipped.path(), {.quiet = true});
  run::simulate(
      asked, own.path(),
      {.quiet = true,
       .friction =
           [](const contact::ContactPlace &place) {
             return contact::OwnLaw{std::make_shared<Borrowed>(place.contact == 0 ? 2e5 : 1e5)};
           },
       .friction_name = "Tresca's, 2e5 and 1e5 N/m^2"});
  EXPECT_EQ(output::content_of(own / "contact.csv"), output::content_of(shipped / "contact.csv"));
}

TEST(OwnLaws, NeedANameOfOneLineAndAContact) {
  using ::testing::HasSubstr;
  using ::testing::ThrowsMessage;
  const output::TemporaryFolder folder;
  casefile::Case asked = asked_for("cases/ouafik-2020/conductive.toml", {});
  run::RunOptions options{.quiet = true, .friction = [](const contact::ContactPlace &) {
                            return contact::OwnLaw{std::make_shared<Borrowed>(15.)};
                          }};
  const auto run = [&] { run::simulate(asked, folder / "run", options); };
  for (const char *name : {"", " ", "two\nlines"}) {
    options.friction_name = name;
    EXPECT_THAT(run, ThrowsMessage<CaseError>(HasSubstr("without a name")));
  }
  options.friction_name = "Tresca's";
  asked.contacts.clear();
  EXPECT_THAT(run, ThrowsMessage<CaseError>(HasSubstr("has no [contact]")));
  options.friction = {};
  EXPECT_THAT(run, ThrowsMessage<CaseError>(HasSubstr("and gives none")));
  EXPECT_FALSE(std::filesystem::exists(folder / "run"));
}

}  // namespace
}  // namespace tourmaline::verified
