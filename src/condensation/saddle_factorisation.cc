#include "tourmaline/condensation/saddle_factorisation.h"

#include <dmumps_c.h>
#include <fmt/format.h>

#include <chrono>

#include "tourmaline/error.h"
#include "tourmaline/parallel/ranks.h"

namespace tourmaline::condensation {

namespace {

constexpr int use_comm_world = -987654;  // MUMPS: the Fortran handle of MPI_COMM_WORLD
enum class Job : int { initialise = -1, finish = -2, analyse = 1, factorise = 2, solve = 3 };
constexpr int singular = -10, little_work_space = -8, little_main_space = -9;
constexpr int most_spare_memory = 1000;  // per cent

double seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace

struct SaddleFactorisation::Instance {
  DMUMPS_STRUC_C mumps{};
  SymmetricMatrix matrix;
  std::vector<int> position;
  FactorisationStatistics statistics;
  int count = 0;

  Instance() = default;
  Instance(const Instance &) = delete;
  Instance &operator=(const Instance &) = delete;
  ~Instance() { attempt(Job::finish); }
  int &icntl(int i) { return mumps.icntl[i - 1]; }  // numbered as in MUMPS's guide
  int infog(int i) const { return mumps.infog[i - 1]; }
  int attempt(Job job);
  void call(Job job);
  void factorise_with_room();
  void check() const;
  void set_controls(int threads);
  void set_matrix();
};

int SaddleFactorisation::Instance::attempt(Job job) {
  mumps.job = static_cast<int>(job);
  dmumps_c(&mumps);
  return infog(1);
}

void SaddleFactorisation::Instance::call(Job job) {
  attempt(job);
  check();
}

// Pivoting makes the factor larger than the analysis foresees, by an amount that nobody knows.
void SaddleFactorisation::Instance::factorise_with_room() {
  int code = attempt(Job::factorise);
  while ((code == little_work_space || code == little_main_space) &&
         icntl(14) < most_spare_memory) {
    icntl(14) *= 2;
    code = attempt(Job::factorise);
  }
  check();
}

void SaddleFactorisation::Instance::check() const {
  const int code = infog(1);
  if (code >= 0)
    return;
  if (code == singular)
    throw SolveError(
        "the matrix of the Newton step is singular: some displacement or the potential is not "
        "held; check the boundary conditions");
  if (code == little_work_space || code == little_main_space || code == -13 || code == -19)
    throw MachineError(fmt::format(
        "not enough memory to factorise {} unknowns (MUMPS error {}, {}); use a coarser mesh, or "
        "solver.method = \"condensed\"",
        mumps.n, code, infog(2)));
  throw SolveError(fmt::format("MUMPS failed with error {} ({})", code, infog(2)));
}

// The same as for the condensed body, but for what belongs to pivoting.
void SaddleFactorisation::Instance::set_controls(int threads) {
  for (const int stream : {1, 2, 3})
    icntl(stream) = -1;
  icntl(4) = 0;         // silent
  icntl(6) = 0;         // no permutation to the diagonal,
  icntl(12) = 1;        // nor any other analysis of values, which change
  icntl(8) = 0;         // no scaling: unknowns and multipliers are scaled already
  icntl(7) = 1;         // our ordering
  icntl(13) = 1;        // no ScaLAPACK at the root
  icntl(14) = 40;       // per cent of spare memory
  icntl(16) = threads;  // OpenMP
  icntl(10) = 0;        // no iterative refinement: the Newton iteration refines
}

void SaddleFactorisation::Instance::set_matrix() {
  mumps.n = matrix.size;
  mumps.perm_in = position.data();
  if (parallel::n_ranks() == 1) {
    mumps.nnz = static_cast<MUMPS_INT8>(matrix.value.size());
    mumps.irn = matrix.row.data();
    mumps.jcn = matrix.column.data();
    mumps.a = matrix.value.data();
    return;
  }
  icntl(18) = 3;  // every rank brings entries of its own
  mumps.nnz_loc = static_cast<MUMPS_INT8>(matrix.value.size());
  mumps.irn_loc = matrix.row.data();
  mumps.jcn_loc = matrix.column.data();
  mumps.a_loc = matrix.value.data();
}

SaddleFactorisation::SaddleFactorisation(SymmetricMatrix matrix, const std::vector<int> &position,
                                         int threads)
    : instance_(std::make_unique<Instance>()) {
  Instance &in = *instance_;
  in.matrix = std::move(matrix);
  for (const int p : position)
    in.position.push_back(p + 1);
  in.mumps.comm_fortran = use_comm_world;
  in.mumps.par = 1;
  in.mumps.sym = 2;
  in.call(Job::initialise);
  in.set_controls(threads);
  in.set_matrix();
  const double start = seconds();
  in.call(Job::analyse);
  in.statistics.analyse_seconds = seconds() - start;
}

SaddleFactorisation::~SaddleFactorisation() = default;

std::vector<double> &SaddleFactorisation::values() {
  return instance_->matrix.value;
}

void SaddleFactorisation::factorise() {
  Instance &in = *instance_;
  const double start = seconds();
  in.factorise_with_room();
  in.statistics.factorise_seconds += seconds() - start;
  in.statistics.factor_entries = in.infog(9) >= 0 ? in.infog(9) : -1000000LL * in.infog(9);
  in.statistics.negative_pivots = in.infog(12);
  in.statistics.flops = in.mumps.rinfog[2];
  ++in.count;
}

void SaddleFactorisation::solve(std::vector<double> &right_side) {
  Instance &in = *instance_;
  in.mumps.rhs = right_side.data();
  in.mumps.nrhs = 1;
  in.mumps.lrhs = in.mumps.n;
  in.call(Job::solve);
  parallel::from_first(std::span<double>(right_side));
}

int SaddleFactorisation::count() const {
  return instance_->count;
}

const FactorisationStatistics &SaddleFactorisation::statistics() const {
  return instance_->statistics;
}

}  // namespace tourmaline::condensation
