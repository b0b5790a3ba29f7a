#include "krylov/body_system.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "body/backward_error.h"
#include "krylov/block_smoothing.h"
#include "krylov/node_rows.h"
#include "krylov/petsc.h"
#include "parallel/ranks.h"
#include "stopwatch.h"

namespace tourmaline::krylov {

using body::Fields;
using body::Node;
using body::unknown;

namespace {

void finish_assembly(Mat matrix) {
  check(MatAssemblyBegin(matrix, MAT_FINAL_ASSEMBLY));
  check(MatAssemblyEnd(matrix, MAT_FINAL_ASSEMBLY));
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

  struct ContactBlock {
    PetscInt row, column;  // of nodes
    Block without;         // contact
  };

  Parts(const body::Operator<dim> &the_operator, double the_step);
  ~Parts();
  Parts(const Parts &) = delete;
  Parts &operator=(const Parts &) = delete;

  void preallocate();
  void split(const std::vector<Vector3> &points);
  void make_solver();
  void orthogonalise_twice();
  void attach_rigid_motions(IS displacements, const std::vector<Vector3> &points) const;
  Block projector(Node node) const;
  bool at_contact(PetscInt row) const { return contact_index[rows.node(row)] >= 0; }
  void assemble();
  void note_contact_blocks();
  void note_held_nodes();
  void project_own(PetscScalar *own) const;
  static PetscErrorCode multiply_free(Mat free, Vec x, Vec y);
  std::vector<double> in_si(Vec scaled) const;
  void put_rows(std::span<const double> all, Vec scaled) const;
  void project(std::span<double> vector) const;
  void multiply_whole(Vec x, Vec y) const;
  Block block_of(PetscInt row, PetscInt column) const;
  Block with_contact(const ContactBlock &of) const;
  void put_contact();
  void put_contact_in(Mat displacements) const;
  void precondition();

  const body::Operator<dim> &op;
  double step;
  std::vector<bool> is_prescribed;
  std::vector<NodeTangent<dim>> contact, preconditioned;
  std::vector<NodeCoupling<dim>> coupling;   // as `contact`, or empty
  std::vector<Eigen::Vector2d> crossing;     // likewise
  std::vector<int> contact_index;            // by node; -1: not at the contact
  std::vector<ContactBlock> contact_blocks;  // in this rank's rows
  NodeRows rows;
  std::vector<std::pair<PetscInt, Block>> held;  // own rows, from the first one on, where Q != 1
  std::array<double, n> scale;
  const body::CellProducts<dim> *cells = nullptr;  // once refined
  Mat matrix = nullptr;  // Q (K + C) Q + 1 - Q, as the preconditioner needs it
  Mat free = nullptr;    // its product with Q x, which the Krylov iteration takes
  Vec right_side = nullptr, solution = nullptr, projected = nullptr;
  struct Field {
    const char *name = nullptr;
    IS own = nullptr;
  };
  std::array<Field, 3> fields;  // u, phi, theta
  KSP solver = nullptr;
  std::array<KSP, 3> of_field{};  // inside it
  double set_up_seconds = 0;
  int set_ups = 0;
};

template <int dim>
BodySystem<dim>::Parts::Parts(const body::Operator<dim> &the_operator, double the_step)
    : op(the_operator),
      step(the_step),
      contact_index(the_operator.graph().n_nodes(), -1),
      rows(the_operator.graph()),
      scale(the_operator.scales(the_step)) {}

template <int dim>
BodySystem<dim>::Parts::~Parts() {
  KSPDestroy(&solver);
  for (Field &field : fields)
    ISDestroy(&field.own);
  VecDestroy(&projected);
  VecDestroy(&solution);
  VecDestroy(&right_side);
  MatDestroy(&free);
  MatDestroy(&matrix);
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
  const auto all = static_cast<PetscInt>(graph.n_nodes()), own = rows.n_own();
  for (PetscInt row = 0; row < own; ++row) {
    const auto blocks = static_cast<PetscInt>(length[rows.own_node(row)]);
    inside.push_back(std::min(blocks, own));
    outside.push_back(std::min(blocks, all - own));
  }
  check(MatCreate(PETSC_COMM_WORLD, &matrix));
  check(MatSetSizes(matrix, n * own, n * own, n * all, n * all));
  check(MatSetType(matrix, MATAIJ));
  check(MatSetBlockSize(matrix, n));
  check(MatXAIJSetPreallocation(matrix, n, inside.data(), outside.data(), nullptr, nullptr));
  check(MatCreateVecs(matrix, &solution, &right_side));
  check(VecDuplicate(solution, &projected));
  check(MatCreateShell(PETSC_COMM_WORLD, n * own, n * own, n * all, n * all, this, &free));
  check(MatShellSetOperation(free, MATOP_MULT, reinterpret_cast<void (*)()>(multiply_free)));
}

template <int dim>
void BodySystem<dim>::Parts::attach_rigid_motions(IS displacements,
                                                  const std::vector<Vector3> &points) const {
  Vec places = nullptr;
  check(VecCreate(PETSC_COMM_WORLD, &places));
  check(VecSetBlockSize(places, dim));
  check(VecSetSizes(places, dim * rows.n_own(), PETSC_DECIDE));
  check(VecSetUp(places));
  PetscScalar *values = nullptr;
  check(VecGetArray(places, &values));
  for (PetscInt row = 0; row < rows.n_own(); ++row)
    std::copy_n(points[rows.own_node(row)].begin(), dim, values + dim * row);
  check(VecRestoreArray(places, &values));
  MatNullSpace motions = nullptr;
  check(MatNullSpaceCreateRigidBody(places, &motions));
  check(PetscObjectCompose(reinterpret_cast<PetscObject>(displacements), "nearnullspace",
                           reinterpret_cast<PetscObject>(motions)));
  check(MatNullSpaceDestroy(&motions));
  check(VecDestroy(&places));
}

template <int dim>
void BodySystem<dim>::Parts::split(const std::vector<Vector3> &points) {
  fields = {{{"u", rows.own(n, 0, dim)},
             {"phi", rows.own(n, Fields<dim>::potential, 1)},
             {"theta", rows.own(n, Fields<dim>::temperature, 1)}}};
  attach_rigid_motions(fields[0].own, points);
}

// Coarse spaces, and the preconditioners of phi and theta, are those of the body without its
// contact: so they are made once, and no step depends on the contacts before it.
template <int dim>
void BodySystem<dim>::Parts::make_solver() {
  assemble();
  check(KSPCreate(PETSC_COMM_WORLD, &solver));
  check(KSPSetFromOptions(solver));
  PC preconditioner = nullptr;
  check(KSPGetPC(solver, &preconditioner));
  for (const Field &field : fields)
    check(PCFieldSplitSetIS(preconditioner, field.name, field.own));
  check(KSPSetOperators(solver, free, matrix));
  check(KSPSetUp(solver));
  PetscInt n_fields = 0;
  KSP *of_each = nullptr;
  check(PCFieldSplitGetSubKSP(preconditioner, &n_fields, &of_each));
  std::copy_n(of_each, fields.size(), of_field.begin());
  check(PetscFree(of_each));
  for (KSP one : of_field) {
    check(KSPSetUp(one));
    check(KSPSetReusePreconditioner(one, PETSC_TRUE));
  }
  check(KSPSetReusePreconditioner(solver, PETSC_TRUE));
}

// Stiff parts on soft ones take the basis its orthogonality: without this the iteration sees a
// residual that is not there.
template <int dim>
void BodySystem<dim>::Parts::orthogonalise_twice() {
  check(KSPGMRESSetCGSRefinementType(solver, KSP_GMRES_CGS_REFINE_ALWAYS));
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

// Q K Q, and 1 on the diagonal of what is held, so that it stays zero; here of what is prescribed.
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
      if (graph.column[e] == i && rows.owns(i))
        block += Block::Identity() - qi;
      const PetscInt row = rows.of(i), column = rows.of(graph.column[e]);
      check(MatSetValuesBlocked(matrix, 1, &row, 1, &column, block.data(), ADD_VALUES));
    }
  }
  finish_assembly(matrix);
}

