#include "schema_parts.h"
#include "sense.h"
#include "tourmaline/case/contact_case.h"
#include "tourmaline/case/mesh_case.h"

namespace tourmaline::casefile {

namespace {

void declare(Visitor &v, FrictionCase &friction) {
  for (const char *name : {"coefficient", "cohesion", "limit"})
    v.refuse(name,
             "belongs to Coulomb's law, which is not available in this version; law = \"tresca\" "
             "has `bound`");
  v.key({.name = "law",
         .description = "none: the foundation is slippery; tresca: the tangential traction stays "
                        "below a given bound, and slip is opposed by it (9)",
         .choices = {"none", "tresca"},
         .foreseen = {"coulomb", "slip_rate"}},
        &friction.law);
  v.key({.name = "bound",
         .description = "friction bound S of Tresca's law (9)",
         .unit = "N/m^2",
         .required = true,
         .range = not_negative(sense::traction),
         .used = with("law", friction.law, {"tresca"}),
         .also = {"S"}},
        &friction.bound);
}

void declare(Visitor &v, HeatExchangeCase &heat) {
  v.key({.name = "law",
         .description = "insulated: no heat crosses; exchange: q.nu = k_c (theta - theta_f) (13)",
         .choices = {"insulated", "exchange"},
         .foreseen = {"pressure_dependent", "frictional_heating"}},
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
}

// Of the six shape functions on a facet those of the corners have the mean 0.
std::string weight_complaint(const MeshCase &mesh) {
  if (mesh.degree == 1 || (mesh.file && !mesh.content) || shape_of(mesh) != CellShape::tetrahedron)
    return "";
  return "contact on tetrahedra of degree 2 is not available, as the corners of their facets have "
         "no weight in the contact; give mesh.degree = 1, or hexahedra";
}

void declare(Visitor &v, ContactCase &contact, const MeshCase &mesh) {
  v.place(contact.where);
  v.places(contact.places);
  v.key(on_sides("boundary, or list of boundaries, in contact with the foundation", mesh),
        &contact.on);
  v.check("on", [&] { return inside_complaint(contact.on, mesh); });
  v.check("on", [&] { return weight_complaint(mesh); });
  v.key({.name = "normal",
         .description = "bilateral: contact is never lost, u_nu = 0 (9)",
         .choices = {"bilateral"},
         .foreseen = {"unilateral", "signorini", "compliance", "normal_compliance", "damped",
                      "damped_response"}},
        &contact.normal.law);
  v.refuse("charge", "not available in this version; no charge crosses the contact boundary");
  v.refuse("electric", "not available in this version; no charge crosses the contact boundary");
  v.refuse("gap", "not available in this version; body and foundation touch at the time 0");
  v.refuse("foundation_displacement", "not available in this version; the foundation rests");
  v.table({.name = "friction", .description = "The tangential contact law"},
          [&](Visitor &inner) { declare(inner, contact.friction); });
  v.table({.name = "heat", .description = "The heat flow between body and foundation"},
          [&](Visitor &inner) { declare(inner, contact.heat); });
}

}  // namespace

void declare_contact(Visitor &v, std::optional<ContactCase> &contact, const MeshCase &mesh) {
  const Key key = {.name = "contact",
                   .description =
                       "Contact with a foundation that does not deform. Without this table "
                       "there is no contact"};
  v.optional_table(key, contact,
                   [&](Visitor &inner, ContactCase &value) { declare(inner, value, mesh); });
}

}  // namespace tourmaline::casefile
