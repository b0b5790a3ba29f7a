#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "output/records.h"

namespace tourmaline::output {

/// Wall-clock seconds of a run; NaN where a stage did not take place.
struct Seconds {
  static constexpr double none = std::numeric_limits<double>::quiet_NaN();
  struct Steps {
    double total = none, per_step = none;  // per_step: the mean
    // Of the total: in the factor, in the contact problem, to find the errors of solutions.
    double substitutions = none, contact = none, estimates = none;
  };
  double start = none;      // from the start of the program to the first stage
  double mesh = none;       // build or read the mesh
  double assemble = none;   // operator and loads
  double analyse = none;    // ordering and symbolic factorisation
  double factorise = none;  // numerical factorisation, all of them
  double condense = none;   // Schur complement and what the interface needs of it
  Steps step;               // the time loop without its output
  double output = none;     // everything written to the result folder
  double total = none;
};

/// What a part of the body is made of.
struct MaterialRecord {
  std::string region;     // names or formula; empty: the whole body
  std::string material;   // entry of the library
  std::string couplings;  // which there are and which not
};

/// One of several contacts.
struct ContactRecord {
  std::string name;
  std::int64_t nodes = 0;  // that its laws hold at
};

/// What a run says about itself when it is over.
struct Summary {
  std::string title;                              // the case's
  std::string version;                            // Tourmaline's
  std::map<std::string, std::string> components;  // versions of the libraries, by their names
  std::string friction_name;                      // of laws that a program brought along
  std::map<std::string, std::string> inputs;   // digests of the files that the case reads, by name
  std::map<std::string, std::uint64_t> files;  // bytes of the other files, see file_sizes
  std::map<std::string, std::int64_t> sizes;   // nodes, cells, unknowns, contact_nodes, steps, ...
  std::map<std::string, std::int64_t> iterations;  // newton_total, newton_max, ...
  std::int64_t factorisations = 0;                 // of the body's operator
  std::string factorised_by;                       // own or mumps; empty: nothing was
  std::string instead_of_own;  // why MUMPS, where the own factorisation was tried first
  std::optional<std::int64_t> negative_pivots;  // where the factorisation counts them
  double backward_error = Seconds::none;        // largest of the run's linear solves, relative
  double forward_error = Seconds::none;         // estimate of the largest, relative
  bool is_refined = false;                      // whether the solutions were refined
  std::vector<Extreme> extremes;
  Seconds seconds;
  std::vector<MaterialRecord> materials;
  std::vector<ContactRecord> contacts;  // empty where there is but one
  std::uint64_t peak_memory_bytes = 0;  // largest resident set, all ranks together
  std::vector<std::string> warnings;
};

/// summary.json: the keys case, friction_law (where a program brought it along), versions, inputs,
/// files, sizes, iterations, factorisations, negative_pivots, backward_error, forward_error,
/// refined, extremes, materials, contacts (of several), seconds, memory (bytes), warnings, in this
/// order. Numbers read back as they were; what is not finite or not known is null. Places have
/// `dimension` coordinates.
std::string summary_text(int dimension, const Summary &summary);

}  // namespace tourmaline::output
