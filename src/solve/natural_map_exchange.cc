// The rows of the natural map in which heat or charge is exchanged.
#include <cmath>

#include "larger.h"
#include "solve/natural_map.h"

namespace tourmaline::solve {

using contact::FrictionBound;
using contact::LocalLaw;
using contact::Tangent;

// Where a point sticks nothing is rubbed, and as its slip is held there the slope does not count.
NaturalMap::Sight NaturalMap::sight(const ExchangePoint &at, const Place &x) const {
  const ContactPoint &p = point(at.slip);
  const Tangent slip = p.slip(x.d);
  Sight seen;
  seen.state = at.known;
  if (at.normal) {
    const ContactPoint &n = point(*at.normal);
    seen.state.pressure = pressure(*at.normal, x);
    seen.state.penetration += n.slip(x.d)[0];
    seen.by_trial = n.law.normal()->pressure_derivative(trial(*at.normal, x)[0],
                                                        curvature_[*at.normal] / n.weight);
  }
  const LocalLaw law = this->law(at.slip, x);
  seen.state.friction = law.potential(slip);
  seen.friction_by_slip = Tangent::Zero(p.size);
  if (law.is_smooth_at(slip))
    seen.friction_by_slip = law.gradient(slip);
  const FrictionCoupling *coupling = this->coupling(at.slip);
  const double size = slip_size(at.slip, x);
  if (coupling == nullptr || !coupling->bound || size == 0)
    return seen;
  const FrictionBound::Value by = bound(*coupling, x);
  const double s = share(static_cast<std::size_t>(coupling_of_[at.slip]), x);
  seen.friction_by_slip += s * by.by_slip * slip;
  seen.friction_by_pressure = s * by.by_pressure * size;
  return seen;
}

contact::Exchange::Value NaturalMap::flow(const ExchangePoint &at, const Place &x) const {
  return at.law->at(at.of_value * x.d[at.entry], sight(at, x).state);
}

double NaturalMap::exchange_value(const ExchangePoint &at, const Place &x) const {
  return x.force[at.entry] + at.of_flow * flow(at, x).flow;
}

// By field.
double NaturalMap::residual_of_exchanges(const Place &x) const {
  std::vector<double> lack, size;
  for (const ExchangePoint &at : exchanges_) {
    for (std::size_t field = size.size(); field <= at.field; ++field) {
      lack.push_back(0);
      size.push_back(body_->size_of_flows(x.d, field));
    }
    const contact::Exchange::Value q = flow(at, x);
    lack[at.field] = larger(lack[at.field], std::abs(x.force[at.entry] + at.of_flow * q.flow));
    size[at.field] =
        larger(size[at.field], std::abs(at.of_flow * q.by_value * at.of_value * x.d[at.entry]));
  }
  double worst = 0;
  for (std::size_t field = 0; field < size.size(); ++field)
    worst = larger(worst, relative_to(lack[field], size[field]));
  return worst;
}

// F' = lambda' + f (q_theta theta' + q_delta delta' + q_p p' + q_w w'), f `of_flow`, w the work of
// friction; p' = D (lambda' + c delta') / weight at the normal's point.
ContactTangent::Exchange NaturalMap::tangent_at(const ExchangePoint &at, const Place &x) const {
  const Sight seen = sight(at, x);
  const contact::Exchange::Value q = at.law->at(at.of_value * x.d[at.entry], seen.state);
  ContactTangent::Exchange row;
  row.entry = at.entry;
  row.of_own = at.of_flow * q.by_value * at.of_value;
  row.normal = at.normal;
  if (at.normal) {
    const std::size_t n = *at.normal;
    const double by_force = at.of_flow *
                            (q.by_pressure + q.by_friction * seen.friction_by_pressure) *
                            seen.by_trial / point(n).weight;
    row.of_normal_force = -by_force;
    row.of_normal = curvature_[n] * by_force + at.of_flow * q.by_penetration;
  }
  row.slip = at.slip;
  row.of_slip = at.of_flow * q.by_friction * seen.friction_by_slip;
  row.right_side = -(x.force[at.entry] + at.of_flow * q.flow);
  return row;
}

}  // namespace tourmaline::solve
