#include "krylov/body_system.h"

#include <fmt/format.h>
#include <petscksp.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "body/backward_error.h"
#include "parallel/ranks.h"
#include "stopwatch.h"
#include "tourmaline/error.h"

namespace tourmaline::krylov {

using body::Fields;
using body::Node;
using body::unknown;

namespace {

void check(PetscErrorCode code) {
  if (code == PETSC_ERR_MEM)
    throw MachineError("not enough memory for the iterative solver; use a coarser mesh");
  if (code != 0)
    throw SolveError(fmt::format("PETSc failed with error {}", static_cast<int>(code)));
}

void finish_assembly(Mat matrix) {
  check(MatAssemblyBegin(matrix, MAT_FINAL_ASSEMBLY));
  check(MatAssemblyEnd(matrix, MAT_FINAL_ASSEMBLY));
}

// Chosen by measurement: docs/measurements.md.
constexpr const char *options[][2] = {
    {"-ksp_type", "fgmres"},
    {"-ksp_gmres_restart", "100"},
    {"-ksp_max_it", "500"},
    {"-pc_type", "fieldsplit"},
    {"-pc_fieldsplit_type", "multiplicative"},
    {"-fieldsplit_u_ksp_type", "preonly"},
    {"-fieldsplit_u_pc_type", "gamg"},
    {"-fieldsplit_u_pc_gamg_threshold", "0"},
    {"-fieldsplit_u_pc_gamg_agg_nsmooths", "0"},
    // Coarse spaces of an earlier matrix would also make a step depend on all steps before it.
    {"-fieldsplit_u_pc_gamg_reuse_interpolation", "0"},
    {"-fieldsplit_u_mg_levels_ksp_type", "chebyshev"},
    {"-fieldsplit_u_mg_levels_ksp_max_it", "4"},
    {"-fieldsplit_u_mg_levels_pc_type", "jacobi"},
    {"-fieldsplit_phi_ksp_type", "preonly"},
    {"-fieldsplit_phi_pc_type", "hypre"},
    {"-fieldsplit_phi_pc_hypre_type", "boomeramg"},
    {"-fieldsplit_theta_ksp_type", "preonly"},
    {"-fieldsplit_theta_pc_type", "hypre"},
    {"-fieldsplit_theta_pc_hypre_type", "boomeramg"},
};

void start() {
  PetscBool running = PETSC_FALSE;
  PetscInitialized(&running);
  if (running)
    return;
  PetscOptionsSetValue(nullptr, "-no_signal_handler", nullptr);
  check(PetscInitializeNoArguments());
  PetscPushErrorHandler(PetscReturnErrorHandler, nullptr);
  for (const auto &[name, value] : options) {
    PetscBool given = PETSC_FALSE;  // by PETSC_OPTIONS, to try others
    check(PetscOptionsHasName(nullptr, nullptr, name, &given));
    if (!given)
      check(PetscOptionsSetValue(nullptr, name, value));
  }
}

}  // namespace

void finish() {
  PetscBool running = PETSC_FALSE;
  PetscInitialized(&running);
  if (running)
    PetscFinalize();
}

template <int dim>
struct BodySystem<dim>::Parts {
  static constexpr int n = Fields<dim>::count;
  using Block = typename body::Operator<dim>::Block;

  Parts(const body::Operator<dim> &the_operator, double the_step);
  ~Parts();
  Parts(const Parts &) = delete;
  Parts &operator=(const Parts &) = delete;

  void number_rows();
  void preallocate();
  void make_solver(const std::vector<Vector3> &points);
  IS field(int first, int count) const;
  void attach_rigid_motions(IS displacements, const std::vector<Vector3> &points) const;
  Block projector(Node node) const;
  void assemble();
  void note_held_nodes();
  void project_own(PetscScalar *own) const;
  static PetscErrorCode multiply_free(Mat free, Vec x, Vec y);
  std::vector<double> in_si(Vec scaled) const;
  void put_rows(std::span<const double> rows, Vec scaled) const;
  void project(std::span<double> vector) const;
  void multiply_cells(Vec x, Vec y) const;
  Block block_of(Node node) const;
  void put_contact();
  void precondition();
  PetscInt own_begin() const { return begin[parallel::rank()]; }
  PetscInt own_count() const { return begin[parallel::rank() + 1] - own_begin(); }
  bool owns(Node node) const {
    return row_of[node] >= own_begin() && row_of[node] < own_begin() + own_count();
  }

