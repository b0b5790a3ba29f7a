#pragma once

#include <petscmat.h>

#include <Eigen/Dense>
#include <array>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "body/cell_products.h"
#include "body/operator.h"
#include "body/prescribed.h"
#include "krylov/node_rows.h"
#include "krylov/node_tangent.h"

namespace tourmaline::krylov {

/// The operator K of a step and the contact's stiffness C as matrices of PETSc, in scaled unknowns,
/// with Q the projector onto what is free. The electric and heat rows change their sign, so that
/// the diagonal blocks are positive definite. The matrix is assembled once; a contact changes the
/// rows and columns of its nodes.
template <int dim>
class BodyMatrix {
 public:
  static constexpr int n = body::Fields<dim>::count;

  /// Of the body without contact. `op` outlives this.
  BodyMatrix(const body::Operator<dim> &op, double step,
             const std::vector<body::Prescribed> &prescribed);
  ~BodyMatrix();
  BodyMatrix(const BodyMatrix &) = delete;
  BodyMatrix &operator=(const BodyMatrix &) = delete;

  Mat matrix() const { return matrix_; }  ///< Q (K + C) Q + 1 - Q
  /// Its product with Q x, that with couplings, or cell by cell, if these are set.
  Mat free() const { return free_; }
  const NodeRows &rows() const { return rows_; }
  const std::vector<bool> &is_prescribed() const { return is_prescribed_; }
  const std::array<double, n> &scale() const { return scale_; }  ///< by component [SI]

  /// One entry for each contact node, always the same nodes. True where only stiffnesses differ
  /// from those of the contact before; without contact nodes nothing does.
  bool set_contact(std::vector<NodeTangent<dim>> contact);
  const std::vector<NodeTangent<dim>> &contact() const { return contact_; }
  /// A matrix for `put_change_in`, with rows and columns of u alone, those of `matrix` by node. To
  /// be destroyed by the caller.
  Mat changes_of_displacements() const;
  /// Puts in what the contact changes in the matrix of displacements.
  void put_change_in(Mat change) const;
  /// E and G of `BodySystem::set_coupling`.
  void set_coupling(std::vector<NodeCoupling<dim>> coupling) { coupling_ = std::move(coupling); }
  /// Products of `free` are those of the cells from now on, which outlive this.
  void refine(const body::CellProducts<dim> &cells) { cells_ = &cells; }
  bool is_refined() const { return cells_ != nullptr; }

  /// Q r [SI].
  void project(std::span<double> vector) const;
  /// By unknown of this rank [SI]. Collective.
  std::vector<double> in_si(Vec scaled) const;
  /// Of rows by unknown those that are this rank's, the electric and heat rows with their sign.
  void put_rows(std::span<const double> rows, Vec scaled) const;

 private:
  using Block = typename body::Operator<dim>::Block;
  struct ContactBlock {
    PetscInt row, column;  // of nodes
    Block without;         // contact
  };

  void preallocate();
  Block projector(body::Node node) const;
  bool at_contact(PetscInt row) const { return contact_of_row_.contains(row); }
  Block projector_of_row(PetscInt row) const;
  void assemble();
  void note_contact_blocks();
  void note_held_nodes();
  void project_own(PetscScalar *own) const;
  static PetscErrorCode multiply_free(Mat free, Vec x, Vec y);
  void multiply_whole(Vec x, Vec y) const;
  Block block_of(PetscInt row, PetscInt column) const;
  Block with_contact(const ContactBlock &of) const;
  void put_contact();

  const body::Operator<dim> &op_;
  double step_;
  std::vector<bool> is_prescribed_;
  std::vector<NodeTangent<dim>> contact_;
  std::vector<NodeCoupling<dim>> coupling_;           // as `contact_`, or empty
  std::vector<int> contact_index_;                    // by node; -1: not at the contact
  std::unordered_map<PetscInt, int> contact_of_row_;  // the same by the rows of contact nodes alone
  std::vector<ContactBlock> contact_blocks_;          // in this rank's rows
  NodeRows rows_;
  std::vector<std::pair<PetscInt, Block>> held_;  // own rows, from the first one on, where Q != 1
  std::array<double, n> scale_;
  const body::CellProducts<dim> *cells_ = nullptr;  // once refined
  Mat matrix_ = nullptr, free_ = nullptr;
  Vec projected_ = nullptr;
};

}  // namespace tourmaline::krylov
