#pragma once

#include <Eigen/Dense>
#include <cmath>
#include <random>
#include <utility>

namespace tourmaline::verified {

/// The same numbers from a seed with every standard library.
class Random {
 public:
  explicit Random(unsigned int seed) : engine_(seed) {}

  double between(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53;
  }
  int below(int n) { return static_cast<int>(engine_() % static_cast<unsigned int>(n)); }
  bool chance(double probability) { return between(0, 1) < probability; }
  /// Of random size between the two, by ratio.
  double sized(double low, double high) { return low * std::pow(high / low, between(0, 1)); }
  /// Entries between -1 and 1.
  Eigen::MatrixXd matrix(Eigen::Index rows, Eigen::Index columns) {
    Eigen::MatrixXd all(rows, columns);
    for (double &entry : all.reshaped())
      entry = between(-1, 1);
    return all;
  }
  template <class List>
  void shuffle(List &list) {
    for (std::size_t i = list.size(); i > 1; --i)
      std::swap(list[i - 1], list[static_cast<std::size_t>(below(static_cast<int>(i)))]);
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace tourmaline::verified