// With the columns that other ranks' cells add to a row.
template <int dim>
void BodySystem<dim>::Parts::note_contact_blocks() {
  PetscInt first = 0, last = 0;
  check(MatGetOwnershipRange(matrix, &first, &last));
  for (PetscInt row = first / n; row < last / n; ++row) {
    PetscInt count = 0;
    const PetscInt *columns = nullptr;
    check(MatGetRow(matrix, n * row, &count, &columns, nullptr));
    for (PetscInt k = 0; k < count; k += n)
      if (at_contact(row) || at_contact(columns[k] / n))
        contact_blocks.push_back({row, columns[k] / n, Block::Zero()});
    check(MatRestoreRow(matrix, n * row, &count, &columns, nullptr));
  }
  for (ContactBlock &at : contact_blocks)
    at.without = block_of(at.row, at.column);
}

template <int dim>
void BodySystem<dim>::Parts::note_held_nodes() {
  held.clear();
  for (PetscInt row = 0; row < rows.n_own(); ++row)
    if (const Block q = projector(rows.own_node(row)); q != Block::Identity())
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
  if (in->cells != nullptr || !in->coupling.empty())
    in->multiply_whole(in->projected, y);
  else
    PetscCall(MatMult(in->matrix, in->projected, y));
  PetscFunctionReturn(0);
}

