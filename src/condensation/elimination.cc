#include "condensation/elimination.h"

#include <algorithm>
#include <numeric>
#include <span>

namespace tourmaline::condensation {

namespace {

// Of every column of L by groups the groups below its diagonal, ascending. A group that only adds
// itself to what its only child has shares the child's list.
class Columns {
 public:
  explicit Columns(const GroupedMatrix &matrix);
  std::span<const int> below(int g) const {
    return std::span(entries_).subspan(begin_[g], end_[g] - begin_[g]);
  }
  bool continues_child(int g) const { return continues_[g]; }
  int child_of(int g) const { return only_child_[g]; }

 private:
  void link(int g);
  bool share(const GroupedMatrix &matrix, int g);
  void join(const GroupedMatrix &matrix, int g);

  std::vector<int> entries_;
  std::vector<std::size_t> begin_, end_;
  std::vector<int> list_, mark_;   // by group: the list that it uses, that it is in
  std::vector<int> child_, next_;  // of the elimination tree
  std::vector<int> only_child_;
  std::vector<bool> continues_;
};

Columns::Columns(const GroupedMatrix &matrix) {
  const int n = matrix.eliminated();
  for (auto *list : {&begin_, &end_})
    list->assign(n, 0);
  for (auto *list : {&list_, &child_, &next_, &only_child_})
    list->assign(n, -1);
  mark_.assign(matrix.size(), -1);
  continues_.assign(n, false);
  for (int g = 0; g < n; ++g) {
    if (child_[g] >= 0 && next_[child_[g]] < 0)
      only_child_[g] = child_[g];
    continues_[g] = only_child_[g] >= 0 && share(matrix, g);
    if (!continues_[g])
      join(matrix, g);
    link(g);
  }
}

void Columns::link(int g) {
  if (begin_[g] == end_[g] || entries_[begin_[g]] >= static_cast<int>(child_.size()))
    return;
  const int parent = entries_[begin_[g]];
  next_[g] = child_[parent];
  child_[parent] = g;
}

bool Columns::share(const GroupedMatrix &matrix, int g) {
  const int child = only_child_[g];
  for (std::size_t e = matrix.row[g]; e < matrix.row[g + 1]; ++e)
    if (const int h = matrix.neighbour[e]; h > g && mark_[h] != list_[child])
      return false;
  list_[g] = list_[child];
  begin_[g] = begin_[child] + 1;
  end_[g] = end_[child];
  return true;
}

void Columns::join(const GroupedMatrix &matrix, int g) {
  list_[g] = g;
  begin_[g] = entries_.size();
  const auto add = [&](int h) {
    if (h <= g || mark_[h] == g)
      return;
    mark_[h] = g;
    entries_.push_back(h);
  };
  for (std::size_t e = matrix.row[g]; e < matrix.row[g + 1]; ++e)
    add(matrix.neighbour[e]);
  for (int child = child_[g]; child >= 0; child = next_[child])
    for (std::size_t e = begin_[child]; e < end_[child]; ++e)
      add(entries_[e]);
  end_[g] = entries_.size();
  std::sort(entries_.begin() + static_cast<std::ptrdiff_t>(begin_[g]), entries_.end());
}

double operations_of(double pivots, double below) {
  const double height = pivots + below;
  return (height * height * height - below * below * below) / 3;
}

// The tree of fronts while they are merged; a front goes by the number of its first group's chain.
class Tree {
 public:
  Tree(const GroupedMatrix &matrix, const Columns &columns);
  void merge();
  void number(Elimination &elimination) const;

 private:
  void merge_children(int p);
  void absorb(int child, int p);
  void sort_children(int p);
  std::vector<int> postorder() const;

