#pragma once

#include <Eigen/Dense>
#include <array>
#include <span>

#include "body/fields.h"
#include "material/plane.h"

namespace tourmaline::body {

/// The parts of the stored energy [J], in 2D [J/m]: 1/2 int F eps.eps, 1/2 int beta E.E,
/// 1/2 int alpha theta^2, int P.E theta.
struct Energies {
  double elastic = 0, electric = 0, thermal = 0, coupling = 0;

  double sum() const { return elastic + electric + thermal + coupling; }
};

/// The incompatible modes of one linear quadrilateral or hexahedron: in each direction of the cell
/// a bubble 1 - xi_m^2, for every component of u and for phi. Amplitudes stand u first, mode by
/// mode, then phi. Temperature has none, since a mode of theta would have a memory.
///
/// All of them are determined by the state of the cell's nodes at the same time, a = response x:
/// their rows of the storage operator vanish (Gauss's law and equilibrium, tested with the modes).
template <int dim>
struct CellModes {
  static constexpr int n_nodes = 1 << dim, n_unknowns = n_nodes * Fields<dim>::count;
  static constexpr int n_displacement = dim * dim, n_amplitudes = n_displacement + dim;
  using Amplitudes = Eigen::Matrix<double, n_amplitudes, 1>;
  using Stiffness = Eigen::Matrix<double, n_amplitudes, n_amplitudes>;
  using Coupling = Eigen::Matrix<double, n_amplitudes, n_unknowns>;

  /// The storage operator between the amplitudes, K_aa, and between them and the nodes' unknowns,
  /// K_ax. `cell` has its mode gradients.
  struct Blocks {
    Blocks(const Quadrature<dim> &cell, const material::BodyConstants<dim> &material);
    Stiffness stiffness = Stiffness::Zero();
    Coupling coupling = Coupling::Zero();
  };

  CellModes(const Quadrature<dim> &cell, const Blocks &blocks);

  /// This cell's share of `Operator::energy_shift`; x is a state of the whole body.
  Energies energy_shift(std::span<const double> x) const;

  std::array<Node, n_nodes> nodes;
  Stiffness stiffness;  ///< K_aa
  Coupling response;    ///< -K_aa^-1 K_ax
};

}  // namespace tourmaline::body
