#include "body/cell_modes.h"

#include <algorithm>

#include "cell_block.h"

namespace tourmaline::body {

namespace {

// Adds a block between mode m and a node, or between modes m and k, without the row (and column)
// of theta, which modes do not have. `column` is where the block's columns stand.
template <int dim, class Rows>
void add_rows(const NodeBlock<dim> &block, int m, Rows &&rows, int column, int n_columns) {
  rows.block(dim * m, column, dim, n_columns) += block.topLeftCorner(dim, n_columns);
  rows.row(dim * dim + m).segment(column, n_columns) += block.row(dim).head(n_columns);
}

template <int dim>
void add_between_modes(const NodeBlock<dim> &block, int m, int k,
                       typename CellModes<dim>::Stiffness &stiffness) {
  constexpr int phi = dim * dim;
  stiffness.template block<dim, dim>(dim * m, dim * k) += block.template topLeftCorner<dim, dim>();
  stiffness.template block<dim, 1>(dim * m, phi + k) += block.template block<dim, 1>(0, dim);
  stiffness.template block<1, dim>(phi + m, dim * k) += block.template block<1, dim>(dim, 0);
  stiffness(phi + m, phi + k) += block(dim, dim);
}

}  // namespace

template <int dim>
CellModes<dim>::Blocks::Blocks(const Quadrature<dim> &cell,
                               const material::BodyConstants<dim> &material) {
  constexpr int n = Fields<dim>::count;
  std::array<Trial<dim>, dim> modes;
  for (std::size_t q = 0; q < cell.jxw.size(); ++q) {
    const double jxw = cell.jxw[q];
    for (int m = 0; m < dim; ++m)
      modes[m] = trial<dim>(material, cell.mode_gradients[q * dim + m], cell.mode_around(q, m));
    for (int m = 0; m < dim; ++m) {
      for (int k = 0; k < dim; ++k) {
        NodeBlock<dim> block = NodeBlock<dim>::Zero();
        add_block<dim>(modes[m], modes[k], 0, {jxw, 0, 0, 0}, block);
        add_between_modes<dim>(block, m, k, stiffness);
      }
      for (int b = 0; b < n_nodes; ++b) {
        NodeBlock<dim> block = NodeBlock<dim>::Zero();
        add_block<dim>(modes[m], trial<dim>(material, cell.gradient(q, b), cell.around(q, b)), 0,
                       {jxw, 0, jxw * cell.value(q, b), 0}, block);
        add_rows<dim>(block, m, coupling, n * b, n);
      }
    }
  }
}

template <int dim>
CellModes<dim>::CellModes(const Quadrature<dim> &cell, const Blocks &blocks)
    : stiffness(blocks.stiffness),
      response(-blocks.stiffness.partialPivLu().solve(blocks.coupling)) {
  std::copy(cell.nodes.begin(), cell.nodes.end(), nodes.begin());
}

// With the amplitudes a = a_u + a_phi + a_theta that each field of x causes, the condensed forms
// are x_f K_fg x_g - a_f K_aa a_g, and K_ax x_f = -K_aa a_f. A field's own form is taken over its
// amplitudes as well; what these add, and what condensing took away, is the shift.
template <int dim>
Energies CellModes<dim>::energy_shift(std::span<const double> x) const {
  Amplitudes by_u = Amplitudes::Zero(), by_phi = Amplitudes::Zero(), by_theta = Amplitudes::Zero();
  for (int b = 0; b < n_nodes; ++b) {
    const Eigen::Map<const Eigen::Matrix<double, Fields<dim>::count, 1>> at(
        &x[unknown<dim>(nodes[b], 0)]);
    const auto columns = response.template middleCols<Fields<dim>::count>(Fields<dim>::count * b);
    by_u += columns.template leftCols<dim>() * at.template head<dim>();
    by_phi += columns.col(Fields<dim>::potential) * at[Fields<dim>::potential];
    by_theta += columns.col(Fields<dim>::temperature) * at[Fields<dim>::temperature];
  }
  Amplitudes u = by_u + by_phi + by_theta, phi = u;
  u.template tail<dim>().setZero();
  phi.template head<n_displacement>().setZero();
  const Amplitudes forces_u = stiffness * by_u, forces_phi = stiffness * by_phi,
                   forces_theta = stiffness * by_theta;
  return {
      .elastic = by_u.dot(forces_u) / 2 - u.dot(forces_u) + u.dot(stiffness * u) / 2,
      .electric = -by_phi.dot(forces_phi) / 2 + phi.dot(forces_phi) - phi.dot(stiffness * phi) / 2,
      .thermal = -by_theta.dot(forces_theta) / 2,
      .coupling = -by_phi.dot(forces_theta) + phi.dot(forces_theta)};
}

template struct CellModes<2>;
template struct CellModes<3>;

}  // namespace tourmaline::body
