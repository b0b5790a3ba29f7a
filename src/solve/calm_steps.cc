#include "solve/calm_steps.h"

#include <algorithm>

namespace tourmaline::solve {

using Eigen::Index;
using Eigen::VectorXd;

VectorXd CalmSteps::next(const VectorXd &x, const VectorXd &image) {
  constexpr double first = 0.1, turns = 0.5, goes_on = 1.2;
  const VectorXd way = image - x;
  if (share_.size() == 0)
    share_ = VectorXd::Constant(x.size(), first);
  for (Index i = 0; i < last_.size(); ++i)
    if (way[i] * last_[i] != 0)
      share_[i] = std::min(1., share_[i] * (way[i] * last_[i] < 0 ? turns : goes_on));
  last_ = way;
  return x + share_.cwiseProduct(way);
}

}  // namespace tourmaline::solve
