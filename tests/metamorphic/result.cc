#include "result.h"

#include <optional>

#include "../cases/run_case.h"

namespace tourmaline::testing {
namespace {

using Eigen::MatrixXd;

// The columns of a table whose names begin and end so; those of a vector are x, y, z.
struct Quantity {
  std::string table, begin, end;
  Dimension dimension;
  bool is_vector = false, is_linear = true, is_of_depth = false;  // of a metre of it in 2D
};

const std::vector<Quantity> &all_quantities() {
  constexpr bool vector = true, linear = true, of_depth = true;
  constexpr Dimension energy{1, 1}, power{1, 1, 0, 0, -1}, charge{1, 1, -1}, stress{-2, 1};
  static const std::vector<Quantity> all{
      {"nodes", "u_", "", {1}, vector},
      {"nodes", "potential", "", {0, 0, 1}},
      {"nodes", "temperature", "", {0, 0, 0, 1}},
      {"contact", "normal_traction", "", stress},
      {"contact", "tangential_traction_", "", stress, vector},
      {"contact", "slip_", "x", {1}, vector},
      {"contact", "heat_flux", "", {-1, 1, 0, 0, -1}},
      {"history", "", "_energy", energy, false, false, of_depth},
      {"history", "", "_power", power, false, false, of_depth},
      {"history", "", "_loss", power, false, false, of_depth},
      {"history", "friction_dissipation", "", power, false, false, of_depth},
      {"history", "load_", "x", {0, 1}, vector, linear, of_depth},
      {"history", "reaction_", "x", {0, 1}, vector, linear, of_depth},
      {"history", "contact_force_", "x", {0, 1}, vector, linear, of_depth},
      {"history", "charge_side", "", charge, false, linear, of_depth},
      {"history", "electrode_", "_charge", charge, false, linear, of_depth},
      {"history", "electrode_", "_voltage", {0, 0, 1}},
      {"history", "electrode_", "_current", {1, 1, -1, 0, -1}, false, linear, of_depth},
      {"history", "heat_side", "", power, false, linear, of_depth}};
  return all;
}

std::string name_of(const Quantity &quantity) {
  return quantity.table + " " + quantity.begin + "*" + quantity.end;
}

MatrixXd columns(const Table &table, const std::vector<std::string> &names) {
  MatrixXd all(table.n_rows(), names.size());
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::vector<double> values = table.numbers(names[i]);
    all.col(static_cast<Eigen::Index>(i)) =
        Eigen::Map<const Eigen::VectorXd>(values.data(), all.rows());
  }
  return all;
}

MatrixXd vectors(const Table &table, const std::string &name, int dimension) {
  std::vector<std::string> names;
  for (int axis = 0; axis < dimension; ++axis)
    names.push_back(name + "xyz"[axis]);
  return columns(table, names);
}

MatrixXd values(const Table &table, const Quantity &quantity, int dimension) {
  if (quantity.is_vector)
    return vectors(table, quantity.begin, dimension);
  std::vector<std::string> names;
  for (const auto &[name, cells] : table.columns)
    if (name.starts_with(quantity.begin) && name.ends_with(quantity.end))
      names.push_back(name);
  return columns(table, names);
}

// For each place the row of the nearest one of `others`.
std::vector<Eigen::Index> partners(const MatrixXd &places, const MatrixXd &others) {
  std::vector<Eigen::Index> partner(places.rows());
  if (partner.empty())
    return partner;
  const double size = places.cwiseAbs().maxCoeff();
  for (Eigen::Index i = 0; i < places.rows(); ++i) {
    const double distance =
        (others.rowwise() - places.row(i)).rowwise().norm().minCoeff(&partner[i]);
    EXPECT_LT(distance, 1e-12 * size);
  }
  return partner;
}

// Rows by step, then place, put into the order of the places' partners.
MatrixXd reordered(const MatrixXd &rows, const std::vector<Eigen::Index> &partner) {
  MatrixXd result = rows;
  const auto n = static_cast<Eigen::Index>(partner.size());
  for (Eigen::Index i = 0; i < rows.rows(); ++i)
    result.row(i) = rows.row(i / n * n + partner[i % n]);
  return result;
}

void expect_same_status(const Result &expected, const Result &actual,
                        const std::vector<Eigen::Index> &partner, double tolerance) {
  const std::size_t n = partner.size();
  const double round_off = tolerance * largest(expected.slip_rate);
  for (std::size_t i = 0; i < expected.status.size(); ++i)
    EXPECT_TRUE(expected.slip_rate[i] <= round_off ||
                expected.status[i] == actual.status[i / n * n + partner[i % n]])
        << i;
}

double largest_of(const Result &result, const std::string &name) {
  return result.quantities.at(name).cwiseAbs().maxCoeff();
}

// What a quantity is measured by: points that stick have slips, and so dissipation, of round-off,
// those without friction such tangential tractions, and a single electrode such a charge.
double measure(const Result &result, const std::string &name) {
  static const std::map<std::string, std::string> others{
      {"contact slip_*x", "nodes u_*"},
      {"contact tangential_traction_*", "contact normal_traction*"},
      {"history friction_dissipation*", "history *_power"}};
  double size = largest_of(result, name);
  if (const auto other = others.find(name); other != others.end())
    size = std::max(size, largest_of(result, other->second));
  if (name == "history charge_side*" && result.quantities.contains("history *_energy"))
    size = std::max(
        size, largest_of(result, "history *_energy") / largest_of(result, "nodes potential*"));
  return size;
}

}  // namespace

