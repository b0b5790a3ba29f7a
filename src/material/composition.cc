#include "material/composition.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>

#include "dense/decompositions.h"
#include "material/completeness.h"
#include "material/orientation.h"
#include "tourmaline/case/case.h"
#include "tourmaline/error.h"

namespace tourmaline::material {

namespace {

bool varies(const casefile::FormulaVector &direction) {
  return std::any_of(direction.begin(), direction.end(),
                     [](const casefile::Formula &entry) { return entry.depends_on_place(); });
}

// Mass matters where it is accelerated or its drag counts, and in the heat it stores.
std::set<std::string> left_out(const casefile::Case &asked,
                               const casefile::MaterialCase &material) {
  std::set<std::string> left;
  if (!asked.model.electric)
    left.insert({"piezoelectric", "permittivity", "pyroelectric"});
  if (asked.model.thermal)
    return left;
  left.insert(
      {"thermal", "pyroelectric", "conductivity", "specific_heat", "reference_temperature"});
  if (!asked.time.is_dynamic() && asked.load.base_acceleration.empty() &&
      !with_entry(material).constants.contains("mass_damping"))
    left.insert("density");
  return left;
}

Plane plane_of(const casefile::ModelCase &model) {
  if (model.is_axisymmetric())
    return Plane::axisymmetric;
  return model.plane == "stress" ? Plane::stress : Plane::strain;
}

bool is_polar(const Constants &c) {
  return c.piezoelectric.squaredNorm() > 0 || c.pyroelectric.squaredNorm() > 0;
}

}  // namespace

std::vector<casefile::MaterialCase> materials_of(const casefile::Case &asked) {
  std::vector<casefile::MaterialCase> all;
  for (const casefile::RegionCase &region : asked.regions)
    all.push_back(region.material);
  if (all.empty())
    all.push_back(asked.material);
  for (casefile::MaterialCase &material : all)
    material.left_out = left_out(asked, material);
  return all;
}

template <int dim>
Composition<dim>::Composition(const casefile::Case &asked) : plane_(plane_of(asked.model)) {
  require_complete(materials_of(asked));
  for (const casefile::MaterialCase &material : materials_of(asked))
    add(material);
  fill_conductors();
  check_reference_temperatures();
  for (Part &part : parts_)
    if (!material::varies(part.asked.poling)) {
      const Tensor axes = crystal_axes(part.asked, dim);
      part.everywhere = rotated(part.crystal, axes);
      part.restricted_everywhere = restricted(*part.everywhere);
      part.poling_everywhere = axes.col(2);
    }
}

template <int dim>
void Composition<dim>::add(const casefile::MaterialCase &asked) {
  parts_.push_back({asked, constants_of(asked), {}, {}, {}});
}

template <int dim>
void Composition<dim>::fill_conductors() {
  double largest = 0;
  for (const Part &part : parts_)
    largest = std::max(largest, dense::eigenvalues(part.crystal.permittivity).maxCoeff());
  if (largest == 0)              // all metal
    largest = 8.8541878128e-12;  // of the vacuum
  for (Part &part : parts_)
    if (part.crystal.conductor)
      part.crystal.permittivity = contrast * largest * Tensor::Identity();
}

template <int dim>
void Composition<dim>::check_reference_temperatures() const {
  for (const Part &part : parts_)
    if (part.crystal.reference_temperature != reference_temperature())
      throw CaseError(fmt::format(
          "[[region]] the reference temperatures {} K and {} K of two materials differ; give all "
          "the same `reference_temperature`, to which temperatures are differences",
          reference_temperature(), part.crystal.reference_temperature));
}

template <int dim>
BodyConstants<dim> Composition<dim>::at(std::size_t region, const Place &centre) const {
  const Part &part = parts_.at(region);
  if (part.restricted_everywhere)
    return *part.restricted_everywhere;
  return restricted(rotated(part.crystal, crystal_axes(part.asked, dim, centre)));
}

template <int dim>
Constants Composition<dim>::in_space(std::size_t region, const Place &centre) const {
  const Part &part = parts_.at(region);
  Constants c = part.everywhere ? *part.everywhere
                                : rotated(part.crystal, crystal_axes(part.asked, dim, centre));
  if (c.conductor)
    c.permittivity.setZero();
  return c;
}

template <int dim>
Vector Composition<dim>::poling(std::size_t region, const Place &centre) const {
  const Part &part = parts_.at(region);
  if (!material::is_polar(part.crystal))
    return Vector::Zero();
  return part.poling_everywhere ? *part.poling_everywhere
                                : Vector(crystal_axes(part.asked, dim, centre).col(2));
}

template <int dim>
bool Composition<dim>::varies() const {
  return parts_.size() > 1 || !parts_.front().everywhere;
}

template <int dim>
bool Composition<dim>::has_conductors() const {
  return std::any_of(parts_.begin(), parts_.end(),
                     [](const Part &part) { return part.crystal.conductor; });
}

template <int dim>
bool Composition<dim>::is_damped() const {
  return std::any_of(parts_.begin(), parts_.end(), [](const Part &part) {
    return part.crystal.stiffness_damping > 0 || part.crystal.mass_damping > 0;
  });
}

template <int dim>
bool Composition<dim>::resists_motion() const {
  return std::any_of(parts_.begin(), parts_.end(),
                     [](const Part &part) { return part.crystal.mass_damping > 0; });
}

template <int dim>
bool Composition<dim>::is_polar() const {
  return std::any_of(parts_.begin(), parts_.end(),
                     [](const Part &part) { return material::is_polar(part.crystal); });
}

template class Composition<2>;
template class Composition<3>;

}  // namespace tourmaline::material
