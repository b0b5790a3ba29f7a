#include "krylov/block_rows.h"

#include <algorithm>
#include <cstddef>

#include "for_each_processor.h"
#include "krylov/petsc.h"

namespace tourmaline::krylov {

namespace {

// As an argument of a template a vector would lose its alignment.
template <int lanes>
struct Column {
  using Vector [[gnu::vector_size(8 * lanes), gnu::aligned(8), gnu::may_alias]] = double;
};

constexpr int most_lanes = 8;

struct Rows {
  const PetscInt *first, *column;
  std::ptrdiff_t count;
  const double *entries;
};

// A column of a block is read as one vector; lanes beyond its end are what stands behind it, and
// are dropped at the end.
template <int size, int lanes>
[[gnu::always_inline]] inline void add_rows(const Rows &rows, const double *x, double *y) {
  for (std::ptrdiff_t i = 0; i < rows.count; ++i) {
    typename Column<lanes>::Vector sum = {}, other = {};
    for (std::ptrdiff_t e = rows.first[i]; e < rows.first[i + 1]; ++e) {
      const double *const block = rows.entries + e * size * size;
      const double *const from = x + std::ptrdiff_t{rows.column[e]} * size;
      for (int c = 0; c < size; ++c)
        (c % 2 == 0 ? sum : other) +=
            *reinterpret_cast<const typename Column<lanes>::Vector *>(block + c * size) * from[c];
    }
    sum += other;
    for (int r = 0; r < size; ++r)
      y[i * size + r] += sum[r];
  }
}

FOR_EACH_PROCESSOR
void add_single_rows(const Rows &rows, const double *x, double *y) {
  for (std::ptrdiff_t i = 0; i < rows.count; ++i)
    for (std::ptrdiff_t e = rows.first[i]; e < rows.first[i + 1]; ++e)
      y[i] += rows.entries[e] * x[rows.column[e]];
}

FOR_EACH_PROCESSOR
void add_rows_of_two(const Rows &rows, const double *x, double *y) {
  add_rows<2, 2>(rows, x, y);
}

FOR_EACH_PROCESSOR
void add_rows_of_three(const Rows &rows, const double *x, double *y) {
  add_rows<3, 4>(rows, x, y);
}

FOR_EACH_PROCESSOR
void add_rows_of_six(const Rows &rows, const double *x, double *y) {
  add_rows<6, 8>(rows, x, y);
}

}  // namespace

BlockRows::BlockRows(Mat matrix, PetscInt block_size)
    : size_(block_size == 2 || block_size == 3 || block_size == 6 ? block_size : 1), first_{0} {
  PetscInt n_rows = 0;
  check(MatGetLocalSize(matrix, &n_rows, nullptr));
  for (PetscInt row = 0; row < n_rows; row += size_)
    put_columns(matrix, row);
  column_.shrink_to_fit();
  entries_.resize(column_.size() * size_ * size_ + most_lanes);
  for (PetscInt row = 0; row < n_rows; row += size_)
    read_again(matrix, row);
}

// Of the row of blocks that begins with this one of the matrix, whose rows may share them in part.
void BlockRows::put_columns(Mat matrix, PetscInt row) {
  PetscInt n = 0;
  const PetscInt *columns = nullptr;
  const std::ptrdiff_t begin = first_.back();
  for (PetscInt r = 0; r < size_; ++r) {
    check(MatGetRow(matrix, row + r, &n, &columns, nullptr));
    for (PetscInt k = 0; k < n; ++k)
      if (k == 0 || columns[k] / size_ != column_.back())
        column_.push_back(columns[k] / size_);
    check(MatRestoreRow(matrix, row + r, &n, &columns, nullptr));
  }
  std::sort(column_.begin() + begin, column_.end());
  column_.erase(std::unique(column_.begin() + begin, column_.end()), column_.end());
  first_.push_back(static_cast<PetscInt>(column_.size()));
}

void BlockRows::read_again(Mat matrix, PetscInt row) {
  PetscInt n = 0;
  const PetscInt *columns = nullptr;
  const PetscScalar *values = nullptr;
  const std::size_t of_a_block = std::size_t(size_) * size_;
  for (PetscInt r = 0; r < size_; ++r) {
    check(MatGetRow(matrix, row + r, &n, &columns, &values));
    auto at = column_.begin() + first_[row / size_];
    for (PetscInt k = 0; k < n; ++k) {
      at = std::find(at, column_.end(), columns[k] / size_);
      const auto block = static_cast<std::size_t>(at - column_.begin());
      entries_[block * of_a_block + std::size_t(columns[k] % size_) * size_ + r] = values[k];
    }
    check(MatRestoreRow(matrix, row + r, &n, &columns, &values));
  }
}

void BlockRows::add_product(const double *x, double *y) const {
  const Rows rows{first_.data(), column_.data(), static_cast<std::ptrdiff_t>(first_.size()) - 1,
                  entries_.data()};
  if (size_ == 6)
    add_rows_of_six(rows, x, y);
  else if (size_ == 3)
    add_rows_of_three(rows, x, y);
  else if (size_ == 2)
    add_rows_of_two(rows, x, y);
  else
    add_single_rows(rows, x, y);
}

}  // namespace tourmaline::krylov