// Unknowns of the whole body.
template <int dim>
std::vector<double> BodySystem<dim>::Parts::in_si(Vec scaled) const {
  const PetscScalar *own = nullptr;
  check(VecGetArrayRead(scaled, &own));
  const std::vector<double> all =
      parallel::joined(std::vector<double>(own, own + rows.n_own() * n));
  check(VecRestoreArrayRead(scaled, &own));
  std::vector<double> state(all.size());
  for (std::size_t row = 0; row < rows.n_all(); ++row)
    for (int c = 0; c < n; ++c)
      state[unknown<dim>(rows.node(row), c)] = scale[c] * all[row * n + c];
  return state;
}

// This rank's share of rows of the whole body, the electric and heat rows with their sign.
template <int dim>
void BodySystem<dim>::Parts::put_rows(std::span<const double> all, Vec scaled) const {
  PetscScalar *own = nullptr;
  check(VecGetArray(scaled, &own));
  for (PetscInt i = 0; i < rows.n_own() * n; ++i) {
    const int c = i % n;
    own[i] = (c < dim ? 1 : -1) * scale[c] * all[unknown<dim>(rows.own_node(i / n), c)];
  }
  check(VecRestoreArray(scaled, &own));
}

// Q (K + C) x + E K x + G x for an x in the range of Q.
template <int dim>
void BodySystem<dim>::Parts::multiply_whole(Vec x, Vec y) const {
  using Vector = Eigen::Matrix<double, dim, 1>;
  const std::vector<double> state = in_si(x);
  std::vector<double> product(state.size());
  if (cells != nullptr)
    cells->multiply(step, state, product);
  else
    op.multiply(step, state, product);
  std::vector<Vector> coupled;
  for (std::size_t i = 0; i < coupling.size(); ++i) {
    const std::size_t first = unknown<dim>(contact[i].node, 0);
    coupled.push_back(coupling[i].of_force * Vector::Map(&product[first]) +
                      coupling[i].of_displacement * Vector::Map(&state[first]));
  }
  for (const NodeTangent<dim> &at : contact) {
    const std::size_t first = unknown<dim>(at.node, 0);
    Vector::Map(&product[first]) += at.stiffness * Vector::Map(&state[first]);
    for (int c = dim; c < n; ++c)
      product[first + c] -= at.crossing[c - dim] * state[first + c];
  }
  project(product);
  for (std::size_t i = 0; i < coupled.size(); ++i)
    Vector::Map(&product[unknown<dim>(contact[i].node, 0)]) += coupled[i];
  put_rows(product, y);
}

template <int dim>
typename BodySystem<dim>::Parts::Block BodySystem<dim>::Parts::block_of(PetscInt row,
                                                                        PetscInt column) const {
  std::array<PetscInt, n> of_row, of_column;
  std::iota(of_row.begin(), of_row.end(), n * row);
  std::iota(of_column.begin(), of_column.end(), n * column);
  Block block;
  check(MatGetValues(matrix, n, of_row.data(), n, of_column.data(), block.data()));
  return block;
}

// Q (K + C) Q + 1 - Q of these nodes. The contact leaves nothing free that is prescribed.
template <int dim>
typename BodySystem<dim>::Parts::Block BodySystem<dim>::Parts::with_contact(
    const ContactBlock &of) const {
  const Node node = rows.node(of.row);
  const Block q = projector(node);
  Block block = q * of.without * projector(rows.node(of.column));
  if (of.row != of.column)
    return block;
  block += Block::Identity() - q;
  if (const int k = contact_index[node]; k >= 0) {
    const NodeTangent<dim> &at = contact[k];
    block.template topLeftCorner<dim, dim>() += scale[0] * scale[0] * at.stiffness;
    for (int c = dim; c < n; ++c)
      block(c, c) += scale[c] * scale[c] * at.crossing[c - dim];
  }
  return block;
}

