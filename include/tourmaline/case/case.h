#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tourmaline/case/formula.h"
#include "tourmaline/case/mesh_file.h"

/// What the user asked for: plain structs, one for each table of the case file. They hold values
/// that have been read and checked; defaults stand here and nowhere else. All values are SI.
namespace tourmaline::casefile {

int dimension_of(CellShape shape);
const char *name_of(CellShape shape);
/// The shape of that name, one of `name_of`; throws CaseError otherwise.
CellShape shape_named(const std::string &name);

/// [mesh] box: `cells` intervals along each axis between the corners `min` and `max` [m]; simplices
/// come from splitting each square or cube.
struct Box {
  std::vector<double> min, max;
  std::vector<int> cells;
  CellShape cell = CellShape::triangle;
  /// by name of a side, how many times smaller the cells are there than where they are largest
  /// along that axis; what is not named: 1
  std::map<std::string, double> grading = {};
};

/// [mesh] annulus: the ring between two circles about the origin, in three dimensions a tube along
/// z that stands on z = 0. `cells` intervals along the radius, around and, in 3D, along z; the
/// corners of the cells lie on circles, their edges are straight.
struct Annulus {
  double inner = 0, outer = 0, height = 0;  ///< [m]; height in 3D only
  std::vector<int> cells;
  CellShape cell = CellShape::triangle;
};

struct MeshCase {
  std::optional<Box> box;
  std::optional<Annulus> annulus;
  std::optional<std::string> file;          ///< Gmsh's or CAD's, absolute once it is read
  std::optional<double> size;               ///< of the largest cells of a geometry [m]
  double scale = 1;                         ///< the file's unit of length [m]
  std::string unnamed = "error";            ///< error | natural: boundary facets without a name
  int degree = 1;                           ///< of the finite elements, 1 or 2
  std::string modes = "none";               ///< none | incompatible: of linear cells
  std::shared_ptr<const MeshFile> content;  ///< of `file`
};

int dimension_of(const MeshCase &mesh);
CellShape shape_of(const MeshCase &mesh);

/// [material], [region.material], and an entry of a file of materials: constants in crystal axes,
/// of the stress-charge or the strain-charge form. What is not given is taken from the library's
/// entry; without an entry it must be given.
struct MaterialCase {
  std::string where;  ///< file and line of the table, for error texts
  std::optional<std::string> library;
  std::optional<std::string> file;      ///< of materials, absolute once it is read
  std::string source;                   ///< of an entry: where its numbers are from
  std::vector<std::string> not_given;   ///< of an entry: what a case must add to it
  std::optional<std::string> symmetry;  ///< one of `symmetry_classes`; 6mm when nothing says it
  std::optional<bool> conductor;        ///< no electric field inside
  /// scalar constants by their usual names (`constants_of_class`)
  std::map<std::string, double> constants;
  std::optional<std::vector<std::vector<double>>> compliance;           ///< 6x6 Voigt [1/Pa]
  std::optional<std::vector<std::vector<double>>> strain_coefficients;  ///< d, 3x6 Voigt [C/N]
  std::optional<std::vector<std::vector<double>>> permittivity_T;       ///< 3x3 [C/(V m)]
  std::optional<std::vector<double>> thermal_expansion;                 ///< 6 Voigt [1/K]
  std::optional<std::vector<double>> pyroelectric_T;                    ///< as `pyroelectric`
  std::optional<std::vector<std::vector<double>>> stiffness;            ///< 6x6 Voigt [Pa]
  std::optional<std::vector<std::vector<double>>> piezoelectric;        ///< 3x6 Voigt [C/m^2]
  std::optional<std::vector<std::vector<double>>> permittivity;         ///< 3x3 [C/(V m)]
  std::optional<std::vector<double>> thermal_stress;                    ///< 6 Voigt [N/(K m^2)]
  std::optional<std::vector<double>> pyroelectric;  ///< (p1, p3) in 2D, or (p1, p2, p3) [C/(K m^2)]
  std::optional<std::vector<std::vector<double>>> conductivity;  ///< 3x3 [W/(K m)]
  /// direction of the crystal's axis 3 (the poling axis), by place; empty: y in 2D, z in 3D
  FormulaVector poling;
  /// direction of the crystal's axis 1, made orthogonal to `poling`; empty: x, or any when x is the
  /// poling axis. Matters only for crystals that are not isotropic about axis 3.
  std::vector<double> axis1;
};

/// One [[region]] entry: a part of the body, by the names in a mesh file or by a condition on the
/// centres of the cells, and what it is made of.
struct RegionCase {
  std::vector<std::string> on;
  std::optional<Formula> inside;  ///< `where` in the case file: a cell belongs to it where not zero
  std::string place;              ///< file and line of the entry, for error texts
  MaterialCase material;
};

struct TimeCase {
  double end = 1;  ///< [s]
  int steps = 1;
};

/// One [[boundary]] entry. What is not given is the natural condition.
struct BoundaryCase {
  std::vector<std::string> on;
  std::string where;  ///< file and line of the entry, for error texts
  /// an entry is empty where the component is "free" [m]
  std::optional<std::vector<std::optional<Formula>>> displacement;
  std::optional<Formula> potential;       ///< [V]
  std::optional<Formula> temperature;     ///< [K], difference to the reference temperature
  std::optional<FormulaVector> traction;  ///< sigma nu = f_N [N/m^2]
  std::optional<Formula> surface_charge;  ///< D.nu = phi_b [C/m^2]
  std::optional<Formula> heat_flux;       ///< q.nu [W/m^2], positive leaves the body
};

/// One [[electrode]] entry: boundaries that share one potential. In two dimensions charges,
/// resistances and capacitances are those of one metre of thickness.
struct ElectrodeCase {
  std::string name;
  std::vector<std::string> on;
  std::string where;
  /// [V] of the electrode; beside a resistor or capacitor of their other end, 0 when not given
  std::optional<Formula> voltage;
  std::optional<Formula> charge;    ///< total charge on the electrode [C]
  std::optional<double> resistor;   ///< [ohm]
  std::optional<double> capacitor;  ///< [F], parallel to the resistor
  std::optional<std::string> to;    ///< electrode at the other end of resistor and capacitor

