#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tourmaline/case/boundary_case.h"
#include "tourmaline/case/contact_case.h"
#include "tourmaline/case/load_case.h"
#include "tourmaline/case/material_case.h"
#include "tourmaline/case/mesh_case.h"
#include "tourmaline/case/probe_case.h"

/// What the user asked for: plain structs, one for each table of the case file. They hold values
/// that have been read and checked; defaults stand here and nowhere else. All values are SI.
namespace tourmaline::casefile {

/// Steps of one size that follow those of the interval before.
struct IntervalCase {
  double until = 1;  ///< [s]
  int steps = 1;
};

struct TimeCase {
  double end = 1;                       ///< [s]
  int steps = 1;                        ///< of all intervals together
  std::vector<IntervalCase> intervals;  ///< empty: steps of one size
  std::optional<double> tolerance;      ///< the program chooses steps, the longest end / steps
  std::string regime = "quasistatic";   ///< quasistatic | static | dynamic
  std::string contact_mass = "redistributed";  ///< redistributed | consistent; of the dynamic one

  bool is_static() const { return regime == "static"; }
  bool is_dynamic() const { return regime == "dynamic"; }
};

struct ModelCase {
  std::string plane = "strain";  ///< strain | stress | axisymmetric; of two dimensions
  bool thermal = true;           ///< false: the temperature stays that of reference
  bool electric = true;          ///< false: the potential stays zero everywhere

  /// Of displacement, potential and temperature, whether it is one of the unknowns.
  bool has(const std::string &field) const {
    return field == "temperature" ? thermal : field == "potential" ? electric : true;
  }
  bool is_axisymmetric() const { return plane == "axisymmetric"; }
};

struct SolverCase {
  std::string method = "condensed";  ///< condensed | monolithic
  std::string body = "automatic";    ///< automatic | direct | iterative; of the condensed method
  std::string factorisation = "automatic";  ///< automatic | own | mumps; of the direct body
  double linear_tolerance = 1e-11;          ///< of the iterative solution of the body's equations
  double tolerance =
      1e-12;  ///< of the contact iteration: natural residual over the largest nodal force
  int max_iterations = 100;          ///< Newton iterations in one step
  int threads = 1;                   ///< of the factorisation and of OpenBLAS
  std::string multiplier = "nodal";  ///< nodal | piecewise-constant; of the monolithic route
  /// r_nu [N/m^3] and r_tau [N s/m^3] of (40), (41); not given: from the stiffness at the contact
  std::optional<double> r_normal, r_tangential;
};

struct OutputCase {
  bool fields = true;
  /// Steps between two field files; not given: as many as 50 parts of the time begin.
  std::optional<int> every;
  bool report = true;
  std::string checkpoint = "5 min";  ///< between two checkpoints: steps, a time, or never
};

struct Case {
  std::string title;
  std::string source;  ///< the file's name, for error texts
  MeshCase mesh;
  MaterialCase material;            ///< of the whole body, when there are no regions
  std::vector<RegionCase> regions;  ///< each cell in exactly one of them
  TimeCase time;
  std::vector<BoundaryCase> boundaries;
  std::vector<ElectrodeCase> electrodes;
  std::vector<ContactCase> contacts;  ///< no boundary in two of them
  ModelCase model;
  SolverCase solver;
  std::vector<ProbeCase> probes;
  OutputCase output;
  LoadCase load;
  InitialCase initial;

  int dimension = 2;  ///< 2 or 3, from the mesh

  /// Whether forces, charges, heats and energies are those of a metre across the plane.
  bool is_per_depth() const { return dimension == 2 && !model.is_axisymmetric(); }
};

}  // namespace tourmaline::casefile
