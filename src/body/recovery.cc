#include "body/recovery.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "dense/decompositions.h"
#include "gradients.h"
#include "parallel/ranks.h"

namespace tourmaline::body {

namespace {

constexpr std::size_t components = 6;

/// 1, x, y, (z), then x x, x y, y y, ... as far as `terms` goes.
template <class Powers>
Powers monomials(int dim, Eigen::Index terms, const std::array<double, 3> &x) {
  Powers p(terms);
  Eigen::Index next = 0;
  p[next++] = 1;
  for (int i = 0; i < dim; ++i)
    p[next++] = x[i];
  for (int i = 0; i < dim && next < terms; ++i)
    for (int j = i; j < dim; ++j)
      p[next++] = x[i] * x[j];
  return p;
}

/// The inverse of what is determined, 0 on the rest: the least of all solutions.
Eigen::MatrixXd pseudo_inverse(const Eigen::MatrixXd &normal) {
  const auto [values, vectors] = dense::spectrum(normal);
  Eigen::VectorXd inverse = Eigen::VectorXd::Zero(values.size());
  for (Eigen::Index i = 0; i < values.size(); ++i)
    if (values[i] > 1e-11 * values[values.size() - 1])
      inverse[i] = 1 / values[i];
  return vectors * inverse.asDiagonal() * vectors.transpose();
}

bool is_regular(const Eigen::LDLT<Eigen::MatrixXd> &factor) {
  const auto d = factor.vectorD();
  return factor.info() == Eigen::Success && d.minCoeff() > 1e-11 * d.maxCoeff();
}

/// Sum of the squares of the samples' weights in the value at a corner: below 1 the value is surer
/// than one sample's, as the samples stand around the corner. No small fraction, so that round-off
/// does not decide on regular meshes.
constexpr double greatest_uncertainty = 0.87;

}  // namespace

template <int dim>
Recovery<dim>::Recovery(const Discretisation<dim> &body)
    : body_(body), nodes_(body), shares_(body.corner_shares()) {
  const bool linear = shares_.size() == shares_.front().size();
  terms_ = linear ? 1 + dim : 1 + dim + dim * (dim + 1) / 2;
  body.for_each_cell([&](const Quadrature<dim> &cell) {
    centres_.push_back(cell.centre());
    for (const Node node : cell.nodes)
      numbers_.push_back(nodes_.number(node, cell.region));
  });
  if (linear)
    samples_ = centres_;
  else
    body.for_each_cell_sampled([&](const Quadrature<dim> &cell) {
      samples_.insert(samples_.end(), cell.points.begin(), cell.points.end());
    });
  const PatchesHere here = number_patches();
  share_patches(here, {});
  fit();
  find_neighbours(here);
}

// Of all corners of all ranks' cells, in the order of their regional nodes in the whole body.
template <int dim>
typename Recovery<dim>::PatchesHere Recovery<dim>::number_patches() const {
  const std::size_t n_corners = shares_.front().size(), n_nodes = shares_.size();
  std::vector<double> is_corner(nodes_.size_of_whole(), 0);
  for (std::size_t i = 0; i < numbers_.size(); ++i)
    if (i % n_nodes < n_corners)
      is_corner[nodes_.number_in_whole(numbers_[i])] = 1;
  parallel::largest(is_corner);
  std::vector<Node> patch(is_corner.size());
  Node n_patches = 0;
  for (std::size_t i = 0; i < is_corner.size(); ++i)
    patch[i] = is_corner[i] > 0 ? n_patches++ : 0;
  PatchesHere here{{}, std::vector<bool>(n_patches, false)};
  for (std::size_t i = 0; i < numbers_.size(); ++i)
    if (i % n_nodes < n_corners) {
      here.by_corner.push_back(patch[nodes_.number_in_whole(numbers_[i])]);
      here.touched[here.by_corner.back()] = true;
    }
  return here;
}

template <int dim>
void Recovery<dim>::share_patches(const PatchesHere &here, const std::vector<Node> &known) {
  const NodeSharing whole(here.touched);
  sharing_ = body_.sharing().is_whole() ? whole : NodeSharing(whole, here.touched, known);
  patches_.assign(sharing_.n_nodes(), {});
  corner_of_.assign(sharing_.n_nodes(), none);
  patch_of_.clear();
  const std::size_t n_corners = shares_.front().size(), n_nodes = shares_.size();
  for (std::size_t i = 0; i < here.by_corner.size(); ++i) {
    patch_of_.push_back(*sharing_.node(here.by_corner[i]));
    corner_of_[patch_of_.back()] = numbers_[i / n_corners * n_nodes + i % n_corners];
  }
}

template <int dim>
void Recovery<dim>::fit() {
  measure_patches();
  solve_normal_equations();
}

template <int dim>
std::span<const std::uint32_t> Recovery<dim>::patches_of(std::size_t cell) const {
  const std::size_t n = shares_.front().size();
  return std::span(patch_of_).subspan(cell * n, n);
}

template <int dim>
std::span<const std::array<double, 3>> Recovery<dim>::samples_of(std::size_t cell) const {
  const std::size_t n = centres_.empty() ? 0 : samples_.size() / centres_.size();
  return std::span(samples_).subspan(cell * n, n);
}

template <int dim>
void Recovery<dim>::for_each_sample(
    const std::function<void(std::uint32_t patch, const Place &place)> &visit) const {
  for (std::size_t cell = 0; cell < centres_.size(); ++cell)
    for (const std::uint32_t patch : patches_of(cell))
      for (const Place &place : samples_of(cell))
        visit(patch, place);
}

template <int dim>
void Recovery<dim>::measure_patches() {
  std::vector<double> sums(4 * patches_.size(), 0), extents(3 * patches_.size(), 0);
  for_each_sample([&](std::uint32_t patch, const Place &place) {
    sums[4 * patch + 3] += 1;
    for (int axis = 0; axis < 3; ++axis)
      sums[4 * patch + axis] += place[axis];
  });
  sharing_.add_up(sums);
  for (std::size_t p = 0; p < patches_.size(); ++p)
    for (int axis = 0; axis < 3; ++axis)
      patches_[p].centre[axis] = sums[4 * p + axis] / sums[4 * p + 3];
  for_each_sample([&](std::uint32_t patch, const Place &place) {
    for (int axis = 0; axis < 3; ++axis)
      extents[3 * patch + axis] =
          std::max(extents[3 * patch + axis], std::abs(place[axis] - patches_[patch].centre[axis]));
  });
  sharing_.find_largest(extents);
  // Along an axis in which samples differ by round-off only nothing is determined.
  for (std::size_t p = 0; p < patches_.size(); ++p) {
    const double most = std::max({extents[3 * p], extents[3 * p + 1], extents[3 * p + 2], 1e-300});
    for (int axis = 0; axis < 3; ++axis)
      patches_[p].extent[axis] = extents[3 * p + axis] > 1e-9 * most ? extents[3 * p + axis] : most;
  }
}

template <int dim>
typename Recovery<dim>::Powers Recovery<dim>::powers(std::uint32_t patch,
                                                     const Place &place) const {
  const Patch &at = patches_[patch];
  Place scaled;
  for (int axis = 0; axis < 3; ++axis)
    scaled[axis] = (place[axis] - at.centre[axis]) / at.extent[axis];
  return monomials<Powers>(dim, terms_, scaled);
}

template <int dim>
Eigen::Map<const Eigen::MatrixXd> Recovery<dim>::inverse(std::uint32_t patch) const {
  return {&inverses_[patch * static_cast<std::size_t>(terms_ * terms_)], terms_, terms_};
}

// The normal equations of all patches, then in their place the inverses.
template <int dim>
void Recovery<dim>::solve_normal_equations() {
  const auto size = static_cast<std::size_t>(terms_ * terms_);
  inverses_.assign(patches_.size() * size, 0);
  const auto matrix = [&](std::uint32_t patch) {
    return Eigen::Map<Eigen::MatrixXd>(&inverses_[patch * size], terms_, terms_);
  };
  for_each_sample([&](std::uint32_t patch, const Place &place) {
    const Powers p = powers(patch, place);
    matrix(patch) += p * p.transpose();
  });
  sharing_.add_up(inverses_);
  const Eigen::Index linear = dim + 1;
  for (std::uint32_t patch = 0; patch < patches_.size(); ++patch) {
    auto normal = matrix(patch);
    const Eigen::LDLT<Eigen::MatrixXd> factor(normal);
    if (is_regular(factor)) {
      normal = factor.solve(Eigen::MatrixXd::Identity(terms_, terms_)).eval();
      if (corner_of_[patch] == none)
        continue;
      const Powers p = powers(patch, body_.points()[nodes_.node(corner_of_[patch])]);
      patches_[patch].surrounds = p.dot(normal * p) < greatest_uncertainty;
    } else {
      const Eigen::MatrixXd part = pseudo_inverse(normal.topLeftCorner(linear, linear));
      normal.setZero();
      normal.topLeftCorner(linear, linear) = part;
    }
  }
}

// Of each corner that its samples do not surround, with a neighbour that has what it lacks:
// polynomials of its own (first), or, where a cell has none, of the neighbours' neighbours. By
// numbers in the whole body, of all ranks.
template <int dim>
std::vector<std::uint32_t> Recovery<dim>::pairs_with_neighbours(bool second,
                                                                const Neighbours &first) const {
  std::vector<std::uint32_t> pairs;
  for (std::size_t cell = 0; cell < centres_.size(); ++cell)
    for (const std::uint32_t patch : patches_of(cell)) {
      const Node own = sharing_.number(patch);
      if (patches_[patch].surrounds || (second && first.count(own)))
        continue;
      for (const std::uint32_t other : patches_of(cell))
        if (!second && patches_[other].surrounds)
          pairs.insert(pairs.end(), {own, sharing_.number(other)});
        else if (const auto found = first.find(sharing_.number(other));
                 second && found != first.end())
          for (const std::uint32_t farther : found->second)
            pairs.insert(pairs.end(), {own, farther});
    }
  return parallel::joined(pairs);
}

template <int dim>
void Recovery<dim>::find_neighbours(const PatchesHere &here) {
  Neighbours all;  // by numbers in the whole body
  for (const bool second : {false, true}) {
    const std::vector<std::uint32_t> pairs = pairs_with_neighbours(second, all);
    for (std::size_t i = 0; i < pairs.size(); i += 2)
      all[pairs[i]].push_back(pairs[i + 1]);
    for (auto &[patch, others] : all) {
      std::sort(others.begin(), others.end());
      others.erase(std::unique(others.begin(), others.end()), others.end());
    }
  }
  if (!sharing_.is_whole())
    know(here, all);
  for (const auto &[patch, others] : all)
    if (const auto own = sharing_.node(patch))
      neighbours_[*own] = sharing_.nodes(others);
}

// From now on every rank has all patches that serve others.
template <int dim>
void Recovery<dim>::know(const PatchesHere &here, const Neighbours &all) {
  std::set<Node> serving;
  for (const auto &[patch, others] : all)
    serving.insert(others.begin(), others.end());
  share_patches(here, {serving.begin(), serving.end()});
  fit();
}

template <int dim>
std::vector<output::SymmetricTensor> Recovery<dim>::sampled(
    const material::Composition<dim> &composition, std::span<const double> state) const {
  std::vector<output::SymmetricTensor> stress;
  stress.reserve(samples_.size());
  body_.for_each_cell_sampled([&](const Quadrature<dim> &cell) {
    const Place &centre = centres_[stress.size() / cell.points.size()];
    const material::Constants constants = composition.in_space(cell.region, centre);
    for (std::size_t q = 0; q < cell.points.size(); ++q) {
      Gradients at;
      add_gradients(cell, q, state, 1, at);
      add_strains_across(composition.plane(), constants, at);
      stress.push_back(in_file_order(stress_of(at, constants), 1));
    }
  });
  return stress;
}

template <int dim>
std::vector<double> Recovery<dim>::coefficients(
    std::span<const output::SymmetricTensor> stress) const {
  const std::size_t size = components * static_cast<std::size_t>(terms_);
  std::vector<double> sums(patches_.size() * size, 0);
  for (std::size_t cell = 0, next = 0; cell < centres_.size(); ++cell)
    for (const Place &place : samples_of(cell)) {
      const Eigen::Map<const Eigen::Matrix<double, 1, components>> row(stress[next++].data());
      for (const std::uint32_t patch : patches_of(cell))
        Eigen::Map<Coefficients>(&sums[patch * size], terms_, components) +=
            powers(patch, place).lazyProduct(row);
    }
  sharing_.add_up(sums);
  for (std::uint32_t patch = 0; patch < patches_.size(); ++patch) {
    Eigen::Map<Coefficients> of_patch(&sums[patch * size], terms_, components);
    const Coefficients right = of_patch;
    of_patch.noalias() = inverse(patch).lazyProduct(right);
  }
  return sums;
}

template <int dim>
void Recovery<dim>::add_own_value(std::uint32_t patch, const Place &place, double share,
                                  std::span<const double> coefficients,
                                  output::SymmetricTensor &to) const {
  const std::size_t size = components * static_cast<std::size_t>(terms_);
  const Eigen::Map<const Coefficients> of_patch(&coefficients[patch * size], terms_, components);
  Eigen::Map<Eigen::Matrix<double, 1, components>>(to.data()) +=
      share * powers(patch, place).transpose().lazyProduct(of_patch);
}

template <int dim>
void Recovery<dim>::add_value(std::uint32_t patch, const Place &place, double share,
                              std::span<const double> coefficients,
                              output::SymmetricTensor &to) const {
  const auto found = neighbours_.find(patch);
  if (found == neighbours_.end())
    return add_own_value(patch, place, share, coefficients, to);
  for (const std::uint32_t other : found->second)
    add_own_value(other, place, share / static_cast<double>(found->second.size()), coefficients,
                  to);
}

template <int dim>
std::vector<output::SymmetricTensor> Recovery<dim>::operator()(
    const material::Composition<dim> &composition, std::span<const double> state,
    std::span<const output::SymmetricTensor> means) const {
  const bool linear = samples_.size() == centres_.size();
  const std::vector<double> all =
      coefficients(linear ? std::vector(means.begin(), means.end()) : sampled(composition, state));
  std::vector<output::SymmetricTensor> stress(nodes_.size(), output::SymmetricTensor{});
  std::vector<bool> done(nodes_.size(), false);
  for (std::size_t i = 0; i < numbers_.size(); ++i) {
    const std::uint32_t number = numbers_[i];
    if (done[number])
      continue;
    done[number] = true;
    const std::vector<double> &shares = shares_[i % shares_.size()];
    const auto patches = patches_of(i / shares_.size());
    for (std::size_t v = 0; v < shares.size(); ++v)
      if (shares[v] > 1e-12)
        add_value(patches[v], body_.points()[nodes_.node(number)], shares[v], all, stress[number]);
  }
  return stress;
}

template class Recovery<2>;
template class Recovery<3>;

}  // namespace tourmaline::body
