#include "case/reference.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

namespace tourmaline::casefile {
namespace {

using testing::HasSubstr;

TEST(ReferencePage, IsTheOneInTheDocumentation) {
  std::ifstream in(std::string(TOURMALINE_SOURCE_DIR) + "/docs/case-file.md");
  const std::string page{std::istreambuf_iterator<char>(in), {}};
  EXPECT_TRUE(page == reference_page())
      << "docs/case-file.md is out of date: tourmaline reference > docs/case-file.md";
}

TEST(ReferencePage, HasEveryTable) {
  const std::string page = reference_page();
  for (const char *table :
       {"[mesh]", "[mesh.box]", "[material]", "[time]", "[[boundary]]", "[contact]",
        "[contact.friction]", "[contact.heat]", "[load]", "[initial]", "[solver]", "[output]"})
    EXPECT_THAT(page, HasSubstr(std::string("# ") + table + "\n"));
}

TEST(ReferencePage, SaysUnitRangeAndDefault) {
  const std::string page = reference_page();
  EXPECT_THAT(page, HasSubstr("| `bound` | formula | N/m^2 | required |"));
  EXPECT_THAT(page, HasSubstr(">= 0; at most 1e+18 in size; only with `law = \"tresca\"` |"));
  EXPECT_THAT(page, HasSubstr("| `method` | text |  | `\"condensed\"` |"));
  EXPECT_THAT(page, HasSubstr("| `end` | number | s | required |"));
}

TEST(ReferencePage, SaysWhichTablesMayBeGivenAsAValue) {
  const std::string page = reference_page();
  EXPECT_THAT(page, HasSubstr("| `normal` | text or table |  | `\"bilateral\"` | `law` of "
                              "[contact.normal], or that table |"));
  EXPECT_THAT(page, HasSubstr("| `coefficient` | formula or table |  | required | `value` of "
                              "[contact.friction.coefficient], or that table; only with `law = "
                              "\"coulomb\"` |"));
  EXPECT_THAT(page, HasSubstr("# [contact.normal]\n"));
  EXPECT_THAT(page, HasSubstr("# [contact.friction.coefficient]\n"));
}

// A region's are those of [material].
TEST(ReferencePage, ListsTheKeysOfAMaterialOnce) {
  const std::string page = reference_page();
  const auto first = page.find("| `c11` |");
  ASSERT_NE(first, std::string::npos);
  EXPECT_EQ(page.find("| `c11` |", first + 1), std::string::npos);
  EXPECT_LT(page.find("## [material]\n"), first);
  EXPECT_THAT(page, HasSubstr("### [region.material]\n\nWhat the region is made of; the keys are "
                              "those of [material]. Required.\n\n## [material]\n"));
}

}  // namespace
}  // namespace tourmaline::casefile
