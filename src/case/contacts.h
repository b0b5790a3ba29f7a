#pragma once

namespace tourmaline::casefile {

struct Case;

/// Throws CaseError where the name of a contact cannot stand in the head of a table, or another
/// contact has it.
void check_contacts(const Case &asked);

}  // namespace tourmaline::casefile
