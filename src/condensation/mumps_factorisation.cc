#include "condensation/mumps_factorisation.h"

#include <utility>

#include "mumps.h"
#include "parallel/ranks.h"

namespace tourmaline::condensation {

struct MumpsFactorisation::Instance {
  Mumps mumps;
  std::vector<int> schur;
  std::vector<double> schur_complement, reduced;

  Instance(SymmetricMatrix matrix, const std::vector<int> &position, std::size_t n_schur,
           int threads)
      : mumps(std::move(matrix), position, n_schur, Mumps::Pivoting::none, threads,
              {"the operator of the body", "use a coarser mesh"}) {}
  void set_schur();
  void mirror_schur();
};

void MumpsFactorisation::Instance::set_schur() {
  const int n = static_cast<int>(schur.size());
  if (n == 0)
    return;
  DMUMPS_STRUC_C &data = mumps.data;
  mumps.icntl(19) = 2;  // lower triangle by columns, on the host
  data.size_schur = n;
  data.listvar_schur = schur.data();
  data.nprow = data.npcol = 1;
  data.mblock = data.nblock = 100;
  reduced.assign(n, 0.);
  if (parallel::is_first())
    schur_complement.assign(std::size_t(n) * n, 0.);
  data.schur = schur_complement.data();
  data.schur_lld = n;
  data.redrhs = reduced.data();
  data.lredrhs = n;
}

// MUMPS leaves one triangle; which one depends on how its columns are read.
void MumpsFactorisation::Instance::mirror_schur() {
  const std::size_t n = schur_complement.empty() ? 0 : schur.size();
  for (std::size_t column = 0; column < n; ++column)
    for (std::size_t row = column + 1; row < n; ++row)
      schur_complement[row * n + column] = schur_complement[column * n + row];
}

MumpsFactorisation::MumpsFactorisation(SymmetricMatrix matrix, const std::vector<int> &position,
                                       const std::vector<int> &schur, int threads)
    : instance_(std::make_unique<Instance>(std::move(matrix), position, schur.size(), threads)) {
  Instance &in = *instance_;
  for (const int v : schur)
    in.schur.push_back(v + 1);
  in.set_schur();
  in.mumps.analyse();
  in.mumps.factorise();
  in.mirror_schur();
  in.mumps.statistics.solver = "mumps";
  in.mumps.release_entries();
}

MumpsFactorisation::~MumpsFactorisation() = default;

const std::vector<double> &MumpsFactorisation::schur_complement() const {
  return instance_->schur_complement;
}

void MumpsFactorisation::set_reason(std::string reason) {
  instance_->mumps.statistics.reason = std::move(reason);
}

const FactorisationStatistics &MumpsFactorisation::statistics() const {
  return instance_->mumps.statistics;
}

std::vector<double> MumpsFactorisation::reduce(std::vector<double> &right_side) {
  Instance &in = *instance_;
  in.mumps.set_right_side(right_side);
  if (in.schur.empty())
    return {};
  in.mumps.icntl(26) = 1;
  in.mumps.call(Mumps::Job::solve);
  parallel::from_first(std::span<double>(in.reduced));
  return in.reduced;
}

void MumpsFactorisation::expand(std::span<const double> interface) {
  Instance &in = *instance_;
  std::copy(interface.begin(), interface.end(), in.reduced.begin());
  in.mumps.icntl(26) = in.schur.empty() ? 0 : 2;
  in.mumps.call(Mumps::Job::solve);
  parallel::from_first(std::span(in.mumps.data.rhs, static_cast<std::size_t>(in.mumps.data.n)));
}

}  // namespace tourmaline::condensation
