// Label: other code. The cases of tests/reference/contact_laws, which an independent program solved
// from the documents alone; its README says how, and why these solutions are the only ones.

#include <array>
#include <limits>

#include "closed_balances.h"
#include "run_case.h"

namespace tourmaline::verified {
namespace {

namespace fs = std::filesystem;

const char *const folder = "tests/reference/contact_laws";

std::vector<std::string> laws_cases() {
  std::vector<std::string> names;
  for (const auto &entry :
       fs::directory_iterator(fs::path(TOURMALINE_SOURCE_DIR) / folder / "cases"))
    names.push_back(entry.path().stem());
  std::sort(names.begin(), names.end());
  return names;
}

using Place = std::array<long, 2>;

// In nanometres.
Place place(double x, double y) {
  return {std::lround(x * 1e9), std::lround(y * 1e9)};
}

/// Rows of a table by their places, of contact.csv those of one step.
std::map<Place, std::size_t> by_place(const Table &table, int step = 0) {
  const std::vector<double> x = table.numbers("x"), y = table.numbers("y");
  const std::vector<double> steps = step ? table.numbers("step") : std::vector<double>();
  std::map<Place, std::size_t> rows;
  for (std::size_t i = 0; i < x.size(); ++i)
    if (!step || steps[i] == step)
      rows[place(x[i], y[i])] = i;
  return rows;
}

/// Columns of one unit, by the largest of which one that is nothing but round-off is measured.
using Kinds = std::vector<std::vector<std::string>>;

/// By column the largest difference, and the largest value that is expected.
struct Differences {
  std::map<std::string, double> largest, size;

  void add(const std::string &column, double value, double expected) {
    EXPECT_TRUE(std::isfinite(value)) << column;
    largest[column] = std::max(largest[column], std::abs(value - expected));
    size[column] = std::max(size[column], std::abs(expected));
  }
  void expect_below(double tolerance, const Kinds &kinds) const {
    for (const std::vector<std::string> &kind : kinds) {
      double of_kind = 0;
      for (const std::string &column : kind)
        of_kind = std::max(of_kind, size.at(column));
      for (const std::string &column : kind) {
        const double scale = size.at(column) > 1e-9 * of_kind ? size.at(column) : of_kind;
        EXPECT_LE(largest.at(column), tolerance * scale) << column;
      }
    }
  }
};

// Each case is run once for all of its tests.
const RunCase &run_of(const std::string &name) {
  static std::map<std::string, RunCase> runs;
  return runs.try_emplace(name, std::string(folder) + "/cases/" + name + ".toml").first->second;
}

class ContactLaws : public ::testing::TestWithParam<std::string> {
 protected:
  ContactLaws() : run_(run_of(GetParam())) {
    std::ifstream in(fs::path(TOURMALINE_SOURCE_DIR) / folder / "results" / (GetParam() + ".json"));
    theirs_ = nlohmann::json::parse(in);
  }

