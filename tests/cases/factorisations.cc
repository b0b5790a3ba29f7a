// Both factorisations of the body solve the same equations.
#include <algorithm>
#include <cmath>

#include "run_case.h"
#include "tourmaline/error.h"

namespace tourmaline::verified {
namespace {

double largest_of(const std::vector<double> &values) {
  double most = 0;
  for (const double value : values)
    most = std::max(most, std::abs(value));
  return most;
}

// Columns whose parts are all next to nothing beside the field's largest are measured by that.
void expect_same_fields(const std::string &file, std::vector<std::string> overrides, double bound) {
  SCOPED_TRACE(file);
  overrides.push_back("output.report=false");
  const auto with = [&](const char *which) {
    std::vector<std::string> all = overrides;
    all.push_back(std::string("solver.factorisation='") + which + "'");
    return RunCase(file, all);
  };
  const RunCase own = with("own"), mumps = with("mumps");
  EXPECT_EQ(own.summary().at("factorised_by"), "own");
  EXPECT_EQ(mumps.summary().at("factorised_by"), "mumps");
  EXPECT_EQ(own.summary().at("negative_pivots"), mumps.summary().at("negative_pivots"));
  const Table one = own.nodes(), other = mumps.nodes();
  double displacement = 0;
  for (const char *component : {"u_x", "u_y", "u_z"})
    if (one.columns.contains(component))
      displacement = std::max(displacement, largest_of(one.numbers(component)));
  for (const auto &[name, cells] : one.columns) {
    const std::vector<double> values = one.numbers(name), others = other.numbers(name);
    const double size = name.starts_with("u_") ? displacement : largest_of(values);
    constexpr double nothing = 1e-15;  // V or K, where that field is not excited
    if (!name.starts_with("u_") && size < nothing)
      continue;
    for (std::size_t i = 0; i < values.size(); ++i)
      ASSERT_LE(std::abs(values[i] - others[i]), bound * size) << name << ", row " << i;
  }
  EXPECT_EQ(own.contact().columns.at("status"), mumps.contact().columns.at("status"));
}

TEST(Factorisations, GiveTheSameFieldsInPlaneAndSolidBodies) {
  expect_same_fields("cases/ouafik-2020/conductive.toml", {"mesh.box.cells=[24,24]"}, 1e-12);
  expect_same_fields("cases/ouafik-2020/conductive.toml",
                     {"mesh.box.cells=[12,12]", "mesh.degree=2"}, 1e-12);
  expect_same_fields("cases/block-3d/twisted.toml", {"mesh.box.cells=[5,5,5]"}, 1e-12);
}

TEST(Factorisations, GiveTheSameFieldsWithElectrodesRegionsAndRevolution) {
  expect_same_fields("cases/devices/friction-sensor-loaded.toml", {}, 1e-12);
  expect_same_fields("cases/devices/disc-transducer.toml", {}, 1e-12);
  // Conductors, whose permittivity is a million times that of the others.
  expect_same_fields("cases/devices/bimorph.toml", {}, 1e-8);
}

TEST(Factorisations, ThreadsChangeNoBitOfABodyWithoutContact) {
  for (const char *degree : {"mesh.degree=1", "mesh.degree=2"}) {
    const auto with = [&](const char *threads) {
      return RunCase("cases/verification/perfect-stick-clamped.toml",
                     {"solver.factorisation='own'",
                      "mesh.box={min=[0,0],max=[6e-3,4.5e-3],cells=[3,3],cell='quadrilateral'}",
                      degree, threads, "output.report=false"})
          .nodes();
    };
    EXPECT_EQ(with("solver.threads=1").columns, with("solver.threads=3").columns);
  }
}

TEST(Factorisations, TheOwnOneIsOfTheDirectBodyOnly) {
  for (const char *other : {"solver.method='monolithic'", "solver.body='iterative'"})
    EXPECT_THROW(
        RunCase("cases/ouafik-2020/conductive.toml", {"solver.factorisation='own'", other}),
        CaseError);
}

}  // namespace
}  // namespace tourmaline::verified
