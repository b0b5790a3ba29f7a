#include "random_sample.h"

#include <fmt/format.h>

#include "material/library.h"
#include "random_mesh.h"
#include "tourmaline/case/case.h"

namespace tourmaline::verified {
namespace {

// The sizes at which what the loads do in a body of BaTiO3 of `length` [m] is alike.
double typical(const std::string &key, double length) {
  constexpr double strain = 2e-7, stress = 1e4, charge = 4e-6, warmth = 5e-3;  // K
  static const std::map<std::string, std::pair<double, int>> all{
      {"displacement", {strain, 1}},
      {"traction", {stress, 0}},
      {"bound", {stress, 0}},
      {"force", {stress, -1}},
      {"potential", {1e4, 1}},
      {"voltage", {1e4, 1}},
      {"surface_charge", {charge, 0}},
      {"charge", {charge, -1}},
      {"temperature", {warmth, 0}},
      {"foundation_temperature", {warmth, 0}},
      {"heat_flux", {50 * warmth, -1}},
      {"heat", {50 * warmth, -2}},
      {"exchanged heat", {50, -1}},
      {"exchanged charge", {charge / 1e4, -1}},
      {"foundation_potential", {1e4, 1}},
      {"foundation_displacement", {strain, 1}},
      {"gap", {strain, 1}},
      {"compliance", {stress / strain, -1}},
      {"coulomb", {0.15, 0}},
      {"cohesion", {stress / 10, 0}},
      {"pressure", {stress, 0}}};
  const auto &[size, power] = all.at(key);
  return size * std::pow(length, power);
}

Term random_term(const std::string &key, double length, int rows, int dimension, Random &random) {
  const char *courses[] = {"{}", "{}^2", "sin(3*{})", "(1 - 2*{})"};
  const double size = typical(key, length);
  return {courses[random.below(4)], size * random.matrix(rows, 1),
          size / length * random.matrix(rows, dimension)};
}

// Of the friction and exchange laws: positive, as they must be, at every place.
Term positive_term(const std::string &key, double length, int dimension, Random &random) {
  return {"1", Eigen::VectorXd::Constant(1, random.sized(0.3, 3) * typical(key, length)),
          0.05 * typical(key, length) / length * random.matrix(1, dimension)};
}

SampleMaterial random_material(int dimension, Random &random) {
  SampleMaterial material;
  const char *classes[] = {"6mm", "mm2", "3m"};  // a plane body must not drive u_z
  material.symmetry = classes[random.below(dimension)];
  casefile::MaterialCase ceramic;
  ceramic.library = "BaTiO3-Liu2014";
  std::map<std::string, double> &c = material.constants;
  c = material::find(ceramic).given.constants;
  if (material.symmetry == "3m")
    c.insert({{"c14", 9e9}, {"e22", 3}});
  else if (material.symmetry == "mm2")
    for (const auto &[key, like, ratio] : {std::tuple{"c22", "c11", 0.9},
                                           {"c23", "c13", 0.9},
                                           {"c55", "c44", 1.2},
                                           {"c66", "c44", 1.1},
                                           {"e32", "e31", 0.7},
                                           {"e24", "e15", 1.2},
                                           {"beta22", "beta11", 0.8},
                                           {"m22", "m11", 0.9},
                                           {"k22", "k11", 0.6}})
      c[key] = ratio * c.at(like);
  const double stiffer = random.sized(0.7, 1.5);
  for (auto &[key, value] : c)
    value *= (key[0] == 'c' ? stiffer : 1) * random.between(0.96, 1.04);
  c["reference_temperature"] = 293;  // one for the whole body
  material.poling = random.matrix(dimension, 1);
  material.axis1 = random.matrix(dimension, 1);
  return material;
}

/// Adds the conditions of a case one by one.
class Builder {
 public:
  Builder(Sample &sample, double length, Random &random)
      : sample_(sample), length_(length), random_(random) {}

  Condition &add(const std::string &table, int side, const std::string &key) {
    const bool is_vector = key.ends_with("displacement") || key == "traction" || key == "force";
    const int rows = is_vector ? sample_.dimension() : 1;
    return put(table, side < 0 ? "" : fmt::format("side{}", side), key,
               random_term(key, length_, rows, sample_.dimension(), random_));
  }
  // Of the size that is typical of `like`.
  Condition &add_law(const std::string &table, const std::string &key, const std::string &like) {
    Condition &law =
        put(table, "", key, positive_term(like, length_, sample_.dimension(), random_));
    law.is_law = true;
    return law;
  }
  Condition &add_law(const std::string &table, const std::string &key) {
    return add_law(table, key, key);
  }
  void add_number(const std::string &key, const std::string &like) {
    sample_.numbers[key] = random_.sized(0.3, 3) * typical(like, length_);
  }
  // A plane of symmetry, or one whose support moves.
  void add_roller(int side, int axis) {
    Condition &roller = add("boundary", side, "displacement");
    roller.free.assign(sample_.dimension(), true);
    roller.free[axis] = false;
    roller.terms[0].gradient.setZero();
    if (random_.chance(0.4))
      roller.terms[0].value.setZero();
  }

