#include "report/field_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "../output/small_body.h"
#include "../output/temporary_folder.h"
#include "output/vtu.h"
#include "tourmaline/error.h"

namespace tourmaline::report {
namespace {

using output::CellFields;
using output::Grid;
using output::PointFields;
using testing::HasSubstr;
using testing::ThrowsMessage;

const FieldArray &array(const FieldFile &file, std::string_view name) {
  for (const FieldArray &a : file.arrays)
    if (a.name == name)
      return a;
  throw std::runtime_error("no array " + std::string(name));
}

class FieldFiles : public testing::Test {
 protected:
  std::filesystem::path write(const std::string &name, const Grid &grid, const PointFields &points,
                              const CellFields &cells) {
    output::VtuWriter(grid).write(folder / name, 0.5, points, cells);
    return folder / name;
  }
  output::TemporaryFolder folder;
};

TEST_F(FieldFiles, WhatWasWrittenIsReadBackToTheLastBit) {
  const Grid grid = output::square(70);  // more than one compressed block
  const PointFields points = output::point_fields(grid.points.size());
  const CellFields cells = output::cell_fields(grid.n_cells());
  const FieldFile file = read_field_file(write("result_0001.vtu", grid, points, cells));
  EXPECT_EQ(file.grid.points, grid.points);
  EXPECT_EQ(file.grid.connectivity, grid.connectivity);
  EXPECT_EQ(file.grid.dimension, 2);
  EXPECT_EQ(array(file, "potential").values, points.potential);
  EXPECT_EQ(array(file, "von_mises").values, cells.von_mises);
  const FieldArray &stress = array(file, "stress");
  ASSERT_EQ(stress.components, 6U);
  EXPECT_FALSE(stress.on_points);
  for (std::size_t i = 0; i < cells.stress.size(); ++i)
    for (std::size_t c = 0; c < 6; ++c)
      ASSERT_EQ(stress.values[6 * i + c], cells.stress[i][c]);
}

/// The left or the right half of a square's cells, with the points that they need.
struct Half {
  Half(const Grid &whole, const PointFields &points, const CellFields &all_cells, bool right) {
    std::map<std::uint32_t, std::uint32_t> number;
    for (std::size_t c = 0; c < whole.n_cells(); ++c) {
      double x = 0;
      for (int a = 0; a < 3; ++a)
        x += whole.points[whole.connectivity[3 * c + a]][0] / 3;
      if ((x > 0.5) != right)
        continue;
      for (int a = 0; a < 3; ++a) {
        const std::uint32_t node = whole.connectivity[3 * c + a];
        const auto [entry, is_new] = number.try_emplace(node, number.size());
        if (is_new) {
          grid.points.push_back(whole.points[node]);
          fields.displacement.push_back(points.displacement[node]);
          fields.potential.push_back(points.potential[node]);
          fields.temperature.push_back(points.temperature[node]);
        }
        grid.connectivity.push_back(entry->second);
      }
      cells.stress.push_back(all_cells.stress[c]);
      cells.principal_stress.push_back(all_cells.principal_stress[c]);
      cells.von_mises.push_back(all_cells.von_mises[c]);
      cells.strain.push_back(all_cells.strain[c]);
      cells.electric_field.push_back(all_cells.electric_field[c]);
      cells.electric_displacement.push_back(all_cells.electric_displacement[c]);
      cells.heat_flux.push_back(all_cells.heat_flux[c]);
    }
  }
  Grid grid;
  PointFields fields;
  CellFields cells;
};

TEST_F(FieldFiles, PiecesOfSeveralRanksMakeOneBodyWithEachPointOnce) {
  const Grid whole = output::square(4);
  const PointFields points = output::point_fields(whole.points.size());
  const CellFields cells = output::cell_fields(whole.n_cells());
  const Half left(whole, points, cells, false), right(whole, points, cells, true);
  ASSERT_GT(left.grid.points.size() + right.grid.points.size(), whole.points.size());
  write("piece_0.vtu", left.grid, left.fields, left.cells);
  write("piece_1.vtu", right.grid, right.fields, right.cells);
  std::ofstream(folder / "result_0001.pvtu")
      << "<VTKFile type=\"PUnstructuredGrid\"><PUnstructuredGrid GhostLevel=\"0\">\n"
         "<Piece Source=\"piece_0.vtu\"/>\n<Piece Source=\"piece_1.vtu\"/>\n"
         "</PUnstructuredGrid></VTKFile>\n";
  const FieldFile file = read_field_file(folder / "result_0001.pvtu");
  ASSERT_EQ(file.grid.points.size(), whole.points.size());
  EXPECT_EQ(file.grid.n_cells(), whole.n_cells());
  // Points are by place: x slowest. Those of `square` run x fastest.
  const FieldArray &potential = array(file, "potential");
  for (std::size_t i = 0; i < 5; ++i)
    for (std::size_t j = 0; j < 5; ++j) {
      EXPECT_EQ(file.grid.points[5 * i + j], whole.points[5 * j + i]);
      EXPECT_EQ(potential.values[5 * i + j], points.potential[5 * j + i]);
    }
  double area = 0;
  for (std::size_t c = 0; c < file.grid.n_cells(); ++c) {
    const auto &a = file.grid.points[file.grid.connectivity[3 * c]],
               &b = file.grid.points[file.grid.connectivity[3 * c + 1]],
               &d = file.grid.points[file.grid.connectivity[3 * c + 2]];
    area += ((b[0] - a[0]) * (d[1] - a[1]) - (b[1] - a[1]) * (d[0] - a[0])) / 2;
  }
  EXPECT_NEAR(area, 1, 1e-14);
}

TEST_F(FieldFiles, PiecesOfRanksWithoutCellsAreNone) {
  const Grid grid = output::square(2);
  write("whole.vtu", grid, output::point_fields(9), output::cell_fields(8));
  Grid none = grid;
  none.points.clear();
  none.connectivity.clear();
  write("none.vtu", none, output::point_fields(0), output::cell_fields(0));
  const auto pieces =
      [&](const std::string &name, const std::string &list) {
        std::ofstream(folder / name)
            << "<VTKFile type=\"PUnstructuredGrid\"><PUnstructuredGrid GhostLevel=\"0\">\n"
            << list << "</PUnstructuredGrid></VTKFile>\n";
        return folder / name;
      };
  const std::string empty = "<Piece Source=\"none.vtu\"/>\n",
                    whole = "<Piece Source=\"whole.vtu\"/>\n";
  for (const std::string &list : {empty + whole, whole + empty, empty + empty + whole + empty}) {
    const FieldFile file = read_field_file(pieces("some.pvtu", list));
    EXPECT_EQ(file.grid.points.size(), 9U);
    EXPECT_EQ(file.grid.n_cells(), 8U);
  }
  const auto all_empty = pieces("all.pvtu", empty + empty);
  EXPECT_THAT([&] { read_field_file(all_empty); },
              ThrowsMessage<CaseError>(HasSubstr("none of its pieces holds points")));
}

TEST_F(FieldFiles, ADamagedFileIsNamed) {
  const Grid grid = output::square(2);
  const auto path = write("result_0001.vtu", grid, output::point_fields(9), output::cell_fields(8));
  std::filesystem::resize_file(path, std::filesystem::file_size(path) / 2);
  EXPECT_THAT([&] { read_field_file(path); },
              ThrowsMessage<CaseError>(HasSubstr("result_0001.vtu")));
  EXPECT_THAT([&] { read_field_file(folder / "result_0002.vtu"); },
              ThrowsMessage<CaseError>(HasSubstr("No such file")));
}

}  // namespace
}  // namespace tourmaline::report