  bool is_loaded() const { return resistor || capacitor; }
  /// Whether the potential is given, and not an unknown of the step.
  bool is_driven() const { return voltage && !is_loaded(); }
};

struct FrictionCase {
  std::string law = "none";  ///< none | tresca
  Formula bound = 0;         ///< S [N/m^2]
};

struct HeatExchangeCase {
  std::string law = "insulated";       ///< insulated | exchange
  Formula coefficient = 0;             ///< k_c [W/(K m^2)], no dependence on t
  Formula foundation_temperature = 0;  ///< theta_f [K], difference to the reference temperature
};

struct ContactCase {
  std::vector<std::string> on;
  std::string where;
  std::string normal = "bilateral";
  FrictionCase friction;
  HeatExchangeCase heat;
};

struct SolverCase {
  std::string method = "condensed";  ///< condensed | monolithic
  std::string body = "automatic";    ///< automatic | direct | iterative; of the condensed method
  double linear_tolerance = 1e-11;   ///< of the iterative solution of the body's equations
  double tolerance =
      1e-12;  ///< of the contact iteration: natural residual over the largest nodal force
  int max_iterations = 100;          ///< Newton iterations in one step
  int threads = 1;                   ///< of OpenBLAS and OpenMP
  std::string multiplier = "nodal";  ///< nodal | piecewise-constant; of the monolithic route
  /// r_nu [N/m^3] and r_tau [N s/m^3] of (40), (41); not given: from the stiffness at the contact
  std::optional<double> r_normal, r_tangential;
};

struct OutputCase {
  bool fields = true;
  int every =
      0;  ///< steps between two field files; 0 while reading: so many that at most 50 are left
  bool report = true;
  std::string checkpoint = "5 min";  ///< between two checkpoints: steps, a time, or never
};

struct LoadCase {
  FormulaVector force;  ///< f_0 [N/m^3]; empty: none
  Formula charge = 0;   ///< phi_0 [C/m^3]
  Formula heat = 0;     ///< q_0 [W/m^3]
};

struct InitialCase {
  FormulaVector displacement;  ///< u_0 [m]; empty: zero
  Formula potential = 0;       ///< phi_0 [V]
  Formula temperature = 0;     ///< theta_0 [K]
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
  std::optional<ContactCase> contact;
  SolverCase solver;
  OutputCase output;
  LoadCase load;
  InitialCase initial;

  int dimension = 2;  ///< 2 or 3, from the mesh
};

}  // namespace tourmaline::casefile
