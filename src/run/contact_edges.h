#pragma once

#include <span>
#include <string>
#include <vector>

#include "body/discretisation.h"
#include "tourmaline/vector.h"

namespace tourmaline::casefile {
struct Case;
}

namespace tourmaline::run {

/// A warning of contacts that meet at an edge of the body (`contact::Interface::edges`), where only
/// the first of them acts on the nodes; empty: none does.
std::string contact_edge_warning(const casefile::Case &asked, const std::vector<Vector3> &points,
                                 std::span<const body::Node> edges);

/// The same before a run; builds the mesh where there are several contacts.
std::string contact_edge_warning(const casefile::Case &asked);

}  // namespace tourmaline::run