// Set, not added: what the matrix holds depends on this contact only, not on those before.
template <int dim>
void BodySystem<dim>::Parts::put_contact() {
  for (const ContactBlock &at : contact_blocks) {
    const Block block = with_contact(at);
    check(MatSetValuesBlocked(matrix, 1, &at.row, 1, &at.column, block.data(), INSERT_VALUES));
  }
  finish_assembly(matrix);
}

// What the contact changes in the matrix of displacements.
template <int dim>
void BodySystem<dim>::Parts::put_contact_in(Mat displacements) const {
  using BlockOfU = Eigen::Matrix<double, dim, dim, Eigen::RowMajor>;
  for (const ContactBlock &at : contact_blocks) {
    const BlockOfU block = with_contact(at).template topLeftCorner<dim, dim>();
    check(
        MatSetValuesBlocked(displacements, 1, &at.row, 1, &at.column, block.data(), INSERT_VALUES));
  }
  finish_assembly(displacements);
}

// Only the multigrid of u follows the contact.
template <int dim>
void BodySystem<dim>::Parts::precondition() {
  Mat of_u = nullptr;
  check(KSPGetOperators(of_field[0], nullptr, &of_u));
  put_contact_in(of_u);
  check(KSPSetReusePreconditioner(of_field[0], PETSC_FALSE));
  check(KSPSetOperators(of_field[0], of_u, of_u));
  check(KSPSetUp(of_field[0]));
  PC multigrid = nullptr;
  check(KSPGetPC(of_field[0], &multigrid));
  smooth_by_blocks(multigrid);
  check(KSPSetUpOnBlocks(of_field[0]));
  check(KSPSetReusePreconditioner(of_field[0], PETSC_TRUE));
  preconditioned = contact;
  ++set_ups;
}

template <int dim>
BodySystem<dim>::BodySystem(const body::Operator<dim> &op, double step,
                            const std::vector<Vector3> &points,
                            const std::vector<body::Prescribed> &prescribed)
    : parts_(std::make_unique<Parts>(op, step)) {
  start_petsc();
  Stopwatch watch;
  parts_->is_prescribed = body::mask_of(prescribed, op.graph().n_nodes() * Parts::n);
  parts_->preallocate();
  parts_->split(points);
  parts_->make_solver();
  parts_->set_up_seconds = watch.lap();
}

template <int dim>
BodySystem<dim>::~BodySystem() = default;

template <int dim>
void BodySystem<dim>::set_contact(const std::vector<NodeTangent<dim>> &asked) {
  Parts &in = *parts_;
  std::vector<NodeTangent<dim>> contact = asked;
  for (std::size_t i = 0; i < in.crossing.size(); ++i)
    contact[i].crossing = in.crossing[i];
  const bool is_first = in.set_ups == 0;
  if (!is_first && contact == in.contact)
    return;
  Stopwatch watch;
  const bool as_free =
      !is_first &&
      std::equal(contact.begin(), contact.end(), in.contact.begin(), in.contact.end(),
                 [](const auto &now, const auto &then) { return now.projector == then.projector; });
  in.contact = contact;
  if (is_first) {
    for (std::size_t i = 0; i < contact.size(); ++i)
      in.contact_index[contact[i].node] = static_cast<int>(i);
    in.note_contact_blocks();
  }
  if (!as_free)
    in.note_held_nodes();
  in.put_contact();
  if (!as_free)
    in.precondition();
  in.set_up_seconds += watch.lap();
}

template <int dim>
void BodySystem<dim>::set_crossing(const std::vector<Eigen::Vector2d> &crossing) {
  parts_->crossing = crossing;
}

template <int dim>
void BodySystem<dim>::set_coupling(std::vector<NodeCoupling<dim>> coupling) {
  parts_->coupling = std::move(coupling);
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
  if (parts_->solver != nullptr)
    parts_->orthogonalise_twice();
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
constexpr std::size_t tangent_size = 3 + 2 * dim *dim;  // node, projector, stiffness, crossing

template <int dim>
std::vector<double> numbers_of(const std::vector<NodeTangent<dim>> &contact) {
  std::vector<double> numbers;
  numbers.reserve(contact.size() * tangent_size<dim>);
  for (const NodeTangent<dim> &at : contact) {
    numbers.push_back(at.node);
    numbers.insert(numbers.end(), at.projector.data(), at.projector.data() + dim * dim);
    numbers.insert(numbers.end(), at.stiffness.data(), at.stiffness.data() + dim * dim);
    numbers.insert(numbers.end(), at.crossing.data(), at.crossing.data() + 2);
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
    std::copy_n(next + 1 + 2 * dim * dim, 2, at.crossing.data());
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