 private:
  Condition &put(const std::string &table, const std::string &on, const std::string &key,
                 Term term) {
    sample_.conditions.push_back({table, on, key, {std::move(term)}});
    return sample_.conditions.back();
  }

  Sample &sample_;
  double length_;
  Random &random_;
};

MeshShape random_shape(int dimension, int degree, int contact, Random &random) {
  MeshShape shape;
  shape.dimension = dimension;
  const bool solid = shape.dimension == 3;
  shape.simplices = random.chance(0.5);
  shape.ring = contact < 2 && random.chance(0.5);
  const double length = random.sized(0.01, 0.1);
  for (int axis = 0; axis < shape.dimension; ++axis) {
    shape.size.push_back(length * random.between(0.7, 1));
    shape.cells.push_back(2 + random.below(solid || degree == 2 ? 2 : 4));
  }
  if (shape.ring) {
    shape.size[0] = 0.5 * shape.size[1];
    shape.cells[1] = 9 + random.below(3);  // facets within 41 degrees of the mean normal
    shape.cells[0] = 2;
  }
  shape.regions = 1 + random.below(2);
  shape.layered = contact;
  return shape;
}

// So small that there is one solution.
void add_coulomb(Builder &add, Sample &sample, Random &random) {
  sample.laws["contact.friction"] = "coulomb";
  add.add_law("contact.friction", "coefficient", "coulomb");
  if (random.chance(0.5))
    add.add_law("contact.friction", "cohesion");
  if (random.chance(0.3))
    add.add_law("contact.friction", "limit", "bound").terms[0].value *= 2;  // above the cohesion
}

void add_tresca(Builder &add, Sample &sample, double larger) {
  sample.laws["contact.friction"] = "tresca";
  Term &bound = add.add_law("contact.friction", "bound").terms[0];
  bound.value *= larger;
  bound.gradient *= larger;
}

// One that opens.
void add_normal_law(Builder &add, Sample &sample, Random &random) {
  const char *laws[] = {"unilateral", "compliance", "damped"};
  const std::string law = laws[random.below(3)];
  sample.laws["contact.normal"] = law;
  if (law == "unilateral")
    return;
  Term &c = add.add_law("contact.normal", "coefficient", "compliance").terms[0];
  if (law == "damped") {
    c.value *= sample.end;
    c.gradient *= sample.end;
  }
}

void add_charge(Builder &add, Sample &sample, Random &random) {
  sample.laws["contact.electric"] = random.chance(0.4) ? "exchange" : "leak";
  Term &c = add.add_law("contact.electric", "coefficient", "exchanged charge").terms[0];
  if (sample.laws["contact.electric"] == "leak") {
    c.value /= sample.end;
    c.gradient /= sample.end;
  }
  add.add("contact.electric", -1, "foundation_potential");
  if (random.chance(0.5))
    add.add_number("contact.electric.ramp", "gap");
}

// Heat by the contact's state.
void add_heat(Builder &add, Sample &sample, Random &random) {
  if (random.chance(0.5)) {
    add.add_law("contact.heat.pressure", "coefficient", "exchanged heat");
    add.add_number("contact.heat.pressure.reference", "pressure");
  }
  if (random.chance(0.5))
    add.add_number("contact.heat.ramp", "gap");
  if (sample.laws.contains("contact.friction") && random.chance(0.8))
    sample.numbers["contact.heat.friction_share"] = random.between(0, 1);
}

struct ContactWish {
  bool opens;  ///< it may
  bool rubs;   ///< friction and what crosses may depend on the pressure
  bool moves;  ///< a support moves some of its points
};

void add_contact(Builder &add, Sample &sample, int side, const ContactWish &here, const Wish &wish,
                 Random &random) {
  sample.contact = fmt::format("side{}", side);
  if (here.opens && random.chance(0.6))
    add_normal_law(add, sample, random);
  if (!wish.linear && random.chance(0.4))
    add.add_law("contact", "gap").terms[0].value *= random.chance(0.5) ? 1 : -1;
  // A point that a support moves rubs, however much friction there is.
  if (wish.linear ? !here.moves && random.chance(0.6) : random.chance(0.85)) {
    // Tresca's friction jumps where contact opens: there may be several solutions.
    if (here.rubs && (sample.laws.contains("contact.normal") || random.chance(0.4)))
      add_coulomb(add, sample, random);
    else
      add_tresca(add, sample, wish.linear ? 1e6 : 1);
  }
  if (random.chance(0.4))
    add.add("contact", -1, "foundation_displacement");
  if (random.chance(0.6)) {
    sample.laws["contact.heat"] = "exchange";
    add.add_law("contact.heat", "coefficient", "exchanged heat");
    add.add("contact.heat", -1, "foundation_temperature");
    if (!wish.linear && here.rubs && random.chance(0.7))
      add_heat(add, sample, random);
  }
  if (!wish.linear && here.rubs && random.chance(0.6))
    add_charge(add, sample, random);
}

void add_electrode(Builder &add, int side, bool resistors, Random &random) {
  Condition &electrode = add.add("electrode", side, "voltage");
  electrode.terms[0].gradient.setZero();
  if (resistors && random.chance(0.5))
    electrode.resistor = random.sized(1e6, 1e9);
}

void make_body(Sample &sample, const MeshShape &shape, Random &random) {
  sample.mesh = random_mesh(shape, random);
  sample.incompatible = sample.degree == 1 && !shape.simplices && random.chance(0.5);
  for (int i = 0; i < shape.regions; ++i)
    sample.materials.push_back(random_material(shape.dimension, random));
  // A conductor beside the contact: region1 has the potential's side.
  sample.materials[0].conductor = shape.regions == 2 && random.chance(0.3);
  if (sample.materials[0].conductor)
    std::erase_if(sample.materials[0].constants, [](const auto &constant) {
      return std::string_view("bep").find(constant.first[0]) != std::string_view::npos;
    });
}

// Opposite to the contact, and on sides along the other axes: the lower ones for rollers.
void add_supports(Builder &add, Sample &sample, const MeshShape &shape, const Wish &wish,
                  Random &random) {
  const int contact = shape.layered, held = contact ^ 1;
  // Quadratic tetrahedra have no contact: their corners have no weight in nodal quadrature.
  const bool can_touch = shape.dimension == 2 || !shape.simplices || sample.degree == 1,
             touches = can_touch && random.chance(0.85), rolls = !shape.ring && random.chance(0.4),
             only_rollers = rolls && touches && random.chance(0.5),
             rimmed = shape.ring && shape.dimension == 3 && random.chance(0.5);
  add.add("boundary", held, "potential");
  add.add("boundary", held, "temperature");
  add.add("boundary", held, only_rollers ? "traction" : "displacement");
  if (touches)
    add_contact(add, sample, contact,
                // Not available at points that are held obliquely to the normal.
                {.opens = !wish.linear && !only_rollers && !rimmed,
                 .rubs = !wish.linear && !rimmed,
                 .moves = rolls || rimmed},
                wish, random);
  for (int axis = 0; axis < shape.dimension && rolls; ++axis)
    if (axis != contact / 2 && (only_rollers || random.chance(0.6)))
      add.add_roller(2 * axis, axis);
  if (rimmed)
    add.add_roller(4, random.below(3));
}

void add_loads(Builder &add, Sample &sample, const MeshShape &shape, const Wish &wish,
               Random &random) {
  const bool conducts = sample.materials[0].conductor;
  const int side = shape.ring ? 5 : shape.layered < 2 ? 3 : 1;
  const bool has_side = !shape.ring || shape.dimension == 3, electrode = random.chance(0.4);
  // An electrode at the contact would take what crosses there; one that floats is not available
  // beside it either.
  const bool charges = sample.laws.contains("contact.electric"),
             beside = has_side && (charges || random.chance(0.5));
  if (electrode && (beside || !charges))
    add_electrode(add, beside ? side : shape.layered, wish.resistors && !charges, random);
  if (has_side) {
    add.add("boundary", side, "traction");
    add.add("boundary", side, "heat_flux");
    if (!electrode && !conducts)
      add.add("boundary", side, "surface_charge");
  }
  for (const std::string key : {"force", "charge", "heat"})
    if (random.chance(0.6) && !(conducts && key == "charge"))
      add.add("load", -1, key);
}

}  // namespace

Sample random_sample(Random &random, const Wish &wish) {
  Sample sample;
  sample.degree = 1 + random.below(2);
  sample.end = random.sized(1, 100);
  const int dimension = 2 + random.below(2);
  const MeshShape shape =
      random_shape(dimension, sample.degree, random.below(2 * dimension), random);
  make_body(sample, shape, random);
  Builder add(sample, shape.size.back(), random);
  add_supports(add, sample, shape, wish, random);
  add_loads(add, sample, shape, wish, random);
  return sample;
}

Sample with_other_loads(Sample sample, Random &random) {
  for (Condition &condition : sample.conditions)
    if (!condition.is_law)
      for (Term &term : condition.terms) {
        const Eigen::Index rows = term.value.size();
        term.value = term.value.cwiseProduct(random.matrix(rows, 1)).eval();
        term.gradient =
            term.gradient.cwiseProduct(random.matrix(rows, term.gradient.cols())).eval();
        term.course = random.chance(0.5) ? "cos(2*{})" : "{}^3";
      }
  return sample;
}

}  // namespace tourmaline::verified
