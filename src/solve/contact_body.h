#pragma once

#include <Eigen/Dense>
#include <cmath>
#include <optional>
#include <vector>

#include "solve/force_size.h"
#include "solve/interface_newton.h"

namespace tourmaline::solve {

/// A step of Newton's method for a contact problem, linear in the change x of its unknowns and the
/// change s of shares (`NaturalMap`). Entries of x that are held are known; the others are asked
/// for, with A x the nodal forces [N] that resist.
struct ContactTangent {
  /// Of a point that is not held, n the point of its normal:
  ///
  ///     (D - I) (A x)_i + C x_i + b (A x)_n + c x_n + a s_j = g
  struct Point {
    std::size_t point = 0;
    contact::TangentMatrix derivative;      ///< D, symmetric, from 0 to I
    contact::TangentMatrix of_own;          ///< C [N/m]
    std::optional<std::size_t> normal;      ///< n; nothing: b = c = 0
    contact::Tangent of_force, of_normal;   ///< b, c [N/m]
    std::optional<std::size_t> share;       ///< of `shares`; nothing: a = 0
    contact::Tangent of_share, right_side;  ///< a, g [N]
  };
  /// Of a share that is not known: -(A x)_n + c x_n + a s_j = g
  struct Share {
    std::size_t share = 0, normal = 0;  ///< j, n
    double of_normal = 0, of_share = 0, right_side = 0;
  };

  /// Of a temperature or potential, x_e behind those of points (`ExchangePoint`), with the points n
  /// and s of the node's normal and slip: -(A x)_e + c_e x_e + b (A x)_n + c x_n + a.x_s = g
  struct Exchange {
    Eigen::Index entry = 0;                          ///< e
    double of_own = 0;                               ///< c_e [N/m]
    std::optional<std::size_t> normal;               ///< n; nothing: b = c = 0
    double of_normal_force = 0, of_normal = 0;       ///< b, c [N/m]
    std::size_t slip = 0;                            ///< s
    contact::Tangent of_slip = contact::Tangent(0);  ///< a [N/m]
    double right_side = 0;                           ///< g [N]
  };

  Eigen::VectorXd known;        ///< x of held points, elsewhere 0 [m]
  Eigen::VectorXd known_share;  ///< s, 0 where it is asked for; may be empty
  std::vector<Point> points;
  std::vector<Share> shares;
  std::vector<Exchange> exchanges;
  bool is_last = false;  ///< no step follows that would take what is left of the system
};

/// The body as the contact sees it, in unknowns d of its points: slip increments and penetrations
/// [m]. It answers with nodal forces f - A d [N], with A symmetric and positive semidefinite.
class ContactBody {
 public:
  virtual ~ContactBody() = default;

  virtual Eigen::VectorXd force(const Eigen::VectorXd &d) = 0;  ///< f - A d
  /// Whether asking for that costs so much that after a step it is taken from what resists the
  /// step, but for the last one.
  virtual bool carries_forces() const { return false; }
  /// What a residual at the d that was asked for last is compared to: the largest of the terms of
  /// its forces [N]; not 0.
  virtual double size_of_forces(const Eigen::VectorXd &d) const = 0;
  /// The same of the rows of a field that is exchanged; where there are any.
  virtual double size_of_flows(const Eigen::VectorXd & /*d*/, std::size_t /*field*/) const {
    return 1;
  }
  /// Whether a residual [N] there is within `tolerance` of that.
  virtual bool is_within(const Eigen::VectorXd &d, double residual, double tolerance) const = 0;
  /// Size of f [N].
  virtual double largest_force() const = 0;
  /// About the largest eigenvalue of the point's own block of A [N/m].
  virtual double curvature(std::size_t point) const = 0;
  /// The size of A's diagonal in an entry that is exchanged [N/m]; where there are any.
  virtual double curvature_of_exchange(Eigen::Index /*entry*/) const { return 1; }

  struct Moved {
    Eigen::VectorXd x, resisted, share;  ///< resisted = A x; what is known is in it
  };
  /// Nothing where the linear system cannot be solved.
  virtual std::optional<Moved> solve(const ContactTangent &tangent) = 0;
  /// These rows and columns of A, where it is at hand.
  virtual std::optional<Eigen::MatrixXd> stiffness(
      const std::vector<Eigen::Index> & /*entries*/) const {
    return std::nullopt;
  }
  /// d without contact, A d = f; 0 where that cannot be solved.
  virtual Eigen::VectorXd without_contact() = 0;
  /// The convex programme with the laws of `points`.
  virtual InterfaceSolution minimise(const std::vector<ContactPoint> &points, Eigen::VectorXd start,
                                     const InterfaceSettings &settings) = 0;
};

/// With the matrix A at hand.
class DenseBody : public ContactBody {
 public:
  /// What these refer to outlives this. `factor`: of programmes before it; nothing: none.
  explicit DenseBody(const InterfaceProgramme &programme, KeptFactor *factor = nullptr);
  DenseBody(const DenseBody &) = delete;
  DenseBody &operator=(const DenseBody &) = delete;

  Eigen::VectorXd force(const Eigen::VectorXd &d) override;
  bool carries_forces() const override { return is_large(programme_.force.size()); }
  double size_of_forces(const Eigen::VectorXd &d) const override { return size_.at(d); }
  double size_of_flows(const Eigen::VectorXd &d, std::size_t field) const override {
    return solve::size_of_flows(programme_, d, field);
  }
  bool is_within(const Eigen::VectorXd &d, double residual, double tolerance) const override {
    return size_.is_within(d, residual, tolerance);
  }
  double largest_force() const override;
  double curvature(std::size_t point) const override { return curvature_[point]; }
  double curvature_of_exchange(Eigen::Index entry) const override {
    return std::abs(programme_.stiffness(entry, entry));
  }
  std::optional<Moved> solve(const ContactTangent &tangent) override;
  std::optional<Eigen::MatrixXd> stiffness(
      const std::vector<Eigen::Index> &entries) const override {
    return programme_.stiffness(entries, entries);
  }
  Eigen::VectorXd without_contact() override;
  InterfaceSolution minimise(const std::vector<ContactPoint> &points, Eigen::VectorXd start,
                             const InterfaceSettings &settings) override;

 private:
  /// Columns of all d, those of exchanged fields among them, then of the shares.
  struct Rows {
    SystemRows of_unknowns;
    Eigen::VectorXd right_side;
    std::vector<Eigen::Index> unknowns;
  };
  void fill(const ContactTangent::Point &at, Eigen::Index row, Rows &rows) const;
  void fill(const ContactTangent::Exchange &at, Eigen::Index row, Rows &rows) const;
  void fill(const ContactTangent::Share &at, Eigen::Index row, Rows &rows) const;
  Rows rows(const ContactTangent &tangent) const;

  const InterfaceProgramme programme_;  // refers to what is not its own
  std::vector<double> curvature_;       // by point [N/m]
  mutable ForceSize size_;
  KeptFactor own_;
  KeptFactor &factor_;
};

}  // namespace tourmaline::solve
