#include "tourmaline/contact/tresca.h"

#include <fmt/format.h>

#include "contact/kinds.h"
#include "tourmaline/error.h"

namespace tourmaline::contact {

namespace {

// Tangential part with respect to x: I - x x^T / |x|^2; zero in one dimension.
TangentMatrix across(const Tangent &x) {
  return TangentMatrix::Identity(x.size(), x.size()) - x * x.transpose() / x.squaredNorm();
}

}  // namespace

double Tresca::dissipation(const Tangent &d) const {
  return bound * d.norm();
}

Tangent Tresca::traction(const Tangent &trial) const {
  const double size = trial.norm();
  return size <= bound ? trial : Tangent(bound / size * trial);
}

TangentMatrix Tresca::traction_derivative(const Tangent &trial) const {
  const double size = trial.norm();
  if (size <= bound)
    return TangentMatrix::Identity(trial.size(), trial.size());
  return bound / size * across(trial);
}

ContactStatus Tresca::status(const Tangent &trial) const {
  return trial.norm() <= bound ? ContactStatus::stick : ContactStatus::slip;
}

bool Tresca::is_smooth_at(const Tangent &d) const {
  return bound == 0 || !d.isZero(0);
}

Tangent Tresca::gradient(const Tangent &d) const {
  return bound == 0 ? Tangent(Tangent::Zero(d.size())) : Tangent(bound * d.normalized());
}

TangentMatrix Tresca::hessian(const Tangent &d) const {
  if (bound == 0 || d.size() == 1)
    return TangentMatrix::Zero(d.size(), d.size());
  return bound / d.norm() * across(d);
}

namespace {

Friction tresca_at(const casefile::FrictionCase &asked, const ContactPlace &place) {
  const double bound = asked.bound.value(place.point, place.time);
  if (bound < 0)
    throw CaseError(fmt::format(
        "{}: the friction bound is {:g} N/m^2 at ({:g}, {:g}, {:g}), t = {:g} s; "
        "it must be >= 0 (paper, eq. 9)",
        asked.bound.where(), bound, place.point[0], place.point[1], place.point[2], place.time));
  return Tresca{bound};
}

std::string tresca_words(const casefile::FrictionCase &asked) {
  return fmt::format("Tresca friction, S = {} N/m²", asked.bound.text());
}

}  // namespace

const FrictionKind friction_kinds::tresca{
    .name = "tresca", .at = tresca_at, .bound = nullptr, .words = tresca_words};

const FrictionKind friction_kinds::none{
    .name = "none",
    .at = [](const casefile::FrictionCase &, const ContactPlace &) -> Friction { return Tresca{}; },
    .bound = nullptr,
    .words = [](const casefile::FrictionCase &) -> std::string { return "no friction"; }};

}  // namespace tourmaline::contact
