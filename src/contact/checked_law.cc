#include "contact/checked_law.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <new>
#include <string_view>
#include <type_traits>

#include "tourmaline/error.h"

namespace tourmaline::contact {

namespace {

// Beside round-off and what a law may call its border; far below any mistake.
constexpr double on_border = 1e-9;
// Between a gradient by differences and a dissipation of another degree than one.
constexpr double same_work = 1e-4;

/// The law that is asked, for messages.
struct Label {
  std::string name;
  Vector3 point;  // [m]
  double time;    // [s]

  std::string text() const {
    return fmt::format("the friction law \"{}\" at ({:g}, {:g}, {:g}), t = {:g} s", name, point[0],
                       point[1], point[2], time);
  }
};

std::string text(const Tangent &components) {
  std::string list;
  for (const double x : components)
    list += fmt::format("{}{:.17g}", list.empty() ? "" : ", ", x);
  return "(" + list + ")";
}

/// What a law threw, as this library's errors.
template <class Call>
auto answer(const Label &label, std::string_view function, const Call &call) {
  const auto refused = [&](const char *what) {
    return CaseError(fmt::format("{}: {} threw an exception: {}", label.text(), function, what));
  };
  try {
    return call();
  } catch (const Error &) {
    throw;
  } catch (const std::bad_alloc &) {
    throw;
  } catch (const std::exception &error) {
    throw refused(error.what());
  } catch (...) {
    throw refused("it is none of the standard library's");
  }
}

class CheckedLaw : public FrictionLaw {
 public:
  CheckedLaw(std::shared_ptr<const FrictionLaw> law, Label label)
      : law_(std::move(law)), label_(std::move(label)) {}

  double dissipation(const Tangent &d) const override {
    const double j = ask("dissipation", [&] { return law_->dissipation(d); });
    if (d.allFinite() && !(j >= 0 && std::isfinite(j)))
      refuse("dissipation", d, fmt::format("is {:g} J/m^2, and must be finite and >= 0", j));
    return j;
  }

  Tangent traction(const Tangent &trial) const override {
    return vector("traction", trial, [&] { return law_->traction(trial); });
  }

  TangentMatrix traction_derivative(const Tangent &trial) const override {
    return matrix("traction_derivative", trial, [&] { return law_->traction_derivative(trial); });
  }

  // On the border of its set, and in the round-off beside it, the law itself says which.
  ContactStatus status(const Tangent &trial) const override {
    const ContactStatus said = ask("status", [&] { return law_->status(trial); });
    if (said != ContactStatus::stick && said != ContactStatus::slip)
      refuse("status", trial, "is neither stick nor slip");
    if (!trial.allFinite())
      return said;
    if (said == ContactStatus::stick && (trial - traction(trial)).norm() > on_border * trial.norm())
      refuse("status", trial,
             fmt::format("is stick, but traction of the same is {}: the point slips",
                         text(traction(trial))));
    const Tangent further = (1 + on_border) * trial;
    if (said == ContactStatus::slip && !trial.isZero(0) && further.allFinite() &&
        traction(further) == further)
      refuse("status", trial, "is slip, but traction leaves the trial value as it is: it sticks");
    return said;
  }

  bool is_smooth_at(const Tangent &d) const override {
    return ask("is_smooth_at", [&] { return law_->is_smooth_at(d); });
  }

  // As j is positively homogeneous, its gradient does the work j (Euler).
  Tangent gradient(const Tangent &d) const override {
    Tangent g = vector("gradient", d, [&] { return law_->gradient(d); });
    if (const double j = dissipation(d);
        d.allFinite() && std::abs(g.dot(d) - j) > same_work * std::max(g.norm() * d.norm(), j))
      refuse("gradient", d,
             fmt::format("is {}, whose product with the slip is {:g}, and dissipation is {:g}; "
                         "they must be equal, as the dissipation is positively homogeneous",
                         text(g), g.dot(d), j));
    return g;
  }

  TangentMatrix hessian(const Tangent &d) const override {
    return matrix("hessian", d, [&] { return law_->hessian(d); });
  }

 private:
  template <class Call>
  std::invoke_result_t<Call> ask(std::string_view function, const Call &call) const {
    return answer(label_, function, call);
  }

  template <class Call>
  Tangent vector(std::string_view function, const Tangent &of, const Call &call) const {
    Tangent found = ask(function, call);
    if (found.size() != of.size())
      refuse(function, of,
             fmt::format("has {} components, and must have {}", found.size(), of.size()));
    require_finite(function, of, found);
    return found;
  }

  template <class Call>
  TangentMatrix matrix(std::string_view function, const Tangent &of, const Call &call) const {
    TangentMatrix found = ask(function, call);
    if (found.rows() != of.size() || found.cols() != of.size())
      refuse(function, of,
             fmt::format("has {} rows and {} columns, and must have {} of both", found.rows(),
                         found.cols(), of.size()));
    require_finite(function, of, found);
    return found;
  }

  // Of an argument that is not finite itself the body is the cause.
  template <class Found>
  void require_finite(std::string_view function, const Tangent &of, const Found &found) const {
    if (of.allFinite() && !found.allFinite())
      refuse(function, of, "holds a value that is no finite number");
  }

  [[noreturn]] void refuse(std::string_view function, const Tangent &of,
                           const std::string &what) const {
    throw CaseError(fmt::format("{}: {}({}) {}", label_.text(), function, text(of), what));
  }

  std::shared_ptr<const FrictionLaw> law_;
  Label label_;
};

Friction checked_at(const FrictionAt &laws, const std::string &name, const ContactPlace &place) {
  const Label label{name, place.point, place.time};
  Friction found = answer(label, "the function that gives the law", [&] { return laws(place); });
  if (const auto *tresca = std::get_if<Tresca>(&found)) {
    if (!(tresca->bound >= 0 && std::isfinite(tresca->bound)))
      throw CaseError(
          fmt::format("{}: the bound of Tresca's law is {:g} N/m^2; it must be finite "
                      "and >= 0",
                      label.text(), tresca->bound));
    return found;
  }
  auto &own = std::get<OwnLaw>(found);
  if (!own.law)
    throw CaseError(label.text() + ": there is none; its OwnLaw is empty");
  own.law = std::make_shared<CheckedLaw>(std::move(own.law), label);
  return found;
}

}  // namespace

FrictionAt checked(FrictionAt laws, std::string name) {
  return [laws = std::move(laws), name = std::move(name)](const ContactPlace &place) {
    return checked_at(laws, name, place);
  };
}

}  // namespace tourmaline::contact
