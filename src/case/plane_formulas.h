#pragma once

namespace tourmaline::casefile {

struct Case;

/// Throws CaseError for a formula of a two-dimensional case that uses z, which would be 0 all over
/// the body.
void check_plane(const Case &asked);

}  // namespace tourmaline::casefile