  std::vector<std::vector<int>> groups_, children_;
  std::vector<int> parent_;  // kept_: what is kept; -1: none
  std::vector<double> pivots_, below_, peak_;
  int kept_;  // the number of the front of what is kept
};

Tree::Tree(const GroupedMatrix &matrix, const Columns &columns) {
  std::vector<int> front_of(matrix.eliminated());
  for (int g = 0; g < matrix.eliminated(); ++g) {
    if (!columns.continues_child(g))
      groups_.emplace_back();
    front_of[g] = columns.continues_child(g) ? front_of[columns.child_of(g)]
                                             : static_cast<int>(groups_.size()) - 1;
    groups_[front_of[g]].push_back(g);
  }
  kept_ = static_cast<int>(groups_.size());
  for (const auto &groups : groups_) {
    double pivots = 0, below = 0;
    for (const int g : groups)
      pivots += matrix.size(g);
    for (const int g : columns.below(groups.back()))
      below += matrix.size(g);
    pivots_.push_back(pivots);
    below_.push_back(below);
  }
  groups_.emplace_back();
  for (int g = matrix.eliminated(); g < matrix.size(); ++g)
    groups_.back().push_back(g);
  pivots_.push_back(0);
  below_.push_back(0);
  children_.resize(groups_.size());
  parent_.assign(groups_.size(), -1);
  for (int s = 0; s < kept_; ++s)
    if (const auto below = columns.below(groups_[s].back()); !below.empty()) {
      parent_[s] = below[0] < matrix.eliminated() ? front_of[below[0]] : kept_;
      children_[parent_[s]].push_back(s);
    }
}

// Children come before their parents.
void Tree::merge() {
  for (int p = 0; p < kept_; ++p)
    merge_children(p);
  peak_.assign(groups_.size(), 0.);
  for (int p = 0; p <= kept_; ++p)
    sort_children(p);
}

// A child that leaves nearly all rows of its parent adds few zeros to it.
void Tree::merge_children(int p) {
  std::vector<int> children = children_[p];
  std::sort(children.begin(), children.end(), [&](int a, int b) {
    return below_[a] > below_[b] || (below_[a] == below_[b] && a < b);
  });
  for (const int c : children)
    if (Front::seconds(pivots_[c] + pivots_[p], below_[p]) <=
        Front::seconds(pivots_[c], below_[c]) + Front::seconds(pivots_[p], below_[p]))
      absorb(c, p);
}

void Tree::absorb(int child, int p) {
  groups_[child].insert(groups_[child].end(), groups_[p].begin(), groups_[p].end());
  groups_[p] = std::move(groups_[child]);
  groups_[child].clear();
  pivots_[p] += pivots_[child];
  std::erase(children_[p], child);
  for (const int c : children_[child])
    parent_[c] = p;
  children_[p].insert(children_[p].end(), children_[child].begin(), children_[child].end());
  children_[child].clear();
}

// The order in which what is handed on takes the least memory (Liu 1986).
void Tree::sort_children(int p) {
  const auto handed = [&](int c) { return below_[c] * below_[c] / 2; };
  std::sort(children_[p].begin(), children_[p].end(), [&](int a, int b) {
    const double x = peak_[a] - handed(a), y = peak_[b] - handed(b);
    return x > y || (x == y && a < b);
  });
  double stack = 0;
  for (const int c : children_[p]) {
    peak_[p] = std::max(peak_[p], stack + peak_[c]);
    stack += handed(c);
  }
  peak_[p] = std::max(peak_[p], stack + handed(p));
}

std::vector<int> Tree::postorder() const {
  std::vector<int> order, open;
  for (int s = 0; s <= kept_; ++s)
    if (parent_[s] < 0 && !groups_[s].empty())
      open.push_back(s);
  while (!open.empty()) {
    const int s = open.back();
    open.pop_back();
    order.push_back(s);
    open.insert(open.end(), children_[s].begin(), children_[s].end());
  }
  // What was taken first comes last; children of a front in their order.
  std::reverse(order.begin(), order.end());
  return order;
}

void Tree::number(Elimination &elimination) const {
  std::vector<int> order = postorder(), number(groups_.size(), -1);
  std::stable_partition(order.begin(), order.end(), [&](int s) { return s != kept_; });
  for (std::size_t f = 0; f < order.size(); ++f)
    number[order[f]] = static_cast<int>(f);
  for (const int s : order) {
    elimination.fronts.push_back({.parent = parent_[s] < 0 ? -1 : number[parent_[s]]});
    elimination.group_first.push_back(static_cast<int>(elimination.groups.size()));
    elimination.groups.insert(elimination.groups.end(), groups_[s].begin(), groups_[s].end());
    elimination.child_first.push_back(static_cast<int>(elimination.children.size()));
    for (const int c : children_[s])
      elimination.children.push_back(number[c]);
  }
  elimination.group_first.push_back(static_cast<int>(elimination.groups.size()));
  elimination.child_first.push_back(static_cast<int>(elimination.children.size()));
}

// The diagonal decides the signs, and those the order inside a front.
void set_places(const GroupedMatrix &matrix, Elimination &e) {
  const auto n = static_cast<std::size_t>(matrix.first.back());
  e.place.assign(n, -1);
  for (std::size_t f = 0; f < e.fronts.size(); ++f) {
    Front &front = e.fronts[f];
    front.first = static_cast<int>(e.variable.size());
    const auto add = [&](bool positive) {
      for (int k = e.group_first[f]; k < e.group_first[f + 1]; ++k)
        for (int i = matrix.first[e.groups[k]]; i < matrix.first[e.groups[k] + 1]; ++i)
          if (const int v = matrix.variables[i]; (e.diagonal[v] > 0) == positive) {
            e.place[v] = static_cast<int>(e.variable.size());
            e.variable.push_back(v);
          }
      return static_cast<int>(e.variable.size()) - front.first;
    };
    front.positive = add(true);
    front.pivots = add(false);
  }
}

// Groups below a front, in the order of elimination, become places: group by group of one front
// the positive ones, then the others.
class RowsBelow {
 public:
  RowsBelow(const GroupedMatrix &matrix, Elimination &e) : matrix_(matrix), e_(e) {
    rank_.resize(matrix.size());
    front_of_.resize(matrix.size());
    for (std::size_t f = 0; f < e.fronts.size(); ++f)
      for (int k = e.group_first[f]; k < e.group_first[f + 1]; ++k) {
        rank_[e.groups[k]] = k;
        front_of_[e.groups[k]] = static_cast<int>(f);
      }
  }

