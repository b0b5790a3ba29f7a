#include "solve/natural_map.h"

#include <algorithm>
#include <cmath>

#include "contact/shared_law.h"
#include "larger.h"

namespace tourmaline::solve {

using contact::FrictionBound;
using contact::LocalLaw;
using contact::PointLaw;
using contact::Tangent;
using contact::TangentMatrix;
using contact::Tresca;
using Eigen::Index;
using Eigen::VectorXd;

NaturalMap::NaturalMap(std::shared_ptr<ContactBody> body, const std::vector<ContactPoint> &points,
                       const std::vector<FrictionCoupling> &couplings,
                       std::span<const ExchangePoint> exchanges, double strength,
                       std::optional<double> ramp)
    : body_(std::move(body)),
      points_(points),
      couplings_(couplings),
      exchanges_(exchanges),
      strength_(strength),
      coupling_of_(points.size(), -1),
      ramp_(ramp),
      largest_force_(body_->largest_force()) {
  for (std::size_t j = 0; j < couplings_.size(); ++j) {
    coupling_of_[couplings_[j].slip] = static_cast<int>(j);
    jump_.push_back(size_of_jump(couplings_[j]));
  }
  for (std::size_t i = 0; i < points_.size(); ++i)
    curvature_.push_back(body_->curvature(i));
}

NaturalMap::NaturalMap(const CoupledProgramme &programme, double strength,
                       std::optional<double> ramp)
    : NaturalMap(std::make_shared<DenseBody>(programme.convex), programme.convex.points,
                 programme.couplings, {}, strength, ramp) {}

// The body belongs to somebody else.
NaturalMap::NaturalMap(const CoupledContact &contact, double strength, std::optional<double> ramp)
    : NaturalMap(std::shared_ptr<ContactBody>(std::shared_ptr<void>(), &contact.body),
                 contact.points, contact.couplings, contact.exchanges, strength, ramp) {}

// None where the pressure is known, and where the contact cannot open.
double NaturalMap::size_of_jump(const FrictionCoupling &coupling) const {
  const ContactPoint &p = point(coupling.slip);
  if (!coupling.normal || p.size == 0 || point(*coupling.normal).law.normal()->is_closed(-1))
    return 0;
  if (coupling.bound)
    return p.weight * strength_ * coupling.bound->at(0, 0).bound;
  const PointLaw &own = p.law.friction();
  return p.weight * strength_ *
         PointLaw(own.law()).dissipation(Tangent::Unit(p.size + own.held().size(), 0));
}

const FrictionCoupling *NaturalMap::coupling(std::size_t i) const {
  return coupling_of_[i] < 0 ? nullptr : &couplings_[static_cast<std::size_t>(coupling_of_[i])];
}

bool NaturalMap::has_jumps() const {
  return std::any_of(jump_.begin(), jump_.end(), [](double jump) { return jump > 0; });
}

NaturalMap::Place NaturalMap::at(VectorXd d) const {
  Place x = at(std::move(d), VectorXd());
  if (!ramp_)
    return x;
  x.share = VectorXd::Zero(static_cast<Index>(couplings_.size()));
  for (std::size_t j = 0; j < couplings_.size(); ++j) {
    const double touches = pressure(couplings_[j], x).is_closed ? 1 : 0;
    x.share[static_cast<Index>(j)] =
        jump_[j] == 0 || *ramp_ == 0 ? touches : std::clamp(normal_force(j, x) / *ramp_, 0., 1.);
  }
  return x;
}

NaturalMap::Place NaturalMap::at(VectorXd d, VectorXd share) const {
  Place x{std::move(d), {}, std::move(share)};
  x.force = body_->force(x.d);
  return x;
}

Tangent NaturalMap::trial(std::size_t i, const Place &x) const {
  const ContactPoint &p = point(i);
  return (x.force.segment(p.offset, p.size) + curvature_[i] * p.slip(x.d)) / p.weight;
}

NaturalMap::Pressure NaturalMap::pressure(const FrictionCoupling &coupling, const Place &x) const {
  if (!coupling.normal)
    return {coupling.pressure, coupling.is_closed};
  const std::size_t n = *coupling.normal;
  return {pressure(n, x), point(n).law.normal()->is_closed(trial(n, x)[0])};
}

double NaturalMap::pressure(std::size_t normal, const Place &x) const {
  return point(normal).law.normal()->pressure(trial(normal, x)[0],
                                              curvature_[normal] / point(normal).weight);
}

double NaturalMap::normal_force(std::size_t j, const Place &x) const {
  const std::size_t n = *couplings_[j].normal;
  return point(n).weight * trial(n, x)[0];
}

double NaturalMap::share(std::size_t j, const Place &x) const {
  if (ramp_ && jump_[j] > 0)
    return x.share[static_cast<Index>(j)];
  return pressure(couplings_[j], x).is_closed ? 1 : 0;
}

// Before it is cut off at 0 and 1; a jump larger than all forces is none the less steep.
double NaturalMap::share_wanted(std::size_t j, const Place &x) const {
  const double s = share(j, x), scale = *ramp_ + std::min(jump_[j], largest_force_);
  return s + (normal_force(j, x) - *ramp_ * s) / scale;
}

VectorXd NaturalMap::share_value(const Place &x) const {
  VectorXd lacks = VectorXd::Zero(x.share.size());
  for (std::size_t j = 0; j < couplings_.size() && ramp_; ++j)
    if (jump_[j] > 0)
      lacks[static_cast<Index>(j)] = (*ramp_ + std::min(jump_[j], largest_force_)) *
                                     (share(j, x) - std::clamp(share_wanted(j, x), 0., 1.));
  return lacks;
}

double NaturalMap::slip_size(std::size_t i, const Place &x) const {
  const ContactPoint &p = point(i);
  return std::hypot(p.slip(x.d).norm(), p.law.held().norm());
}

// Of a point that carries all of it.
FrictionBound::Value NaturalMap::bound(const FrictionCoupling &coupling, const Place &x) const {
  FrictionBound::Value value =
      coupling.bound->at(pressure(coupling, x).value, slip_size(coupling.slip, x));
  value.bound *= strength_;
  value.by_pressure *= strength_;
  value.by_slip *= strength_;
  return value;
}

PointLaw NaturalMap::friction(std::size_t j, const Place &x, double share) const {
  const FrictionCoupling &coupling = couplings_[j];
  const PointLaw &own = point(coupling.slip).law.friction();
  if (share * strength_ == 0)
    return {Tresca{0}, own.held()};
  if (coupling.bound)
    return {Tresca{share * bound(coupling, x).bound}, own.held()};
  share *= strength_;
  return share == 1 ? own : PointLaw{contact::shared(own.law(), share), own.held()};
}

LocalLaw NaturalMap::law(std::size_t i, const Place &x) const {
  if (coupling_of_[i] < 0)
    return point(i).law;
  const auto j = static_cast<std::size_t>(coupling_of_[i]);
  return friction(j, x, share(j, x));
}

Tangent NaturalMap::point_value(std::size_t i, const Place &x) const {
  const ContactPoint &p = point(i);
  return x.force.segment(p.offset, p.size) -
         p.weight * law(i, x).traction(trial(i, x), curvature_[i] / p.weight);
}

VectorXd NaturalMap::value(const Place &x) const {
  VectorXd all(x.d.size());
  for (std::size_t i = 0; i < points_.size(); ++i)
    all.segment(point(i).offset, point(i).size) = point_value(i, x);
  for (const ExchangePoint &at : exchanges_)
    all[at.entry] = exchange_value(at, x);
  return all;
}

double NaturalMap::merit(const Place &x) const {
  double sum = 0;
  for (std::size_t i = 0; i < points_.size(); ++i)
    if (point(i).size > 0)
      sum += point_value(i, x).squaredNorm() / (curvature_[i] * curvature_[i]);
  const VectorXd shares = share_value(x);
  for (Index j = 0; j < shares.size(); ++j)
    if (shares[j] != 0)
      sum += std::pow(shares[j] / curvature_[*couplings_[static_cast<std::size_t>(j)].normal], 2);
  for (const ExchangePoint &at : exchanges_)
    sum += std::pow(exchange_value(at, x) / body_->curvature_of_exchange(at.entry), 2);
  return sum;
}

double NaturalMap::largest_value(const Place &x) const {
  double largest = 0;
  for (std::size_t i = 0; i < points_.size(); ++i)
    largest = larger(largest, point_value(i, x).norm());
  for (const double lack : share_value(x))
    largest = larger(largest, std::abs(lack));
  return largest;
}

double NaturalMap::residual(const Place &x) const {
  const double of_forces = relative_to(largest_value(x), body_->size_of_forces(x.d));
  return exchanges_.empty() ? of_forces : larger(of_forces, residual_of_exchanges(x));
}

bool NaturalMap::is_zero(const Place &x, double tolerance) const {
  return body_->is_within(x.d, largest_value(x), tolerance) &&
         (exchanges_.empty() || residual_of_exchanges(x) <= tolerance);
}

std::vector<std::size_t> NaturalMap::unsettled(const Place &x, double tolerance) const {
  const double allowed = tolerance * body_->size_of_forces(x.d);
  std::vector<std::size_t> points;
  for (std::size_t i = 0; i < points_.size(); ++i)
    if (!(point_value(i, x).norm() <= allowed))
      points.push_back(i);
  return points;
}

// Difference quotients, which serve with known components of the slip, too; without these the
// traction of a ball is linear in its radius.
void NaturalMap::add_coupling(std::size_t j, const Place &x, Branch &branch) const {
  constexpr double more = 1e-6;
  const std::size_t i = couplings_[j].slip;
  const Tangent y = trial(i, x);
  const double r = curvature_[i] / point(i).weight, s = share(j, x);
  const Tangent now = friction(j, x, s).traction(y, r);
  if (ramp_ && jump_[j] > 0)
    branch.by_share = (friction(j, x, s + more).traction(y, r) - now) / more;
  if (!couplings_[j].bound || s == 0)
    return;
  const FrictionBound::Value value = bound(couplings_[j], x);
  const double b = s * value.bound, wider = b == 0 ? 1 : b * (1 + more);
  const PointLaw wide{Tresca{wider}, point(i).law.held()};
  const Tangent by_bound = (wide.traction(y, r) - now) / (wider - b);
  branch.by_pressure = s * value.by_pressure * by_bound;
  branch.by_slip = s * value.by_slip * by_bound;
}

NaturalMap::Branch NaturalMap::branch(std::size_t i, const Place &x) const {
  const ContactPoint &p = point(i);
  Branch found;
  found.derivative = law(i, x).traction_derivative(trial(i, x), curvature_[i] / p.weight);
  found.is_held = p.size > 0 && found.derivative.isIdentity(0);
  found.by_pressure = found.by_slip = found.by_share = Tangent::Zero(p.size);
  if (coupling_of_[i] >= 0 && p.size > 0 && !found.is_held)
    add_coupling(static_cast<std::size_t>(coupling_of_[i]), x, found);
  return found;
}

// Held points and shares at 0 or 1 go there at once.
NaturalMap::Unknowns NaturalMap::unknowns(const Place &x) const {
  Unknowns u;
  u.d = VectorXd::Zero(x.d.size());
  u.share = VectorXd::Zero(x.share.size());
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const ContactPoint &p = point(i);
    u.branches.push_back(branch(i, x));
    if (u.branches.back().is_held)
      u.d.segment(p.offset, p.size) = -p.slip(x.d);
  }
  for (std::size_t j = 0; j < couplings_.size() && ramp_; ++j) {
    if (jump_[j] == 0)
      continue;
    if (const double wanted = share_wanted(j, x); wanted > 0 && wanted < 1)
      u.shares.push_back(j);
    else
      u.share[static_cast<Index>(j)] = (wanted > 0 ? 1 : 0) - share(j, x);
  }
  return u;
}

