#pragma once

#include <Eigen/Dense>
#include <map>
#include <string>
#include <vector>

namespace tourmaline::verified {

/// Exponents of length, force, voltage, temperature and time in a unit.
struct Dimension {
  int length = 0, force = 0, voltage = 0, temperature = 0, time = 0;
};

/// How many of the new units are one of the old.
struct Units {
  double length = 1, force = 1, voltage = 1, temperature = 1, time = 1;

  double factor(const Dimension &of) const;
};

/// Of a key of the case file; resistors in three dimensions. Contact laws share the key
/// `coefficient`: theirs is that of the `law`, the name of its table and its own.
Dimension dimension_of_key(const std::string &key, const std::string &law = {});

/// A mesh file: vertices of the cells in Gmsh's order.
struct SampleMesh {
  std::vector<Eigen::VectorXd> points;
  std::vector<std::vector<int>> cells, facets;
  std::vector<int> region, side;  ///< of cells and facets, named "region0" and "side0"
  bool simplices = false;

  std::string text() const;  ///< of Gmsh's format 2.2
};

/// course(t / end) * (value + gradient x). Courses have {} for the time.
struct Term {
  std::string course;
  Eigen::VectorXd value;
  Eigen::MatrixXd gradient;
};

/// What is prescribed by a formula, or by one for each axis.
struct Condition {
  std::string table, on, key;   ///< `on` is a side, or empty
  std::vector<Term> terms;      ///< their sum
  std::vector<bool> free = {};  ///< components that are not prescribed; empty: none
  bool is_law = false;          ///< no load, but part of the operator or of a contact law
  double resistor = 0;          ///< of an electrode; 0: none
};

struct SampleMaterial {
  std::string symmetry;  ///< 6mm, mm2 or 3m: classes with a mirror plane across axis 1
  std::map<std::string, double> constants;
  Eigen::VectorXd poling, axis1;
  bool conductor = false;
};

/// A case that transformations can be done to.
struct Sample {
  SampleMesh mesh;
  int degree = 1;
  bool incompatible = false;
  std::vector<SampleMaterial> materials;  ///< by region
  std::vector<Condition> conditions;
  std::string contact;                           ///< side; empty: none
  std::map<std::string, std::string> laws = {};  ///< of the contact, by table
  std::map<std::string, double> numbers = {};    ///< of laws, by table and key
  double end = 1;
  int steps = 2;
  std::string solver = "method = \"condensed\", body = \"direct\", tolerance = 1e-14";

  int dimension() const { return static_cast<int>(mesh.points.front().size()); }
  std::string law_of(const std::string &table) const;  ///< for `dimension_of_key`
  bool has_free_components() const;
  bool contact_is_tilted() const;  ///< to the axes, somewhere
  /// nullptr: none.
  const Condition *find(const std::string &table, const std::string &key) const;
  std::string text() const;  ///< the case file, whose mesh file is `sample.msh`
};

}  // namespace tourmaline::verified
