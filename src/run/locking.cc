#include "run/locking.h"

#include <fmt/format.h>

#include <algorithm>

#include "body/locking.h"
#include "mesh/mesh.h"

namespace tourmaline::run {

namespace {

// What was measured on beams and bimorphs stands in docs/conventions.md: above this share of the
// stresses' energy displacements are some 5 % too small, or more. Bodies that are not slender do
// not bend, and what their cells miss is something else.
// Nor is it bending where the share of the strains' energy is this small: bimorphs that are 5 % too
// stiff have 0.02, bodies that heat or voltage stretch without hindrance 3e-6 and less, and their
// stresses are all error.
constexpr double largest_share = 0.05, least_slender = 2, least_of_strain = 1e-3;

// What a voltage or heat would bend and cells block altogether is full of stresses that are none of
// bending, beside which the share is small; of the strains' energy it is larger then, 0.018 and
// more on the coarsest bimorphs (measured on meshes of 3 to 100 cells along).
constexpr double largest_of_strain = 0.015, rather = 1.5;

// Cells in the thickness below which bending is some 10 % too stiff.
double least_cells(bool simplices) {
  return simplices ? 4 : 2;
}

std::string advice(bool simplices) {
  return std::string("Give mesh.degree = 2") +
         (simplices ? "" : " or mesh.modes = \"incompatible\"") + ", or finer cells";
}

bool may_lock(const casefile::MeshCase &mesh) {
  return mesh.degree == 1 && mesh.modes == "none";
}

}  // namespace

std::string few_cells_warning(const body::Slenderness &found, bool simplices) {
  return fmt::format(
      "this body is slender, and {:.2g} linear cells, measured by their longest diagonal, stand in "
      "its thickness: too few if it is bent. {}",
      found.cells, advice(simplices));
}

// Simplices in one row, or longer than the body is thick, have no neighbours across it by which to
// see that it bends: bimorphs that are 85 % too stiff have 2e-4 to 4e-3 of the strains' energy.
bool tells_nothing(const body::Slenderness &found, const body::LockedShare &share, bool simplices) {
  constexpr double stretched = 1e-4;
  return simplices && found.cells < 1 && share.of_strain >= stretched;
}

template <int dim>
std::string locking_warning(const solve::Model<dim> &model, const std::vector<double> &state) {
  if (!may_lock(model.asked.mesh))
    return "";
  const body::Slenderness found = body::slenderness(model.body);
  if (found.ratio < least_slender)
    return "";
  const body::LockedShare share = body::locked_share(model.body, model.composition, state);
  const bool bends = share.of_stress >= largest_share && share.of_strain >= least_of_strain,
             is_blocked =
                 share.of_strain >= largest_of_strain && share.of_strain > rather * share.of_stress;
  if (!bends && !is_blocked)
    return tells_nothing(found, share, model.body.has_simplices())
               ? few_cells_warning(found, model.body.has_simplices())
               : "";
  return fmt::format(
      "linear cells are too stiff for how this body bends: they hold {:.0f} % of the energy of its "
      "{} only because they cannot follow its shape, and displacements are too small. {}",
      100 * (bends ? share.of_stress : share.of_strain), bends ? "stresses" : "strains",
      advice(model.body.has_simplices()));
}

template std::string locking_warning<2>(const solve::Model<2> &, const std::vector<double> &);
template std::string locking_warning<3>(const solve::Model<3> &, const std::vector<double> &);

namespace {

template <int dim>
std::string slender_warning_in(const casefile::Case &asked) {
  const body::Discretisation<dim> body(mesh::build<dim>(asked), 1, body::geometry_of(asked));
  const body::Slenderness found = body::slenderness(body);
  if (found.ratio < least_slender || found.cells >= least_cells(body.has_simplices()))
    return "";
  return few_cells_warning(found, body.has_simplices());
}

// Without a mesh: a box that cannot be slender.
bool is_compact(const casefile::Box &box) {
  double least = box.max[0] - box.min[0], greatest = least;
  for (std::size_t i = 1; i < box.max.size(); ++i) {
    least = std::min(least, box.max[i] - box.min[i]);
    greatest = std::max(greatest, box.max[i] - box.min[i]);
  }
  return greatest < 3 * least;
}

}  // namespace

std::string slender_warning(const casefile::Case &asked) {
  if (!may_lock(asked.mesh) || (asked.mesh.box && is_compact(*asked.mesh.box)))
    return "";
  return asked.dimension == 2 ? slender_warning_in<2>(asked) : slender_warning_in<3>(asked);
}

}  // namespace tourmaline::run
