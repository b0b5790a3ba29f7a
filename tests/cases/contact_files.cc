// What the field files of the contact hold is what contact.csv and the mesh hold.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <set>

#include "../output/decode_vtk.h"
#include "run_case.h"

namespace tourmaline::verified {
namespace {

using ::testing::HasSubstr;

const std::string laws = "tests/reference/contact_laws/cases/";
const std::vector<std::string> few_steps{"time.steps=2"};

/// A case with its field files, in a folder that goes away with the object.
class RunWithFields {
 public:
  RunWithFields(const std::string &file, std::vector<std::string> overrides) {
    overrides.insert(overrides.end(), {"output.fields=true", "output.report=false"});
    const auto path = std::filesystem::path(TOURMALINE_SOURCE_DIR) / file;
    run::simulate(casefile::read_file(path, overrides), folder_.path(), {.quiet = true});
  }

  std::string content(const std::string &name) const { return output::content_of(folder_ / name); }
  Table contact() const { return read_table(folder_ / "contact.csv"); }
  Table history() const { return read_table(folder_ / "history.csv"); }
  std::set<std::string> names() const { return output::names_in(folder_.path()); }

 private:
  output::TemporaryFolder folder_;
};

/// Rows of one step of contact.csv.
Table step_of(const Table &contact, int step) {
  Table rows;
  for (std::size_t i = 0; i < contact.n_rows(); ++i)
    if (contact.columns.at("step")[i] == std::to_string(step))
      for (const auto &[name, cells] : contact.columns)
        rows.columns[name].push_back(cells[i]);
  return rows;
}

/// Component c of the points' vectors of three.
std::vector<double> component(const std::vector<double> &vectors, std::size_t c) {
  std::vector<double> values;
  for (std::size_t i = c; i < vectors.size(); i += 3)
    values.push_back(vectors[i]);
  return values;
}

std::vector<double> status_numbers(const Table &rows) {
  std::vector<double> numbers;
  for (const std::string &status : rows.columns.at("status"))
    numbers.push_back(status == "open" ? 0 : status == "stick" ? 1 : 2);
  return numbers;
}

void expect_the_rows(const std::string &vtu, const Table &rows, int dimension) {
  const std::vector<std::string> axes{"x", "y", "z"};
  for (std::size_t c = 0; c < static_cast<std::size_t>(dimension); ++c) {
    EXPECT_EQ(component(output::array_in<double>(vtu, "Points"), c), rows.numbers(axes[c]));
    for (const std::string name : {"tangential_traction", "slip"})
      EXPECT_EQ(component(output::array_in<double>(vtu, name), c),
                rows.numbers(name + "_" + axes[c]));
  }
  const std::set<std::string> not_alone{"step", "time", "x", "y", "z", "status"};
  for (const auto &[name, cells] : rows.columns)
    if (!not_alone.contains(name) && !name.starts_with("slip_") &&
        !name.starts_with("tangential_traction_")) {
      EXPECT_EQ(output::array_in<double>(vtu, name), rows.numbers(name)) << name;
    }
  EXPECT_EQ(output::array_in<double>(vtu, "slip_rate"), rows.numbers("slip_rate"));
  const auto status = output::array_in<std::uint8_t>(vtu, "status");
  EXPECT_EQ(std::vector<double>(status.begin(), status.end()), status_numbers(rows));
}

struct Shipped {
  std::string file;
  int dimension;
};

class ContactFiles : public ::testing::TestWithParam<Shipped> {};

TEST_P(ContactFiles, HoldTheRowsOfContactCsv) {
  const RunWithFields run(GetParam().file, few_steps);
  const Table contact = run.contact();
  for (const int step : {1, 2})
    expect_the_rows(run.content("contact_000" + std::to_string(step) + ".vtu"),
                    step_of(contact, step), GetParam().dimension);
  EXPECT_THAT(run.content("contact.pvd"), HasSubstr("file=\"contact_0002.vtu\""));
  EXPECT_FALSE(run.names().contains("contact_0000.vtu"));
}

INSTANTIATE_TEST_SUITE_P(Cases, ContactFiles,
                         ::testing::Values(Shipped{laws + "hertz.toml", 2},
                                           Shipped{laws + "coulomb-warmed.toml", 2},
                                           Shipped{laws + "layer-slip-weakening.toml", 2},
                                           Shipped{"cases/ring/ring.toml", 2},
                                           Shipped{"cases/block-3d/twisted.toml", 3}));

TEST(ContactFilesOfOneLaw, HaveTheBoundAndTheAccumulatedSlipWhereTheTableHasThem) {
  const RunWithFields weakening(laws + "layer-slip-weakening.toml", few_steps);
  for (const std::string name : {"friction_bound", "accumulated_slip"})
    EXPECT_GT(largest(output::array_in<double>(weakening.content("contact_0002.vtu"), name)), 0);
  const RunWithFields tresca("cases/ring/ring.toml", few_steps);
  EXPECT_EQ(tresca.content("contact_0002.vtu").find("friction_bound"), std::string::npos);
}

TEST(ContactFilesOfOneLaw, TellOpenNodesFromThoseThatTouch) {
  const RunWithFields run(laws + "hertz.toml", few_steps);
  const auto status = output::array_in<std::uint8_t>(run.content("contact_0002.vtu"), "status");
  EXPECT_EQ(status.front(), 0);
  EXPECT_NE(status[status.size() / 2], 0);
}

TEST(ContactFilesOfSeveralSteps, AreWrittenWithTheFields) {
  const RunWithFields run(laws + "hertz.toml", {"time.steps=5", "output.every=2"});
  std::set<std::string> written;
  for (const std::string &name : run.names())
    if (name.starts_with("contact_"))
      written.insert(name);
  EXPECT_EQ(written,
            (std::set<std::string>{"contact_0002.vtu", "contact_0004.vtu", "contact_0005.vtu"}));
}

/// A box whose lower side is the contact; cells of each kind.
std::string box(const std::string &cell, int degree) {
  const bool plane = cell == "triangle" || cell == "quadrilateral";
  return "mesh = { degree = " + std::to_string(degree) + ", box = { min = [0, 0" +
         (plane ? "" : ", 0") + "], max = [2, 1" + (plane ? "" : ", 3") + "], cells = [2, 1" +
         (plane ? "" : ", 3") + "], cell = \"" + cell + "\" } }\n" +
         "material.library = \"steel\"\ntime = { end = 1, steps = 1 }\n" +
         "boundary = [ { on = \"top\", displacement = [0, " + (plane ? "-1e-6" : "0, -1e-6") +
         "], potential = 0 } ]\ncontact = { on = \"bottom\", normal = \"unilateral\" }\n";
}

struct Cells {
  std::string cell;
  int degree;
  std::uint8_t type;
  double size;  // of the lower side: length or area
};

class Facets : public ::testing::TestWithParam<Cells> {};

using Points = Eigen::Map<const Eigen::Matrix3Xd>;

double size_of(const Points &points, const std::vector<std::int64_t> &corners) {
  Eigen::Vector3d area = Eigen::Vector3d::Zero();
  if (corners.size() == 2)
    return (points.col(corners[1]) - points.col(corners[0])).norm();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Eigen::Vector3d a = points.col(corners[i]),
                          b = points.col(corners[(i + 1) % corners.size()]);
    area += a.cross(b) / 2;
  }
  return area.norm();
}

TEST_P(Facets, CoverTheContactAndHaveTheirMiddleNodesBetweenTheCorners) {
  const output::TemporaryFolder folder;
  std::ofstream(folder / "case.toml") << box(GetParam().cell, GetParam().degree);
  const RunWithFields run(folder / "case.toml", {});
  const std::string vtu = run.content("contact_0001.vtu");
  const auto types = output::array_in<std::uint8_t>(vtu, "types");
  const auto nodes = output::array_in<std::int64_t>(vtu, "connectivity");
  const auto places = output::array_in<double>(vtu, "Points");
  const Points points(places.data(), 3, static_cast<Eigen::Index>(places.size() / 3));
  ASSERT_FALSE(types.empty());
  const std::size_t each = nodes.size() / types.size();
  const std::size_t corners = each == 3 && GetParam().degree == 2 ? 2
                              : each == 6                         ? 3
                              : each == 9                         ? 4
                                                                  : each;
  double size = 0;
  std::set<std::int64_t> used(nodes.begin(), nodes.end());
  EXPECT_EQ(used.size(), places.size() / 3);
  for (std::size_t f = 0; f < types.size(); ++f) {
    EXPECT_EQ(types[f], GetParam().type);
    const std::vector<std::int64_t> facet(
        nodes.begin() + static_cast<std::ptrdiff_t>(f * each),
        nodes.begin() + static_cast<std::ptrdiff_t>((f + 1) * each));
    const std::vector<std::int64_t> outer(facet.begin(),
                                          facet.begin() + static_cast<std::ptrdiff_t>(corners));
    size += size_of(points, outer);
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();
    for (const std::int64_t node : outer)
      centre += points.col(node) / static_cast<double>(corners);
    for (std::size_t i = corners; i < each; ++i) {
      const std::size_t side = i - corners;
      const Eigen::Vector3d middle =
          side < corners && (corners > 2 || side == 0)
              ? (points.col(facet[side]) + points.col(facet[(side + 1) % corners])) / 2
              : centre;
      EXPECT_LE((points.col(facet[i]) - middle).norm(), 1e-12) << i;
    }
  }
  EXPECT_NEAR(size, GetParam().size, 1e-12);
}

INSTANTIATE_TEST_SUITE_P(OfEveryKind, Facets,
                         ::testing::Values(Cells{"triangle", 1, 3, 2}, Cells{"triangle", 2, 21, 2},
                                           Cells{"quadrilateral", 1, 3, 2},
                                           Cells{"quadrilateral", 2, 21, 2},
                                           Cells{"tetrahedron", 1, 5, 2},
                                           Cells{"hexahedron", 1, 9, 2},
                                           Cells{"hexahedron", 2, 28, 2}));

double largest(std::vector<double> values, double sign) {
  for (double &value : values)
    value *= sign;
  return *std::max_element(values.begin(), values.end());
}

TEST(History, ItsLargestPressureAndOpeningAreThoseOfTheContactNodes) {
  const RunWithFields run(laws + "coulomb-cooled.toml", few_steps);
  const Table history = run.history(), last = step_of(run.contact(), 2);
  EXPECT_EQ(history.numbers("max_pressure").back(), largest(last.numbers("normal_traction"), -1));
  EXPECT_EQ(history.numbers("max_opening").back(), largest(last.numbers("gap"), 1));
  EXPECT_GT(history.numbers("max_opening").back(), 0);
}

TEST(History, BilateralContactWithTrescasLawHasNoPressureToTell) {
  const RunWithFields run(laws + "bilateral-tresca.toml", few_steps);
  EXPECT_FALSE(run.history().columns.contains("max_pressure"));
}

}  // namespace
}  // namespace tourmaline::verified
