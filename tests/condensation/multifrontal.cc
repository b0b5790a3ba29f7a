#include "condensation/multifrontal.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <numeric>
#include <random>
#include <set>

namespace tourmaline::condensation {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// A quasi-definite matrix in groups, with its entries at hand.
struct Example {
  MatrixXd entries;
  std::vector<int> group_of;  // by variable; groups in the order of elimination
  int groups = 0, kept = 0;

  GroupedMatrix matrix() const {
    GroupedMatrix m;
    m.kept = kept;
    for (int g = 0; g < groups; ++g) {
      for (int v = 0; v < static_cast<int>(group_of.size()); ++v)
        if (group_of[v] == g)
          m.variables.push_back(v);
      m.first.push_back(static_cast<int>(m.variables.size()));
    }
    for (int g = 0; g < groups; ++g) {
      std::set<int> neighbours{g};
      for (const int i : of(g))
        for (Index j = 0; j < entries.cols(); ++j)
          if (entries(i, j) != 0)
            neighbours.insert(group_of[j]);
      m.neighbour.insert(m.neighbour.end(), neighbours.begin(), neighbours.end());
      m.row.push_back(m.neighbour.size());
    }
    m.block = [this](const GroupedMatrix &of_groups, int group, std::size_t e, double *values) {
      for (const int i : of(group))
        for (const int j : of(of_groups.neighbour[e]))
          *values++ = entries(i, j);
    };
    return m;
  }

  std::vector<int> of(int group) const {
    std::vector<int> variables;
    for (int v = 0; v < static_cast<int>(group_of.size()); ++v)
      if (group_of[v] == group)
        variables.push_back(v);
    return variables;
  }

