#include <fmt/format.h>

#include <cmath>

#include "schema_parts.h"
#include "sense.h"
#include "tourmaline/case/contact_case.h"
#include "tourmaline/case/mesh_case.h"

namespace tourmaline::casefile {

namespace {

// The unit of c in the law; where there is none yet, in both.
std::string words_of_unit(const std::string &law) {
  if (law == "compliance")
    return "N/m^(2+m)";
  return law == "damped" ? "N s/m^3" : "N/m^(2+m) or N s/m^3";
}

// Of m = 1.5 there is no unit that a text could give.
std::string unit_of_response(const NormalCase &normal) {
  if (normal.law != "compliance" || normal.exponent != std::floor(normal.exponent))
    return words_of_unit(normal.law);
  return fmt::format("N/m^{:.0f}", 2 + normal.exponent);
}

void declare(Visitor &v, NormalCase &normal) {
  v.key({.name = "law",
         .description =
             "with u_nu and u_f.nu the normal displacements of body and foundation, d = u_nu - "
             "u_f.nu - gap how far they have closed beyond the gap, and p = -sigma_nu. bilateral: "
             "contact is never lost, d = 0 (9); unilateral (Signorini's): d <= 0, p >= 0, p d = 0; "
             "compliance: p = c (d+)^m, d+ being d where it is positive and else 0; damped: p = c "
             "times the rate of d+ while it grows, else 0",
         .choices = {"bilateral", "unilateral", "compliance", "damped"},
         .also = {"type"},
         .choices_also = {{"signorini", "unilateral"},
                          {"normal_compliance", "compliance"},
                          {"damped_response", "damped"}}},
        &normal.law);
  v.key({.name = "exponent",
         .description = "m of compliance",
         .range = {.low = 1, .sense = sense::contact_exponent},
         .used = with("law", normal.law, {"compliance"}),
         .also = {"m", "m_nu"}},
        &normal.exponent);
  v.key({.name = "coefficient",
         .description = "c of the law: of compliance in N/m^(2+m), of damped in N s/m^3",
         .unit = words_of_unit(normal.law),
         .required = true,
         .range = positive(sense::contact_compliance),
         .constant_in_time = true,
         .used = with("law", normal.law, {"compliance", "damped"}),
         .also = {"c", "c_nu", "stiffness"},
         .unit_here = unit_of_response(normal)},
        &normal.coefficient);
}

const std::string forms_of_coefficient =
    "write coefficient = 0.3, or { static = 0.4, kinetic = 0.2, speed = 1e-3 }, or { static, "
    "kinetic, distance }";

std::string coefficient_complaint(const FrictionCoefficientCase &mu) {
  if (mu.value && (mu.at_rest || mu.kinetic || mu.speed || mu.distance))
    return "`value` is the whole coefficient, but `static`, `kinetic`, `speed` or `distance` are "
           "given as well; " +
           forms_of_coefficient;
  if (!mu.value && !mu.at_rest && !mu.kinetic)
    return "has no coefficient; " + forms_of_coefficient;
  if (mu.value)
    return "";
  if (!mu.at_rest || !mu.kinetic)
    return fmt::format("has `{}` but not `{}`; {}", mu.at_rest ? "static" : "kinetic",
                       mu.at_rest ? "kinetic" : "static", forms_of_coefficient);
  if (mu.speed && mu.distance)
    return "both `speed` and `distance` are given; the coefficient falls with the one or the other";
  if (!mu.speed && !mu.distance)
    return "neither `speed` nor `distance` is given, over which the coefficient goes from static "
           "to kinetic; " +
           forms_of_coefficient;
  return "";
}

void declare(Visitor &v, FrictionCoefficientCase &mu) {
  const Range range = not_negative(sense::friction);
  v.optional({.name = "value",
              .description = "mu that does not depend on slip, of place and time",
              .range = range,
              .also = {"mu"}},
             mu.value);
  v.optional({.name = "static",
              .description = "mu at rest: mu = kinetic + (static - kinetic) exp(-v/speed), v being "
                             "the slip rate, or exp(-s/distance), s being the accumulated slip",
              .range = range,
              .also = {"mu_s", "at_rest"}},
             mu.at_rest);
  v.optional({.name = "kinetic",
              .description = "mu of fast or long slip",
              .range = range,
              .also = {"mu_k", "mu_d", "dynamic"}},
             mu.kinetic);
  v.optional({.name = "speed",
              .description = "slip rate at which 1/e of static - kinetic is left",
              .unit = "m/s",
              .range = positive(sense::slip_rate),
              .also = {"v_c", "velocity"}},
             mu.speed);
  v.optional({.name = "distance",
              .description = "accumulated slip at which 1/e of static - kinetic is left",
              .unit = "m",
              .range = positive(sense::slip),
              .also = {"D_c", "length"}},
             mu.distance);
  v.one_group({{"value"}, {"static", "kinetic", "speed"}, {"static", "kinetic", "distance"}});
  v.check("", [&] { return coefficient_complaint(mu); });
}

// Of formulas that vary, whoever evaluates them judges.
std::string limit_complaint(const FrictionCase &friction) {
  if (!friction.limit || !friction.limit->is_number() || !friction.cohesion.is_number() ||
      friction.limit->value({}, 0) >= friction.cohesion.value({}, 0))
    return "";
  return fmt::format("must be at least the cohesion, which is {} N/m^2", friction.cohesion.text());
}

void declare_coulomb(Visitor &v, FrictionCase &friction) {
  const Use coulomb = with("law", friction.law, {"coulomb"});
  v.table({.name = "coefficient",
           .description = "The coefficient mu of Coulomb's law: a number or formula of place and "
                          "time, or what it goes from and to as the contact slips",
           .required = true,
           .used = coulomb,
           .also = {"mu", "friction_coefficient"},
           .sole = "value"},
          [&](Visitor &inner) { declare(inner, friction.coefficient); });
  v.key({.name = "cohesion",
         .description = "part of Coulomb's bound that does not depend on the pressure",
         .unit = "N/m^2",
         .range = not_negative(sense::traction),
         .used = coulomb,
         .also = {"c"}},
        &friction.cohesion);
  v.optional({.name = "limit",
              .description = "Coulomb's bound grows no further with the pressure",
              .unit = "N/m^2",
              .range = not_negative(sense::traction),
              .default_words = "none",
              .used = coulomb,
              .also = {"tau_max", "cap"}},
             friction.limit);
  v.check("limit", [&] { return limit_complaint(friction); });
}

void declare(Visitor &v, FrictionCase &friction) {
  v.key({.name = "law",
         .description = "none: the foundation is slippery; tresca: the tangential traction stays "
                        "below a given bound, and slip is opposed by it (9); coulomb: likewise, "
                        "with the bound min(cohesion + mu p, limit), p being the contact pressure "
                        "-sigma_nu, and at least 0",
         .choices = {"none", "tresca", "coulomb"}},
        &friction.law);
  v.key({.name = "bound",
         .description = "friction bound S of Tresca's law (9)",
         .unit = "N/m^2",
         .required = true,
         .range = not_negative(sense::traction),
         .used = with("law", friction.law, {"tresca"}),
         .also = {"S"}},
        &friction.bound);
  declare_coulomb(v, friction);
}

void declare(Visitor &v, PressureConductanceCase &pressure) {
  v.key({.name = "coefficient",
         .description = "coefficient of heat exchange at the pressure `reference`",
         .unit = "W/(K m^2)",
         .required = true,
         .range = not_negative(sense::heat_exchange),
         .constant_in_time = true},
        &pressure.coefficient);
  v.key({.name = "reference",
         .description = "the pressure to which p is compared",
         .unit = "N/m^2",
         .required = true,
         .range = positive(sense::traction),
         .also = {"hardness"}},
        &pressure.reference);
  v.key({.name = "exponent",
         .description = "by which the exchange grows with the pressure",
         .range = positive(sense::contact_exponent)},
        &pressure.exponent);
}

Key ramp_key(const std::string &what, const Use &used) {
  return {
      .name = "ramp",
      .description = what +
                     " by clamp(1 - gap/ramp, 0, 1), gap being the opening at the end of "
                     "the step, so that it ends where the opening reaches this; what crosses is "
                     "then summed at the nodes, not integrated facet by facet",
      .unit = "m",
      .range = positive(sense::slip),
      .default_words = "it does not fade",
      .used = used};
}

void declare(Visitor &v, HeatExchangeCase &heat) {
  v.key({.name = "law",
         .description = "insulated: nothing but heat of friction crosses; exchange: q.nu = k_c "
                        "(theta - theta_f) (13)",
         .choices = {"insulated", "exchange"}},
        &heat.law);
  const Use exchange = with("law", heat.law, {"exchange"});
  v.key({.name = "coefficient",
         .description = "coefficient of heat exchange k_c (13)",
         .unit = "W/(K m^2)",
         .required = true,
         .range = not_negative(sense::heat_exchange),
         .constant_in_time = true,
         .used = exchange,
         .also = {"k_c"}},
        &heat.coefficient);
  v.key({.name = "foundation_temperature",
         .description = "temperature theta_f of the foundation (13), difference to the reference "
                        "temperature",
         .unit = "K",
         .required = true,
         .range = any(sense::temperature),
         .used = exchange,
         .also = {"theta_f"}},
        &heat.foundation_temperature);
  v.optional_table(
      {.name = "pressure",
       .description = "Exchange that grows with the contact pressure p = -sigma_nu: "
                      "coefficient (p/reference)^exponent is added to k_c; what it adds is summed "
                      "at the nodes, not integrated facet by facet",
       .used = exchange,
       .also = {"pressure_dependent"}},
      heat.pressure, [](Visitor &inner, PressureConductanceCase &value) { declare(inner, value); });
  v.optional(ramp_key("k_c fades as the contact opens,", exchange), heat.ramp);
  v.optional({.name = "friction_share",
              .description = "share of the power of friction that warms the body at the contact; "
                             "the foundation has the rest; there must be friction",
              .range = from_to(0., 1.),
              .default_words = "friction makes no heat",
              .also = {"frictional_heating", "share"}},
             heat.friction_share);
}

std::string unit_of_charge_exchange(const std::string &law) {
  if (law == "exchange")
    return "F/m^2";
  return law == "leak" ? "S/m^2" : "F/m^2 or S/m^2";
}

std::string complaint_about(const FoundationCircuitCase &circuit) {
  if (circuit.voltage.depends_on_place() || (circuit.charge && circuit.charge->depends_on_place()))
    return "depends on the place; a foundation has one potential and one charge, which may depend "
           "on t only";
  if (circuit.charge && (circuit.is_loaded() || !circuit.voltage.is_zero()))
    return "the foundation's charge is given, so neither a voltage nor a resistor or capacitor can "
           "be";
  if (!circuit.voltage.is_zero() && !circuit.is_loaded())
    return "a voltage is that of the other end of a resistor or capacitor, and there is none; for "
           "a foundation that has this potential itself give foundation_potential instead of "
           "circuit";
  return "";
}

void declare(Visitor &v, FoundationCircuitCase &circuit, bool is_per_depth) {
  v.optional(of_whole_body({.name = "charge",
                            .description = "charge on the foundation over time, -integral of D.nu",
                            .unit = "C",
                            .range = any(sense::charge)},
                           is_per_depth),
             circuit.charge);
  v.optional(of_whole_body({.name = "resistor",
                            .description = "resistance between the foundation and `voltage`",
                            .unit = "ohm",
                            .range = positive(sense::resistance)},
                           is_per_depth),
             circuit.resistor);
  v.optional(
      of_whole_body({.name = "capacitor",
                     .description = "capacitance between the same two, parallel to the resistor",
                     .unit = "F",
                     .range = positive(sense::capacitance)},
                    is_per_depth),
      circuit.capacitor);
  v.key({.name = "voltage",
         .description = "voltage of the other end of resistor and capacitor over time",
         .unit = "V",
         .range = any(sense::potential)},
        &circuit.voltage);
  v.check("", [&] { return complaint_about(circuit); });
}

std::string potential_complaint(const ChargeExchangeCase &electric) {
  if (electric.exchanges() && !electric.circuit && !electric.foundation_potential)
    return "`foundation_potential` is missing, the potential of the foundation [V], or `circuit`, "
           "what is connected to one whose potential is to be found";
  if (electric.circuit && electric.foundation_potential)
    return "both `foundation_potential` and `circuit` are given; the potential follows from the "
           "circuit";
  return "";
}

void declare(Visitor &v, ChargeExchangeCase &electric, bool is_per_depth) {
  v.key({.name = "law",
         .description = "insulated: no charge crosses; exchange: a capacitor, D.nu = c (phi - "
                        "phi_f); leak: a conductor, d(D.nu)/dt = c (phi - phi_f), D.nu being 0 at "
                        "the time 0",
         .choices = {"insulated", "exchange", "leak"},
         .choices_also = {{"capacitor", "exchange"}, {"conducting", "leak"}}},
        &electric.law);
  const Use crosses = with("law", electric.law, {"exchange", "leak"});
  v.key({.name = "coefficient",
         .description = "c of the law: of exchange in F/m^2, of leak in S/m^2",
         .unit = unit_of_charge_exchange(electric.law),
         .required = true,
         .range = not_negative(sense::charge_exchange),
         .constant_in_time = true,
         .used = crosses,
         .also = {"k", "k_e", "c"}},
        &electric.coefficient);
  v.optional_table(
      {.name = "circuit",
       .description =
           "A foundation that conducts and whose potential phi_f follows from what is connected to "
           "it: instead of foundation_potential. With `charge` it floats with that charge; a "
           "resistor or capacitor leads to ground or to a given voltage; with nothing it is open "
           "and keeps its charge at the time 0, at which its potential is 0. In 2D charges, "
           "resistances and capacitances are those of one metre of thickness",
       .used = crosses,
       .also = {"floating", "free"}},
      electric.circuit, [&](Visitor &inner, FoundationCircuitCase &circuit) {
        declare(inner, circuit, is_per_depth);
      });
  v.optional({.name = "foundation_potential",
              .description = "potential phi_f of the foundation; it or `circuit` is given",
              .unit = "V",
              .range = any(sense::potential),
              .used = crosses,
              .also = {"phi_f", "phi_0"}},
             electric.foundation_potential);
  v.check("", [&] { return potential_complaint(electric); });
  v.optional(ramp_key("c fades as the contact opens,", crosses), electric.ramp);
}

// Of the six shape functions on a facet those of the corners have the mean 0.
std::string weight_complaint(const MeshCase &mesh) {
  if (mesh.degree == 1 || (mesh.file && !mesh.content) || shape_of(mesh) != CellShape::tetrahedron)
    return "";
  return "contact on tetrahedra of degree 2 is not available, as the corners of their facets have "
         "no weight in the contact; give mesh.degree = 1, or hexahedra";
}

void declare(Visitor &v, ContactCase &contact, const MeshCase &mesh, int dimension,
             bool is_per_depth) {
  v.place(contact.where);
  v.places(contact.places);
  v.optional(
      {.name = "name",
       .description = "what the contact is called in files where there are several; letters, "
                      "digits, _ and -",
       .default_words = "the names of its boundaries, joined by +"},
      contact.name);
  v.key(on_sides("boundary, or list of boundaries, in contact with the foundation", mesh),
        &contact.on);
  v.check("on", [&] { return inside_complaint(contact.on, mesh); });
  v.check("on", [&] { return weight_complaint(mesh); });
  v.key({.name = "gap",
         .description = "g, by which body and foundation are apart along the normal at the time 0; "
                        "negative: pressed into each other",
         .unit = "m",
         .range = any(sense::coordinate),
         .constant_in_time = true,
         .also = {"g"}},
        &contact.gap);
  v.key({.name = "foundation_displacement",
         .description = "u_f, by which the foundation moves; slip and closing are measured to it",
         .unit = "m",
         .range = any(sense::coordinate),
         .length = one_each_axis(dimension),
         .default_words = "it rests",
         .also = {"u_f"}},
        &contact.foundation_displacement);
  v.table({.name = "normal",
           .description = "The contact law along the normal. One that needs no further key may be "
                          "given as a text: normal = \"unilateral\"",
           .sole = "law"},
          [&](Visitor &inner) { declare(inner, contact.normal); });
  v.refuse("charge", "what crosses of it is said by the table `electric`");
  v.table({.name = "friction",
           .description = "The tangential contact law. None may be given as a text: friction = "
                          "\"none\"",
           .sole = "law"},
          [&](Visitor &inner) { declare(inner, contact.friction); });
  v.table({.name = "heat",
           .description = "The heat flow between body and foundation. None may be given as a text: "
                          "heat = \"insulated\"",
           .sole = "law"},
          [&](Visitor &inner) { declare(inner, contact.heat); });
  v.table({.name = "electric",
           .description = "The charge that crosses between body and foundation. None may be given "
                          "as a text: electric = \"insulated\"",
           .sole = "law"},
          [&](Visitor &inner) { declare(inner, contact.electric, is_per_depth); });
}

}  // namespace

namespace {

// `normal = "unilateral"` or `friction.law = "coulomb"`: the first law that changes with the
// contact's state; empty: there is none.
std::string law_of_the_state(const std::vector<ContactCase> &contacts) {
  for (const ContactCase &contact : contacts) {
    if (contact.normal.law != "bilateral")
      return "normal = \"" + contact.normal.law + "\"";
    if (contact.friction.law == "coulomb")
      return "friction.law = \"coulomb\"";
    if (std::string key = contact.crosses_by_state(); !key.empty())
      return key;
  }
  return "";
}

}  // namespace

std::string multiplier_complaint(const std::vector<ContactCase> &contacts,
                                 const std::string &multiplier) {
  if (multiplier == "nodal")
    return "";
  if (contacts.size() > 1)
    return fmt::format(
        "several contacts are not available with solver.multiplier = \"{}\" in this version; take "
        "\"nodal\"",
        multiplier);
  const std::string law = law_of_the_state(contacts);
  if (law.empty())
    return "";
  return fmt::format(
      "contact with {} is not available with solver.multiplier = \"{}\" in this version; take "
      "\"nodal\"",
      law, multiplier);
}

void declare_contacts(Visitor &v, std::vector<ContactCase> &contacts, const MeshCase &mesh,
                      int dimension, bool is_per_depth) {
  const Key key = {.name = "contact",
                   .description =
                       "Contact with a foundation that does not deform. Without this table "
                       "there is no contact; several contacts, each under [[contact]], have "
                       "boundaries and laws of their own",
                   .may_be_table = true};
  v.entries(key, contacts, [&](Visitor &inner, ContactCase &value) {
    declare(inner, value, mesh, dimension, is_per_depth);
  });
}

}  // namespace tourmaline::casefile