  const RunCase &run_;
  nlohmann::json theirs_;
};

TEST_P(ContactLaws, AgreeWithTheIndependentProgramAtEveryContactNodeAndStep) {
  Kinds kinds{{"normal_traction", "tangential_traction_x", "tangential_traction_y"},
              {"normal_displacement", "slip_x", "slip_y", "gap"},
              {"slip_rate"},
              {"temperature"},
              {"potential"},
              {"heat_flux"}};
  const Table table = run_.contact();
  if (table.columns.contains("accumulated_slip"))
    kinds[1].push_back("accumulated_slip");
  std::map<std::string, std::vector<double>> ours;
  for (const auto &kind : kinds)
    for (const std::string &column : kind)
      ours[column] = table.numbers(column);
  Differences differences;
  std::size_t n_rows = 0;
  for (const nlohmann::json &step : theirs_.at("steps")) {
    const auto rows = by_place(table, step.at("step"));
    const nlohmann::json &contact = step.at("contact");
    for (std::size_t i = 0; i < contact.at("x").size(); ++i, ++n_rows) {
      const auto row = rows.find(place(contact["x"][i], contact["y"][i]));
      ASSERT_NE(row, rows.end());
      for (const auto &[column, values] : ours)
        differences.add(column, values[row->second], contact.at(column)[i]);
    }
  }
  EXPECT_EQ(n_rows, table.n_rows());
  // A rate is round-off where it moves nothing.
  const double moved =
      std::max(differences.size["normal_displacement"], differences.size["slip_x"]);
  double &rate = differences.size["slip_rate"];
  if (rate < 1e-9 * moved / table.numbers("time")[0])
    rate = moved / table.numbers("time")[0];
  differences.expect_below(1e-9, kinds);
}

// Without friction stick or slip says nothing.
TEST_P(ContactLaws, HaveTheStatusesOfTheIndependentProgram) {
  const bool has_friction = theirs_.at("friction_law") != "none";
  const Table table = run_.contact();
  const std::vector<std::string> &ours = table.columns.at("status");
  for (const nlohmann::json &step : theirs_.at("steps")) {
    const auto rows = by_place(table, step.at("step"));
    const nlohmann::json &contact = step.at("contact");
    for (std::size_t i = 0; i < contact.at("x").size(); ++i) {
      const std::string expected = contact.at("status")[i];
      const std::string &status = ours[rows.at(place(contact["x"][i], contact["y"][i]))];
      if (has_friction || expected == "open" || status == "open") {
        EXPECT_EQ(status, expected) << "step " << step.at("step") << ", node " << i;
      }
    }
  }
}

TEST_P(ContactLaws, AgreeWithTheIndependentProgramInsideTheBody) {
  const Table table = run_.nodes(), contact = run_.contact();
  const auto rows = by_place(table);
  const nlohmann::json &nodes = theirs_.at("nodes");
  Differences differences;
  for (const char *column : {"u_x", "u_y", "potential", "temperature"}) {
    const std::vector<double> ours = table.numbers(column);
    differences.size[column] = theirs_.at("largest").at(column);
    // A body that is free at the end has fields that are nothing beside those that it had.
    if (contact.columns.contains(column))
      differences.size[column] = std::max(differences.size[column], largest(contact, column));
    for (std::size_t i = 0; i < nodes.at("x").size(); ++i)
      differences.add(column, ours[rows.at(place(nodes["x"][i], nodes["y"][i]))],
                      nodes.at(column)[i]);
  }
  differences.expect_below(1e-9, {{"u_x", "u_y"}, {"potential"}, {"temperature"}});
}

TEST_P(ContactLaws, BalancesOfEnergyForcesChargeAndHeatCloseInEveryStep) {
  const Table history = run_.history();
  expect_closed_balances(history);
}

/// A column of history.csv, zero where the case has none.
std::vector<double> column_or_zero(const Table &history, const std::string &column) {
  return history.columns.contains(column) ? history.numbers(column)
                                          : std::vector<double>(history.n_rows(), 0.);
}

/// The balance of energy of each step, put together from the columns, and the sum of the sizes of
/// its terms.
struct EnergyBalance {
  explicit EnergyBalance(const Table &history)
      : lack(history.n_rows(), 0.), size(history.n_rows(), 0.) {
    for (const char *gained : {"load_power", "electric_power", "thermal_power", "foundation_power"})
      add(column_or_zero(history, gained), -1);
    for (const char *spent : {"stored_energy_rate", "friction_dissipation", "conduction_loss",
                              "time_step_loss", "contact_dissipation"})
      add(column_or_zero(history, spent), 1);
    const std::vector<double> times = history.numbers("time");
    std::vector<double> stored = column_or_zero(history, "contact_energy");
    for (std::size_t n = stored.size(); n-- > 0;)
      stored[n] = (stored[n] - (n ? stored[n - 1] : 0)) / times[0];
    add(stored, 1);
    // What is stored is a difference of these, and as uncertain as they are.
    for (const char *energy :
         {"elastic_energy", "electric_energy", "thermal_energy", "contact_energy"})
      for (std::size_t n = 0; n < size.size(); ++n)
        size[n] += column_or_zero(history, energy)[n] / times[0];
  }
  void add(const std::vector<double> &terms, double sign) {
    for (std::size_t n = 0; n < terms.size(); ++n) {
      lack[n] += sign * terms[n];
      size[n] += std::abs(terms[n]);
    }
  }
  std::vector<double> lack, size;
};

TEST_P(ContactLaws, TheColumnsOfEnergyAddUpToItsBalance) {
  const Table history = run_.history();
  const EnergyBalance balance(history);
  // A body that has come off moves far more than it deforms, and what the stiffness times these
  // motions would be cancels up to round-off.
  const double stiffness = 1.5e11, moved = largest(history, "max_displacement");
  const double round_off = std::numeric_limits<double>::epsilon() * stiffness * moved * moved *
                           static_cast<double>(run_.nodes().n_rows()) / history.numbers("time")[0];
  for (std::size_t n = 0; n < balance.lack.size(); ++n)
    EXPECT_LE(std::abs(balance.lack[n]), 1e-10 * balance.size[n] + round_off) << n;
}

TEST_P(ContactLaws, FrictionAndAYieldingFoundationOnlyTakeEnergy) {
  const Table history = run_.history();
  const EnergyBalance balance(history);
  for (const char *column : {"friction_dissipation", "contact_dissipation"}) {
    const std::vector<double> taken = column_or_zero(history, column);
    for (std::size_t n = 0; n < taken.size(); ++n)
      EXPECT_GE(taken[n], -1e-12 * balance.size[n]) << column << " " << n;
  }
}

TEST_P(ContactLaws, TheEulerStepOnlyTakesEnergy) {
  const Table history = run_.history();
  const EnergyBalance balance(history);
  const std::vector<double> loss = history.numbers("time_step_loss");
  for (std::size_t n = 0; n < loss.size(); ++n)
    EXPECT_GE(loss[n], -1e-12 * balance.size[n]) << n;
}

INSTANTIATE_TEST_SUITE_P(Cases, ContactLaws, ::testing::ValuesIn(laws_cases()),
                         [](const auto &name) {
                           std::string text = name.param;
                           std::replace(text.begin(), text.end(), '-', '_');
                           return text;
                         });

}  // namespace
}  // namespace tourmaline::verified
