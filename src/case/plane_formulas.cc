#include "case/plane_formulas.h"

#include <fmt/format.h>

#include "case/each_formula.h"
#include "case/toml_text.h"
#include "tourmaline/case/case.h"
#include "tourmaline/error.h"

namespace tourmaline::casefile {

void check_plane(const Case &asked) {
  if (asked.dimension != 2)
    return;
  for_each_formula(asked, [](const Formula &formula) {
    if (formula.depends_on_z())
      throw CaseError(fmt::format(
          "{} = {}: a two-dimensional case has no z, its coordinates are x and y; allowed: x, y, t",
          formula.where(), toml_text(shortened(formula.text()))));
  });
}

}  // namespace tourmaline::casefile