  void add(Front &front, std::span<const int> groups) {
    std::vector<int> sorted(groups.begin(), groups.end());
    std::sort(sorted.begin(), sorted.end(), [&](int a, int b) { return rank_[a] < rank_[b]; });
    front.rows = e_.below.size();
    for (std::size_t i = 0, end = 0; i < sorted.size(); i = end) {
      while (end < sorted.size() && front_of_[sorted[end]] == front_of_[sorted[i]])
        ++end;
      const auto same_front = std::span(sorted).subspan(i, end - i);
      add(same_front, true);
      add(same_front, false);
    }
    front.below = static_cast<int>(e_.below.size() - front.rows);
  }

 private:
  void add(std::span<const int> groups, bool positive) {
    for (const int g : groups)
      for (int i = matrix_.first[g]; i < matrix_.first[g + 1]; ++i)
        if (const int v = matrix_.variables[i]; (e_.diagonal[v] > 0) == positive)
          e_.below.push_back(e_.place[v]);
  }

  const GroupedMatrix &matrix_;
  Elimination &e_;
  std::vector<int> rank_, front_of_;
};

// Both lists ascend.
void set_rows_in_parents(Elimination &e) {
  e.in_parent.resize(e.below.size());
  for (const Front &front : e.fronts) {
    if (front.parent < 0)
      continue;
    const Front &parent = e.fronts[front.parent];
    int at = 0;
    for (std::size_t i = front.rows; i < front.rows + front.below; ++i) {
      const int pivot = e.below[i] - parent.first;
      if (pivot < parent.pivots) {
        e.in_parent[i] = pivot;
        continue;
      }
      while (e.below[parent.rows + at] != e.below[i])
        ++at;
      e.in_parent[i] = parent.pivots + at;
    }
  }
}

std::vector<double> diagonal_of(const GroupedMatrix &matrix) {
  std::vector<double> diagonal(matrix.first.back()), block;
  for (int g = 0; g < matrix.size(); ++g)
    for (std::size_t e = matrix.row[g]; e < matrix.row[g + 1]; ++e) {
      if (matrix.neighbour[e] != g)
        continue;
      const int n = matrix.size(g);
      block.resize(std::size_t(n) * n);
      matrix.block(matrix, g, e, block.data());
      for (int i = 0; i < n; ++i)
        diagonal[matrix.variables[matrix.first[g] + i]] = block[std::size_t(i) * (n + 1)];
    }
  return diagonal;
}

}  // namespace

double Front::operations() const {
  return operations_of(pivots, below);
}

// Its calls, its operations, its share of the factor (memory that has to be found, and then the
// substitutions of some twenty steps), what it hands on (docs/measurements.md).
double Front::seconds(double pivots, double below) {
  const double entries = pivots * below + pivots * pivots / 2;
  return 1e-5 + 4e-11 * operations_of(pivots, below) + 4e-8 * entries + 1e-9 * below * below;
}

Elimination::Elimination(const GroupedMatrix &matrix) : diagonal(diagonal_of(matrix)) {
  const Columns columns(matrix);
  Tree tree(matrix, columns);
  tree.merge();
  tree.number(*this);
  set_places(matrix, *this);
  RowsBelow rows(matrix, *this);
  for (std::size_t f = 0; f < fronts.size(); ++f) {
    const auto own = std::span(groups).subspan(group_first[f], group_first[f + 1] - group_first[f]);
    const bool is_kept = !own.empty() && own[0] >= matrix.eliminated();
    rows.add(fronts[f], is_kept ? own : columns.below(own.back()));
    if (is_kept)
      fronts[f].pivots = fronts[f].positive = 0;
  }
  set_rows_in_parents(*this);
}

}  // namespace tourmaline::condensation
