#pragma once

#include <Eigen/Dense>
#include <array>
#include <functional>
#include <limits>
#include <map>
#include <span>
#include <vector>

#include "body/regional_nodes.h"
#include "material/composition.h"
#include "output/records.h"

namespace tourmaline::body {

/// Stresses at the nodes by superconvergent patch recovery (Zienkiewicz and Zhu 1992), inside each
/// region. The patch of a corner are the cells of one region around it. A polynomial of the degree
/// of the shape functions is fitted to (1) at the patch's sampling points by least squares; a node
/// takes the polynomials of the corners of a cell with their shares in it. A corner that its
/// samples do not surround, as on the boundary, takes those of its neighbours; where there is no
/// such neighbour, as in a layer of one cell, its own with as many terms as the samples determine.
///
/// Linear stresses come out exactly where the sampled ones are exact.
template <int dim>
class Recovery {
 public:
  /// The geometry, once for all states. All ranks make it together.
  explicit Recovery(const Discretisation<dim> &body);

  /// Stress [Pa] by regional node; those that this rank's cells do not have are 0. `means` are
  /// those of this rank's cells (`derived_fields`): of a linear cell the value in its centre.
  std::vector<output::SymmetricTensor> operator()(
      const material::Composition<dim> &composition, std::span<const double> state,
      std::span<const output::SymmetricTensor> means) const;
  const RegionalNodes &nodes() const { return nodes_; }

 private:
  using Place = std::array<double, 3>;
  using Neighbours = std::map<Node, std::vector<Node>>;  // by patch
  static constexpr auto none = std::numeric_limits<std::uint32_t>::max();
  static constexpr int most_terms = 1 + dim + dim * (dim + 1) / 2;
  using Powers = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, most_terms, 1>;
  using Coefficients = Eigen::Matrix<double, Eigen::Dynamic, 6, Eigen::RowMajor, most_terms, 6>;

  /// Places are measured from the mean of the patch's sampling points, in its extent along each
  /// axis [m].
  struct Patch {
    Place centre{}, extent{};
    bool surrounds = false;  ///< its corner
  };

  /// Of all ranks' patches those at this rank's cells: by corner of these, and whether one is.
  struct PatchesHere {
    std::vector<Node> by_corner;
    std::vector<bool> touched;
  };

  PatchesHere number_patches() const;
  void share_patches(const PatchesHere &here, const std::vector<Node> &known);
  void fit();
  void measure_patches();
  void solve_normal_equations();
  void find_neighbours(const PatchesHere &here);
  std::vector<std::uint32_t> pairs_with_neighbours(bool second, const Neighbours &first) const;
  void know(const PatchesHere &here, const Neighbours &all);
  Powers powers(std::uint32_t patch, const Place &place) const;
  Eigen::Map<const Eigen::MatrixXd> inverse(std::uint32_t patch) const;
  std::span<const std::uint32_t> patches_of(std::size_t cell) const;
  std::span<const Place> samples_of(std::size_t cell) const;
  void for_each_sample(
      const std::function<void(std::uint32_t patch, const Place &place)> &visit) const;
  std::vector<output::SymmetricTensor> sampled(const material::Composition<dim> &composition,
                                               std::span<const double> state) const;
  std::vector<double> coefficients(std::span<const output::SymmetricTensor> stress) const;
  void add_value(std::uint32_t patch, const Place &place, double share,
                 std::span<const double> coefficients, output::SymmetricTensor &to) const;
  void add_own_value(std::uint32_t patch, const Place &place, double share,
                     std::span<const double> coefficients, output::SymmetricTensor &to) const;

  const Discretisation<dim> &body_;
  RegionalNodes nodes_;
  std::vector<std::vector<double>> shares_;  // of the corners in each node of a cell
  Eigen::Index terms_;                       // of a polynomial: constant, linear, quadratic ones
  std::vector<Place> centres_, samples_;     // of this rank's cells
  std::vector<std::uint32_t> numbers_;       // regional nodes of this rank's cells
  // Patches are shared out as nodes are: a rank has those of its cells' corners and those that all
  // know, as they serve corners that their samples do not surround.
  NodeSharing sharing_;
  std::vector<std::uint32_t> patch_of_;   // patches of this rank's cells, by corner
  std::vector<std::uint32_t> corner_of_;  // regional node of each patch; none: not at its cells
  std::vector<Patch> patches_;
  std::vector<double> inverses_;  // of the patches' normal equations
  Neighbours neighbours_;         // of those whose samples do not surround their corner
};

}  // namespace tourmaline::body
