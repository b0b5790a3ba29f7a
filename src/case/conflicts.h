#pragma once

#include <string>
#include <vector>

namespace tourmaline::casefile {

struct Case;
struct MeshCase;

/// Names of what a boundary consists of: a side of a box is one part; boundaries of a mesh file may
/// share parts.
std::vector<std::string> parts_of_boundary(const MeshCase &mesh, const std::string &boundary);

/// Throws CaseError when a boundary has two conditions on one field: a displacement component and a
/// traction there, a potential and a charge, a temperature and a heat flow, any of them twice, or
/// any of them where the contact laws have their say. A traction component that is exactly zero is
/// no condition beside a displacement.
void check_conflicts(const Case &asked);

}  // namespace tourmaline::casefile
