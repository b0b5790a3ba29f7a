#pragma once

#include "material/orientation.h"
#include "material/plane.h"
#include "plane_waves.h"
#include "solve/model.h"
#include "tourmaline/case/case.h"

/// Fields are chosen; the loads, charges, heat sources and boundary conditions that make them the
/// solution follow from (1)-(6), (8), (11), (13). All couplings are active: the poling axis is
/// tilted, so every in-plane (2D) or every (3D) entry of the tensors is there, and the pyroelectric
/// vector has a part across that axis.
namespace tourmaline::verified {

/// Courses whose rates are exact in backward Euler; they differ, so that no field's rate follows
/// from another's.
inline const Course of_displacement{"1+2*t", "2", 1}, of_potential{"1.5-0.75*t", "-0.75", 1.5},
    of_temperature{"0.5+1.5*t", "1.5", 0.5};

/// A wave for every field, all fields different.
template <int dim>
Waves<dim> waves(const Profile &profile);

template <>
inline Waves<2> waves<2>(const Profile &profile) {
  return {{{0.3, {2.1, 0.9}, 0.2, profile, of_displacement},
           {0.25, {-1.3, 2.0}, 0.7, profile, of_displacement},
           {0.4, {1.7, -1.1}, 1.1, profile, of_potential},
           {0.5, {0.8, 2.3}, -0.4, profile, of_temperature}}};
}

template <>
inline Waves<3> waves<3>(const Profile &profile) {
  return {{{0.3, {1.9, 0.8, -0.6}, 0.2, profile, of_displacement},
           {0.25, {-0.7, 1.6, 1.0}, 0.7, profile, of_displacement},
           {0.2, {0.5, -1.2, 1.7}, -0.3, profile, of_displacement},
           {0.4, {1.4, 0.9, 1.1}, 1.1, profile, of_potential},
           {0.5, {-0.8, 1.5, 1.2}, -0.4, profile, of_temperature}}};
}

/// A material whose constants are all about 1, so that every coupling counts.
inline casefile::MaterialCase coupled_material(int dimension) {
  casefile::MaterialCase asked;
  asked.constants = {{"c11", 3},
                     {"c12", 1},
                     {"c13", 0.8},
                     {"c33", 2.5},
                     {"c44", 0.9},
                     {"e31", -0.3},
                     {"e33", 0.9},
                     {"e15", 0.6},
                     {"beta11", 1.1},
                     {"beta33", 1.4},
                     {"m11", 0.5},
                     {"m33", 0.3},
                     {"k11", 0.7},
                     {"k33", 1.2},
                     {"density", 1},
                     {"specific_heat", 2},
                     {"reference_temperature", 1.5}};
  asked.pyroelectric = std::vector<double>{0.2, 0.1, 0.4};
  asked.poling = {0.3, -0.5, 0.8};
  asked.axis1 = {0.9, 0.2, -0.4};
  if (dimension == 2) {
    asked.pyroelectric = std::vector<double>{0.2, 0.4};
    asked.poling = {0.5, 0.8};
    asked.axis1.clear();
  }
  return asked;
}

/// A side of the box and the direction of its outer normal.
struct Side {
  const char *name;
  int axis, sign;
};

inline std::vector<Side> sides(int dimension) {
  if (dimension == 2)
    return {{"left", 0, -1}, {"right", 0, 1}, {"bottom", 1, -1}, {"top", 1, 1}};
  return {{"left", 0, -1}, {"right", 0, 1},   {"front", 1, -1},
          {"back", 1, 1},  {"bottom", 2, -1}, {"top", 2, 1}};
}

template <int dim>
Vector<dim> normal_of(const Side &side) {
  return side.sign * Vector<dim>::Unit(side.axis);
}

/// A case on n intervals along each axis and the fields that its loads and conditions are to bring
/// about.
template <int dim>
struct Problem {
  Problem(const casefile::MaterialCase &material, const Waves<dim> &waves, double length,
          double end)
      : exact(constants(material), waves) {
    asked.dimension = dim;
    asked.material = material;
    casefile::Box &box = asked.mesh.box.emplace();
    box.min.assign(dim, 0.);
    box.max.assign(dim, length);
    asked.time.end = end;
    asked.time.steps = 2;
    asked.output.fields = false;
    asked.output.every = 1;
    for (int i = 0; i < dim; ++i) {
      asked.load.force.emplace_back(exact.force(i));
      asked.initial.displacement.emplace_back(exact.at_start(i));
    }
    asked.load.charge = casefile::Formula(exact.charge());
    asked.load.heat = casefile::Formula(exact.heat());
    asked.initial.potential = casefile::Formula(exact.at_start(exact.phi));
    asked.initial.temperature = casefile::Formula(exact.at_start(exact.theta));
  }

  void on_mesh(casefile::CellShape shape, int degree, int n) {
    asked.mesh.degree = degree;
    asked.mesh.box->cell = shape;
    asked.mesh.box->cells.assign(dim, n);
  }
  void prescribe_displacement(const Side &side) {
    casefile::BoundaryCase &boundary = on(side);
    boundary.displacement.emplace();
    for (int i = 0; i < dim; ++i)
      boundary.displacement->emplace_back(exact.value(i));
  }
  void prescribe_potential(const Side &side) {
    on(side).potential = casefile::Formula(exact.value(exact.phi));
  }
  void prescribe_temperature(const Side &side) {
    on(side).temperature = casefile::Formula(exact.value(exact.theta));
  }
  void prescribe(const Side &side) {
    prescribe_displacement(side);
    prescribe_potential(side);
    prescribe_temperature(side);
  }
  void pull(const Side &side) {
    casefile::BoundaryCase &boundary = on(side);
    boundary.traction.emplace();
    for (int i = 0; i < dim; ++i)
      boundary.traction->emplace_back(exact.traction(i, normal_of<dim>(side)));
  }
  void charge(const Side &side) {
    on(side).surface_charge = casefile::Formula(exact.surface_charge(normal_of<dim>(side)));
  }
  void draw_heat(const Side &side) {
    on(side).heat_flux = casefile::Formula(exact.heat_flux(normal_of<dim>(side)));
  }

  casefile::Case asked;
  Manufactured<dim> exact;

 private:
  static material::BodyConstants<dim> constants(const casefile::MaterialCase &material) {
    return material::restricted<dim>(
        material::rotated(material::constants_of(material), material::crystal_axes(material, dim)));
  }
  casefile::BoundaryCase &on(const Side &side) {
    for (casefile::BoundaryCase &boundary : asked.boundaries)
      if (boundary.on.front() == side.name)
        return boundary;
    asked.boundaries.emplace_back().on = {side.name};
    return asked.boundaries.back();
  }
};

template <int dim>
Problem<dim> coupled(const Profile &profile) {
  return {coupled_material(dim), waves<dim>(profile), 1, 1};
}

template <int dim>
Problem<dim> held_on_all_sides(const Profile &profile) {
  Problem<dim> problem = coupled<dim>(profile);
  for (const Side &side : sides(dim))
    problem.prescribe(side);
  return problem;
}

}  // namespace tourmaline::verified
