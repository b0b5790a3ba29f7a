#include "gmres.h"

#include <unsupported/Eigen/IterativeSolvers>

// Eigen's GMRES takes a matrix of one's own by these traits ("Matrix-free solvers" of its manual).
namespace tourmaline::condensation {
class Product;
class Inverse;
}  // namespace tourmaline::condensation

namespace Eigen::internal {
template <>
struct traits<tourmaline::condensation::Product> : traits<SparseMatrix<double>> {};
}  // namespace Eigen::internal

namespace tourmaline::condensation {

using Eigen::Index;
using Eigen::VectorXd;

class Product : public Eigen::EigenBase<Product> {
 public:
  using Scalar = double;
  using RealScalar = double;
  using StorageIndex = int;
  enum {
    ColsAtCompileTime = Eigen::Dynamic,
    MaxColsAtCompileTime = Eigen::Dynamic,
    IsRowMajor = false
  };

  Product(const LinearMap &map, const LinearMap &inverse, Index size)
      : map_(map), inverse_(inverse), size_(size) {}
  Index rows() const { return size_; }
  Index cols() const { return size_; }
  const LinearMap &map() const { return map_; }
  const LinearMap &inverse() const { return inverse_; }
  template <class Right>
  Eigen::Product<Product, Right, Eigen::AliasFreeProduct> operator*(
      const Eigen::MatrixBase<Right> &x) const {
    return {*this, x.derived()};
  }

 private:
  const LinearMap &map_, &inverse_;
  Index size_;
};

/// In the form of Eigen's preconditioners.
class Inverse {
 public:
  template <class Matrix>
  Inverse &analyzePattern(const Matrix &) {
    return *this;
  }
  template <class Matrix>
  Inverse &factorize(const Matrix &of) {
    map_ = &of.inverse();
    return *this;
  }
  template <class Matrix>
  Inverse &compute(const Matrix &of) {
    return factorize(of);
  }
  VectorXd solve(const VectorXd &b) const { return (*map_)(b); }
  Eigen::ComputationInfo info() const { return Eigen::Success; }

 private:
  const LinearMap *map_ = nullptr;
};

}  // namespace tourmaline::condensation

namespace Eigen::internal {
template <class Right>
struct generic_product_impl<tourmaline::condensation::Product, Right, SparseShape, DenseShape,
                            GemvProduct>
    : generic_product_impl_base<tourmaline::condensation::Product, Right,
                                generic_product_impl<tourmaline::condensation::Product, Right>> {
  template <class To>
  static void scaleAndAddTo(To &to, const tourmaline::condensation::Product &left,
                            const Right &right, double factor) {
    to += factor * left.map()(right);
  }
};
}  // namespace Eigen::internal

namespace tourmaline::condensation {

VectorXd gmres(const LinearMap &product, const LinearMap &approximate_inverse, const VectorXd &b,
               double reduction, int iterations) {
  const Product matrix(product, approximate_inverse, b.size());
  Eigen::GMRES<Product, Inverse> solver;
  solver.set_restart(iterations);
  solver.setMaxIterations(iterations);
  solver.setTolerance(reduction);
  solver.compute(matrix);
  return solver.solve(b);
}

}  // namespace tourmaline::condensation