  const body::Operator<dim> &op;
  double step;
  std::vector<bool> is_prescribed;
  std::vector<NodeTangent<dim>> contact, preconditioned;
  std::vector<int> contact_index;     // by node; -1: not at the contact
  std::vector<Block> contact_blocks;  // diagonal blocks of this rank's contact nodes, without C
  std::vector<PetscInt> row_of;       // by node; a rank's own nodes stand together
  std::vector<Node> node_of;          // by row
  std::vector<PetscInt> begin;        // of each rank's rows, and the end
  std::vector<std::pair<PetscInt, Block>> held;  // own rows, from the first one on, where Q != 1
  std::array<double, n> scale;
  const body::CellProducts<dim> *cells = nullptr;  // once refined
  Mat matrix = nullptr;  // Q (K + C) Q + 1 - Q, as the preconditioner needs it
  Mat free = nullptr;    // its product with Q x, which the Krylov iteration takes
  Vec right_side = nullptr, solution = nullptr, projected = nullptr;
  KSP solver = nullptr;
  double set_up_seconds = 0;
  int set_ups = 0;
};

template <int dim>
BodySystem<dim>::Parts::Parts(const body::Operator<dim> &the_operator, double the_step)
    : op(the_operator),
      step(the_step),
      contact_index(the_operator.graph().n_nodes(), -1),
      scale(the_operator.scales(the_step)) {}

template <int dim>
BodySystem<dim>::Parts::~Parts() {
  KSPDestroy(&solver);
  VecDestroy(&projected);
  VecDestroy(&solution);
  VecDestroy(&right_side);
  MatDestroy(&free);
  MatDestroy(&matrix);
}

// A node belongs to the first rank whose cells touch it.
template <int dim>
void BodySystem<dim>::Parts::number_rows() {
  const body::NodeGraph &graph = op.graph();
  const int ranks = parallel::n_ranks();
  std::vector<double> closeness(graph.n_nodes(), -ranks);  // the largest wins
  for (Node i = 0; i < graph.n_nodes(); ++i)
    if (graph.row[i] != graph.row[i + std::size_t{1}])
      closeness[i] = -parallel::rank();
  parallel::largest(closeness);
  node_of.resize(graph.n_nodes());
  std::iota(node_of.begin(), node_of.end(), Node{0});
  std::stable_sort(node_of.begin(), node_of.end(),
                   [&](Node a, Node b) { return closeness[a] > closeness[b]; });
  row_of.resize(graph.n_nodes());
  begin.assign(ranks + 1, 0);
  for (std::size_t row = 0; row < node_of.size(); ++row) {
    row_of[node_of[row]] = static_cast<PetscInt>(row);
    ++begin[static_cast<std::size_t>(-closeness[node_of[row]]) + 1];
  }
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
}

// Where ranks meet, a row has at most the entries that they have in it together.
template <int dim>
void BodySystem<dim>::Parts::preallocate() {
  const body::NodeGraph &graph = op.graph();
  std::vector<double> length(graph.n_nodes());
  for (Node i = 0; i < graph.n_nodes(); ++i)
    length[i] = static_cast<double>(graph.row[i + std::size_t{1}] - graph.row[i]);
  parallel::sum(length);
  std::vector<PetscInt> inside, outside;
  for (PetscInt row = 0; row < own_count(); ++row) {
    const auto blocks = static_cast<PetscInt>(length[node_of[own_begin() + row]]);
    inside.push_back(std::min(blocks, own_count()));
    outside.push_back(std::min(blocks, static_cast<PetscInt>(graph.n_nodes()) - own_count()));
  }
  const auto all = static_cast<PetscInt>(graph.n_nodes());
  check(MatCreate(PETSC_COMM_WORLD, &matrix));
  check(MatSetSizes(matrix, n * own_count(), n * own_count(), n * all, n * all));
  check(MatSetType(matrix, MATAIJ));
  check(MatSetBlockSize(matrix, n));
  check(MatXAIJSetPreallocation(matrix, n, inside.data(), outside.data(), nullptr, nullptr));
  check(MatCreateVecs(matrix, &solution, &right_side));
  check(VecDuplicate(solution, &projected));
  check(MatCreateShell(PETSC_COMM_WORLD, n * own_count(), n * own_count(), n * all, n * all, this,
                       &free));
  check(MatShellSetOperation(free, MATOP_MULT, reinterpret_cast<void (*)()>(multiply_free)));
}

// Rows of `count` unknowns from `first` on, of this rank's nodes.
template <int dim>
IS BodySystem<dim>::Parts::field(int first, int count) const {
  std::vector<PetscInt> rows;
  for (PetscInt row = own_begin(); row < own_begin() + own_count(); ++row)
    for (int c = 0; c < count; ++c)
      rows.push_back(n * row + first + c);
  IS field = nullptr;
  check(ISCreateGeneral(PETSC_COMM_WORLD, static_cast<PetscInt>(rows.size()), rows.data(),
                        PETSC_COPY_VALUES, &field));
  check(ISSetBlockSize(field, count));
  return field;
}

template <int dim>
void BodySystem<dim>::Parts::attach_rigid_motions(IS displacements,
                                                  const std::vector<Vector3> &points) const {
  Vec places = nullptr;
  check(VecCreate(PETSC_COMM_WORLD, &places));
  check(VecSetBlockSize(places, dim));
  check(VecSetSizes(places, dim * own_count(), PETSC_DECIDE));
  check(VecSetUp(places));
  PetscScalar *values = nullptr;
  check(VecGetArray(places, &values));
  for (PetscInt row = 0; row < own_count(); ++row)
    std::copy_n(points[node_of[own_begin() + row]].begin(), dim, values + dim * row);
  check(VecRestoreArray(places, &values));
  MatNullSpace motions = nullptr;
  check(MatNullSpaceCreateRigidBody(places, &motions));
  check(PetscObjectCompose(reinterpret_cast<PetscObject>(displacements), "nearnullspace",
                           reinterpret_cast<PetscObject>(motions)));
  check(MatNullSpaceDestroy(&motions));
  check(VecDestroy(&places));
}

template <int dim>
void BodySystem<dim>::Parts::make_solver(const std::vector<Vector3> &points) {
  check(KSPCreate(PETSC_COMM_WORLD, &solver));
  check(KSPSetFromOptions(solver));
  PC preconditioner = nullptr;
  check(KSPGetPC(solver, &preconditioner));
  const struct {
    const char *name;
    int first, count;
  } fields[] = {
      {"u", 0, dim}, {"phi", Fields<dim>::potential, 1}, {"theta", Fields<dim>::temperature, 1}};
  for (const auto &f : fields) {
    IS rows = field(f.first, f.count);
    if (f.count == dim)
      attach_rigid_motions(rows, points);
    check(PCFieldSplitSetIS(preconditioner, f.name, rows));
    check(ISDestroy(&rows));
  }
}

template <int dim>
typename BodySystem<dim>::Parts::Block BodySystem<dim>::Parts::projector(Node node) const {
  Block q = Block::Identity();
  if (contact_index[node] >= 0)
    q.template topLeftCorner<dim, dim>() = contact[contact_index[node]].projector;
  for (int c = contact_index[node] >= 0 ? dim : 0; c < n; ++c)
    if (is_prescribed[unknown<dim>(node, c)])
      q(c, c) = 0;
  return q;
}

// Q K Q, and 1 on the diagonal of what is held, so that it stays zero.
template <int dim>
void BodySystem<dim>::Parts::assemble() {
  const body::NodeGraph &graph = op.graph();
  Block sign = Block::Identity();
  sign.template bottomRightCorner<2, 2>() *= -1;
  const Eigen::Map<const Eigen::Matrix<double, n, 1>> scales(scale.data());
  check(MatZeroEntries(matrix));
  for (Node i = 0; i < graph.n_nodes(); ++i) {
    const Block qi = projector(i);
    for (std::size_t e = graph.row[i]; e < graph.row[i + 1]; ++e) {
      const Block k = scales.asDiagonal() * op.step_block(e, step) * scales.asDiagonal();
      Block block = sign * qi * k * projector(graph.column[e]);
      if (graph.column[e] == i && owns(i))
        block += Block::Identity() - qi;
      const PetscInt row = row_of[i], column = row_of[graph.column[e]];
      check(MatSetValuesBlocked(matrix, 1, &row, 1, &column, block.data(), ADD_VALUES));
    }
  }
  finish_assembly(matrix);
  contact_blocks.clear();
  for (const NodeTangent<dim> &at : contact)
    if (owns(at.node))
      contact_blocks.push_back(block_of(at.node));
}

template <int dim>
void BodySystem<dim>::Parts::note_held_nodes() {
  held.clear();
  for (PetscInt row = 0; row < own_count(); ++row)
    if (const Block q = projector(node_of[own_begin() + row]); q != Block::Identity())
      held.emplace_back(row, q);
}

template <int dim>
void BodySystem<dim>::Parts::project_own(PetscScalar *own) const {
  using Vector = Eigen::Matrix<double, n, 1>;
  for (const auto &[row, q] : held) {
    Eigen::Map<Vector> at(own + n * row);
    at = (q * at).eval();
  }
}

// The preconditioner's coarse spaces move a component that is held beside free ones. With the
// matrix alone that motion would be zero only as far as the iteration has come, and the residual of
// the free rows would not be the one that the iteration sees. So what it finds may leave the range
// of Q: it is projected here, and once more at the end.
template <int dim>
PetscErrorCode BodySystem<dim>::Parts::multiply_free(Mat free, Vec x, Vec y) {
  PetscFunctionBeginUser;
  Parts *in = nullptr;
  PetscCall(MatShellGetContext(free, &in));
  PetscCall(VecCopy(x, in->projected));
  PetscScalar *own = nullptr;
  PetscCall(VecGetArray(in->projected, &own));
  in->project_own(own);
  PetscCall(VecRestoreArray(in->projected, &own));
  if (in->cells != nullptr)
    in->multiply_cells(in->projected, y);
  else
    PetscCall(MatMult(in->matrix, in->projected, y));
  PetscFunctionReturn(0);
}

// Unknowns of the whole body.
template <int dim>
std::vector<double> BodySystem<dim>::Parts::in_si(Vec scaled) const {
  const PetscScalar *own = nullptr;
  check(VecGetArrayRead(scaled, &own));
  const std::vector<double> all = parallel::joined(std::vector<double>(own, own + own_count() * n));
  check(VecRestoreArrayRead(scaled, &own));
  std::vector<double> state(all.size());
  for (std::size_t row = 0; row < node_of.size(); ++row)
    for (int c = 0; c < n; ++c)
      state[unknown<dim>(node_of[row], c)] = scale[c] * all[row * n + c];
  return state;
}

// This rank's share of rows of the whole body, the electric and heat rows with their sign.
template <int dim>
void BodySystem<dim>::Parts::put_rows(std::span<const double> rows, Vec scaled) const {
  PetscScalar *own = nullptr;
  check(VecGetArray(scaled, &own));
  for (PetscInt i = 0; i < own_count() * n; ++i) {
    const int c = i % n;
    own[i] = (c < dim ? 1 : -1) * scale[c] * rows[unknown<dim>(node_of[own_begin() + i / n], c)];
  }
  check(VecRestoreArray(scaled, &own));
}

// Q (K + C) x for an x in the range of Q.
template <int dim>
void BodySystem<dim>::Parts::multiply_cells(Vec x, Vec y) const {
  using Vector = Eigen::Matrix<double, dim, 1>;
  const std::vector<double> state = in_si(x);
  std::vector<double> rows(state.size());
  cells->multiply(step, state, rows);
  for (const NodeTangent<dim> &at : contact) {
    const std::size_t first = unknown<dim>(at.node, 0);
    Vector::Map(&rows[first]) += at.stiffness * Vector::Map(&state[first]);
  }
  project(rows);
  put_rows(rows, y);
}

template <int dim>
typename BodySystem<dim>::Parts::Block BodySystem<dim>::Parts::block_of(Node node) const {
  std::array<PetscInt, n> rows;
  std::iota(rows.begin(), rows.end(), n * row_of[node]);
  Block block;
  check(MatGetValues(matrix, n, rows.data(), n, rows.data(), block.data()));
  return block;
}

// Set, not added: what the matrix holds depends on this contact only, not on those before.
template <int dim>
void BodySystem<dim>::Parts::put_contact() {
  auto without = contact_blocks.begin();
  for (const NodeTangent<dim> &at : contact) {
    if (!owns(at.node))
      continue;
    Block block = *without++;
    block.template topLeftCorner<dim, dim>() += scale[0] * scale[0] * at.stiffness;
    const PetscInt row = row_of[at.node];
    check(MatSetValuesBlocked(matrix, 1, &row, 1, &row, block.data(), INSERT_VALUES));
  }
  finish_assembly(matrix);
}

template <int dim>
void BodySystem<dim>::Parts::precondition() {
  check(KSPSetOperators(solver, free, matrix));
  check(KSPSetReusePreconditioner(solver, PETSC_FALSE));
  check(KSPSetUp(solver));
  check(KSPSetUpOnBlocks(solver));
  check(KSPSetReusePreconditioner(solver, PETSC_TRUE));
  preconditioned = contact;
  ++set_ups;
}

template <int dim>
BodySystem<dim>::BodySystem(const body::Operator<dim> &op, double step,
                            const std::vector<Vector3> &points,
                            const std::vector<body::Prescribed> &prescribed)
    : parts_(std::make_unique<Parts>(op, step)) {
  start();
  Stopwatch watch;
  parts_->is_prescribed = body::mask_of(prescribed, op.graph().n_nodes() * Parts::n);
  parts_->number_rows();
  parts_->preallocate();
  parts_->make_solver(points);
  parts_->set_up_seconds = watch.lap();
}

template <int dim>
BodySystem<dim>::~BodySystem() = default;

template <int dim>
void BodySystem<dim>::set_contact(const std::vector<NodeTangent<dim>> &contact) {
  Parts &in = *parts_;
  const bool is_first = in.set_ups == 0;
  if (!is_first && contact == in.contact)
    return;
  Stopwatch watch;
  const bool as_free =
      !is_first &&
      std::equal(contact.begin(), contact.end(), in.contact.begin(), in.contact.end(),
                 [](const auto &now, const auto &then) { return now.projector == then.projector; });
  in.contact = contact;
  if (!as_free) {
    for (std::size_t i = 0; i < contact.size(); ++i)
      in.contact_index[contact[i].node] = static_cast<int>(i);
    in.note_held_nodes();
    in.assemble();
  }
  in.put_contact();
  if (!as_free)
    in.precondition();
  in.set_up_seconds += watch.lap();
}

template <int dim>
void BodySystem<dim>::refresh() {
  Stopwatch watch;
  if (parts_->contact != parts_->preconditioned)
    parts_->precondition();
  parts_->set_up_seconds += watch.lap();
}

template <int dim>
void BodySystem<dim>::refine(const body::CellProducts<dim> &cells) {
  parts_->cells = &cells;
  // Stiff parts on soft ones take the basis its orthogonality: without this the iteration sees a
  // residual that is not there.
  check(KSPGMRESSetCGSRefinementType(parts_->solver, KSP_GMRES_CGS_REFINE_ALWAYS));
}

template <int dim>
bool BodySystem<dim>::is_refined() const {
  return parts_->cells != nullptr;
}

template <int dim>
void BodySystem<dim>::project(std::span<double> vector) const {
  parts_->project(vector);
}

template <int dim>
void BodySystem<dim>::Parts::project(std::span<double> vector) const {
  using Vector = Eigen::Matrix<double, dim, 1>;
  for (const auto &at : contact) {
    const auto u = Vector::Map(&vector[unknown<dim>(at.node, 0)]);
    const Vector free_part = at.projector * u;
    std::copy(free_part.begin(), free_part.end(), &vector[unknown<dim>(at.node, 0)]);
  }
  for (std::size_t i = 0; i < vector.size(); ++i) {
    const bool is_projected = i % n < dim && contact_index[i / n] >= 0;
    if (is_prescribed[i] && !is_projected)
      vector[i] = 0;
  }
}

template <int dim>
Solved BodySystem<dim>::solve(std::span<const double> right_side, double reduction,
                              std::span<double> solution) {
  Parts &in = *parts_;
  in.put_rows(right_side, in.right_side);
  check(KSPSetTolerances(in.solver, reduction, 1e-300, PETSC_DEFAULT, PETSC_DEFAULT));
  check(KSPSolve(in.solver, in.right_side, in.solution));
  KSPConvergedReason reason{};
  PetscInt iterations = 0;
  check(KSPGetConvergedReason(in.solver, &reason));
  check(KSPGetIterationNumber(in.solver, &iterations));
  const std::vector<double> found = in.in_si(in.solution);
  std::copy(found.begin(), found.end(), solution.begin());
  project(solution);
  return {static_cast<int>(iterations), reason > 0};
}

template <int dim>
double BodySystem<dim>::relative_size(std::span<const double> change,
                                      std::span<const double> state) const {
  return body::relative_size<dim>(change, state, parts_->scale);
}

template <int dim>
double BodySystem<dim>::backward_error(std::span<const double> residual,
                                       std::span<const double> right_side,
                                       std::span<const double> state) const {
  std::vector<double> scale(state.size());
  for (std::size_t i = 0; i < scale.size(); ++i)
    scale[i] = parts_->is_prescribed[i] ? 0 : parts_->scale[i % Parts::n];
  return body::backward_error(parts_->op, parts_->step, scale, residual, right_side, state);
}

namespace {

template <int dim>
constexpr std::size_t tangent_size = 1 + 2 * dim *dim;  // node, projector, stiffness

template <int dim>
std::vector<double> numbers_of(const std::vector<NodeTangent<dim>> &contact) {
  std::vector<double> numbers;
  numbers.reserve(contact.size() * tangent_size<dim>);
  for (const NodeTangent<dim> &at : contact) {
    numbers.push_back(at.node);
    numbers.insert(numbers.end(), at.projector.data(), at.projector.data() + dim * dim);
    numbers.insert(numbers.end(), at.stiffness.data(), at.stiffness.data() + dim * dim);
  }
  return numbers;
}

template <int dim>
std::vector<NodeTangent<dim>> contact_of(std::span<const double> numbers) {
  std::vector<NodeTangent<dim>> contact(numbers.size() / tangent_size<dim>);
  const double *next = numbers.data();
  for (NodeTangent<dim> &at : contact) {
    at.node = static_cast<Node>(next[0]);
    std::copy_n(next + 1, dim * dim, at.projector.data());
    std::copy_n(next + 1 + dim * dim, dim * dim, at.stiffness.data());
    next += tangent_size<dim>;
  }
  return contact;
}

}  // namespace

template <int dim>
void BodySystem<dim>::save(output::SavedNumbers &numbers) const {
  numbers.put("preconditioned contact", numbers_of(parts_->preconditioned));
  numbers.put("matrix' contact", numbers_of(parts_->contact));
  numbers.put("preconditioners", {static_cast<double>(parts_->set_ups)});
}

// The second contact leaves the preconditioner of the first, as it did before.
template <int dim>
void BodySystem<dim>::restore(const output::SavedNumbers &numbers, std::size_t contact_nodes) {
  const std::size_t size = contact_nodes * tangent_size<dim>;
  set_contact(contact_of<dim>(numbers.get("preconditioned contact", size)));
  set_contact(contact_of<dim>(numbers.get("matrix' contact", size)));
  parts_->set_ups = static_cast<int>(numbers.get("preconditioners", 1)[0]);
}

template <int dim>
double BodySystem<dim>::set_up_seconds() const {
  return parts_->set_up_seconds;
}

template <int dim>
int BodySystem<dim>::set_ups() const {
  return parts_->set_ups;
}

template class BodySystem<2>;
template class BodySystem<3>;

}  // namespace tourmaline::krylov
