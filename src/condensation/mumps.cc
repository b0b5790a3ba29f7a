#include "mumps.h"

#include <fmt/format.h>

#include <utility>

#include "parallel/ranks.h"
#include "stopwatch.h"
#include "tourmaline/error.h"

namespace tourmaline::condensation {

namespace {

constexpr int use_comm_world = -987654;  // MUMPS: the Fortran handle of MPI_COMM_WORLD
constexpr int little_work_space = -8, little_main_space = -9, singular = -10, no_memory = -13,
              no_work_memory = -19;
constexpr int most_spare = 1000;  // per cent

}  // namespace

Mumps::Mumps(SymmetricMatrix the_matrix, const std::vector<int> &position, std::size_t kept,
             Pivoting pivoting, int threads, Advice advice)
    : matrix(std::move(the_matrix)), advice_(std::move(advice)) {
  for (const int p : position)
    position_.push_back(p + 1);
  if (position.size() == kept)
    add_pivot();
  data.comm_fortran = use_comm_world;
  data.par = 1;
  data.sym = static_cast<int>(pivoting);
  call(Job::initialise);
  set_controls(threads);
  set_matrix();
}

Mumps::~Mumps() {
  attempt(Job::finish);
}

int Mumps::attempt(Job job) {
  data.job = static_cast<int>(job);
  dmumps_c(&data);
  return infog(1);
}

void Mumps::call(Job job) {
  attempt(job);
  check();
}

void Mumps::check() const {
  const int code = infog(1);
  if (code >= 0)
    return;
  if (code == singular)
    throw SolveError(advice_.matrix +
                     " is singular: some displacement or the potential is not held; check the "
                     "boundary conditions, and constants or units that differ by many powers of "
                     "ten");
  if (code == little_work_space || code == little_main_space || code == no_memory ||
      code == no_work_memory)
    throw MachineError(
        fmt::format("not enough memory to factorise {} unknowns (MUMPS error {}, {}); {}", data.n,
                    code, infog(2), advice_.memory));
  throw SolveError(fmt::format("MUMPS failed with error {} ({})", code, infog(2)));
}

// Measured on this operator: docs/measurements.md.
void Mumps::set_controls(int threads) {
  for (const int stream : {1, 2, 3})
    icntl(stream) = -1;
  icntl(4) = 0;    // silent
  icntl(6) = 0;    // no permutation to the diagonal,
  icntl(12) = 1;   // nor any other analysis of values;
  icntl(8) = 0;    // no scaling: the unknowns are scaled already
  icntl(7) = 1;    // our ordering
  icntl(13) = 1;   // no ScaLAPACK at the root, which would take the matrix for positive definite
  icntl(14) = 40;  // per cent of spare memory
  icntl(16) = threads;  // OpenMP
  icntl(10) = 0;        // no iterative refinement: it needs the matrix and two more substitutions
}

void Mumps::add_pivot() {
  for (int &p : position_)
    ++p;
  position_.push_back(1);
  ++matrix.size;
  if (!parallel::is_first())
    return;
  matrix.row.push_back(matrix.size);
  matrix.column.push_back(matrix.size);
  matrix.value.push_back(1);
}

void Mumps::set_matrix() {
  data.n = matrix.size;
  data.perm_in = position_.data();
  if (parallel::n_ranks() == 1) {
    data.nnz = static_cast<MUMPS_INT8>(matrix.value.size());
    data.irn = matrix.row.data();
    data.jcn = matrix.column.data();
    data.a = matrix.value.data();
    return;
  }
  icntl(18) = 3;  // every rank brings entries of its own; those at equal places are added
  data.nnz_loc = static_cast<MUMPS_INT8>(matrix.value.size());
  data.irn_loc = matrix.row.data();
  data.jcn_loc = matrix.column.data();
  data.a_loc = matrix.value.data();
}

void Mumps::analyse() {
  Stopwatch watch;
  call(Job::analyse);
  statistics.analyse_seconds = watch.lap();
}

void Mumps::factorise() {
  Stopwatch watch;
  int code = attempt(Job::factorise);
  while ((code == little_work_space || code == little_main_space) && icntl(14) < most_spare) {
    icntl(14) *= 2;
    code = attempt(Job::factorise);
  }
  check();
  statistics.factorise_seconds += watch.lap();
  statistics.factor_entries = infog(9) >= 0 ? infog(9) : -1000000LL * infog(9);
  statistics.negative_pivots = infog(12);
  statistics.flops = data.rinfog[2];
}

void Mumps::release_entries() {
  matrix = {};
  data.irn = data.jcn = data.irn_loc = data.jcn_loc = nullptr;
  data.a = data.a_loc = nullptr;
}

void Mumps::set_right_side(std::vector<double> &right_side) {
  right_side.resize(static_cast<std::size_t>(data.n), 0.);
  data.rhs = right_side.data();
  data.nrhs = 1;
  data.lrhs = data.n;
}

}  // namespace tourmaline::condensation
