#pragma once

#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "contact/laws.h"
#include "solve/model.h"

namespace tourmaline::solve {

/// Which named boundary what passes the surface of the body is booked for: of prescribed values and
/// loads that of the case, of the contact's nodes the first one of their contact that they are on.
template <int dim>
class BoundaryBook {
 public:
  /// `model` outlives this.
  explicit BoundaryBook(const Model<dim> &model);

  /// Steps of another size, or coefficients that follow it, are the model's now.
  void weigh();

  /// Those that have a column of history.csv, in its order.
  const std::vector<std::string> &of_heats() const { return heats_; }
  const std::vector<std::string> &of_charges() const { return charges_; }

  /// Of interface node i, for what crosses there by the contact's state; empty: nothing does so.
  const std::string &of_heat(std::size_t i) const { return of_heat_[i]; }
  const std::string &of_charge(std::size_t i) const { return of_charge_[i]; }
  const std::string &of_force(std::size_t i) const { return of_force_[i]; }

  /// What crosses a boundary by place alone: k_c theta [W], c phi [C].
  double heat_exchanged(const std::string &boundary, std::span<const double> state) const;
  double charge_held(const std::string &boundary, std::span<const double> state) const;

 private:
  // By boundary, the integral of k_c N_i, of c N_i.
  using Weights = std::map<std::string, std::vector<std::pair<body::Node, double>>>;

  void find_boundaries();
  void find_crossings(contact::Crossing what);
  void find_forces();
  static double sum(const Weights &weights, int component, const std::string &boundary,
                    std::span<const double> state);

  const Model<dim> &model_;
  std::vector<std::string> heats_, charges_;
  std::vector<std::string> of_heat_, of_charge_, of_force_;  // by interface node
  Weights exchange_, capacitors_;
};

}  // namespace tourmaline::solve
