#include "output/contact_surface.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "decode_vtk.h"
#include "small_body.h"
#include "temporary_folder.h"

namespace tourmaline::output {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

std::vector<ContactRow> rows_of(std::size_t n) {
  std::vector<ContactRow> rows;
  for (std::size_t i = 0; i < n; ++i)
    rows.push_back({{value(i, 1), value(i, 2), value(i, 3)},
                    value(i, 4),
                    {value(i, 5), value(i, 6), value(i, 7)},
                    value(i, 8),
                    {value(i, 9), value(i, 10), value(i, 11)},
                    value(i, 12),
                    static_cast<ContactStatus>(i % 3),
                    value(i, 13),
                    value(i, 14),
                    value(i, 15),
                    value(i, 16),
                    value(i, 17),
                    {{"friction_bound", value(i, 18)}, {"accumulated_slip", value(i, 19)}}});
  return rows;
}

class Surface : public testing::Test {
 protected:
  std::string written(int dimension, std::size_t n, const ContactFacets &facets) {
    rows = rows_of(n);
    ContactSurface(dimension, rows, facets).write(folder / "a.vtu", 0.25, rows);
    return content_of(folder / "a.vtu");
  }
  template <class Of>
  std::vector<double> wanted(Of of) const {
    std::vector<double> values;
    for (const ContactRow &row : rows)
      for (const double value : of(row))
        values.push_back(value);
    return values;
  }

  TemporaryFolder folder;
  std::vector<ContactRow> rows;
};

TEST_F(Surface, TheDecodedFileHoldsEveryColumnOfTheRows) {
  const std::string text = written(2, 7, {{0, 1}, {1, 2}});
  using One = std::array<double, 1>;
  EXPECT_EQ(array_in<double>(text, "Points"), wanted([](const auto &r) { return r.point; }));
  EXPECT_EQ(array_in<double>(text, "normal_traction"),
            wanted([](const auto &r) { return One{r.normal_traction}; }));
  EXPECT_EQ(array_in<double>(text, "tangential_traction"),
            wanted([](const auto &r) { return r.tangential_traction; }));
  EXPECT_EQ(array_in<double>(text, "normal_displacement"),
            wanted([](const auto &r) { return One{r.normal_displacement}; }));
  EXPECT_EQ(array_in<double>(text, "slip"), wanted([](const auto &r) { return r.slip; }));
  EXPECT_EQ(array_in<double>(text, "slip_rate"),
            wanted([](const auto &r) { return One{r.slip_rate}; }));
  EXPECT_EQ(array_in<double>(text, "temperature"),
            wanted([](const auto &r) { return One{r.temperature}; }));
  EXPECT_EQ(array_in<double>(text, "potential"),
            wanted([](const auto &r) { return One{r.potential}; }));
  EXPECT_EQ(array_in<double>(text, "heat_flux"),
            wanted([](const auto &r) { return One{r.heat_flux}; }));
  EXPECT_EQ(array_in<double>(text, "gap"), wanted([](const auto &r) { return One{r.gap}; }));
  EXPECT_EQ(array_in<double>(text, "charge_flux"),
            wanted([](const auto &r) { return One{r.charge_flux}; }));
  for (const std::size_t i : {0U, 1U})
    EXPECT_EQ(array_in<double>(text, rows[0].quantities[i].first),
              wanted([i](const auto &r) { return One{r.quantities[i].second}; }));
  EXPECT_THAT(array_in<std::uint8_t>(text, "status"), ElementsAre(0, 1, 2, 0, 1, 2, 0));
}

TEST_F(Surface, AFileKnowsItsTimeAndWhatIsAVector) {
  const std::string text = written(2, 2, {{0, 1}});
  EXPECT_THAT(text, HasSubstr("NumberOfTuples=\"1\" format=\"ascii\">\n0.25\n"));
  for (const char *name : {"slip", "tangential_traction"})
    EXPECT_THAT(text, HasSubstr(std::string("Name=\"") + name + "\" NumberOfComponents=\"3\""));
}

struct Facet {
  int dimension;
  std::vector<std::uint32_t> nodes;
  std::uint8_t type;
  std::vector<std::int64_t> in_vtk_order;
};

TEST_F(Surface, EveryFacetIsACellOfItsOwnTypeInVtksOrder) {
  for (const Facet &facet :
       {Facet{2, {0, 1}, 3, {0, 1}}, Facet{2, {0, 1, 2}, 21, {0, 2, 1}},
        Facet{3, {0, 2, 1}, 5, {0, 2, 1}}, Facet{3, {0, 1, 3, 2}, 9, {0, 1, 3, 2}},
        Facet{3, {0, 1, 2, 3, 4, 5}, 22, {0, 1, 2, 3, 4, 5}},
        Facet{3, {0, 2, 8, 6, 1, 5, 7, 3, 4}, 28, {0, 2, 8, 6, 1, 5, 7, 3, 4}}}) {
    const std::string text = written(facet.dimension, 9, {facet.nodes, facet.nodes});
    std::vector<std::int64_t> twice = facet.in_vtk_order;
    twice.insert(twice.end(), facet.in_vtk_order.begin(), facet.in_vtk_order.end());
    const auto n = static_cast<std::int64_t>(facet.nodes.size());
    EXPECT_EQ(array_in<std::int64_t>(text, "connectivity"), twice);
    EXPECT_THAT(array_in<std::int64_t>(text, "offsets"), ElementsAre(n, 2 * n));
    EXPECT_THAT(array_in<std::uint8_t>(text, "types"), ElementsAre(facet.type, facet.type));
  }
}

TEST_F(Surface, WhatDoesNotFitIsRefused) {
  EXPECT_THROW(written(2, 2, {{0, 2}}), std::invalid_argument);
  EXPECT_THROW(written(2, 9, {{0, 1, 2, 3}}), std::invalid_argument);
  EXPECT_THROW(written(3, 9, {{0, 1}}), std::invalid_argument);
  const std::vector<ContactRow> three = rows_of(3), two = rows_of(2);
  const ContactSurface surface(2, three, {{0, 1}, {1, 2}});
  EXPECT_THROW(surface.write(folder / "b.vtu", 0, two), std::invalid_argument);
  EXPECT_FALSE(std::filesystem::exists(folder / "b.vtu"));
}

TEST(ContactFacets, AreThoseOfTheNamedBoundariesByRowsAndEachOnce) {
  const std::vector<NamedBoundary> boundaries{
      {"sole", {{9, 4}, {4, 7}}}, {"top", {{1, 2}}}, {"heel", {{4, 7}, {20, 9}}}};
  const std::vector<std::string> on{"heel", "sole"};
  const std::vector<std::uint32_t> nodes{4, 7, 9, 20};
  EXPECT_THAT(contact_facets(boundaries, on, nodes),
              ElementsAre(ElementsAre(0, 1), ElementsAre(2, 0), ElementsAre(3, 2)));
  const std::vector<std::uint32_t> fewer{4, 7, 9};
  EXPECT_THAT([&] { contact_facets(boundaries, on, fewer); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("20")));
}

}  // namespace
}  // namespace tourmaline::output