// F' = (I - D) lambda' - c D - w (T_p p' + T_s |d|' + T_s s'), lambda' = -A.
ContactTangent::Point NaturalMap::tangent_at(std::size_t i, const Place &x,
                                             const Unknowns &u) const {
  const ContactPoint &p = point(i);
  const Branch &at = u.branches[i];
  ContactTangent::Point row;
  row.point = i;
  row.derivative = at.derivative;
  row.of_own = -curvature_[i] * at.derivative;
  row.right_side = -point_value(i, x);
  const FrictionCoupling *coupling = this->coupling(i);
  if (coupling == nullptr)
    return row;
  if (const double size = slip_size(i, x); size > 0)
    row.of_own -= p.weight / size * at.by_slip * p.slip(x.d).transpose();
  if (coupling->normal && !at.by_pressure.isZero(0)) {
    // w p' = D (lambda' + c delta') at the normal's point
    const std::size_t n = *coupling->normal;
    row.normal = n;
    row.of_force = p.weight / point(n).weight * u.branches[n].derivative(0, 0) * at.by_pressure;
    row.of_normal = -curvature_[n] * row.of_force;
  }
  if (ramp_) {
    row.share = static_cast<std::size_t>(coupling_of_[i]);
    row.of_share = -p.weight * at.by_share;
  }
  return row;
}

