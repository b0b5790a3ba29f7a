#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "output/records.h"
#include "report/contact_face.h"
#include "report/contact_line.h"
#include "report/legend.h"
#include "report/skin.h"
#include "report/solid.h"
#include "report/table.h"
#include "tourmaline/case/case.h"

namespace tourmaline::report {

/// A field over the skin of a body and over time. `values[c]` holds component c: for each state the
/// values at all places, one state behind the other.
struct Field {
  std::string name;
  std::string unit;
  bool on_points = true;
  std::vector<std::string> components;  ///< x, y, ...; xx, yy, ...; one empty name for a scalar
  std::vector<std::vector<float>> values;
  std::vector<std::vector<float>> inner =
      {};  ///< the same behind the skin, where the result has that
  /// Its differences are smaller than round-off in the run's energies.
  bool below_round_off = false;

  /// An unknown of the body, not derived from one.
  bool is_unknown() const {
    return name == "displacement" || name == "potential" || name == "temperature";
  }
  /// How its values come about: "mean of each cell", "recovered at the nodes"; empty: as computed.
  std::string origin() const;
};

/// A named part of the boundary, its facets by the skin's nodes: corners in a circle, in 2D along
/// the line.
struct Boundary {
  std::string name;
  Conditions conditions;
  std::vector<std::vector<std::uint32_t>> facets;
};

/// What a probe told in every step, one row for each of them; along a line one for each place.
struct ProbeTable {
  std::string name;
  bool is_line;
  Table table;
};

/// A result folder, read back. What is not there is empty, with a remark where somebody may look
/// for it.
struct Result {
  std::string name;  ///< of the folder
  int dimension = 2;
  std::string resolved;                 ///< resolved.toml
  std::optional<casefile::Case> asked;  ///< the same, read
  std::string friction_name;            ///< of a program's own laws; empty: the case's
  std::string summary;                  ///< summary.json
  std::optional<Table> history, contact;
  std::vector<ProbeTable> probes;
  std::vector<ContactPiece> contact_pieces;  ///< of a plane body
  std::vector<ContactFace> contact_faces;    ///< of a solid body
  std::vector<double> friction_bound;        ///< S at each row of `contact` [N/m^2]; empty: none
  std::vector<std::string> remarks;

  Skin skin;
  std::optional<Solid> solid;             ///< where it was asked for
  std::size_t n_points = 0, n_cells = 0;  ///< of the body
  std::vector<Vector3> points;            ///< of the skin's nodes [m]
  std::vector<Boundary> boundaries;
  std::size_t n_states = 0;   ///< field files that there are
  std::vector<double> times;  ///< of those that are read [s]
  std::vector<int> steps;
  std::vector<Field> fields;

  /// What its contacts are called, in the order of their numbers; none where the case is unknown.
  std::vector<std::string> contact_names() const;
  const Field *field(const std::string &name) const;
};

/// Which of the field files are read: so many, evenly and the last one among them, that they hold
/// at most `most_numbers` numbers on the skin; the last one always. Or the one nearest to `time`
/// [s].
struct States {
  std::size_t most_numbers = 0;
  std::optional<double> time = std::nullopt;
  bool means_of_recovered = false;  ///< means over cells, too, of what is recovered at the nodes
  /// What lies behind the skin of a solid body is read, too, where that is at most so many numbers.
  std::size_t most_inner = 0;
};

/// Reads the folder that a run left. Throws CaseError when it is no result folder or a file in it
/// is damaged.
Result read_result(const std::filesystem::path &folder, const States &states);

}  // namespace tourmaline::report
