#pragma once

namespace tourmaline::casefile {

struct Case;

/// Throws CaseError for what a case says of a field or a motion that its model does without: of
/// temperatures and heat with `thermal = false`, of potentials and charge with `electric = false`,
/// of an acceleration across the axis of a body of revolution. Zeros say nothing.
void check_left_out(const Case &asked);

}  // namespace tourmaline::casefile
