#include "condensation/trapezoid.h"

#include <cblas.h>

#include <algorithm>
#include <vector>

extern "C" void dpotrf_(const char *triangle, const int *n, double *a, const int *leading,
                        int *info);

namespace tourmaline::condensation {

namespace {

// Columns of one sign in one panel.
struct Block {
  int first, last;
  double sign;
};

// Rows that one thread takes at a time, whatever their number is.
constexpr int rows_of_a_product = 512;
// Columns of a broad panel, and rows that one thread takes of what is left.
constexpr int broadest = 512, rows_of_a_tile = 1024;
// Whoever has the first of a panel's columns has all of its diagonal block.
static_assert(broadest <= rows_of_a_product && broadest <= rows_of_a_tile);

template <typename Task>
void in_chunks(int begin, int end, int rows, parallel::Team &team, const Task &task) {
  const int chunks = (end - begin + rows - 1) / rows;
  team.share_out(
      chunks, [&](int k, int) { task(begin + k * rows, std::min(end, begin + (k + 1) * rows)); });
}

// target -= L_rows S L_columns^T for rows [r0, r1) and columns [c0, c1) of the front; where both
// begin at the diagonal its upper half is left alone.
void subtract(const Trapezoid &l, const Block &by, double *target, int leading, int r0, int r1,
              int c0, int c1) {
  const int n = c1 - c0, k = by.last - by.first, l_leading = l.leading(by.first / l.width);
  if (r0 == c0) {
    cblas_dsyrk(CblasColMajor, CblasLower, CblasNoTrans, n, k, -by.sign, l.at(c0, by.first),
                l_leading, 1, target, leading);
    r0 += n;
    target += n;
  }
  if (r1 > r0)
    cblas_dgemm(CblasColMajor, CblasNoTrans, CblasTrans, r1 - r0, n, k, -by.sign,
                l.at(r0, by.first), l_leading, l.at(c0, by.first), l_leading, 1, target, leading);
}

// The columns' own block; true: all pivots have the sign.
int factorise_diagonal(const Trapezoid &l, const Block &block) {
  const int n = block.last - block.first, leading = l.leading(block.first / l.width);
  if (block.sign < 0)
    for (int j = block.first; j < block.last; ++j)
      for (int i = j; i < l.height; ++i)
        *l.at(i, j) *= -1;
  int info = 0;
  dpotrf_("L", &n, l.at(block.first, block.first), &leading, &info);
  return info;
}

void divide_below(const Trapezoid &l, const Block &block, int r0, int r1) {
  const int leading = l.leading(block.first / l.width);
  cblas_dtrsm(CblasColMajor, CblasRight, CblasLower, CblasTrans, CblasNonUnit, r1 - r0,
              block.last - block.first, 1, l.at(block.first, block.first), leading,
              l.at(r0, block.first), leading);
}

std::vector<Block> blocks_of(const Trapezoid &l, int panel, int positive) {
  const int first = l.first(panel), last = l.last(panel);
  const int change = std::clamp(positive, first, last);
  std::vector<Block> blocks;
  if (change > first)
    blocks.push_back({first, change, 1});
  if (change < last)
    blocks.push_back({change, last, -1});
  return blocks;
}

// Every panel of `rest` in chunks of rows.
void subtract_from_rest(const Trapezoid &l, const std::vector<Block> &blocks, const Trapezoid &rest,
                        parallel::Team &team) {
  struct Tile {
    int panel, begin;
  };
  std::vector<Tile> tiles;
  for (int p = 0; p < rest.panels(); ++p)
    for (int row = rest.first(p); row < rest.height; row += rows_of_a_tile)
      tiles.push_back({p, row});
  const int n = static_cast<int>(tiles.size()), k = l.columns;
  team.share_out(n, [&](int t, int) {
    const auto [p, begin] = tiles[t];
    const int end = std::min(rest.height, begin + rows_of_a_tile);
    for (const Block &by : blocks)
      subtract(l, by, rest.at(begin, rest.first(p)), rest.leading(p), k + begin, k + end,
               k + rest.first(p), k + rest.last(p));
  });
}

}  // namespace

Trapezoid Trapezoid::at(double *data, int height, int columns) {
  const Trapezoid all{data, height, columns};
  return {data, height, columns, std::clamp(columns, 1, all.is_low() ? 8 : 128)};
}

Trapezoid Trapezoid::broad(double *data, int height, int columns) {
  return {data, height, columns, std::clamp(columns, 1, broadest)};
}

std::size_t Trapezoid::begin(int panel) const {
  const auto p = static_cast<std::size_t>(std::max(panel, 0));
  return p * width * height - std::size_t(width) * width * (p * (p - (p > 0)) / 2);
}

std::size_t Trapezoid::tail() const {
  const int p = panels() - 1;
  return p < 0 ? 0 : std::size_t(last(p) - first(p)) * leading(p);
}

double *Trapezoid::column_from_row_0(int column) const {
  const int p = column < width ? 0 : column / width;  // mostly there is one alone
  return data + begin(p) + std::size_t(column - first(p)) * leading(p) - first(p);
}

void Trapezoid::copy_to(const Trapezoid &to) const {
  for (int j = 0; j < columns; ++j)
    std::copy_n(at(j, j), height - j, to.at(j, j));
}

int factorise(const Trapezoid &l, const Trapezoid &rest, int positive, parallel::Team &team) {
  std::vector<Block> done;
  for (int p = 0; p < l.panels(); ++p) {
    const int first = l.first(p), last = l.last(p), leading = l.leading(p);
    in_chunks(first, l.height, rows_of_a_product, team, [&](int r0, int r1) {
      for (const Block &by : done)
        subtract(l, by, l.at(r0, first), leading, r0, r1, first, last);
    });
    for (const Block &block : blocks_of(l, p, positive)) {
      if (const int wrong = factorise_diagonal(l, block); wrong > 0)
        return block.first + wrong - 1;
      in_chunks(block.last, l.height, rows_of_a_product, team,
                [&](int r0, int r1) { divide_below(l, block, r0, r1); });
      if (block.last < last)
        in_chunks(block.last, l.height, rows_of_a_product, team, [&](int r0, int r1) {
          subtract(l, block, l.at(r0, block.last), leading, r0, r1, block.last, last);
        });
      done.push_back(block);
    }
  }
  subtract_from_rest(l, done, rest, team);
  return -1;
}

}  // namespace tourmaline::condensation
