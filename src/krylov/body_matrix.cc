#include "krylov/body_matrix.h"

#include <algorithm>
#include <numeric>

#include "krylov/petsc.h"
#include "parallel/ranks.h"

namespace tourmaline::krylov {

using body::Node;
using body::unknown;

namespace {

void finish_assembly(Mat matrix) {
  check(MatAssemblyBegin(matrix, MAT_FINAL_ASSEMBLY));
  check(MatAssemblyEnd(matrix, MAT_FINAL_ASSEMBLY));
}

}  // namespace

template <int dim>
BodyMatrix<dim>::BodyMatrix(const body::Operator<dim> &op, double step,
                            const std::vector<body::Prescribed> &prescribed)
    : op_(op),
      step_(step),
      is_prescribed_(body::mask_of(prescribed, op.graph().n_nodes() * n)),
      contact_index_(op.graph().n_nodes(), -1),
      rows_(op.sharing()),
      scale_(op.scales(step)) {
  preallocate();
  assemble();
}

template <int dim>
BodyMatrix<dim>::~BodyMatrix() {
  VecDestroy(&projected_);
  MatDestroy(&free_);
  MatDestroy(&matrix_);
}

template <int dim>
bool BodyMatrix<dim>::set_contact(std::vector<NodeTangent<dim>> contact) {
  const bool as_free =
      std::equal(contact.begin(), contact.end(), contact_.begin(), contact_.end(),
                 [](const auto &now, const auto &then) { return now.projector == then.projector; });
  const bool is_first = contact_.empty();
  contact_ = std::move(contact);
  if (is_first) {
    for (std::size_t i = 0; i < contact_.size(); ++i)
      contact_of_row_[rows_.of(contact_[i].node)] = contact_index_[contact_[i].node] =
          static_cast<int>(i);
    note_contact_blocks();
  }
  if (!as_free || is_first)
    note_held_nodes();
  put_contact();
  return as_free;
}

// Where ranks meet, a row has at most the entries that they have in it together.
template <int dim>
void BodyMatrix<dim>::preallocate() {
  const body::NodeGraph &graph = op_.graph();
  const body::NodeSharing &sharing = rows_.sharing();
  std::vector<double> near(graph.n_nodes()),
      far(near);  // blocks with nodes of the same rank, of others
  for (Node i = 0; i < graph.n_nodes(); ++i)
    for (std::size_t e = graph.row[i]; e < graph.row[i + std::size_t{1}]; ++e)
      ++(sharing.rank_of(graph.column[e]) == sharing.rank_of(i) ? near : far)[i];
  sharing.add_up(near);
  sharing.add_up(far);
  std::vector<PetscInt> inside, outside;
  const auto all = rows_.n_all(), own = rows_.n_own();
  for (PetscInt row = 0; row < own; ++row) {
    const Node node = rows_.own_node(row);
    inside.push_back(std::min(static_cast<PetscInt>(near[node]), own));
    outside.push_back(std::min(static_cast<PetscInt>(far[node]), all - own));
  }
  check(MatCreate(PETSC_COMM_WORLD, &matrix_));
  check(MatSetSizes(matrix_, n * own, n * own, n * all, n * all));
  check(MatSetType(matrix_, MATAIJ));
  check(MatSetBlockSize(matrix_, n));
  check(MatXAIJSetPreallocation(matrix_, n, inside.data(), outside.data(), nullptr, nullptr));
  check(MatCreateVecs(matrix_, &projected_, nullptr));
  check(MatCreateShell(PETSC_COMM_WORLD, n * own, n * own, n * all, n * all, this, &free_));
  check(MatShellSetOperation(free_, MATOP_MULT, reinterpret_cast<void (*)()>(multiply_free)));
}

template <int dim>
typename BodyMatrix<dim>::Block BodyMatrix<dim>::projector(Node node) const {
  Block q = Block::Identity();
  if (contact_index_[node] >= 0)
    q.template topLeftCorner<dim, dim>() = contact_[contact_index_[node]].projector;
  for (int c = contact_index_[node] >= 0 ? dim : 0; c < n; ++c)
    if (is_prescribed_[unknown<dim>(node, c)])
      q(c, c) = 0;
  return q;
}

// Q K Q, and 1 on the diagonal of what is held, so that it stays zero; here of what is prescribed.
template <int dim>
void BodyMatrix<dim>::assemble() {
  const body::NodeGraph &graph = op_.graph();
  Block sign = Block::Identity();
  sign.template bottomRightCorner<2, 2>() *= -1;
  const Eigen::Map<const Eigen::Matrix<double, n, 1>> scales(scale_.data());
  check(MatZeroEntries(matrix_));
  for (Node i = 0; i < graph.n_nodes(); ++i) {
    const Block qi = projector(i);
    for (std::size_t e = graph.row[i]; e < graph.row[i + 1]; ++e) {
      const Block k = scales.asDiagonal() * op_.step_block(e, step_) * scales.asDiagonal();
      Block block = sign * qi * k * projector(graph.column[e]);
      if (graph.column[e] == i && rows_.sharing().is_own(i))
        block += Block::Identity() - qi;
      const PetscInt row = rows_.of(i), column = rows_.of(graph.column[e]);
      check(MatSetValuesBlocked(matrix_, 1, &row, 1, &column, block.data(), ADD_VALUES));
    }
  }
  finish_assembly(matrix_);
}

// With the columns that other ranks' cells add to a row.
template <int dim>
void BodyMatrix<dim>::note_contact_blocks() {
  PetscInt first = 0, last = 0;
  check(MatGetOwnershipRange(matrix_, &first, &last));
  for (PetscInt row = first / n; row < last / n; ++row) {
    PetscInt count = 0;
    const PetscInt *columns = nullptr;
    check(MatGetRow(matrix_, n * row, &count, &columns, nullptr));
    for (PetscInt k = 0; k < count; k += n)
      if (at_contact(row) || at_contact(columns[k] / n))
        contact_blocks_.push_back({row, columns[k] / n, Block::Zero()});
    check(MatRestoreRow(matrix_, n * row, &count, &columns, nullptr));
  }
  for (ContactBlock &at : contact_blocks_)
    at.without = block_of(at.row, at.column);
}

template <int dim>
void BodyMatrix<dim>::note_held_nodes() {
  held_.clear();
  for (PetscInt row = 0; row < rows_.n_own(); ++row)
    if (const Block q = projector(rows_.own_node(row)); q != Block::Identity())
      held_.emplace_back(row, q);
}

template <int dim>
void BodyMatrix<dim>::project_own(PetscScalar *own) const {
  using Vector = Eigen::Matrix<double, n, 1>;
  for (const auto &[row, q] : held_) {
    Eigen::Map<Vector> at(own + n * row);
    at = (q * at).eval();
  }
}

// The preconditioner's coarse spaces move a component that is held beside free ones. With the
// matrix alone that motion would be zero only as far as the iteration has come, and the residual of
// the free rows would not be the one that the iteration sees. So what it finds may leave the range
// of Q: it is projected here, and once more at the end.
template <int dim>
PetscErrorCode BodyMatrix<dim>::multiply_free(Mat free, Vec x, Vec y) {
  PetscFunctionBeginUser;
  BodyMatrix *in = nullptr;
  PetscCall(MatShellGetContext(free, &in));
  PetscCall(VecCopy(x, in->projected_));
  PetscScalar *own = nullptr;
  PetscCall(VecGetArray(in->projected_, &own));
  in->project_own(own);
  PetscCall(VecRestoreArray(in->projected_, &own));
  if (in->cells_ != nullptr || !in->coupling_.empty())
    in->multiply_whole(in->projected_, y);
  else
    PetscCall(MatMult(in->matrix_, in->projected_, y));
  PetscFunctionReturn(0);
}

template <int dim>
std::vector<double> BodyMatrix<dim>::in_si(Vec scaled) const {
  const PetscScalar *own = nullptr;
  check(VecGetArrayRead(scaled, &own));
  std::vector<double> state(n * rows_.sharing().n_nodes(), 0.);
  for (PetscInt row = 0; row < rows_.n_own(); ++row)
    for (int c = 0; c < n; ++c)
      state[unknown<dim>(rows_.own_node(row), c)] = scale_[c] * own[row * n + c];
  check(VecRestoreArrayRead(scaled, &own));
  rows_.sharing().take_from_owners(state);
  return state;
}

template <int dim>
void BodyMatrix<dim>::put_rows(std::span<const double> rows, Vec scaled) const {
  PetscScalar *own = nullptr;
  check(VecGetArray(scaled, &own));
  for (PetscInt i = 0; i < rows_.n_own() * n; ++i) {
    const int c = i % n;
    own[i] = (c < dim ? 1 : -1) * scale_[c] * rows[unknown<dim>(rows_.own_node(i / n), c)];
  }
  check(VecRestoreArray(scaled, &own));
}

template <int dim>
void BodyMatrix<dim>::project(std::span<double> vector) const {
  using Vector = Eigen::Matrix<double, dim, 1>;
  for (const auto &at : contact_) {
    const auto u = Vector::Map(&vector[unknown<dim>(at.node, 0)]);
    const Vector free_part = at.projector * u;
    std::copy(free_part.begin(), free_part.end(), &vector[unknown<dim>(at.node, 0)]);
  }
  for (std::size_t i = 0; i < vector.size(); ++i) {
    const bool is_projected = i % n < dim && contact_index_[i / n] >= 0;
    if (is_prescribed_[i] && !is_projected)
      vector[i] = 0;
  }
}

// Q (K + C) x + E K x + G x for an x in the range of Q.
template <int dim>
void BodyMatrix<dim>::multiply_whole(Vec x, Vec y) const {
  using Vector = Eigen::Matrix<double, dim, 1>;
  const std::vector<double> state = in_si(x);
  std::vector<double> product(state.size());
  if (cells_ != nullptr)
    cells_->multiply(step_, state, product);
  else
    op_.multiply(step_, state, product);
  std::vector<Vector> coupled;
  for (std::size_t i = 0; i < coupling_.size(); ++i) {
    const std::size_t first = unknown<dim>(contact_[i].node, 0);
    coupled.push_back(coupling_[i].of_force * Vector::Map(&product[first]) +
                      coupling_[i].of_displacement * Vector::Map(&state[first]));
  }
  for (const NodeTangent<dim> &at : contact_) {
    const std::size_t first = unknown<dim>(at.node, 0);
    Vector::Map(&product[first]) += at.stiffness * Vector::Map(&state[first]);
    for (int c = dim; c < n; ++c)
      product[first + c] -= at.crossing[c - dim] * state[first + c];
  }
  project(product);
  for (std::size_t i = 0; i < coupled.size(); ++i)
    Vector::Map(&product[unknown<dim>(contact_[i].node, 0)]) += coupled[i];
  put_rows(product, y);
}

template <int dim>
typename BodyMatrix<dim>::Block BodyMatrix<dim>::block_of(PetscInt row, PetscInt column) const {
  std::array<PetscInt, n> of_row, of_column;
  std::iota(of_row.begin(), of_row.end(), n * row);
  std::iota(of_column.begin(), of_column.end(), n * column);
  Block block;
  check(MatGetValues(matrix_, n, of_row.data(), n, of_column.data(), block.data()));
  return block;
}

// Of nodes beside the contact, which another rank may have, it is in the matrix already.
template <int dim>
typename BodyMatrix<dim>::Block BodyMatrix<dim>::projector_of_row(PetscInt row) const {
  const auto found = contact_of_row_.find(row);
  return found == contact_of_row_.end() ? Block(Block::Identity())
                                        : projector(contact_[found->second].node);
}

// Q (K + C) Q + 1 - Q of these nodes. The contact leaves nothing free that is prescribed.
template <int dim>
typename BodyMatrix<dim>::Block BodyMatrix<dim>::with_contact(const ContactBlock &of) const {
  const Block q = projector_of_row(of.row);
  Block block = q * of.without * projector_of_row(of.column);
  if (of.row != of.column)
    return block;
  block += Block::Identity() - q;
  const NodeTangent<dim> &at = contact_[contact_of_row_.at(of.row)];
  block.template topLeftCorner<dim, dim>() += scale_[0] * scale_[0] * at.stiffness;
  for (int c = dim; c < n; ++c)
    block(c, c) += scale_[c] * scale_[c] * at.crossing[c - dim];
  return block;
}

// Set, not added: what the matrix holds depends on this contact only, not on those before.
template <int dim>
void BodyMatrix<dim>::put_contact() {
  for (const ContactBlock &at : contact_blocks_) {
    const Block block = with_contact(at);
    check(MatSetValuesBlocked(matrix_, 1, &at.row, 1, &at.column, block.data(), INSERT_VALUES));
  }
  finish_assembly(matrix_);
}

// Blocks of any contact, whether it changes them or not.
template <int dim>
Mat BodyMatrix<dim>::changes_of_displacements() const {
  const auto all = rows_.n_all(), own = rows_.n_own();
  PetscInt first = 0, last = 0;
  check(MatGetOwnershipRange(matrix_, &first, &last));
  std::vector<PetscInt> inside(own), outside(own);
  for (const ContactBlock &at : contact_blocks_)
    ++(n * at.column >= first && n * at.column < last ? inside : outside)[at.row - first / n];
  Mat change = nullptr;
  check(MatCreate(PETSC_COMM_WORLD, &change));
  check(MatSetSizes(change, dim * own, dim * own, dim * all, dim * all));
  check(MatSetType(change, MATAIJ));
  check(MatSetBlockSize(change, dim));
  check(MatXAIJSetPreallocation(change, dim, inside.data(), outside.data(), nullptr, nullptr));
  return change;
}

template <int dim>
void BodyMatrix<dim>::put_change_in(Mat change) const {
  using BlockOfU = Eigen::Matrix<double, dim, dim, Eigen::RowMajor>;
  for (const ContactBlock &at : contact_blocks_) {
    const BlockOfU block = (with_contact(at) - at.without).template topLeftCorner<dim, dim>();
    check(MatSetValuesBlocked(change, 1, &at.row, 1, &at.column, block.data(), INSERT_VALUES));
  }
  finish_assembly(change);
}

template class BodyMatrix<2>;
template class BodyMatrix<3>;

}  // namespace tourmaline::krylov
