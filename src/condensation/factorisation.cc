#include "tourmaline/condensation/factorisation.h"

#include <dmumps_c.h>
#include <fmt/format.h>
#include <mpi.h>

#include <chrono>

#include "tourmaline/error.h"
#include "tourmaline/parallel/ranks.h"

namespace tourmaline::condensation {

namespace {

constexpr int use_comm_world = -987654;  // MUMPS: the Fortran handle of MPI_COMM_WORLD
constexpr int initialise = -1, finish = -2, analyse = 1, factorise = 2, solve = 3;

double seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace

struct Factorisation::Instance {
  DMUMPS_STRUC_C mumps{};
  SymmetricMatrix matrix;
  std::vector<int> position, schur;
  std::vector<double> schur_complement, reduced;
  FactorisationStatistics statistics;

  Instance() = default;
  Instance(const Instance &) = delete;
  Instance &operator=(const Instance &) = delete;
  ~Instance();
  int &icntl(int i) { return mumps.icntl[i - 1]; }  // numbered as in MUMPS's guide
  int infog(int i) const { return mumps.infog[i - 1]; }
  void call(int job);
  void check() const;
  void set_controls(int threads);
  void set_matrix();
  void set_schur();
  void mirror_schur();
};

Factorisation::Instance::~Instance() {
  mumps.job = finish;
  dmumps_c(&mumps);
}

void Factorisation::Instance::call(int job) {
  mumps.job = job;
  dmumps_c(&mumps);
  check();
}

void Factorisation::Instance::check() const {
  const int code = infog(1);
  if (code >= 0)
    return;
  if (code == -10)
    throw SolveError(
        "the operator of the body is singular: some displacement or the potential is not held; "
        "check the boundary conditions");
  if (code == -9 || code == -13 || code == -19 || code == -8)
    throw MachineError(fmt::format(
        "not enough memory to factorise {} unknowns (MUMPS error {}, {}); use a coarser mesh",
        mumps.n, code, infog(2)));
  throw SolveError(fmt::format("MUMPS failed with error {} ({})", code, infog(2)));
}

// Settings measured on this operator: docs/architecture.md.
void Factorisation::Instance::set_controls(int threads) {
  for (const int stream : {1, 2, 3})
    icntl(stream) = -1;
  icntl(4) = 0;    // silent
  icntl(6) = 0;    // no permutation to the diagonal,
  icntl(8) = 0;    // no scaling: the unknowns are scaled already
  icntl(7) = 1;    // our ordering
  icntl(13) = 1;   // no ScaLAPACK at the root, which would take the matrix for positive definite
  icntl(14) = 40;  // per cent of spare memory
  icntl(16) = threads;  // OpenMP
  icntl(10) = 0;        // no iterative refinement: it needs the matrix and two more substitutions
}

void Factorisation::Instance::set_matrix() {
  mumps.n = matrix.size;
  mumps.perm_in = position.data();
  if (parallel::n_ranks() == 1) {
    mumps.nnz = static_cast<MUMPS_INT8>(matrix.value.size());
    mumps.irn = matrix.row.data();
    mumps.jcn = matrix.column.data();
    mumps.a = matrix.value.data();
    return;
  }
  icntl(18) = 3;  // every rank brings entries of its own; those at equal places are added
  mumps.nnz_loc = static_cast<MUMPS_INT8>(matrix.value.size());
  mumps.irn_loc = matrix.row.data();
  mumps.jcn_loc = matrix.column.data();
  mumps.a_loc = matrix.value.data();
}

void Factorisation::Instance::set_schur() {
  const int n = static_cast<int>(schur.size());
  if (n == 0)
    return;
  icntl(19) = 2;  // lower triangle by columns, on the host
  mumps.size_schur = n;
  mumps.listvar_schur = schur.data();
  mumps.nprow = mumps.npcol = 1;
  mumps.mblock = mumps.nblock = 100;
  reduced.assign(n, 0.);
  if (parallel::is_first())
    schur_complement.assign(std::size_t(n) * n, 0.);
  mumps.schur = schur_complement.data();
  mumps.schur_lld = n;
  mumps.redrhs = reduced.data();
  mumps.lredrhs = n;
}

// MUMPS leaves one triangle; which one depends on how its columns are read.
void Factorisation::Instance::mirror_schur() {
  const std::size_t n = schur_complement.empty() ? 0 : schur.size();
  for (std::size_t column = 0; column < n; ++column)
    for (std::size_t row = column + 1; row < n; ++row)
      schur_complement[row * n + column] = schur_complement[column * n + row];
}

Factorisation::Factorisation(SymmetricMatrix matrix, const std::vector<int> &position,
                             const std::vector<int> &schur, int threads)
    : instance_(std::make_unique<Instance>()) {
  Instance &in = *instance_;
  in.matrix = std::move(matrix);
  for (const int p : position)
    in.position.push_back(p + 1);
  for (const int v : schur)
    in.schur.push_back(v + 1);
  in.mumps.comm_fortran = use_comm_world;
  in.mumps.par = 1;
  in.mumps.sym = 1;
  in.call(initialise);
  in.set_controls(threads);
  in.set_matrix();
  in.set_schur();
  const double start = seconds();
  in.call(analyse);
  const double analysed = seconds();
  in.call(factorise);
  in.statistics = {analysed - start, seconds() - analysed,
                   in.infog(9) >= 0 ? in.infog(9) : -1000000LL * in.infog(9), in.infog(12),
                   in.mumps.rinfog[2]};
  in.mirror_schur();
  in.matrix = {};  // MUMPS keeps the factor only
  in.mumps.irn = in.mumps.jcn = in.mumps.irn_loc = in.mumps.jcn_loc = nullptr;
  in.mumps.a = in.mumps.a_loc = nullptr;
}

Factorisation::~Factorisation() = default;

const std::vector<double> &Factorisation::schur_complement() const {
  return instance_->schur_complement;
}

const FactorisationStatistics &Factorisation::statistics() const {
  return instance_->statistics;
}

std::vector<double> Factorisation::reduce(std::vector<double> &right_side) {
  Instance &in = *instance_;
  in.mumps.rhs = right_side.data();
  in.mumps.nrhs = 1;
  in.mumps.lrhs = in.mumps.n;
  if (in.schur.empty())
    return {};
  in.icntl(26) = 1;
  in.call(solve);
  parallel::from_first(std::span<double>(in.reduced));
  return in.reduced;
}

void Factorisation::expand(std::span<const double> interface) {
  Instance &in = *instance_;
  std::copy(interface.begin(), interface.end(), in.reduced.begin());
  in.icntl(26) = in.schur.empty() ? 0 : 2;
  in.call(solve);
  parallel::from_first(std::span(in.mumps.rhs, static_cast<std::size_t>(in.mumps.n)));
}

}  // namespace tourmaline::condensation
