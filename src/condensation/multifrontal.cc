#include "condensation/multifrontal.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "parallel/available_memory.h"
#include "stopwatch.h"
#include "tourmaline/error.h"

extern "C" void openblas_set_num_threads(int threads);
extern "C" int openblas_get_num_threads();

namespace tourmaline::condensation {

namespace {

// A pivot that is so small beside its entry on the diagonal has no digit.
constexpr double no_digit = std::numeric_limits<double>::epsilon();

// That one thread takes at a time of what a child hands on.
constexpr int columns_of_a_task = 128;

// Threads are ours: each calls OpenBLAS for itself.
class OneBlasThread {
 public:
  OneBlasThread() : before_(openblas_get_num_threads()) {
    if (before_ != 1)
      openblas_set_num_threads(1);
  }
  ~OneBlasThread() {
    if (before_ != 1)
      openblas_set_num_threads(before_);
  }
  OneBlasThread(const OneBlasThread &) = delete;
  OneBlasThread &operator=(const OneBlasThread &) = delete;

 private:
  int before_;
};

std::size_t handed_on(const Front &front) {
  return Trapezoid::broad(nullptr, front.below, front.below).size();
}

// Panels of a low front are narrow, and its columns are worked on in broad ones beside them.
std::size_t beside(const Front &front) {
  const Trapezoid l = Trapezoid::broad(nullptr, front.height(), front.pivots);
  return l.is_low() ? l.size() : 0;
}

}  // namespace

// Of one thread while it factorises: what fronts hand to their parents lies on two stacks, that of
// a front on the other one than its children's, so each is left as it was found.
class Multifrontal::Work {
 public:
  Work(const Multifrontal &whole, const std::array<std::size_t, 2> &stacks, parallel::Team &team);
  int factorise(const GroupedMatrix &matrix, int front, std::vector<Trapezoid> &handed,
                double *beyond, parallel::Team &team);

 private:
  Trapezoid cleared(const Trapezoid &panels);
  void assemble(const GroupedMatrix &matrix, int front, const Trapezoid &l, const Trapezoid &rest);
  void add(const GroupedMatrix &matrix, int front, int group, std::size_t entry, const Trapezoid &l,
           const Trapezoid &rest);
  void extend(int child, const Trapezoid &from, const Trapezoid &l, const Trapezoid &rest,
              parallel::Team &team);