// Of a share y - e s = 0, y' = lambda' + c delta'.
ContactTangent NaturalMap::tangent(const Place &x, const Unknowns &u) const {
  ContactTangent all;
  all.known = u.d;
  all.known_share = u.share;
  for (std::size_t i = 0; i < points_.size(); ++i)
    if (!u.branches[i].is_held && point(i).size > 0)
      all.points.push_back(tangent_at(i, x, u));
  for (const std::size_t j : u.shares) {
    const std::size_t n = *couplings_[j].normal;
    all.shares.push_back({j, n, curvature_[n], -*ramp_, *ramp_ * share(j, x) - normal_force(j, x)});
  }
  for (const ExchangePoint &at : exchanges_)
    all.exchanges.push_back(tangent_at(at, x));
  return all;
}

ContactTangent NaturalMap::tangent(const Place &x) const {
  return tangent(x, unknowns(x));
}

std::optional<NaturalMap::Direction> NaturalMap::newton_direction(const Place &x,
                                                                  bool is_last) const {
  ContactTangent asked = tangent(x);
  asked.is_last = is_last;
  const std::optional<ContactBody::Moved> moved = body_->solve(asked);
  if (!moved)
    return std::nullopt;
  return Direction{moved->x, moved->resisted, moved->share};
}

// A whole step ends at a share that is one.
NaturalMap::Place NaturalMap::along(const Place &x, const Direction &direction,
                                    double length) const {
  return {x.d + length * direction.d, x.force - length * direction.resisted,
          (x.share + length * direction.share).cwiseMax(0).cwiseMin(1)};
}

