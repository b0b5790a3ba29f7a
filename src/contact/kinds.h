#pragma once

#include <array>
#include <memory>
#include <string>

#include "contact/friction_bound.h"
#include "contact/normal_law.h"
#include "tourmaline/case/contact_case.h"
#include "tourmaline/contact/friction.h"
#include "tourmaline/vector.h"

/// The laws that a case file can name. A new one is its own file, in which its kind stands below
/// it, its line here, its entry in the schema and its test; nothing else knows its name.
namespace tourmaline::contact {

struct NormalKind {
  const char *name;
  /// The law at a point in a step of `step` [s]; `before`: the penetration when it begins [m].
  /// Throws CaseError where the case's numbers there are none of the law's.
  std::shared_ptr<const NormalLaw> (*at)(const casefile::NormalCase &asked, const Vector3 &point,
                                         double step, double before);
  std::string (*words)(const casefile::NormalCase &asked);  ///< UTF-8
};

struct FrictionKind {
  const char *name;
  /// The law at a place, of friction that does not depend on the pressure; null: it does.
  Friction (*at)(const casefile::FrictionCase &asked, const ContactPlace &place);
  /// The bound that depends on the pressure, or null; `slipped`: the slip accumulated when the step
  /// of `step` [s] that ends at `time` begins [m].
  std::shared_ptr<const FrictionBound> (*bound)(const casefile::FrictionCase &asked,
                                                const Vector3 &point, double time, double step,
                                                double slipped);
  std::string (*words)(const casefile::FrictionCase &asked);  ///< UTF-8
};

namespace normal_kinds {
extern const NormalKind bilateral, unilateral, compliance, damped;
inline constexpr std::array all{&bilateral, &unilateral, &compliance, &damped};
}  // namespace normal_kinds

namespace friction_kinds {
extern const FrictionKind none, tresca, coulomb;
inline constexpr std::array all{&none, &tresca, &coulomb};
}  // namespace friction_kinds

const NormalKind &kind_of(const casefile::NormalCase &asked);
const FrictionKind &kind_of(const casefile::FrictionCase &asked);

}  // namespace tourmaline::contact
