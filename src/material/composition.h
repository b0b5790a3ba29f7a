#pragma once

#include <optional>
#include <vector>

#include "material/plane.h"
#include "tourmaline/case/material_case.h"

namespace tourmaline::casefile {
struct Case;
}

namespace tourmaline::material {

using Place = std::array<double, 3>;

/// Of the case's regions, or the one of the whole body; what its model does without is left out.
std::vector<casefile::MaterialCase> materials_of(const casefile::Case &asked);

/// What a body of several materials consists of, cell by cell: the constants of each region, turned
/// to the poling at the place of the cell.
///
/// A conductor is a dielectric of so large a permittivity that its field is nothing: `contrast`
/// times the largest of the others along any direction, whatever their axes. The error of this is
/// of the order of 1 / contrast, and the operator of a step stays quasi-definite.
template <int dim>
class Composition {
 public:
  static constexpr double contrast = 1e6;

  /// Throws CaseError for what `constants_of`, `crystal_axes` and `restricted` refuse, and for
  /// regions whose reference temperatures differ.
  explicit Composition(const casefile::Case &asked);

  /// Of the cell with that region (0 when the case has none) and centre [m].
  BodyConstants<dim> at(std::size_t region, const Place &centre) const;
  /// The same in three dimensions, in the axes of the body; a conductor's permittivity is 0 here,
  /// as there is no field and no electric displacement inside.
  Constants in_space(std::size_t region, const Place &centre) const;
  /// Direction of the crystal's axis 3; zero where nothing is piezo- or pyroelectric.
  Vector poling(std::size_t region, const Place &centre) const;

  Plane plane() const { return plane_; }
  bool conducts(std::size_t region) const { return parts_.at(region).crystal.conductor; }
  bool has_conductors() const;
  /// Whether any material resists its rate of strain or its velocity.
  bool is_damped() const;
  /// Whether any resists its velocity, by which a body without supports does not drift at will.
  bool resists_motion() const;
  double reference_temperature() const { return parts_.front().crystal.reference_temperature; }
  /// Whether materials or poling differ from place to place.
  bool varies() const;
  /// Whether `poling` is anywhere not zero.
  bool is_polar() const;

 private:
  struct Part {
    casefile::MaterialCase asked;
    Constants crystal;
    std::optional<Constants> everywhere;  // in the axes of the body, where these do not vary
    std::optional<BodyConstants<dim>> restricted_everywhere;
    std::optional<Vector> poling_everywhere;
  };

  void add(const casefile::MaterialCase &asked);
  BodyConstants<dim> restricted(const Constants &body_axes) const {
    return material::restricted<dim>(body_axes, plane_);
  }
  void fill_conductors();
  void check_reference_temperatures() const;

  Plane plane_;
  std::vector<Part> parts_;
};

}  // namespace tourmaline::material
