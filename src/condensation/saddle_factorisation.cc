#include "condensation/saddle_factorisation.h"

#include <utility>

#include "mumps.h"
#include "parallel/ranks.h"

namespace tourmaline::condensation {

struct SaddleFactorisation::Instance {
  Mumps mumps;
  int count = 0;

  Instance(SymmetricMatrix matrix, const std::vector<int> &position, int threads)
      : mumps(std::move(matrix), position, 0, Mumps::Pivoting::symmetric, threads,
              {"the matrix of the Newton step",
               "use a coarser mesh, or solver.method = \"condensed\""}) {}
};

SaddleFactorisation::SaddleFactorisation(SymmetricMatrix matrix, const std::vector<int> &position,
                                         int threads)
    : instance_(std::make_unique<Instance>(std::move(matrix), position, threads)) {
  instance_->mumps.analyse();
  instance_->mumps.statistics.solver = "mumps";
}

SaddleFactorisation::~SaddleFactorisation() = default;

std::vector<double> &SaddleFactorisation::values() {
  return instance_->mumps.matrix.value;
}

void SaddleFactorisation::factorise() {
  instance_->mumps.factorise();
  ++instance_->count;
}

void SaddleFactorisation::solve(std::vector<double> &right_side) {
  const std::size_t n = right_side.size();
  instance_->mumps.set_right_side(right_side);
  instance_->mumps.call(Mumps::Job::solve);
  right_side.resize(n);
  parallel::from_first(std::span<double>(right_side));
}

int SaddleFactorisation::count() const {
  return instance_->count;
}

const FactorisationStatistics &SaddleFactorisation::statistics() const {
  return instance_->mumps.statistics;
}

}  // namespace tourmaline::condensation
