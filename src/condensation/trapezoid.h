#pragma once

#include <cstddef>

#include "parallel/team.h"

namespace tourmaline::condensation {

/// The lower trapezoid of a front's columns, doubles that somebody else owns: panels of `width`
/// columns, one after another, each by columns from its first row down.
struct Trapezoid {
  double *data = nullptr;
  int height = 0, columns = 0, width = 1;

  /// In panels as substitutions read them: nearly without gaps where columns are short.
  static Trapezoid at(double *data, int height, int columns);
  /// In panels as products work best: broad ones.
  static Trapezoid broad(double *data, int height, int columns);

  int panels() const { return (columns + width - 1) / width; }
  int first(int panel) const { return panel * width; }
  int last(int panel) const { return columns < first(panel + 1) ? columns : first(panel + 1); }
  int leading(int panel) const { return height - first(panel); }
  std::size_t begin(int panel) const;
  std::size_t size() const { return begin(panels() - 1) + tail(); }
  bool is_low() const { return height < 1024; }
  /// Entry (row, column), on or below the diagonal.
  double *at(int row, int column) const { return column_from_row_0(column) + row; }
  /// What the rows of a column are counted from.
  double *column_from_row_0(int column) const;
  /// `to`: of the same height and columns.
  void copy_to(const Trapezoid &to) const;

 private:
  std::size_t tail() const;
};

/// Factorises the columns `l` of a front, L S L^T with signs S, 1 for the first `positive` columns,
/// then -1, and subtracts from `rest`, the columns that are left, what they eliminate. Diagonal
/// blocks are those of Cholesky's factorisation. Returns the first column whose pivot has another
/// sign, -1 if there is none. The numbers are the same for any team.
int factorise(const Trapezoid &l, const Trapezoid &rest, int positive, parallel::Team &team);

/// x: `height` numbers. Its first `columns` ones become those of L^-1 x, what they eliminate is
/// subtracted from the others.
void substitute_forward(const Trapezoid &l, double *x, parallel::Team &team);
/// From the others the first `columns` ones, those of L^-T x.
void substitute_backward(const Trapezoid &l, double *x, parallel::Team &team);

}  // namespace tourmaline::condensation
