#pragma once

#include "tourmaline/case/mesh_file.h"

namespace tourmaline::mesh {

/// A mesh as a file lists it, made fit for use: vertices that no cell uses are left out, elements
/// listed twice become one that is in both groups, facets on the boundary that the file does not
/// list are added without a name, and every facet knows whether it lies inside. Throws CaseError
/// for what is no body: coordinates that are no numbers, a plane body outside of z = 0, a cell that
/// one group lists twice, facets of more than two cells, listed facets that no cell has, cells
/// whose Jacobian is not of one sign, cells that overlap their neighbours, vertices at one place
/// that are not the same (parts that touch but are not joined), pieces that nothing holds together.
casefile::MeshFile completed(casefile::MeshFile listed);

}  // namespace tourmaline::mesh
