#include "result.h"

#include "../cases/run_case.h"

namespace tourmaline::verified {
namespace {

using Eigen::MatrixXd;

// The columns of a table whose names begin and end so; those of a vector are x, y, z.
struct Quantity {
  std::string table, begin, end;
  Dimension dimension;
  bool is_vector = false, is_linear = true;

  // In 2D of a metre of depth: sums over the body, not voltages.
  bool is_of_depth() const { return table == "history" && dimension.voltage != 1; }
  bool is_place() const { return is_vector && begin.empty(); }
  std::string name() const { return table + " " + begin + "*" + end; }
  bool has(const std::string &column) const {
    return column.starts_with(begin) && column.ends_with(end) &&
           (!is_vector || column.size() == begin.size() + 1);
  }
};

const std::vector<Quantity> &all_quantities() {
  constexpr bool vector = true;
  constexpr Dimension energy{1, 1}, power{1, 1, 0, 0, -1}, charge{1, 1, -1}, stress{-2, 1},
      charge_density{-1, 1, -1};
  static const std::vector<Quantity> all{
      {"nodes", "", "", {1}, vector},  // places
      {"nodes", "u_", "", {1}, vector},
      {"nodes", "potential", "", {0, 0, 1}},
      {"nodes", "temperature", "", {0, 0, 0, 1}},
      {"contact", "", "", {1}, vector},
      {"contact", "normal_traction", "", stress},
      {"contact", "tangential_traction_", "", stress, vector},
      {"contact", "slip_", "", {1}, vector},
      {"contact", "slip_rate", "", {1, 0, 0, 0, -1}, false, false},
      {"contact", "heat_flux", "", {-1, 1, 0, 0, -1}},
      {"contact", "gap", "", {1}},
      {"contact", "charge_flux", "", charge_density},
      {"contact", "temperature", "", {0, 0, 0, 1}},
      {"contact", "potential", "", {0, 0, 1}},
      {"history", "m", "_potential", {0, 0, 1}, false, false},  // least and greatest
      {"history", "", "_energy", energy, false, false},
      {"history", "", "_power", power, false, false},
      {"history", "", "_loss", power, false, false},
      {"history", "friction_dissipation", "", power, false, false},
      {"history", "load_", "", {0, 1}, vector},
      {"history", "reaction_", "", {0, 1}, vector},
      {"history", "contact_force_", "", {0, 1}, vector},
      {"history", "charge_side", "", charge},
      {"history", "electrode_", "_charge", charge},
      {"history", "electrode_", "_voltage", {0, 0, 1}},
      {"history", "electrode_", "_current", {1, 1, -1, 0, -1}},
      {"history", "heat_side", "", power}};
  return all;
}

MatrixXd values(const Table &table, const Quantity &quantity) {
  MatrixXd all(table.n_rows(), 0);
  for (const auto &[name, cells] : table.columns)
    if (quantity.has(name)) {
      const std::vector<double> column = table.numbers(name);
      all.conservativeResize(Eigen::NoChange, all.cols() + 1);
      all.rightCols(1) = Eigen::Map<const Eigen::VectorXd>(column.data(), all.rows());
    }
  return all;
}

// Points that stick have slips, and so dissipation, of round-off, those without friction such
// tangential tractions, and where nothing comes from outside add up to such forces and charges.
// Charges held at a conductor are sums of much larger ones between its nodes.
void measure(Result &result, double step, bool conducts) {
  auto &all = result.quantities;
  for (auto &[name, values] : all)
    values.size = values.all.size() > 0 ? values.all.cwiseAbs().maxCoeff() : 0;
  const auto at_least = [&](const char *name, double size) {
    if (const auto found = all.find(name); found != all.end())
      found->second.size = std::max(found->second.size, size);
  };
  const MatrixXd &extremes = all.at("history m*_potential").all;  // greatest, least
  const MatrixXd &places = all.at("nodes *").all;
  const double side = std::pow(
      (places.colwise().maxCoeff() - places.colwise().minCoeff()).maxCoeff(), places.cols() - 1);
  double charge =
      all.at("history *_energy").size / (extremes.col(0) - extremes.col(1)).cwiseAbs().maxCoeff();
  if (const auto crossing = all.find("contact charge_flux*"); crossing != all.end())
    charge = std::max(charge, crossing->second.size * side);
  if (conducts)
    charge *= 10;
  const double force = all.at("history *_energy").size / all.at("nodes u_*").size;
  at_least("history reaction_*", force);
  at_least("history contact_force_*", force);
  at_least("contact slip_*", all.at("nodes u_*").size);
  at_least("contact gap*", all.at("nodes u_*").size);
  at_least("contact slip_rate*", all.at("nodes u_*").size / step);
  at_least("history friction_dissipation*", all.at("history *_power").size);
  at_least("history charge_side*", charge);
  at_least("history electrode_*_charge", charge);
  at_least("history electrode_*_current", charge / step);
  if (!all.contains("contact *"))
    return;
  at_least("contact normal_traction*", force / side);
  at_least("contact tangential_traction_*", all.at("contact normal_traction*").size);
}

// What the run itself says of its digits: the estimated forward error, and what balances lack. The
// permittivity of a conductor, 10^6 times the others', costs charges some seven digits of sixteen.
double uncertainty(const nlohmann::json &summary, const Table &history, bool conducts) {
  EXPECT_LT(summary["backward_error"], 1e-12);
  double worst = conducts ? 5e-10 : 0;
  if (!summary["forward_error"].is_null())
    worst = std::max(worst, double(summary["forward_error"]));
  for (const auto &[name, cells] : history.columns)
    if (name.ends_with("_imbalance"))
      worst = std::max(worst, largest(history, name));
  return worst;
}

// For each place the row of the nearest one of `others` in the same step.
std::vector<Eigen::Index> partners(const MatrixXd &places, const MatrixXd &others, int steps) {
  std::vector<Eigen::Index> partner(places.rows());
  const Eigen::Index n = places.rows() / steps;
  for (Eigen::Index i = 0; i < places.rows(); ++i) {
    const Eigen::Index first = i / n * n;
    const MatrixXd distances = others.middleRows(first, n).rowwise() - places.row(i);
    EXPECT_LT(distances.rowwise().norm().minCoeff(&partner[i]), 1e-12 * places.norm());
    partner[i] += first;
  }
  return partner;
}

void expect_same_status(const Result &expected, const Result &actual,
                        const std::vector<Eigen::Index> &partner, double tolerance) {
  const auto &[rates, size] = expected.quantities.at("contact slip_rate*");
  const MatrixXd &others = actual.quantities.at("contact slip_rate*").all;
  for (std::size_t i = 0; i < expected.status.size(); ++i) {
    const double rate = std::max(rates(static_cast<Eigen::Index>(i), 0), others(partner[i], 0));
    EXPECT_TRUE(rate <= tolerance * size || expected.status[i] == actual.status[partner[i]])
        << i << ": " << expected.status[i] << ", slip rate " << rate;
  }
}

}  // namespace

Result run(const Sample &sample) {
  const output::TemporaryFolder folder;
  std::ofstream(folder / "sample.msh") << sample.mesh.text();
  const RunCase done(casefile::read_text(sample.text(), (folder / "case.toml").string(), {},
                                         mesh::read_mesh_file));
  std::map<std::string, Table> tables{{"nodes", done.nodes()}, {"history", done.history()}};
  Result result;
  result.steps = sample.steps;
  if (!sample.contact.empty()) {
    tables["contact"] = done.contact();
    result.status = tables["contact"].columns.at("status");
  }
  for (const Quantity &quantity : all_quantities())
    if (tables.contains(quantity.table))
      result.quantities[quantity.name()].all = values(tables[quantity.table], quantity);
  const bool conducts = sample.materials[0].conductor;
  measure(result, sample.end / sample.steps, conducts);
  result.uncertainty = uncertainty(done.summary(), tables["history"], conducts);
  return result;
}

Result image_of(Result result, const Image &image) {
  const double depth = image.turn.rows() == 2 ? image.units.length : 1;
  for (const Quantity &quantity : all_quantities())
    if (const auto found = result.quantities.find(quantity.name());
        found != result.quantities.end()) {
      auto &[all, size] = found->second;
      const double factor =
          image.units.factor(quantity.dimension) / (quantity.is_of_depth() ? depth : 1);
      all *= factor;
      size *= factor;
      if (quantity.is_vector)
        all *= image.turn.transpose();
    }
  return result;
}

Result superposed(const Result &one, double a, const Result &other, double b) {
  Result sum = one;
  sum.status.clear();
  sum.uncertainty = std::max(one.uncertainty, other.uncertainty);
  for (const Quantity &quantity : all_quantities()) {
    const std::string name = quantity.name();
    if (!quantity.is_linear)
      sum.quantities.erase(name);
    else if (sum.quantities.contains(name) && !quantity.is_place()) {
      const Values &first = one.quantities.at(name), &second = other.quantities.at(name);
      sum.quantities[name] = {a * first.all + b * second.all,
                              std::abs(a) * first.size + std::abs(b) * second.size};
    }
  }
  return sum;
}

void expect_same(const Result &expected, const Result &actual, double tolerance) {
  // Tractions, charges and heats amplify errors of u, phi and theta.
  tolerance += 30 * std::max(expected.uncertainty, actual.uncertainty);
  std::map<std::string, std::vector<Eigen::Index>> partner;
  for (const auto &[name, values] : expected.quantities) {
    const MatrixXd &other = actual.quantities.at(name).all;
    ASSERT_EQ(other.rows(), values.all.rows()) << name;
    ASSERT_EQ(other.cols(), values.all.cols()) << name;
    const std::string table = name.substr(0, name.find(' '));
    if (name.ends_with(" *"))
      partner[table] = partners(values.all, other, table == "nodes" ? 1 : expected.steps);
    if (values.all.size() == 0)
      continue;
    const MatrixXd ordered =
        partner.contains(table) ? MatrixXd(other(partner[table], Eigen::all)) : other;
    EXPECT_TRUE(ordered.allFinite()) << name;
    EXPECT_LE((ordered - values.all).cwiseAbs().maxCoeff(), tolerance * values.size) << name;
  }
  if (!expected.status.empty())
    expect_same_status(expected, actual, partner.at("contact"), tolerance);
}

}  // namespace tourmaline::verified
