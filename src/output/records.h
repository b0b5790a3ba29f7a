#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tourmaline/contact_status.h"
#include "tourmaline/vector.h"

/// What a run hands to its output files: plain numbers in SI units, no mesh library, no MPI.
/// Vectors have three components in 2D too (z = 0); symmetric tensors are xx, yy, zz, xy, yz, xz.
namespace tourmaline::output {

using SymmetricTensor = std::array<double, 6>;

/// VTK's numbers for the cells that we write.
enum class VtkCell : std::uint8_t {
  triangle = 5,
  quadrilateral = 9,
  tetrahedron = 10,
  hexahedron = 12,
  quadratic_triangle = 22,
  quadratic_quadrilateral = 28,  // biquadratic, 9 nodes
  quadratic_tetrahedron = 24,
  quadratic_hexahedron = 29  // triquadratic, 27 nodes
};

/// Nodes and cells; `connectivity` lists each cell's nodes in VTK's order, all cells alike.
struct Grid {
  int dimension = 2;
  std::vector<Vector3> points;
  VtkCell cell = VtkCell::triangle;
  std::size_t nodes_per_cell = 3;
  std::vector<std::uint32_t> connectivity;

  std::size_t n_cells() const { return connectivity.size() / nodes_per_cell; }
};

/// Takes out of a grid the points that none of its cells uses; returns which are left, ascending.
std::vector<std::uint32_t> keep_used_points(Grid &grid);

/// A part of the boundary that has a name, its facets by their nodes: corners in a circle, then the
/// middles of sides and faces of degree 2; a line from end to end, its middle node between.
struct NamedBoundary {
  std::string name;
  std::vector<std::vector<std::uint32_t>> facets;
  bool inside = false;  ///< facets between cells are among them
};

/// Values at the nodes of the grid.
struct PointFields {
  std::vector<Vector3> displacement;  // m
  std::vector<double> potential;      // V
  std::vector<double> temperature;    // K
  // Recovered at the nodes inside each region; empty where only the unknowns are wanted.
  std::vector<SymmetricTensor> stress;    // Pa
  std::vector<Vector3> principal_stress;  // Pa, of that stress, largest first
  std::vector<double> von_mises;          // Pa, of that stress
};

/// Means over each cell, by the constitutive law (1)-(3).
struct CellFields {
  std::vector<SymmetricTensor> stress;         // Pa
  std::vector<Vector3> principal_stress;       // Pa, of that stress, largest first
  std::vector<double> von_mises;               // Pa
  std::vector<SymmetricTensor> strain;         // 1
  std::vector<Vector3> electric_field;         // E = -grad phi, V/m
  std::vector<Vector3> electric_displacement;  // C/m^2
  std::vector<Vector3> heat_flux;              // W/m^2
  // Empty where there is nothing to tell: of one material, of nothing poled.
  std::vector<double> region;   // index of the case's [[region]]
  std::vector<Vector3> poling;  // unit vector; 0 where nothing is piezo- or pyroelectric
};

/// One contact node in one step; traction is sigma nu on the body.
struct ContactRow {
  Vector3 point;
  double normal_traction;       // N/m^2
  Vector3 tangential_traction;  // N/m^2
  double normal_displacement;   // u_nu [m]
  Vector3 slip;                 // u_tau, measured to the foundation [m]
  double slip_rate;             // |slip(n) - slip(n-1)| / k [m/s]
  ContactStatus status;
  double temperature;  // K
  double potential;    // V
  double heat_flux;    // q.nu = k_c (theta - theta_f), positive leaves the body [W/m^2]
  double gap;          // by which body and foundation are apart [m]
  double charge_flux;  // D.nu [C/m^2]
  // Named columns behind these; every row of a run has the same names in the same order.
  std::vector<std::pair<std::string, double>> quantities;
  // Of several contacts the one that the node belongs to: its name and its number in the case.
  std::string contact = {};
  std::int32_t contact_number = 0;
};

/// One line of history.csv. `quantities` are the named columns behind the fixed ones; every step of
/// a run has the same names in the same order.
struct HistoryRow {
  int step = 0;
  double time = 0;
  int newton_iterations = 0;
  double residual = 0;
  std::size_t stick = 0, slip = 0, open = 0;
  std::vector<std::pair<std::string, double>> quantities;

  /// The quantity of that name; null where there is none.
  const double *find(std::string_view name) const;
};

/// The smallest or largest value of a field and the node where it stands.
struct Extreme {
  std::string field;
  double minimum = 0, maximum = 0;
  Vector3 at_minimum{}, at_maximum{};
};

}  // namespace tourmaline::output
