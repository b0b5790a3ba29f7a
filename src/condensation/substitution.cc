#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "condensation/trapezoid.h"
#include "for_each_processor.h"

// A substitution reads each number of the factor once, so memory bounds it, which is read fastest
// as one stream: forwards in one substitution, backwards in the other. Columns are 100 numbers long
// or fewer in most fronts, and of strips of eight of them, eight streams that soon end, memory
// gives half or a third (docs/measurements.md). Where columns are long it gives the same, and a
// strip reads or writes the vector, which no longer stays in the smallest cache, once for all
// eight.

namespace tourmaline::condensation {

namespace {

constexpr int strip = 8, half_a_strip = 4;
// Rows of single columns at most: a vector of so many stays in the smallest cache.
constexpr int rows_at_once = 1024;
// Rows that one thread takes at a time, whatever their number is.
constexpr int rows_of_a_task = 4096;

// Numbers of the factor that are asked for before their turn: where pages are small, memory is read
// ahead to the end of a page only.
constexpr int ahead = 256;

// Four rows at once.
using Four [[gnu::vector_size(32), gnu::aligned(8), gnu::may_alias]] = double;

// y -= l x, n numbers.
[[gnu::always_inline]] inline void subtract(const double *l, double x, double *y, int n) {
  int i = 0;
  for (; i + 8 <= n; i += 8) {
    __builtin_prefetch(l + i + ahead);
    *reinterpret_cast<Four *>(y + i) -= *reinterpret_cast<const Four *>(l + i) * x;
    *reinterpret_cast<Four *>(y + i + 4) -= *reinterpret_cast<const Four *>(l + i + 4) * x;
  }
  for (; i + 4 <= n; i += 4)
    *reinterpret_cast<Four *>(y + i) -= *reinterpret_cast<const Four *>(l + i) * x;
  for (; i < n; ++i)
    y[i] -= l[i] * x;
}

// l . y, n numbers from the last one on.
[[gnu::always_inline]] inline double product(const double *l, const double *y, int n) {
  Four sums[4] = {};
  const auto add = [&](int i, Four &sum) {
    sum += *reinterpret_cast<const Four *>(l + i) * *reinterpret_cast<const Four *>(y + i);
  };
  int i = n;
  for (; i >= 16; i -= 16) {
    __builtin_prefetch(l + i - ahead);
    __builtin_prefetch(l + i - ahead - 8);
    for (int k = 1; k <= 4; ++k)
      add(i - 4 * k, sums[k - 1]);
  }
  for (; i >= 4; i -= 4)
    add(i - 4, sums[0]);
  double rest = 0;
  while (i-- > 0)
    rest += l[i] * y[i];
  const Four sum = (sums[0] + sums[1]) + (sums[2] + sums[3]);
  return ((sum[0] + sum[1]) + (sum[2] + sum[3])) + rest;
}

// The unknowns of columns [c0, c1) of one panel, and rows below them down to `end` less what these
// eliminate there.
FOR_EACH_PROCESSOR
void solve_forward(const Trapezoid &l, int c0, int c1, double *x, int end) {
  const double *const first = l.at(c0, c0);
  const std::size_t step = l.leading(c0 / l.width) + 1;
  for (int c = c0; c < c1; ++c) {
    const double *const column = first + (c - c0) * step;
    x[c] /= column[0];
    subtract(column + 1, x[c], x + c + 1, end - c - 1);
  }
}

FOR_EACH_PROCESSOR
void solve_backward(const Trapezoid &l, int c0, int c1, double *x, int end) {
  const double *const first = l.at(c0, c0);
  const std::size_t step = l.leading(c0 / l.width) + 1;
  for (int c = c1; c-- > c0;) {
    const double *const column = first + (c - c0) * step;
    x[c] = (x[c] - product(column + 1, x + c + 1, end - c - 1)) / column[0];
  }
}

// Columns of a panel that are some rows long: entry (i, k) is l[i + k leading].
struct Strip {
  const double *l;
  std::size_t leading;
  int rows;
};

// y -= L x.
template <int columns>
[[gnu::always_inline]] inline void subtract(const Strip &a, const double *x, double *y) {
  std::array<double, columns> by;
  std::copy_n(x, columns, by.begin());
  int i = 0;
  for (; i + 4 <= a.rows; i += 4) {
    Four &rest = *reinterpret_cast<Four *>(y + i);
    Four sum = rest;
    for (int k = 0; k < columns; ++k)
      sum -= *reinterpret_cast<const Four *>(a.l + i + k * a.leading) * by[k];
    rest = sum;
  }
  for (; i < a.rows; ++i)
    for (int k = 0; k < columns; ++k)
      y[i] -= a.l[i + k * a.leading] * by[k];
}

// sums += L^T y.
template <int columns>
[[gnu::always_inline]] inline void add_products(const Strip &a, const double *y, double *sums) {
  Four parts[columns] = {};
  int i = 0;
  for (; i + 4 <= a.rows; i += 4) {
    const Four by = *reinterpret_cast<const Four *>(y + i);
    for (int k = 0; k < columns; ++k)
      parts[k] += *reinterpret_cast<const Four *>(a.l + i + k * a.leading) * by;
  }
  for (int k = 0; k < columns; ++k) {
    double sum = (parts[k][0] + parts[k][1]) + (parts[k][2] + parts[k][3]);
    for (int row = i; row < a.rows; ++row)
      sum += a.l[row + k * a.leading] * y[row];
    sums[k] += sum;
  }
}

// Rows [r0, r1) of the columns from c on.
Strip strip_at(const Trapezoid &l, int c, int r0, int r1) {
  return {l.at(r0, c), static_cast<std::size_t>(l.leading(c / l.width)), r1 - r0};
}

// Rows [r0, r1) of x less what columns [c0, c1) of one panel eliminate there.
FOR_EACH_PROCESSOR
void eliminate(const Trapezoid &l, int c0, int c1, double *x, int r0, int r1) {
  int c = c0;
  for (; c + strip <= c1; c += strip)
    subtract<strip>(strip_at(l, c, r0, r1), x + c, x + r0);
  for (; c + half_a_strip <= c1; c += half_a_strip)
    subtract<half_a_strip>(strip_at(l, c, r0, r1), x + c, x + r0);
  for (; c < c1; ++c)
    subtract<1>(strip_at(l, c, r0, r1), x + c, x + r0);
}

// sums[c - c0] += what rows [r0, r1) of x give to columns [c0, c1) of one panel.
FOR_EACH_PROCESSOR
void add_up(const Trapezoid &l, int c0, int c1, const double *x, int r0, int r1, double *sums) {
  int c = c0;
  for (; c + strip <= c1; c += strip)
    add_products<strip>(strip_at(l, c, r0, r1), x + r0, sums + (c - c0));
  for (; c + half_a_strip <= c1; c += half_a_strip)
    add_products<half_a_strip>(strip_at(l, c, r0, r1), x + r0, sums + (c - c0));
  for (; c < c1; ++c)
    add_products<1>(strip_at(l, c, r0, r1), x + r0, sums + (c - c0));
}

int tasks(int begin, int end) {
  return (end - begin + rows_of_a_task - 1) / rows_of_a_task;
}

template <typename Task>
void for_each_task(int begin, int end, parallel::Team &team, const Task &task) {
  team.share_out(tasks(begin, end), [&](int k, int) {
    task(k, begin + k * rows_of_a_task, std::min(end, begin + (k + 1) * rows_of_a_task));
  });
}

bool is_low(const Trapezoid &l, int panel) {
  return l.leading(panel) <= rows_at_once;
}

// Strips reach down to this row at once; what is below waits for its panel, and is shared out.
int reach(const Trapezoid &l, int panel) {
  return std::max(l.last(panel), std::min(l.height, rows_of_a_task));
}

}  // namespace

void substitute_forward(const Trapezoid &l, double *x, parallel::Team &team) {
  for (int p = 0; p < l.panels(); ++p) {
    const int first = l.first(p), last = l.last(p), end = reach(l, p);
    if (is_low(l, p)) {
      solve_forward(l, first, last, x, l.height);
      continue;
    }
    for (int c = first; c < last; c += strip) {
      const int next = std::min(last, c + strip);
      solve_forward(l, c, next, x, next);
      eliminate(l, c, next, x, next, end);
    }
    for_each_task(end, l.height, team,
                  [&](int, int r0, int r1) { eliminate(l, first, last, x, r0, r1); });
  }
}

void substitute_backward(const Trapezoid &l, double *x, parallel::Team &team) {
  std::vector<double> parts;
  for (int p = l.panels() - 1; p >= 0; --p) {
    const int first = l.first(p), last = l.last(p), end = reach(l, p), n = last - first;
    if (is_low(l, p)) {
      solve_backward(l, first, last, x, l.height);
      continue;
    }
    parts.assign(std::size_t(n) * tasks(end, l.height), 0.);
    for_each_task(end, l.height, team, [&](int k, int r0, int r1) {
      add_up(l, first, last, x, r0, r1, parts.data() + std::size_t(k) * n);
    });
    for (std::size_t i = 0; i < parts.size(); ++i)
      x[first + static_cast<int>(i % n)] -= parts[i];
    for (int next = last, c = first + (n - 1) / strip * strip; next > first; next = c, c -= strip) {
      std::array<double, strip> sums{};
      add_up(l, c, next, x, next, end, sums.data());
      for (int k = c; k < next; ++k)
        x[k] -= sums[k - c];
      solve_backward(l, c, next, x, next);
    }
  }
}

}  // namespace tourmaline::condensation
