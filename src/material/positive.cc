#include "material/positive.h"

#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "dense/decompositions.h"
#include "tourmaline/error.h"

namespace tourmaline::material {

namespace {

const std::vector<std::string> &entries(Eigen::Index size) {
  static const std::vector<std::string> strain{"eps11",   "eps22",   "eps33",
                                               "2 eps23", "2 eps13", "2 eps12"},
      field{"E1", "E2", "E3", "theta"};
  return size == 6 ? strain : field;
}

std::string text(const Eigen::VectorXd &state) {
  std::string text;
  for (Eigen::Index i = 0; i < state.size(); ++i)
    if (std::abs(state[i]) > 0.05 * state.cwiseAbs().maxCoeff())
      text += fmt::format("{}{:.2g} {}",
                          text.empty() ? (state[i] < 0 ? "-" : "") : (state[i] < 0 ? " - " : " + "),
                          std::abs(state[i]), entries(state.size())[i]);
  return text;
}

}  // namespace

LeastEnergy least_energy(const Eigen::MatrixXd &constants) {
  const auto [values, vectors] = dense::spectrum(constants);
  return {values[0], text(vectors.col(0))};
}

void need_positive(const Eigen::MatrixXd &constants, const std::string &name,
                   const std::string &where) {
  const double size = constants.cwiseAbs().maxCoeff();
  if (!((constants - constants.transpose()).cwiseAbs().maxCoeff() <= 1e-12 * size))
    throw CaseError(fmt::format("{} {} is not symmetric", where, name));
  if (const auto [value, state] = least_energy(constants); value <= 0)
    throw CaseError(fmt::format(
        "{} {} is not positive definite: its smallest eigenvalue is {:.6g}, so that the state {} "
        "would store no positive energy; a stored energy must be positive for every state",
        where, name, value, state));
}

}  // namespace tourmaline::material