// What a point's trial value exceeds its border by; it changes its branch where this changes its
// sign.
double NaturalMap::excess(std::size_t i, const Place &x) const {
  const ContactPoint &p = point(i);
  const Tangent y = trial(i, x);
  if (p.law.normal() != nullptr)
    return y[0];
  const double r = curvature_[i] / p.weight;
  return (y - law(i, x).traction(y, r)).norm() - 1e-14 * y.norm();
}

// Of `moving` the entries that the point's branch depends on are those of the place on the way.
// More than 1 where it does not turn.
double NaturalMap::length_to_turn(std::size_t i, const Place &x, const Direction &direction,
                                  Place &moving) const {
  const auto excess_at = [&](double t) {
    const auto move = [&](const ContactPoint &p) {
      const auto along = Eigen::seqN(p.offset, p.size);
      moving.d(along) = x.d(along) + t * direction.d(along);
      moving.force(along) = x.force(along) - t * direction.resisted(along);
    };
    move(point(i));
    if (const FrictionCoupling *coupling = this->coupling(i); coupling && coupling->normal)
      move(point(*coupling->normal));
    return excess(i, moving);
  };
  const bool start = excess_at(0) > 0;
  if (start == (excess_at(1) > 0))
    return 2;
  constexpr int bisections = 20;
  double low = 0, high = 1;
  for (int k = 0; k < bisections; ++k) {
    const double middle = (low + high) / 2;
    (((excess_at(middle) > 0) == start) ? low : high) = middle;
  }
  return high;
}

