#pragma once

#include <Eigen/Core>
#include <map>

#include "richer_paper.h"

namespace tourmaline::verified {

/// How the tables of a case follow from those of another: places and displacements by `turn` (a
/// signed permutation), then `shift`; numbers by the ratios of units.
struct Image {
  Eigen::Matrix2d turn = Eigen::Matrix2d::Identity();
  Eigen::Vector2d shift = Eigen::Vector2d::Zero();
  double potential = 1, length = 1, stress = 1, heat_flux = 1;

  Eigen::Vector2d place(double x, double y) const {
    return length * (turn * Eigen::Vector2d(x, y)) + shift;
  }
};

struct Column {
  std::string original, image;
  double factor;
};
/// Components that are measured by the largest of them.
using Quantity = std::vector<Column>;

inline Quantity vector_quantity(const Image &image, const std::string &name, double factor) {
  Quantity quantity;
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j)
      if (image.turn(i, j) != 0)
        quantity.push_back({name + "xy"[j], name + "xy"[i], factor * image.turn(i, j)});
  return quantity;
}

inline std::vector<Quantity> of_nodes(const Image &image) {
  return {vector_quantity(image, "u_", image.length),
          {{"potential", "potential", image.potential}},
          {{"temperature", "temperature", 1}}};
}

inline std::vector<Quantity> of_contact(const Image &image) {
  return {vector_quantity(image, "tangential_traction_", image.stress),
          {{"normal_traction", "normal_traction", image.stress}},
          vector_quantity(image, "slip_", image.length),
          {{"slip_rate", "slip_rate", image.length}},
          {{"potential", "potential", image.potential}},
          {{"temperature", "temperature", 1}},
          {{"heat_flux", "heat_flux", image.heat_flux}}};
}

inline std::vector<std::size_t> rows_of_step(const Table &table, const std::string &step) {
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < table.n_rows(); ++i)
    if (step.empty() || table.columns.at("step")[i] == step)
      rows.push_back(i);
  return rows;
}

/// Row of `other` at the image of each row's place, by the least distance; each row is met once.
inline std::map<std::size_t, std::size_t> partners(const Table &table, const Table &other,
                                                   const Image &image, const std::string &step) {
  const std::vector<double> x = table.numbers("x"), y = table.numbers("y"),
                            to_x = other.numbers("x"), to_y = other.numbers("y");
  std::map<std::size_t, std::size_t> partner;
  std::vector<std::size_t> candidates = rows_of_step(other, step);
  for (const std::size_t i : rows_of_step(table, step)) {
    const Eigen::Vector2d place = image.place(x[i], y[i]);
    const auto distance = [&](std::size_t j) {
      return std::hypot(to_x[j] - place.x(), to_y[j] - place.y());
    };
    const auto nearest =
        std::min_element(candidates.begin(), candidates.end(),
                         [&](std::size_t a, std::size_t b) { return distance(a) < distance(b); });
    partner[i] = *nearest;
    candidates.erase(nearest);
  }
  return partner;
}

inline void expect_image(const Table &table, const Table &other, const Image &image,
                         const std::vector<Quantity> &quantities, const std::string &step,
                         double tolerance) {
  const auto partner = partners(table, other, image, step);
  for (const Quantity &quantity : quantities) {
    double size = 0, worst = 0;
    for (const Column &column : quantity) {
      const std::vector<double> from = table.numbers(column.original),
                                to = other.numbers(column.image);
      for (const auto &[i, j] : partner) {
        size = std::max(size, std::abs(column.factor * from[i]));
        worst = std::max(worst, std::abs(to[j] - column.factor * from[i]));
      }
    }
    EXPECT_LE(worst, tolerance * size) << quantity.front().original << " " << step;
  }
}

/// The second case is the image of the first one in all nodes and in steps 1, 5 and 10 of the
/// contact, where some stick and others slip.
inline void expect_image(const RunCase &run, const RunCase &other, const Image &image,
                         double tolerance = round_off) {
  expect_image(run.nodes(), other.nodes(), image, of_nodes(image), "", tolerance);
  const Table contact = run.contact(), other_contact = other.contact();
  ASSERT_TRUE(sticks_and_slips(contact.columns.at("status")));
  for (const std::string step : {"1", "5", "10"}) {
    expect_image(contact, other_contact, image, of_contact(image), step, tolerance);
    for (const auto &[i, j] : partners(contact, other_contact, image, step))
      EXPECT_EQ(contact.columns.at("status")[i], other_contact.columns.at("status")[j]);
  }
}

}  // namespace tourmaline::verified
