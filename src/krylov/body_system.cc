#include "krylov/body_system.h"

#include <algorithm>
#include <array>
#include <utility>

#include "body/backward_error.h"
#include "krylov/block_triangle.h"
#include "krylov/body_matrix.h"
#include "krylov/following_multigrid.h"
#include "krylov/petsc.h"
#include "stopwatch.h"

namespace tourmaline::krylov {

using body::Fields;

void finish() {
  PetscBool running = PETSC_FALSE;
  PetscInitialized(&running);
  if (running)
    PetscFinalize();
}

template <int dim>
struct BodySystem<dim>::Parts {
  Parts(const body::Operator<dim> &op, double step, const std::vector<Vector3> &points,
        const std::vector<body::Prescribed> &prescribed);
  ~Parts();
  Parts(const Parts &) = delete;
  Parts &operator=(const Parts &) = delete;

  std::array<BlockTriangle::Block, 3> fields() const;
  void attach_rigid_motions(const std::vector<Vector3> &points);
  void make_solver();
  void orthogonalise_twice();
  void precondition();
  void make_multigrid();

  BodyMatrix<dim> matrices;
  const body::Operator<dim> &op;
  const double step;
  std::vector<NodeTangent<dim>> preconditioned;  // contact
  std::vector<Eigen::Vector2d> crossing;         // as the contact, or empty
  Vec right_side = nullptr, solution = nullptr;
  BlockTriangle preconditioner;                   // u, phi, theta
  std::unique_ptr<FollowingMultigrid> multigrid;  // of u, from the first contact on
  KSP solver = nullptr;
  double set_up_seconds = 0;
  int set_ups = 0;
};

template <int dim>
BodySystem<dim>::Parts::Parts(const body::Operator<dim> &the_operator, double the_step,
                              const std::vector<Vector3> &points,
                              const std::vector<body::Prescribed> &prescribed)
    : matrices(the_operator, the_step, prescribed),
      op(the_operator),
      step(the_step),
      preconditioner(matrices.matrix(), fields()) {
  check(MatCreateVecs(matrices.matrix(), &solution, &right_side));
  attach_rigid_motions(points);
  make_solver();
}

template <int dim>
BodySystem<dim>::Parts::~Parts() {
  KSPDestroy(&solver);
  VecDestroy(&solution);
  VecDestroy(&right_side);
}

template <int dim>
std::array<BlockTriangle::Block, 3> BodySystem<dim>::Parts::fields() const {
  const NodeRows &rows = matrices.rows();
  constexpr int n = Fields<dim>::count;
  return {{{"u", rows.own(n, 0, dim)},
           {"phi", rows.own(n, Fields<dim>::potential, 1)},
           {"theta", rows.own(n, Fields<dim>::temperature, 1)}}};
}

template <int dim>
void BodySystem<dim>::Parts::attach_rigid_motions(const std::vector<Vector3> &points) {
  const NodeRows &rows = matrices.rows();
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
  check(MatSetNearNullSpace(preconditioner.diagonal(0), motions));
  check(MatNullSpaceDestroy(&motions));
  check(VecDestroy(&places));
}

// Coarse spaces, and the preconditioners of phi and theta, are those of the body without its
// contact: so they are made once, and no step depends on the contacts before it.
template <int dim>
void BodySystem<dim>::Parts::make_solver() {
  check(KSPCreate(PETSC_COMM_WORLD, &solver));
  check(KSPSetFromOptions(solver));
  check(KSPSetOperators(solver, matrices.free(), matrices.matrix()));
  preconditioner.attach_to(solver);
  check(KSPSetUp(solver));
  for (int field = 0; field < BlockTriangle::n_blocks; ++field) {
    check(KSPSetUp(preconditioner.solver(field)));
    check(KSPSetReusePreconditioner(preconditioner.solver(field), PETSC_TRUE));
  }
}

// Stiff parts on soft ones take the basis its orthogonality: without this the iteration sees a
// residual that is not there.
template <int dim>
void BodySystem<dim>::Parts::orthogonalise_twice() {
  check(KSPGMRESSetCGSRefinementType(solver, KSP_GMRES_CGS_REFINE_ALWAYS));
}

// Only the multigrid of u follows the contact.
template <int dim>
void BodySystem<dim>::Parts::precondition() {
  if (multigrid)
    matrices.put_change_in(multigrid->change());
  else
    make_multigrid();
  multigrid->follow();
  preconditioned = matrices.contact();
  ++set_ups;
}

template <int dim>
void BodySystem<dim>::Parts::make_multigrid() {
  Mat change = matrices.changes_of_displacements();
  matrices.put_change_in(change);
  multigrid = std::make_unique<FollowingMultigrid>(preconditioner.solver(0), change);
  check(MatDestroy(&change));
}

template <int dim>
BodySystem<dim>::BodySystem(const body::Operator<dim> &op, double step,
                            const std::vector<Vector3> &points,
                            const std::vector<body::Prescribed> &prescribed) {
  start_petsc();
  Stopwatch watch;
  parts_ = std::make_unique<Parts>(op, step, points, prescribed);
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
  if (!is_first && contact == in.matrices.contact())
    return;
  Stopwatch watch;
  if (!in.matrices.set_contact(std::move(contact)) || is_first)
    in.precondition();
  in.set_up_seconds += watch.lap();
}

template <int dim>
void BodySystem<dim>::set_crossing(const std::vector<Eigen::Vector2d> &crossing) {
  parts_->crossing = crossing;
}

template <int dim>
void BodySystem<dim>::set_coupling(std::vector<NodeCoupling<dim>> coupling) {
  parts_->matrices.set_coupling(std::move(coupling));
}

template <int dim>
void BodySystem<dim>::refresh() {
  Stopwatch watch;
  if (parts_->matrices.contact() != parts_->preconditioned)
    parts_->precondition();
  parts_->set_up_seconds += watch.lap();
}

template <int dim>
void BodySystem<dim>::refine(const body::CellProducts<dim> &cells) {
  parts_->matrices.refine(cells);
  parts_->orthogonalise_twice();
}

template <int dim>
bool BodySystem<dim>::is_refined() const {
  return parts_->matrices.is_refined();
}

template <int dim>
void BodySystem<dim>::project(std::span<double> vector) const {
  parts_->matrices.project(vector);
}

template <int dim>
Solved BodySystem<dim>::solve(std::span<const double> right_side, double reduction,
                              std::span<double> solution) {
  Parts &in = *parts_;
  in.matrices.put_rows(right_side, in.right_side);
  check(KSPSetTolerances(in.solver, reduction, 1e-300, PETSC_DEFAULT, PETSC_DEFAULT));
  check(KSPSolve(in.solver, in.right_side, in.solution));
  KSPConvergedReason reason{};
  PetscInt iterations = 0;
  check(KSPGetConvergedReason(in.solver, &reason));
  check(KSPGetIterationNumber(in.solver, &iterations));
  const std::vector<double> found = in.matrices.in_si(in.solution);
  std::copy(found.begin(), found.end(), solution.begin());
  project(solution);
  return {static_cast<int>(iterations), reason > 0};
}

template <int dim>
double BodySystem<dim>::relative_size(std::span<const double> change,
                                      std::span<const double> state) const {
  return body::relative_size<dim>(parts_->op.sharing(), change, state, parts_->matrices.scale());
}

template <int dim>
double BodySystem<dim>::backward_error(std::span<const double> residual,
                                       std::span<const double> right_side,
                                       std::span<const double> state) const {
  const BodyMatrix<dim> &matrices = parts_->matrices;
  std::vector<double> scale(state.size());
  for (std::size_t i = 0; i < scale.size(); ++i)
    scale[i] = matrices.is_prescribed()[i] ? 0 : matrices.scale()[i % BodyMatrix<dim>::n];
  return body::backward_error(parts_->op, parts_->step, scale, residual, right_side, state);
}

namespace {

template <int dim>
constexpr std::size_t tangent_size = 3 + 2 * dim *dim;  // node, projector, stiffness, crossing

// Nodes by their numbers in the whole body.
template <int dim>
std::vector<double> numbers_of(const std::vector<NodeTangent<dim>> &contact,
                               const body::NodeSharing &sharing) {
  std::vector<double> numbers;
  numbers.reserve(contact.size() * tangent_size<dim>);
  for (const NodeTangent<dim> &at : contact) {
    numbers.push_back(sharing.number(at.node));
    numbers.insert(numbers.end(), at.projector.data(), at.projector.data() + dim * dim);
    numbers.insert(numbers.end(), at.stiffness.data(), at.stiffness.data() + dim * dim);
    numbers.insert(numbers.end(), at.crossing.data(), at.crossing.data() + 2);
  }
  return numbers;
}

template <int dim>
std::vector<NodeTangent<dim>> contact_of(std::span<const double> numbers,
                                         const body::NodeSharing &sharing) {
  std::vector<NodeTangent<dim>> contact(numbers.size() / tangent_size<dim>);
  const double *next = numbers.data();
  for (NodeTangent<dim> &at : contact) {
    at.node = sharing.node(static_cast<body::Node>(next[0])).value();
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
  const body::NodeSharing &sharing = parts_->op.sharing();
  numbers.put("preconditioned contact", numbers_of(parts_->preconditioned, sharing));
  numbers.put("matrix' contact", numbers_of(parts_->matrices.contact(), sharing));
}

// The second contact leaves the preconditioner of the first, as it did before.
template <int dim>
void BodySystem<dim>::restore(const output::SavedNumbers &numbers, std::size_t contact_nodes) {
  const std::size_t size = contact_nodes * tangent_size<dim>;
  const body::NodeSharing &sharing = parts_->op.sharing();
  set_contact(contact_of<dim>(numbers.get("preconditioned contact", size), sharing));
  set_contact(contact_of<dim>(numbers.get("matrix' contact", size), sharing));
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
