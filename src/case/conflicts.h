#pragma once

namespace tourmaline::casefile {

struct Case;

/// Throws CaseError when a boundary has two conditions on one field: a displacement component and a
/// traction there, a potential and a charge, a temperature and a heat flow, any of them twice, or
/// any of them where the contact laws have their say. A traction component that is exactly zero is
/// no condition beside a displacement.
void check_conflicts(const Case &asked);

}  // namespace tourmaline::casefile
