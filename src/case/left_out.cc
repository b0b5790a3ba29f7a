#include "case/left_out.h"

#include <fmt/format.h>

#include "case/place_of_key.h"
#include "case/toml_text.h"
#include "tourmaline/case/case.h"
#include "tourmaline/error.h"

namespace tourmaline::casefile {

namespace {

// What stands there although the field does not exist.
[[noreturn]] void refuse(const std::string &stated, const char *field, const char *key) {
  throw CaseError(
      fmt::format("{}: this body has no {}, as [model] {} = false says; leave out one of the two",
                  stated, field, key));
}

class LeftOut {
 public:
  LeftOut(const char *field, const char *key) : field_(field), key_(key) {}

  void check(Formula formula) const {
    if (!formula.is_zero())
      refuse(fmt::format("{} = {}", formula.where(), toml_text(Value(&formula))), field_, key_);
  }
  void check(const std::optional<Formula> &formula) const {
    if (formula)
      check(*formula);
  }
  void check(bool is_there, const std::string &place) const {
    if (is_there)
      refuse(place, field_, key_);
  }

 private:
  const char *field_, *key_;
};

void check_thermal(const Case &asked) {
  const LeftOut temperature("temperature", "thermal");
  for (const BoundaryCase &boundary : asked.boundaries) {
    temperature.check(boundary.temperature);
    temperature.check(boundary.heat_flux);
  }
  temperature.check(asked.load.heat);
  temperature.check(asked.initial.temperature);
  for (const ContactCase &contact : asked.contacts)
    temperature.check(contact.heat.exchanges() || contact.heat.friction_share,
                      place_of_key(contact.places, contact.where, "heat"));
}

void check_electric(const Case &asked) {
  const LeftOut potential("electric potential", "electric");
  for (const BoundaryCase &boundary : asked.boundaries) {
    potential.check(boundary.potential);
    potential.check(boundary.surface_charge);
  }
  for (const ElectrodeCase &electrode : asked.electrodes)
    potential.check(true, electrode.where + " " + toml_text(electrode.name));
  potential.check(asked.load.charge);
  potential.check(asked.initial.potential);
  for (const ContactCase &contact : asked.contacts)
    potential.check(contact.electric.exchanges(),
                    place_of_key(contact.places, contact.where, "electric"));
}

void check_base(const FormulaVector &acceleration) {
  if (acceleration.empty() || acceleration.front().is_zero())
    return;
  throw CaseError(
      fmt::format("{}: its first component is not 0, but x is the radius of a body of revolution "
                  "([model] plane "
                  "= \"axisymmetric\"), which is accelerated along its axis y alone",
                  acceleration.front().where()));
}

}  // namespace

void check_left_out(const Case &asked) {
  if (!asked.model.thermal)
    check_thermal(asked);
  if (!asked.model.electric)
    check_electric(asked);
  if (asked.model.is_axisymmetric())
    check_base(asked.load.base_acceleration);
}

}  // namespace tourmaline::casefile