  const Multifrontal &whole_;
  std::array<Stack, 2> stacks_;
  std::vector<int> row_of_, rows_of_other_;  // of places below the front at hand; of a group
  std::vector<double> columns_, block_;      // of the front, of two groups
};

Multifrontal::Work::Work(const Multifrontal &whole, const std::array<std::size_t, 2> &stacks,
                         parallel::Team &team)
    : whole_(whole),
      stacks_{Stack(stacks[0], team), Stack(stacks[1], team)},
      row_of_(whole.elimination_.place.size()),
      columns_(whole.beside_) {}

// Returns the place of a pivot that is none, -1 if there is none; `beyond`: where to put what is
// handed on if not on the stack.
int Multifrontal::Work::factorise(const GroupedMatrix &matrix, int f,
                                  std::vector<Trapezoid> &handed, double *beyond,
                                  parallel::Team &team) {
  const Elimination &e = whole_.elimination_;
  const Front &front = e.fronts[f];
  const Trapezoid panels = whole_.panels(f), l = panels.is_low() ? cleared(panels) : panels;
  double *to = beyond != nullptr ? beyond : stacks_[whole_.stack_[f]].push(handed_on(front));
  const Trapezoid rest = handed[f] = Trapezoid::broad(to, front.below, front.below);
  assemble(matrix, f, l, rest);
  for (int c = e.child_first[f]; c < e.child_first[f + 1]; ++c)
    extend(e.children[c], handed[e.children[c]], l, rest, team);
  for (int c = e.child_first[f]; c < e.child_first[f + 1]; ++c)
    if (const int child = e.children[c]; !whole_.is_subtree_[child])
      stacks_[whole_.stack_[child]].pop(handed_on(e.fronts[child]));
  const int wrong = condensation::factorise(l, rest, front.positive, team);
  if (wrong >= 0)
    return front.first + wrong;
  for (int j = 0; j < front.pivots; ++j) {
    const double root = *l.at(j, j), entry = e.diagonal[e.variable[front.first + j]];
    if (!(root * root > no_digit * std::abs(entry)))
      return front.first + j;
  }
  if (panels.is_low())
    l.copy_to(panels);
  return -1;
}

Trapezoid Multifrontal::Work::cleared(const Trapezoid &panels) {
  const Trapezoid l = Trapezoid::broad(columns_.data(), panels.height, panels.columns);
  std::fill_n(columns_.begin(), l.size(), 0.);
  return l;
}

// The entries of the matrix in rows or columns of the front's pivots.
void Multifrontal::Work::assemble(const GroupedMatrix &matrix, int f, const Trapezoid &l,
                                  const Trapezoid &rest) {
  const Elimination &e = whole_.elimination_;
  const Front &front = e.fronts[f];
  for (int i = 0; i < front.below; ++i)
    row_of_[e.below[front.rows + i]] = front.pivots + i;
  for (int k = e.group_first[f]; k < e.group_first[f + 1]; ++k)
    for (std::size_t entry = matrix.row[e.groups[k]]; entry < matrix.row[e.groups[k] + 1]; ++entry)
      add(matrix, f, e.groups[k], entry, l, rest);
}

void Multifrontal::Work::add(const GroupedMatrix &matrix, int f, int group, std::size_t entry,
                             const Trapezoid &l, const Trapezoid &rest) {
  const Elimination &e = whole_.elimination_;
  const Front &front = e.fronts[f];
  const int other = matrix.neighbour[entry], n = matrix.size(group), m = matrix.size(other);
  const int *const rows = matrix.variables.data() + matrix.first[group];
  const int *const columns = matrix.variables.data() + matrix.first[other];
  const auto row = [&](int variable) {
    const int place = e.place[variable], pivot = place - front.first;
    return pivot < front.pivots ? pivot : row_of_[place];
  };
  const bool both_here = whole_.front_of_[other] == f;
  if (whole_.front_of_[other] < f || (both_here && other < group))
    return;
  block_.resize(std::size_t(n) * m);
  matrix.block(matrix, group, entry, block_.data());
  rows_of_other_.resize(m);
  std::transform(columns, columns + m, rows_of_other_.begin(), row);
  for (int i = 0; i < n; ++i)
    for (int j = 0, here = row(rows[i]); j < (other == group ? i + 1 : m); ++j) {
      const auto [column, below] = std::minmax(here, rows_of_other_[j]);
      const double value = block_[std::size_t(i) * m + j];
      if (column < l.columns)
        *l.at(below, column) += value;
      else
        *rest.at(below - l.columns, column - l.columns) += value;
    }
}

// What a child hands on, each column by itself.
void Multifrontal::Work::extend(int child, const Trapezoid &from, const Trapezoid &l,
                                const Trapezoid &rest, parallel::Team &team) {
  const Elimination &e = whole_.elimination_;
  const int *const row = e.in_parent.data() + e.fronts[child].rows;
  const int n = from.columns;
  const auto add_column = [&](int j) {
    const double *const source = from.column_from_row_0(j);
    double *const target = row[j] < l.columns
                               ? l.column_from_row_0(row[j])
                               : rest.column_from_row_0(row[j] - l.columns) - l.columns;
    if (row[n - 1] - row[j] == n - 1 - j)
      for (int i = j; i < n; ++i)
        target[row[j] - j + i] += source[i];
    else
      for (int i = j; i < n; ++i)
        target[row[i]] += source[i];
  };
  team.share_out((n + columns_of_a_task - 1) / columns_of_a_task, [&](int task, int) {
    const int first = task * columns_of_a_task;
    for (int j = first; j < std::min(n, first + columns_of_a_task); ++j)
      add_column(j);
  });
}

Multifrontal::Multifrontal(const GroupedMatrix &matrix, const std::vector<int> &schur, int threads)
    : team_(threads), schur_(schur) {
  Stopwatch watch;
  elimination_ = Elimination(matrix);
  plan();
  statistics_.analyse_seconds = watch.lap();
  const OneBlasThread one;
  factorise(matrix);
  statistics_.factorise_seconds = watch.lap();
  statistics_.solver = "own";
}

void Multifrontal::plan() {
  const auto &fronts = elimination_.fronts;
  const int n = static_cast<int>(fronts.size());
  stack_.assign(n, 0);
  for (int f = n - 1; f >= 0; --f)
    if (fronts[f].parent >= 0)
      stack_[f] = 1 - stack_[fronts[f].parent];
  for (int f = 0; f < n; ++f) {
    const Front &front = fronts[f];
    panels_.push_back(factor_size_);
    factor_size_ += Trapezoid::at(nullptr, front.height(), front.pivots).size();
    statistics_.factor_entries += front.entries();
    statistics_.flops += front.operations();
    statistics_.negative_pivots += front.pivots - front.positive;
    for (int k = elimination_.group_first[f]; k < elimination_.group_first[f + 1]; ++k) {
      front_of_.resize(std::max<std::size_t>(front_of_.size(), elimination_.groups[k] + 1UL));
      front_of_[elimination_.groups[k]] = f;
    }
  }
  int height = 0;
  for (const Front &front : fronts)
    height = std::max(height, front.height());
  for (const Front &front : fronts)
    beside_ = std::max(beside_, beside(front));
  work_.assign(team_.members(), std::vector<double>(height));
  handed_.resize(elimination_.below.size());
  x_.resize(elimination_.place.size());
  share_out();
}

// Subtrees of at most a part of the work each, whatever is above them for all threads together.
void Multifrontal::share_out() {
  const auto &fronts = elimination_.fronts;
  const int n = static_cast<int>(fronts.size());
  is_subtree_.assign(n, 0);
  std::vector<double> work(n);
  std::vector<int> first(n);
  std::iota(first.begin(), first.end(), 0);
  for (int f = 0; f < n; ++f) {
    work[f] += fronts[f].operations();
    if (const int parent = fronts[f].parent; parent >= 0) {
      work[parent] += work[f];
      first[parent] = std::min(first[parent], first[f]);
    }
  }
  const int threads = team_.members();
  const double most = threads == 1 ? 0 : statistics_.flops / (4 * threads);
  for (int f = n - 1; f >= 0;) {
    const bool is_subtree = fronts[f].pivots > 0 && work[f] <= most;
    is_subtree_[f] = is_subtree;
    if (is_subtree)
      subtrees_.push_back({first[f], f});
    else
      top_.push_back(f);
    f = is_subtree ? first[f] - 1 : f - 1;
  }
  statistics_.subtrees = static_cast<int>(subtrees_.size());
  std::reverse(top_.begin(), top_.end());
  std::stable_sort(subtrees_.begin(), subtrees_.end(),
                   [&](const Subtree &a, const Subtree &b) { return work[a.root] > work[b.root]; });
}

// What both stacks hold at most while these fronts are factorised.
std::array<std::size_t, 2> Multifrontal::stacks(std::span<const int> fronts) const {
  std::array<std::size_t, 2> used{}, most{};
  for (const int f : fronts) {
    if (!is_subtree_[f])
      used[stack_[f]] += handed_on(elimination_.fronts[f]);
    most[stack_[f]] = std::max(most[stack_[f]], used[stack_[f]]);
    for (int c = elimination_.child_first[f]; c < elimination_.child_first[f + 1]; ++c)
      if (const int child = elimination_.children[c]; !is_subtree_[child])
        used[stack_[child]] -= handed_on(elimination_.fronts[child]);
  }
  return most;
}

Trapezoid Multifrontal::panels(int f) const {
  const Front &front = elimination_.fronts[f];
  return Trapezoid::at(factor_.data() + panels_[f], front.height(), front.pivots);
}

void Multifrontal::factorise(const GroupedMatrix &matrix) {
  std::vector<Trapezoid> handed(elimination_.fronts.size());
  std::vector<double *> beyond(handed.size(), nullptr);
  std::size_t entries = 0;
  std::array<std::size_t, 2> most{};
  for (const Subtree &s : subtrees_) {
    std::vector<int> fronts(s.root - s.first + 1);
    std::iota(fronts.begin(), fronts.end(), s.first);
    const auto stacks_of = stacks(fronts);
    for (int i = 0; i < 2; ++i)
      most[i] = std::max(most[i], stacks_of[i]);
    entries += handed_on(elimination_.fronts[s.root]);
  }
  const auto of_top = stacks(top_);
  const std::size_t of_members =
      subtrees_.empty() ? 0 : team_.members() * (most[0] + most[1] + beside_);
  parallel::give_back_freed_memory();
  require_memory(factor_size_ + entries + std::max(of_members, of_top[0] + of_top[1] + beside_));
  factor_ = Pages(factor_size_, team_);
  const Pages roots(entries, team_);
  double *next = roots.data();
  for (const Subtree &s : subtrees_) {
    beyond[s.root] = next;
    next += handed_on(elimination_.fronts[s.root]);
  }
  constexpr int none = std::numeric_limits<int>::max();
  std::vector<int> weak(subtrees_.size(), none);  // by subtree, the place of its first weak pivot
  if (!subtrees_.empty()) {
    std::vector<Work> works;
    for (int t = 0; t < team_.members(); ++t)
      works.emplace_back(*this, most, team_);
    team_.share_out(static_cast<int>(subtrees_.size()), [&](int s, int member) {
      for (int f = subtrees_[s].first; f <= subtrees_[s].root && weak[s] == none; ++f)
        if (const int place = works[member].factorise(matrix, f, handed, beyond[f], alone_);
            place >= 0)
          weak[s] = place;
    });
  }
  if (const auto first = std::min_element(weak.begin(), weak.end());
      first != weak.end() && *first != none)
    throw WeakPivot{elimination_.variable[*first]};
  Work work(*this, of_top, team_);
  for (const int f : top_)
    if (const int place = work.factorise(matrix, f, handed, beyond[f], team_); place >= 0)
      throw WeakPivot{elimination_.variable[place]};
  if (!schur_.empty())
    take_schur_complement(handed.back());
}

// Before any of it is taken: of the memory it is known what it will be.
void Multifrontal::require_memory(std::size_t doubles) const {
  const double bytes = 8. * static_cast<double>(doubles + schur_.size() * schur_.size());
  const parallel::AvailableMemory available = parallel::available_memory();
  if (bytes > available.bytes)
    throw MachineError(fmt::format(
        "the factorisation of {} unknowns takes {:.3g} GiB of memory, {} {:.3g} GiB; take fewer "
        "cells",
        elimination_.place.size(), bytes / (1 << 30), available.words,
        available.bytes / (1 << 30)));
}

void Multifrontal::take_schur_complement(const Trapezoid &rest) {
  const std::size_t n = schur_.size();
  std::vector<int> row;
  for (const int v : schur_)
    row.push_back(elimination_.place[v] - elimination_.fronts.back().first);
  schur_complement_.resize(n * n);
  for (std::size_t j = 0; j < n; ++j)
    for (std::size_t i = 0; i < n; ++i)
      schur_complement_[j * n + i] = *rest.at(std::max(row[i], row[j]), std::min(row[i], row[j]));
}

void Multifrontal::forward(int f, double *work, parallel::Team &team) {
  const Elimination &e = elimination_;
  const Front &front = e.fronts[f];
  std::copy_n(x_.data() + front.first, front.pivots, work);
  std::fill_n(work + front.pivots, front.below, 0.);
  for (int c = e.child_first[f]; c < e.child_first[f + 1]; ++c) {
    const Front &child = e.fronts[e.children[c]];
    for (std::size_t i = child.rows; i < child.rows + child.below; ++i)
      work[e.in_parent[i]] += handed_[i];
  }
  substitute_forward(panels(f), work, team);
  std::copy_n(work, front.pivots, x_.data() + front.first);
  std::copy_n(work + front.pivots, front.below, handed_.data() + front.rows);
}

void Multifrontal::backward(int f, double *work, parallel::Team &team) {
  const Elimination &e = elimination_;
  const Front &front = e.fronts[f];
  for (int i = 0; i < front.pivots; ++i)
    work[i] = i < front.positive ? x_[front.first + i] : -x_[front.first + i];
  for (int i = 0; i < front.below; ++i)
    work[front.pivots + i] = x_[e.below[front.rows + i]];
  substitute_backward(panels(f), work, team);
  std::copy_n(work, front.pivots, x_.data() + front.first);
}

template <typename Task>
void Multifrontal::for_each_subtree(const Task &task) {
  team_.share_out(static_cast<int>(subtrees_.size()),
                  [&](int s, int member) { task(subtrees_[s], work_[member].data()); });
}

std::vector<double> Multifrontal::reduce(std::vector<double> &right_side) {
  const OneBlasThread one;
  right_side_ = &right_side;
  for (std::size_t i = 0; i < x_.size(); ++i)
    x_[i] = right_side[elimination_.variable[i]];
  for_each_subtree([&](const Subtree &s, double *work) {
    for (int f = s.first; f <= s.root; ++f)
      forward(f, work, alone_);
  });
  for (const int f : top_)
    forward(f, work_[0].data(), team_);
  std::vector<double> reduced;
  for (const int v : schur_) {
    const int place = elimination_.place[v];
    const Front &kept = elimination_.fronts.back();
    reduced.push_back(x_[place] + handed_[kept.rows + (place - kept.first)]);
  }
  return reduced;
}

void Multifrontal::expand(std::span<const double> interface) {
  const OneBlasThread one;
  for (std::size_t i = 0; i < schur_.size(); ++i)
    x_[elimination_.place[schur_[i]]] = interface[i];
  for (std::size_t k = top_.size(); k-- > 0;)
    backward(top_[k], work_[0].data(), team_);
  for_each_subtree([&](const Subtree &s, double *work) {
    for (int f = s.root; f >= s.first; --f)
      backward(f, work, alone_);
  });
  for (std::size_t i = 0; i < x_.size(); ++i)
    (*right_side_)[elimination_.variable[i]] = x_[i];
}

}  // namespace tourmaline::condensation