  std::vector<int> variables(bool are_kept) const {
    std::vector<int> some;
    for (int v = 0; v < static_cast<int>(group_of.size()); ++v)
      if ((group_of[v] >= groups - kept) == are_kept)
        some.push_back(v);
    return some;
  }
};

/// Groups of 1 to 5 variables, each of either sign, numbered at random; `links` between two of
/// them. Entries between variables of different signs may have any size.
Example random_example(std::mt19937 &random, int groups, int kept, double links) {
  std::uniform_real_distribution<double> value(-1, 1), chance(0, 1);
  Example made;
  made.groups = groups;
  made.kept = kept;
  for (int g = 0; g < groups; ++g)
    made.group_of.insert(made.group_of.end(), std::uniform_int_distribution<int>(1, 5)(random), g);
  std::shuffle(made.group_of.begin(), made.group_of.end(), random);
  const auto n = static_cast<Index>(made.group_of.size());
  std::vector<double> sign(n);
  for (double &s : sign)
    s = chance(random) < 0.6 ? 1 : -1;
  MatrixXd linked = MatrixXd::Identity(groups, groups);
  for (int g = 0; g < groups; ++g)
    for (int h = 0; h < g; ++h)
      linked(g, h) = linked(h, g) = chance(random) < links;
  made.entries = MatrixXd::Zero(n, n);
  for (Index i = 0; i < n; ++i) {
    for (Index j = 0; j < i; ++j)
      if (linked(made.group_of[i], made.group_of[j]) != 0)
        made.entries(i, j) = made.entries(j, i) =
            value(random) * (sign[i] == sign[j] ? 1. / static_cast<double>(n) : 3);
    made.entries(i, i) = sign[i] * (1 + chance(random));
  }
  return made;
}

MatrixXd part(const MatrixXd &of, const std::vector<int> &rows, const std::vector<int> &columns) {
  return of(rows, columns);
}

void expect_solution(const Example &example, int threads = 1) {
  const std::vector<int> inside = example.variables(false), kept = example.variables(true);
  Multifrontal factor(example.matrix(), kept, threads);
  const MatrixXd &k = example.entries;
  const auto n = static_cast<Index>(kept.size());
  const MatrixXd eliminated =
      inside.empty() ? MatrixXd::Zero(n, n)
                     : MatrixXd(part(k, kept, inside) *
                                part(k, inside, inside).fullPivLu().solve(part(k, inside, kept)));
  const MatrixXd schur = part(k, kept, kept) - eliminated;
  const Eigen::Map<const MatrixXd> found(factor.schur_complement().data(), n, n);
  if (n > 0) {
    EXPECT_LT((found - schur).cwiseAbs().maxCoeff(), 1e-11 * schur.cwiseAbs().maxCoeff());
  }

  const VectorXd c = VectorXd::LinSpaced(n, -1, 2), wanted = VectorXd::Random(k.rows());
  const VectorXd b = k * wanted;
  std::vector<double> right_side(b.begin(), b.end());
  const std::vector<double> reduced = factor.reduce(right_side);
  VectorXd x_c = VectorXd::Zero(n);
  for (Index i = 0; i < n; ++i)
    x_c[i] = wanted[kept[static_cast<std::size_t>(i)]];
  if (n > 0) {
    EXPECT_LT((schur * x_c - Eigen::Map<const VectorXd>(reduced.data(), n)).norm(),
              1e-9 * b.norm());
  }
  factor.expand(std::vector<double>(x_c.begin(), x_c.end()));
  EXPECT_LT((Eigen::Map<const VectorXd>(right_side.data(), k.rows()) - wanted).norm(),
            1e-9 * wanted.norm());
}

TEST(Multifrontal, SolvesRandomQuasiDefiniteMatricesOnRandomGraphsAndHasTheirSchurComplement) {
  std::mt19937 random(1);
  for (int k = 0; k < 300; ++k) {
    const int groups = std::uniform_int_distribution<int>(1, 40)(random);
    const int kept = std::uniform_int_distribution<int>(0, groups)(random);
    const double links = std::uniform_real_distribution<double>(0, 0.3)(random);
    SCOPED_TRACE(k);
    expect_solution(random_example(random, groups, kept, links));
  }
}

TEST(Multifrontal, SolvesWhereNothingIsKeptAllIsKeptNothingIsLinkedOrAllIs) {
  std::mt19937 random(2);
  for (const int kept : {0, 7, 30})
    for (const double links : {0., 1.})
      expect_solution(random_example(random, 30, kept, links));
  expect_solution(random_example(random, 1, 0, 0));
  expect_solution(random_example(random, 1, 1, 0));
}

using Place = Eigen::Vector2i;

// The places of a rectangle, those of each half before those of the line between them.
void dissect(const Place &from, const Place &to, std::vector<Place> &places) {
  const Place size = to - from;
  if (size.minCoeff() <= 0)
    return;
  if (size.maxCoeff() == 1)
    return places.push_back(from);
  const int across = size[0] < size[1];
  Place end = to, line = from, line_end = to, behind = from;
  end[across] = line[across] = from[across] + size[across] / 2;
  line_end[across] = behind[across] = line[across] + 1;
  dissect(from, end, places);
  dissect(behind, to, places);
  dissect(line, line_end, places);
}

// A square of nodes with four variables each, one side of which is kept.
Example square(int n) {
  std::vector<Place> places;
  dissect({0, 0}, {n, n - 1}, places);
  dissect({0, n - 1}, {n, n}, places);
  Example made;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> value(-1, 1);
  made.groups = n * n;
  made.kept = n;
  for (int g = 0; g < n * n; ++g)
    made.group_of.insert(made.group_of.end(), 4, g);
  made.entries = MatrixXd::Zero(4 * n * n, 4 * n * n);
  for (int g = 0; g < n * n; ++g)
    for (int h = g; h < n * n; ++h)
      if ((places[g] - places[h]).cwiseAbs().maxCoeff() <= 1)
        for (int i = 0; i < 4; ++i)
          for (int j = 0; j < 4; ++j)
            made.entries(4 * g + i, 4 * h + j) = made.entries(4 * h + j, 4 * g + i) =
                value(random) * ((i < 2) == (j < 2) ? 0.1 : 1);
  for (int v = 0; v < 4 * n * n; ++v)
    made.entries(v, v) = v % 4 < 2 ? 2 : -2;
  return made;
}

TEST(Multifrontal, GivesTheSameBitsForAnyNumberOfThreads) {
  const Example example = square(16);
  const std::vector<int> kept = example.variables(true);
  std::vector<std::vector<double>> solutions, complements;
  for (const int threads : {1, 2, 3, 8}) {
    Multifrontal factor(example.matrix(), kept, threads);
    EXPECT_TRUE(threads == 1 || factor.statistics().subtrees >= threads);
    std::vector<double> x(example.entries.rows());
    std::iota(x.begin(), x.end(), 1.);
    factor.expand(factor.reduce(x));
    solutions.push_back(x);
    complements.push_back(factor.schur_complement());
  }
  for (std::size_t i = 1; i < solutions.size(); ++i) {
    EXPECT_EQ(solutions[i], solutions[0]);
    EXPECT_EQ(complements[i], complements[0]);
  }
  expect_solution(example, 2);
}

TEST(Multifrontal, CountsTheNegativePivotsAndTheEntriesOfItsFactor) {
  const Example example = square(12);
  const Multifrontal factor(example.matrix(), example.variables(true), 1);
  EXPECT_EQ(factor.statistics().negative_pivots, 12 * 11 * 2);
  EXPECT_GT(factor.statistics().factor_entries, 12 * 11 * 4 * 5 / 2);
  EXPECT_LE(factor.statistics().factor_entries, 12 * 11 * 4 * (12 * 12 * 4));
  EXPECT_GT(factor.statistics().flops, 0);
}

void expect_weak(Example example, int variable) {
  try {
    Multifrontal factor(example.matrix(), example.variables(true), 1);
    FAIL() << "nothing was found";
  } catch (const WeakPivot &weak) {
    EXPECT_EQ(weak.variable, variable);
  }
}

TEST(Multifrontal, NamesTheVariableWhosePivotHasTheWrongSignOrNoDigit) {
  Example pair;
  pair.group_of = {0, 1};
  pair.groups = 2;
  for (const double corner : {0.5, 1., 1 + 1e-16, std::numeric_limits<double>::quiet_NaN()}) {
    pair.entries = MatrixXd{{1., 1.}, {1., corner}};
    expect_weak(pair, 1);
    pair.entries *= -1;
    expect_weak(pair, 1);
  }
  pair.entries = MatrixXd{{0., 0.}, {0., 1.}};
  expect_weak(pair, 0);
}

TEST(Trapezoid, HasItsPanelsOneAfterAnotherAndEachEntryOnce) {
  for (const auto &[height, columns] :
       {std::pair{5, 3}, {200, 200}, {300, 130}, {1100, 300}, {2100, 600}}) {
    const Trapezoid shape = Trapezoid::at(nullptr, height, columns);
    std::vector<double> room(shape.size(), 0.);
    const Trapezoid all = Trapezoid::at(room.data(), height, columns);
    for (int j = 0; j < columns; ++j)
      for (int i = j; i < height; ++i)
        ++*all.at(i, j);
    EXPECT_EQ(*std::max_element(room.begin(), room.end()), 1);
    EXPECT_EQ(all.at(height - 1, columns - 1), &room.back());
  }
}

TEST(Trapezoid, IsTheSameInBroadPanels) {
  for (const auto &[height, columns] : {std::pair{7, 3}, {700, 530}, {1100, 300}}) {
    std::vector<double> broad_room(Trapezoid::broad(nullptr, height, columns).size()),
        room(Trapezoid::at(nullptr, height, columns).size());
    const Trapezoid broad = Trapezoid::broad(broad_room.data(), height, columns),
                    narrow = Trapezoid::at(room.data(), height, columns);
    for (int j = 0; j < columns; ++j)
      for (int i = j; i < height; ++i)
        *broad.at(i, j) = j * height + i;
    broad.copy_to(narrow);
    for (int j = 0; j < columns; ++j)
      for (int i = j; i < height; ++i)
        ASSERT_EQ(*narrow.at(i, j), j * height + i);
  }
}

// L, whose columns are taken one by one, by strips of all widths, or one panel by strips and the
// next one by one, and whose rows one task or several take.
TEST(Trapezoid, SubstitutionsAreThoseOfItsColumns) {
  using Sizes = std::initializer_list<std::pair<int, int>>;
  parallel::Team team(2);
  for (const auto &[height, columns] : Sizes{{1, 1},
                                             {7, 3},
                                             {8, 8},
                                             {13, 12},
                                             {70, 66},
                                             {40, 23},
                                             {1024, 40},
                                             {1100, 300},
                                             {2100, 600},
                                             {4103, 9},
                                             {9000, 67}}) {
    const Trapezoid shape = Trapezoid::at(nullptr, height, columns);
    std::vector<double> room(shape.size());
    const Trapezoid l = Trapezoid::at(room.data(), height, columns);
    MatrixXd dense = MatrixXd::Random(height, columns);
    for (int j = 0; j < columns; ++j) {
      dense(j, j) += 3;
      for (int i = j; i < height; ++i)
        *l.at(i, j) = dense(i, j);
    }
    const auto top = dense.topRows(columns).triangularView<Eigen::Lower>();
    const MatrixXd below = dense.bottomRows(height - columns);
    const VectorXd given = VectorXd::Random(height);
    VectorXd expected = given, x = given;
    top.solveInPlace(expected.head(columns));
    expected.tail(height - columns) -= below * expected.head(columns);
    substitute_forward(l, x.data(), team);
    EXPECT_LE((x - expected).cwiseAbs().maxCoeff(), 1e-13 * expected.cwiseAbs().maxCoeff())
        << height << ' ' << columns;
    expected = x = given;
    expected.head(columns) -= below.transpose() * expected.tail(height - columns);
    top.transpose().solveInPlace(expected.head(columns));
    substitute_backward(l, x.data(), team);
    EXPECT_LE((x - expected).cwiseAbs().maxCoeff(), 1e-13 * expected.cwiseAbs().maxCoeff())
        << height << ' ' << columns;
  }
}

// Fronts that are so high are worked on by all threads at once, in tiles.
using Panels = Trapezoid(double *data, int height, int columns);
void expect_same_bits(int height, int columns, int positive, Panels &panels) {
  const int below = height - columns;
  const MatrixXd some = MatrixXd::Random(height, 40);
  MatrixXd front = some * some.transpose() / 200;
  front.diagonal().array() += 2;
  front.bottomRightCorner(height - positive, height - positive) *= -1;
  std::vector<std::vector<double>> results;
  for (const int threads : {1, 2, 5}) {
    const std::size_t of_l = panels(nullptr, height, columns).size();
    std::vector<double> room(of_l + Trapezoid::broad(nullptr, below, below).size());
    const Trapezoid l = panels(room.data(), height, columns),
                    rest = Trapezoid::broad(room.data() + of_l, below, below);
    for (int j = 0; j < height; ++j)
      for (int i = j; i < height; ++i)
        *(j < columns ? l.at(i, j) : rest.at(i - columns, j - columns)) = front(i, j);
    parallel::Team team(threads);
    EXPECT_EQ(factorise(l, rest, positive, team), -1);
    std::vector<double> x(5000 + height, 1.);
    substitute_forward(l, x.data(), team);
    substitute_backward(l, x.data(), team);
    room.insert(room.end(), x.begin(), x.end());
    results.push_back(std::move(room));
  }
  EXPECT_EQ(results[1], results[0]);
  EXPECT_EQ(results[2], results[0]);
  // What is left is the Schur complement.
  const MatrixXd schur =
      front.bottomRightCorner(below, below) -
      front.bottomLeftCorner(below, columns) *
          front.topLeftCorner(columns, columns).lu().solve(front.topRightCorner(columns, below));
  const double size = schur.cwiseAbs().maxCoeff();
  const std::size_t of_l = panels(nullptr, height, columns).size();
  const Trapezoid rest = Trapezoid::broad(results[0].data() + of_l, below, below);
  for (int j = 0; j < below; j += 97)
    for (int i = j; i < below; i += 13)
      EXPECT_NEAR(*rest.at(i, j), schur(i, j), 1e-12 * size);
}

TEST(Trapezoid, HasTheSameBitsForAnyNumberOfThreads) {
  expect_same_bits(1000, 700, 400, Trapezoid::broad);
  expect_same_bits(1300, 300, 170, Trapezoid::at);
  expect_same_bits(2600, 500, 230, Trapezoid::at);
}

}  // namespace
}  // namespace tourmaline::condensation
