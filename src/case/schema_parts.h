#pragma once

#include <optional>
#include <string>
#include <vector>

#include "case/schema.h"

/// The declarations of the case file's tables, which `declare(Visitor &, Case &)` puts together.
namespace tourmaline::casefile {

struct BoundaryCase;
struct ContactCase;
struct ElectrodeCase;
struct ProbeCase;

void declare(Visitor &v, MeshCase &mesh);

/// [material] and [region.material].
void declare(Visitor &v, MaterialCase &material, int dimension);
/// Either [material] or [[region]].
void declare_composition(Visitor &v, Case &asked);

/// The key `on` of a condition, with the names that the mesh has.
Key on_sides(const std::string &description, const MeshCase &mesh);
/// A key of what is of the whole body, in that unit, and of plane bodies that of a metre of depth.
Key of_whole_body(Key key, bool is_per_depth);
/// Of names in a mesh file that lie inside, where a condition would mean something else.
std::string inside_complaint(const std::vector<std::string> &on, const MeshCase &mesh);

void declare_boundaries(Visitor &v, std::vector<BoundaryCase> &boundaries, const MeshCase &mesh,
                        int dimension);
void declare_electrodes(Visitor &v, std::vector<ElectrodeCase> &electrodes, const MeshCase &mesh,
                        bool is_per_depth);
void declare_contacts(Visitor &v, std::vector<ContactCase> &contacts, const MeshCase &mesh,
                      int dimension, bool is_per_depth);
/// The tables that a run writes of single places, lines, boundaries and regions.
void declare_probes(Visitor &v, std::vector<ProbeCase> &probes, const MeshCase &mesh, int dimension,
                    bool is_axisymmetric);
std::string multiplier_complaint(const std::vector<ContactCase> &contacts,
                                 const std::string &multiplier);

}  // namespace tourmaline::casefile
