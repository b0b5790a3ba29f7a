#pragma once

#include "tourmaline/case/case.h"

namespace tourmaline::condensation {

/// Who factorises: own, on one rank only; mumps; automatic is own where it can.
enum class Factoriser { automatic, own, mumps };

struct FactorisationChoice {
  Factoriser by = Factoriser::automatic;
  int threads = 1;
};

/// What a case says of it. Throws CaseError where it asks for "own" on several ranks.
FactorisationChoice choice_of(const casefile::SolverCase &solver);

}  // namespace tourmaline::condensation
