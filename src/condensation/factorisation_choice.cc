#include "condensation/factorisation_choice.h"

#include "parallel/ranks.h"
#include "tourmaline/error.h"

namespace tourmaline::condensation {

FactorisationChoice choice_of(const casefile::SolverCase &solver) {
  FactorisationChoice choice{.threads = solver.threads};
  if (solver.factorisation == "own")
    choice.by = Factoriser::own;
  if (solver.factorisation == "mumps")
    choice.by = Factoriser::mumps;
  if (choice.by == Factoriser::own && parallel::n_ranks() > 1)
    throw CaseError(
        "[solver] factorisation = \"own\" is not available on several MPI ranks: start the program "
        "without mpirun, where solver.threads share the work, or leave it \"automatic\"");
  return choice;
}

}  // namespace tourmaline::condensation
