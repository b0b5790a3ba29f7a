#include "material/crystal_class.h"

#include <fmt/format.h>

#include "tourmaline/error.h"

namespace tourmaline::material {

double CrystalClass::need(const std::string &constant) const {
  const auto found = named.find(constant);
  if (found == named.end())
    throw CaseError(
        fmt::format("{} {} is missing: give it, or a library entry that has it "
                    "(`tourmaline materials` lists them)",
                    where, constant));
  return found->second;
}

namespace {

Stiffness isotropic(double young, double poisson) {
  const double shear = young / (2 * (1 + poisson));
  const double lame = young * poisson / ((1 + poisson) * (1 - 2 * poisson));
  Stiffness c = Stiffness::Zero();
  c.topLeftCorner<3, 3>().setConstant(lame);
  c.diagonal() << lame + 2 * shear, lame + 2 * shear, lame + 2 * shear, shear, shear, shear;
  return c;
}

// c, or s, whose entries with one Voigt index above 3 count twice and with two four times: the
// relations of the class then hold between c_IJ and s_IJ over that factor.
Stiffness elastic(const CrystalClass &crystal, const std::string &letter, double shear) {
  const auto get = [&](const char *indices) { return crystal.need(letter + indices); };
  const bool cubic = crystal.symmetry == "cubic", orthorhombic = crystal.symmetry == "mm2";
  const double m11 = get("11"), m12 = get("12"), m44 = get("44");
  const double m13 = cubic ? m12 : get("13"), m33 = cubic ? m11 : get("33");
  const double m22 = orthorhombic ? get("22") : m11, m23 = orthorhombic ? get("23") : m13;
  Stiffness m = Stiffness::Zero();
  m.topLeftCorner<3, 3>() << m11, m12, m13, m12, m22, m23, m13, m23, m33;
  const double axial = shear * shear * (m11 - m12) / 2;  // isotropic about axis 3
  m.diagonal().tail<3>() << m44, orthorhombic ? get("55") : m44,
      cubic          ? m44
      : orthorhombic ? get("66")
                     : axial;
  if (crystal.symmetry == "3m" || crystal.symmetry == "32") {
    const double m14 = get("14");
    m(0, 3) = m(3, 0) = m14;
    m(1, 3) = m(3, 1) = -m14;
    m(4, 5) = m(5, 4) = shear * m14;
  }
  return m;
}

// e, or d, whose columns above 3 count twice (`shear` = 2).
Piezoelectric piezoelectric(const CrystalClass &crystal, const std::string &letter, double shear) {
  const auto get = [&](const char *indices) { return crystal.need(letter + indices); };
  Piezoelectric e = Piezoelectric::Zero();
  if (crystal.symmetry == "32") {
    e.row(0) << get("11"), -get("11"), 0, get("14"), 0, 0;
    e.row(1) << 0, 0, 0, 0, -get("14"), -shear * get("11");
    return e;
  }
  const bool orthorhombic = crystal.symmetry == "mm2";
  e(0, 4) = get("15");
  e(1, 3) = orthorhombic ? get("24") : get("15");
  e.row(2).head<3>() << get("31"), orthorhombic ? get("32") : get("31"), get("33");
  if (crystal.symmetry == "3m") {
    e(0, 5) = -shear * get("22");
    e(1, 0) = -get("22");
    e(1, 1) = get("22");
  }
  return e;
}

}  // namespace

Stiffness CrystalClass::stiffness() const {
  if (symmetry == "isotropic")
    return isotropic(need("young"), need("poisson"));
  return elastic(*this, "c", 1);
}

Stiffness CrystalClass::compliance() const {
  return elastic(*this, "s", 2);
}

Piezoelectric CrystalClass::stress_coefficients() const {
  return piezoelectric(*this, "e", 1);
}

Piezoelectric CrystalClass::strain_coefficients() const {
  return piezoelectric(*this, "d", 2);
}

Vector CrystalClass::diagonal(const std::string &letters, const std::string &suffix) const {
  const auto get = [&](const char *indices) { return need(letters + indices + suffix); };
  const bool all_alike = symmetry == "isotropic" || symmetry == "cubic";
  const double along1 = get("11");
  return {along1, symmetry == "mm2" ? get("22") : along1, all_alike ? along1 : get("33")};
}

}  // namespace tourmaline::material
