#include "case/conflicts.h"

#include <fmt/format.h>

#include <map>
#include <utility>

#include "case/place_of_key.h"
#include "case/toml_text.h"
#include "tourmaline/case/case.h"
#include "tourmaline/error.h"

namespace tourmaline::casefile {

std::vector<std::string> parts_of_boundary(const MeshCase &mesh, const std::string &boundary) {
  if (!mesh.content)
    return {boundary};
  std::vector<std::string> all;
  for (const int set : mesh.content->boundaries.sets_with(boundary))
    all.push_back(std::to_string(set));
  return all;
}

namespace {

/// What has been prescribed so far: part of the boundary and field -> the formula that prescribes
/// it. A side of a box is one part; names in a mesh file may share parts.
class Prescribed {
 public:
  explicit Prescribed(const MeshCase &mesh) : mesh_(mesh) {}

  void add(const std::string &boundary, const std::string &field, const Formula &formula) {
    for (const std::string &part : parts(boundary)) {
      const auto [entry, is_new] = claims_.try_emplace({part, field}, formula);
      if (!is_new)
        throw CaseError(
            fmt::format("{}: \"{}\" has already a condition on the {}, {}; one is possible",
                        stated(formula), boundary, field, stated(entry->second)));
    }
  }

  const Formula *find(const std::string &boundary, const std::string &field) const {
    for (const std::string &part : parts(boundary))
      if (const auto entry = claims_.find({part, field}); entry != claims_.end())
        return &entry->second;
    return nullptr;
  }

  std::vector<std::string> parts(const std::string &boundary) const {
    return parts_of_boundary(mesh_, boundary);
  }

  // "case.toml:12:13 [boundary[0]] potential = 0"
  static std::string stated(Formula formula) {
    return fmt::format("{} = {}", formula.where(), toml_text(Value(&formula)));
  }

