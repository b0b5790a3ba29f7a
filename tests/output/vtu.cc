#include "output/vtu.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "decode_vtk.h"
#include "output/pvd.h"
#include "small_body.h"
#include "temporary_folder.h"
#include "tourmaline/error.h"

namespace tourmaline::output {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

template <std::size_t n>
std::vector<double> flat(const std::vector<std::array<double, n>> &list) {
  std::vector<double> numbers;
  for (const auto &entry : list)
    numbers.insert(numbers.end(), entry.begin(), entry.end());
  return numbers;
}

class Vtu : public testing::Test {
 protected:
  std::string written() {
    VtuWriter(grid).write(folder / "a.vtu", 0.25, points, cells);
    return content_of(folder / "a.vtu");
  }

  TemporaryFolder folder;
  Grid grid = square(40);
  PointFields points = point_fields(grid.points.size());
  CellFields cells = cell_fields(grid.n_cells());
};

TEST_F(Vtu, TheDecodedFileHoldsTheNumbersThatWerePutIn) {
  const std::string text = written();
  EXPECT_EQ(array_in<double>(text, "displacement"), flat(points.displacement));
  EXPECT_EQ(array_in<double>(text, "potential"), points.potential);
  EXPECT_EQ(array_in<double>(text, "temperature"), points.temperature);
  EXPECT_EQ(array_in<double>(text, "stress"), flat(cells.stress));
  EXPECT_EQ(array_in<double>(text, "von_mises"), cells.von_mises);
  EXPECT_EQ(array_in<double>(text, "principal_stress"), flat(cells.principal_stress));
  EXPECT_EQ(array_in<double>(text, "strain"), flat(cells.strain));
  EXPECT_EQ(array_in<double>(text, "electric_displacement"), flat(cells.electric_displacement));
  EXPECT_EQ(array_in<double>(text, "heat_flux"), flat(cells.heat_flux));
}

TEST_F(Vtu, TheDecodedFileHoldsTheGridThatWasPutIn) {
  const std::string text = written();
  EXPECT_EQ(array_in<double>(text, "Points"), flat(grid.points));
  const std::vector<std::int64_t> nodes(grid.connectivity.begin(), grid.connectivity.end());
  EXPECT_EQ(array_in<std::int64_t>(text, "connectivity"), nodes);
  const auto ends = array_in<std::int64_t>(text, "offsets");
  ASSERT_EQ(ends.size(), grid.n_cells());
  for (std::size_t i = 0; i < ends.size(); ++i)
    EXPECT_EQ(ends[i], std::int64_t(3 * (i + 1)));
  EXPECT_EQ(array_in<std::uint8_t>(text, "types"), std::vector<std::uint8_t>(grid.n_cells(), 5));
}

TEST_F(Vtu, HexahedraHaveEightNodesAndTheirOwnType) {
  grid = Grid{3, {}, VtkCell::hexahedron, 8, {0, 1, 3, 2, 4, 5, 7, 6}};
  for (int i = 0; i < 8; ++i)
    grid.points.push_back({double(i & 1), double(i >> 1 & 1), double(i >> 2)});
  points = point_fields(8);
  cells = cell_fields(1);
  const std::string text = written();
  EXPECT_THAT(array_in<std::int64_t>(text, "offsets"), ElementsAre(8));
  EXPECT_THAT(array_in<std::uint8_t>(text, "types"), ElementsAre(12));
}

TEST_F(Vtu, RegionAndPolingAreThereWhereTheyAreTold) {
  for (const char *array : {"region", "poling"})
    EXPECT_THAT(written(), Not(HasSubstr(array)));
  cells.poling.assign(grid.n_cells(), {0.6, 0.8, 0});
  EXPECT_EQ(array_in<double>(written(), "poling"), flat(cells.poling));
  EXPECT_THAT(written(), Not(HasSubstr("region")));
  cells.region.assign(grid.n_cells(), 2);
  EXPECT_EQ(array_in<double>(written(), "region"), cells.region);
}

TEST(Pvtu, DeclaresTheArraysOfItsPieces) {
  const std::vector<std::string> pieces{"result_0001_0.vtu", "result_0001_1.vtu"};
  EXPECT_THAT(pvtu_text(1, pieces), AllOf(Not(HasSubstr("region")), Not(HasSubstr("poling"))));
  EXPECT_THAT(pvtu_text(1, pieces, {.region = false, .poling = true}),
              AllOf(Not(HasSubstr("region")), HasSubstr("Name=\"poling\"")));
  EXPECT_THAT(pvtu_text(1, pieces, {.region = true, .poling = true}),
              AllOf(HasSubstr("Name=\"region\""), HasSubstr("Name=\"poling\"")));
}

TEST_F(Vtu, ComponentsAreNamedAsParaViewOrdersThem) {
  const std::string text = written();
  for (const char *tensor : {"stress", "strain"})
    EXPECT_THAT(text,
                HasSubstr(std::string("Name=\"") + tensor +
                          "\" NumberOfComponents=\"6\" ComponentName0=\"XX\" ComponentName1=\"YY\" "
                          "ComponentName2=\"ZZ\" ComponentName3=\"XY\" ComponentName4=\"YZ\" "
                          "ComponentName5=\"XZ\""));
  EXPECT_THAT(text, HasSubstr("Name=\"displacement\" NumberOfComponents=\"3\""));
}

TEST_F(Vtu, AFileKnowsItsTime) {
  EXPECT_THAT(written(),
              HasSubstr("Name=\"TimeValue\" NumberOfTuples=\"1\" format=\"ascii\">\n0.25\n"));
}

TEST_F(Vtu, ABodyWithoutCellsIsStillAFile) {
  grid = Grid{};
  points = {};
  cells = {};
  const std::string text = written();
  EXPECT_THAT(text, HasSubstr("NumberOfPoints=\"0\" NumberOfCells=\"0\""));
  EXPECT_TRUE(array_in<double>(text, "stress").empty());
}

TEST_F(Vtu, AFieldThatDoesNotFitTheGridIsRefusedAndLeavesNoFile) {
  cells.heat_flux.pop_back();
  EXPECT_THAT([&] { written(); },
              testing::ThrowsMessage<std::invalid_argument>(HasSubstr("heat_flux")));
  EXPECT_TRUE(names_in(folder.path()).empty());
}

TEST_F(Vtu, ACellOfMissingPointsIsRefused) {
  grid.connectivity.back() = 41 * 41;
  EXPECT_THROW(VtuWriter{grid}, std::invalid_argument);
  grid.connectivity.pop_back();
  EXPECT_THROW(VtuWriter{grid}, std::invalid_argument);
}

TEST_F(Vtu, SameFieldsGiveTheSameBytes) {
  const std::string first = written();
  EXPECT_EQ(written(), first);
}

TEST(Pvd, TheCollectionNamesEveryFileWithItsTime) {
  const std::vector<PvdEntry> series{{0.5, "result_0001.vtu"}, {0.1, "result_0002.vtu"}};
  EXPECT_EQ(
      pvd_text(series),
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"Collection\" version=\"0.1\">\n"
      "<Collection>\n"
      "<DataSet timestep=\"0.5\" group=\"\" part=\"0\" file=\"result_0001.vtu\"/>\n"
      "<DataSet timestep=\"0.10000000000000001\" group=\"\" part=\"0\" file=\"result_0002.vtu\"/>\n"
      "</Collection>\n"
      "</VTKFile>\n");
}

}  // namespace
}  // namespace tourmaline::output
