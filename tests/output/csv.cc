#include "output/csv.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <limits>
#include <stdexcept>

#include "small_body.h"

namespace tourmaline::output {
namespace {

const ContactRow contact_row{.point = {0, 0.5, 0.25},
                             .normal_traction = -2,
                             .tangential_traction = {0, 15, 7},
                             .normal_displacement = -0.,
                             .slip = {0, 1e-11, -3e-11},
                             .slip_rate = 1e-9,
                             .status = ContactStatus::slip,
                             .temperature = -0.001,
                             .potential = 0.068,
                             .heat_flux = 27,
                             .gap = 2e-9,
                             .charge_flux = -3,
                             .quantities = {{"friction_bound", 15}}};

TEST(ContactTable, ItHasTheColumnsOfTheContract) {
  EXPECT_EQ(contact_header(2, contact_row),
            "step,time,x,y,normal_traction,tangential_traction_x,tangential_traction_y,"
            "normal_displacement,slip_x,slip_y,slip_rate,status,temperature,potential,heat_flux,"
            "gap,charge_flux,friction_bound\n");
  EXPECT_EQ(
      contact_header(3, contact_row),
      "step,time,x,y,z,normal_traction,tangential_traction_x,tangential_traction_y,"
      "tangential_traction_z,normal_displacement,slip_x,slip_y,slip_z,slip_rate,status,temperature,"
      "potential,heat_flux,gap,charge_flux,friction_bound\n");
}

TEST(ContactTable, ARowStandsUnderItsColumns) {
  EXPECT_EQ(contact_lines(2, 3, 0.5, std::span(&contact_row, 1)),
            "3,0.5,0,0.5,-2,0,15,0,0,9.9999999999999994e-12,1.0000000000000001e-09,slip,-0.001,"
            "0.068000000000000005,27,2.0000000000000001e-09,-3,15\n");
  EXPECT_EQ(
      contact_lines(3, 3, 0.5, std::span(&contact_row, 1)),
      "3,0.5,0,0.5,0.25,-2,0,15,7,0,0,9.9999999999999994e-12,-3e-11,1.0000000000000001e-09,slip,"
      "-0.001,0.068000000000000005,27,2.0000000000000001e-09,-3,15\n");
}

TEST(ContactTable, EveryStatusHasItsWord) {
  EXPECT_STREQ(name_of(ContactStatus::open), "open");
  EXPECT_STREQ(name_of(ContactStatus::stick), "stick");
  EXPECT_STREQ(name_of(ContactStatus::slip), "slip");
}

TEST(HistoryTable, TheRowsOwnQuantitiesFollowTheFixedColumns) {
  const HistoryRow row{4, 0.25, 3, 0.5, 30, 2, 1, {{"stored_energy", 1.5}, {"largest_slip", -0.}}};
  EXPECT_EQ(history_header(row),
            "step,time,newton_iterations,residual,stick,slip,open,stored_energy,largest_slip\n");
  EXPECT_EQ(history_line(row), "4,0.25,3,0.5,30,2,1,1.5,0\n");
}

std::string nodes_table(int dimension, const std::vector<Vector3> &points,
                        const PointFields &fields) {
  return nodes_header(dimension) + nodes_lines(dimension, points, fields, 0, points.size());
}

TEST(NodesTable, TheThirdDirectionAppearsInThreeDimensionsOnly) {
  Grid grid;
  grid.points = {{0.5, 1, 2}};
  const PointFields fields{{{-0.25, -0., 4}}, {8}, {-16}, {}, {}, {}};
  EXPECT_EQ(nodes_table(2, grid.points, fields),
            "x,y,u_x,u_y,potential,temperature\n0.5,1,-0.25,0,8,-16\n");
  EXPECT_EQ(nodes_table(3, grid.points, fields),
            "x,y,z,u_x,u_y,u_z,potential,temperature\n0.5,1,2,-0.25,0,4,8,-16\n");
}

TEST(NodesTable, EveryNumberReadsBackAsItWas) {
  Grid grid;
  PointFields fields;
  for (std::size_t i = 0; i < 1000; ++i) {
    grid.points.push_back({});
    fields.displacement.push_back({});
    fields.potential.push_back(value(i, int(i % 30) - 10));
    fields.temperature.push_back(1. / 3);
  }
  const std::string table = nodes_table(2, grid.points, fields);
  std::size_t line = table.find('\n') + 1;
  for (const double expected : fields.potential) {
    EXPECT_EQ(std::strtod(table.c_str() + line + std::string("0,0,0,0,").size(), nullptr),
              expected);
    line = table.find('\n', line) + 1;
  }
}

TEST(NodesTable, WhatIsNotANumberIsWrittenWithoutSign) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  Grid grid;
  grid.points = {{0, 0, 0}};
  EXPECT_EQ(nodes_table(2, grid.points, {{{nan, -nan, 0}}, {infinity}, {-infinity}, {}, {}, {}}),
            "x,y,u_x,u_y,potential,temperature\n0,0,nan,nan,inf,-inf\n");
}

TEST(NodesTable, FieldsThatDoNotFitTheGridAreRefused) {
  Grid grid;
  grid.points = {{0, 0, 0}, {1, 0, 0}};
  EXPECT_THROW(nodes_table(2, grid.points, {{{}, {}}, {0, 0}, {0}, {}, {}, {}}),
               std::invalid_argument);
}

}  // namespace
}  // namespace tourmaline::output