std::vector<double> NaturalMap::turns(const Place &x, const Direction &direction) const {
  constexpr std::size_t most = 20;
  Place moving = x;
  std::vector<double> lengths;
  for (std::size_t i = 0; i < points_.size(); ++i)
    if (point(i).size > 0)
      if (const double length = length_to_turn(i, x, direction, moving); length <= 1)
        lengths.push_back(length);
  std::sort(lengths.begin(), lengths.end());
  if (lengths.size() <= most)
    return lengths;
  std::vector<double> some;
  for (std::size_t k = 0; k < most; ++k)
    some.push_back(lengths[k * (lengths.size() - 1) / (most - 1)]);
  return some;
}

NaturalMap::Place NaturalMap::settled(const Place &x) const {
  Place exact = x;
  for (std::size_t i = 0; i < points_.size(); ++i)
    if (branch(i, x).is_held)
      point(i).hold(exact.d);
  return exact.d == x.d && !body_->carries_forces() ? x : at(exact.d, exact.share);
}

std::vector<PointLaw> NaturalMap::friction_at(const Place &x) const {
  std::vector<PointLaw> laws;
  for (std::size_t j = 0; j < couplings_.size(); ++j)
    laws.push_back(friction(j, x, share(j, x)));
  return laws;
}

VectorXd NaturalMap::bounds(const Place &x) const {
  VectorXd all(static_cast<Index>(couplings_.size()));
  for (std::size_t j = 0; j < couplings_.size(); ++j)
    all[static_cast<Index>(j)] =
        share(j, x) * (couplings_[j].bound ? bound(couplings_[j], x).bound : 1);
  return all;
}

std::vector<PointLaw> NaturalMap::friction_at(const Place &x, const VectorXd &bounds) const {
  std::vector<PointLaw> laws;
  for (std::size_t j = 0; j < couplings_.size(); ++j) {
    const PointLaw &own = point(couplings_[j].slip).law.friction();
    const double given = bounds[static_cast<Index>(j)];
    laws.push_back(couplings_[j].bound ? PointLaw{Tresca{given}, own.held()}
                                       : friction(j, x, std::min(given, 1.)));
  }
  return laws;
}

CoupledSolution NaturalMap::solution(const Place &x) const {
  CoupledSolution found;
  found.interface.increment = x.d;
  found.interface.force = VectorXd::Zero(x.d.size());
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const ContactPoint &p = point(i);
    const double r = curvature_[i] / p.weight;
    const LocalLaw law = this->law(i, x);
    found.interface.force.segment(p.offset, p.size) = p.weight * law.traction(trial(i, x), r);
    found.interface.status.push_back(
        p.size == 0 && law.normal() != nullptr ? ContactStatus::stick : law.status(trial(i, x), r));
  }
  found.interface.residual = residual(x);
  found.friction = friction_at(x);
  for (std::size_t j = 0; j < couplings_.size(); ++j) {
    found.pressure.push_back(pressure(couplings_[j], x).value);
    if (jump_[j] > 0 && share(j, x) > 0)  // it touches, whatever round-off says
      found.interface.status[*couplings_[j].normal] = ContactStatus::stick;
  }
  return found;
}

}  // namespace tourmaline::solve
