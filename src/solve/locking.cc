#include "tourmaline/solve/locking.h"

#include <fmt/format.h>

#include <algorithm>

#include "tourmaline/body/locking.h"

namespace tourmaline::solve {

namespace {

// Above this the cells are some 10 % too stiff (docs/conventions.md has the measurements).
constexpr double largest_share = 0.1;

}  // namespace

template <int dim>
LockingWatch<dim>::LockingWatch(const Model<dim> &model)
    : model_(model),
      is_needed_(model.asked.mesh.degree == 1 && model.asked.mesh.modes == "none") {
  if (is_needed_)
    strained_.assign(model.n_unknowns(), 0.);
}

template <int dim>
void LockingWatch<dim>::step(const output::HistoryRow &row, const std::vector<double> &state) {
  if (!is_needed_)
    return;
  const auto elastic = std::find_if(row.quantities.begin(), row.quantities.end(),
                                    [](const auto &q) { return q.first == "elastic_energy"; });
  if (elastic == row.quantities.end() || !(elastic->second > largest_))
    return;
  largest_ = elastic->second;
  strained_ = state;
}

template <int dim>
std::string LockingWatch<dim>::warning() const {
  if (!is_needed_ || largest_ == 0)
    return "";
  const double share = body::locked_share(model_.body, model_.composition, strained_);
  if (std::getenv("SHARE")) fmt::print(stderr, "SHARE {}\n", share);
  if (!(share > largest_share))
    return "";
  return fmt::format(
      "the mesh is too coarse, or too stiff for bending: {:.0f} % of the elastic energy is held by "
      "linear cells that cannot follow the body's shape, so that displacements may be that much "
      "too small. Give mesh.degree = 2{}, or finer cells",
      100 * share,
      model_.body.has_simplices() ? "" : " or mesh.modes = \"incompatible\"");
}

template <int dim>
void LockingWatch<dim>::save(output::SavedNumbers &numbers) const {
  numbers.put("largest elastic energy", {largest_});
  numbers.put("most strained state", strained_);
}

template <int dim>
void LockingWatch<dim>::restore(const output::SavedNumbers &numbers) {
  largest_ = numbers.get("largest elastic energy", 1)[0];
  numbers.fill("most strained state", strained_);
}

template class LockingWatch<2>;
template class LockingWatch<3>;

}  // namespace tourmaline::solve
