#pragma once

#include <array>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "body/operator.h"

namespace tourmaline::body {

/// The products of `Operator`, computed cell by cell from strains and gradients instead of from
/// assembled entries. Derivatives are sums over differences of nodal values, and the first node's
/// forces are what the others' lack, so what does not change within a cell has no derivative at all
/// and each cell's forces and charges add up to zero. The error is of the order of the round-off of
/// stresses, where that of the assembled product is the round-off of |K| |x|: in a thin body or one
/// of very different constants many powers of ten larger. Slower than the assembled product, as
/// shape functions are evaluated anew.
template <int dim>
class CellProducts {
 public:
  /// `modes`: those of the operator, of all cells of this rank or none.
  CellProducts(const Discretisation<dim> &body, const material::Composition<dim> &composition,
               const std::vector<CellModes<dim>> &modes);

  /// As of `Operator`; `coefficient` outlives this object.
  void add_exchange(const std::vector<std::string> &boundaries,
                    const casefile::Formula &coefficient);
  void add_capacitors(const std::vector<std::string> &boundaries,
                      const casefile::Formula &coefficient, double factor = 1);
  void clear_capacitors() { capacitors_.clear(); }

  /// What resists rates of u is that of `op`, assembled: of it no more digits are lost than of a
  /// mass.
  void add_rate_forces(const Operator<dim> &op) { with_rates_ = &op; }

  /// As of `Operator`, all of them.
  void multiply(double step, std::span<const double> x, std::span<double> y) const;
  void multiply_by_field(std::span<const double> x, FieldProducts &products) const;
  std::vector<double> conducted(std::span<const double> x) const;
  std::vector<double> held_by_capacitors(std::span<const double> x) const;

  /// What is stored in each region of the case, of which there are so many [J].
  std::vector<Energies> stored(std::span<const double> x, std::size_t n_regions) const;

 private:
  struct Rows;
  using Constants = material::BodyConstants<dim>;
  /// Of a cell's incompatible modes, by the field that causes them.
  using CellAmplitudes = std::array<typename CellModes<dim>::Amplitudes, 3>;
  using Visit =
      std::function<void(const Quadrature<dim> &, const Constants &, const CellAmplitudes &)>;

  void for_each_cell(std::span<const double> x, const Visit &visit) const;
  void storage(std::span<const double> x, FieldProducts &products) const;
  void conduction(std::span<const double> x, std::vector<double> &taken) const;
  void storage_and_conduction(std::span<const double> x, std::span<double> y,
                              std::vector<double> &taken) const;
  struct Exchange;
  void exchange(const std::vector<Exchange> &exchanges, int component, std::span<const double> x,
                std::vector<double> &taken) const;

  const Discretisation<dim> &body_;
  const material::Composition<dim> &composition_;
  const std::vector<CellModes<dim>> &modes_;
  struct Exchange {
    std::vector<std::string> boundaries;
    const casefile::Formula *coefficient;
    double factor;
  };
  std::vector<Exchange> exchanges_, capacitors_;
  const Operator<dim> *with_rates_ = nullptr;
};

}  // namespace tourmaline::body