Result run(const Sample &sample) {
  const output::TemporaryFolder folder;
  std::ofstream(folder / "sample.msh") << sample.mesh.text();
  const RunCase done(casefile::read_text(sample.text(), (folder / "case.toml").string(), {},
                                         mesh::read_mesh_file));
  std::map<std::string, Table> tables{{"nodes", done.nodes()}, {"history", done.history()}};
  const int dimension = sample.dimension();
  Result result;
  result.nodes = vectors(tables["nodes"], "", dimension);
  if (!sample.contact.empty()) {
    tables["contact"] = done.contact();
    result.contact =
        vectors(tables["contact"], "", dimension)
            .topRows(static_cast<Eigen::Index>(tables["contact"].n_rows()) / sample.steps);
    result.status = tables["contact"].columns.at("status");
    result.slip_rate = tables["contact"].numbers("slip_rate");
  }
  for (const Quantity &quantity : all_quantities())
    if (tables.contains(quantity.table))
      result.quantities[name_of(quantity)] = values(tables[quantity.table], quantity, dimension);
  return result;
}

Result image_of(Result result, const Image &image) {
  const double depth = image.turn.rows() == 2 ? image.units.length : 1;
  result.nodes *= image.units.length * image.turn.transpose();
  if (result.contact.size() > 0)
    result.contact *= image.units.length * image.turn.transpose();
  for (const Quantity &quantity : all_quantities()) {
    const auto found = result.quantities.find(name_of(quantity));
    if (found == result.quantities.end())
      continue;
    found->second *= image.units.factor(quantity.dimension) / (quantity.is_of_depth ? depth : 1);
    if (quantity.is_vector)
      found->second *= image.turn.transpose();
  }
  return result;
}

Result superposed(const Result &one, double a, const Result &other, double b) {
  Result sum = one;
  sum.status.clear();
  for (const Quantity &quantity : all_quantities()) {
    const std::string name = name_of(quantity);
    if (!quantity.is_linear)
      sum.quantities.erase(name);
    else if (sum.quantities.contains(name))
      sum.quantities[name] = a * one.quantities.at(name) + b * other.quantities.at(name);
  }
  return sum;
}

void expect_same(const Result &expected, const Result &actual, double tolerance) {
  const std::map<std::string, std::vector<Eigen::Index>> partner{
      {"nodes", partners(expected.nodes, actual.nodes)},
      {"contact", partners(expected.contact, actual.contact)}};
  for (const auto &[name, values] : expected.quantities) {
    const auto order = partner.find(name.substr(0, name.find(' ')));
    const MatrixXd other = order == partner.end()
                               ? actual.quantities.at(name)
                               : reordered(actual.quantities.at(name), order->second);
    ASSERT_EQ(other.rows(), values.rows()) << name;
    ASSERT_EQ(other.cols(), values.cols()) << name;
    if (values.size() == 0)
      continue;
    EXPECT_TRUE(other.allFinite()) << name;
    EXPECT_LE((other - values).cwiseAbs().maxCoeff(), tolerance * measure(expected, name)) << name;
  }
  if (!expected.status.empty())
    expect_same_status(expected, actual, partner.at("contact"), tolerance);
}

}  // namespace tourmaline::testing