 private:
  const MeshCase &mesh_;
  std::map<std::pair<std::string, std::string>, Formula> claims_;
};

std::string component(int axis) {
  return fmt::format("{} component of displacement or traction", "xyz"[axis]);
}

const std::string electric = "potential or surface charge";
const std::string thermal = "temperature or heat flow";
const std::string whole_traction = "traction";

void add_mechanics(Prescribed &prescribed, const BoundaryCase &boundary, const std::string &name) {
  if (boundary.displacement)
    for (std::size_t i = 0; i < boundary.displacement->size(); ++i)
      if (const auto &formula = (*boundary.displacement)[i])
        prescribed.add(name, component(static_cast<int>(i)), *formula);
  if (!boundary.traction)
    return;
  prescribed.add(name, whole_traction, boundary.traction->front());
  for (std::size_t i = 0; i < boundary.traction->size(); ++i)
    if (const Formula &formula = (*boundary.traction)[i]; !formula.is_zero())
      prescribed.add(name, component(static_cast<int>(i)), formula);
}

void add(Prescribed &prescribed, const BoundaryCase &boundary, const std::string &name) {
  add_mechanics(prescribed, boundary, name);
  for (const auto *formula : {&boundary.potential, &boundary.surface_charge})
    if (*formula)
      prescribed.add(name, electric, **formula);
  for (const auto *formula : {&boundary.temperature, &boundary.heat_flux})
    if (*formula)
      prescribed.add(name, thermal, **formula);
}

[[noreturn]] void fail(const ContactCase &contact, const std::string &boundary,
                       const Formula &formula, const std::string &reason) {
  throw CaseError(fmt::format("{} = \"{}\": {}, by {}",
                              place_of_key(contact.places, contact.where, "on"), boundary, reason,
                              Prescribed::stated(formula)));
}

void check_contact(const ContactCase &contact, const std::string &boundary, int dimension,
                   const Prescribed &prescribed) {
  if (const Formula *formula = prescribed.find(boundary, whole_traction))
    fail(contact, boundary, *formula,
         "the traction on a contact boundary is the law's, but is given as well");
  for (int axis = 0; axis < dimension; ++axis)
    if (const Formula *formula = prescribed.find(boundary, component(axis)))
      fail(contact, boundary, *formula,
           fmt::format(
               "contact on a clamped boundary; its displacement along {} is prescribed. To move "
               "contact nodes, prescribe that on a boundary that shares them",
               "xyz"[axis]));
  if (const Formula *formula = prescribed.find(boundary, thermal);
      formula && contact.heat.exchanges())
    fail(contact, boundary, *formula,
         "heat.law = \"exchange\" says what heat flows there, but it is prescribed as well");
  if (const Formula *formula = prescribed.find(boundary, electric);
      formula && contact.electric.exchanges())
    fail(contact, boundary, *formula,
         fmt::format("electric.law = \"{}\" says what charge crosses there, but it is prescribed "
                     "as well",
                     contact.electric.law));
}

/// Part of the boundary -> the contact there, and its name for it.
using Touched = std::map<std::string, std::pair<const ContactCase *, std::string>>;

[[noreturn]] void fail_twice(const ContactCase &contact, const std::string &name,
                             const ContactCase &other, const std::string &other_name) {
  const std::string place = place_of_key(contact.places, contact.where, "on");
  if (&contact == &other)
    throw CaseError(
        fmt::format("{}: \"{}\" and \"{}\" are in part the same boundary; name one of them", place,
                    other_name, name));
  throw CaseError(fmt::format(
      "{} = \"{}\": {} in contact already, by {} = \"{}\"; a boundary can have one contact", place,
      name, name == other_name ? "this boundary is" : "part of this boundary is",
      place_of_key(other.places, other.where, "on"), other_name));
}

// A facet in contact under two names, or in two contacts, would count twice.
void check_contact_once(const ContactCase &contact, const Prescribed &prescribed,
                        Touched &touched) {
  for (const std::string &name : contact.on)
    for (const std::string &part : prescribed.parts(name))
      if (const auto [entry, is_new] = touched.try_emplace(part, &contact, name); !is_new)
        fail_twice(contact, name, *entry->second.first, entry->second.second);
}

// Its potential is the electrode's: nothing of it follows from what crosses.
void check_electrode(const ElectrodeCase &electrode, const Touched &touched,
                     const Prescribed &prescribed) {
  for (const std::string &name : electrode.on)
    for (const std::string &part : prescribed.parts(name))
      if (const auto found = touched.find(part);
          found != touched.end() && found->second.first->electric.exchanges())
        throw CaseError(fmt::format(
            "{} = \"{}\": the electrode says what the potential on this boundary is, but it is in "
            "a contact with electric.law = \"{}\", {}, as well; leave out one of them",
            place_of_key(electrode.places, electrode.where, "on"), name,
            found->second.first->electric.law,
            place_of_key(found->second.first->places, found->second.first->where, "electric")));
}

}  // namespace

void check_conflicts(const Case &asked) {
  Prescribed prescribed(asked.mesh);
  for (const BoundaryCase &boundary : asked.boundaries)
    for (const std::string &name : boundary.on)
      add(prescribed, boundary, name);
  for (const ElectrodeCase &electrode : asked.electrodes)
    for (const std::string &name : electrode.on)
      if (const Formula *formula = prescribed.find(name, electric))
        throw CaseError(
            fmt::format("{} = \"{}\": this boundary has already a condition on the {}, {}; "
                        "one is possible",
                        place_of_key(electrode.places, electrode.where, "on"), name, electric,
                        Prescribed::stated(*formula)));
  Touched touched;
  for (const ContactCase &contact : asked.contacts) {
    check_contact_once(contact, prescribed, touched);
    for (const std::string &name : contact.on)
      check_contact(contact, name, asked.dimension, prescribed);
  }
  for (const ElectrodeCase &electrode : asked.electrodes)
    check_electrode(electrode, touched, prescribed);
}

}  // namespace tourmaline::casefile
