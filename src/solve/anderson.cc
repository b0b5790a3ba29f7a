#include "solve/anderson.h"

#include "dense/decompositions.h"

namespace tourmaline::solve {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

VectorXd Anderson::next(const VectorXd &x, const VectorXd &image) {
  constexpr std::size_t depth = 5;
  images_.push_back(image);
  changes_.push_back(image - x);
  if (images_.size() > depth + 1) {
    images_.pop_front();
    changes_.pop_front();
  }
  const auto m = static_cast<Index>(images_.size()) - 1;
  if (m == 0)
    return image;
  MatrixXd changes(x.size(), m), images(x.size(), m);
  for (Index k = 0; k < m; ++k) {
    const auto at = static_cast<std::size_t>(k);
    changes.col(k) = changes_[at + 1] - changes_[at];
    images.col(k) = images_[at + 1] - images_[at];
  }
  return image - images * dense::least_squares(changes, changes_.back());
}

}  // namespace tourmaline::solve
