#include <gtest/gtest.h>

#include <cmath>

#include "material/library.h"
#include "material/orientation.h"
#include "material/plane.h"
#include "tourmaline/case/case.h"
#include "tourmaline/error.h"

namespace tourmaline::material {
namespace {

casefile::MaterialCase batio3() {
  casefile::MaterialCase asked;
  asked.library = "BaTiO3-Liu2014";
  return asked;
}

// Quadratic and linear forms of the constants for a strain, a field and a rotation of both.
Voigt strain_voigt(const Tensor &s) {
  Voigt v;
  v << s(0, 0), s(1, 1), s(2, 2), 2 * s(1, 2), 2 * s(0, 2), 2 * s(0, 1);
  return v;
}

TEST(Material, TheLibraryHoldsThePapersConstants) {
  const Constants c = constants_of(batio3());
  EXPECT_EQ(c.stiffness(0, 0), 166e9);
  EXPECT_EQ(c.stiffness(0, 2), 78e9);
  EXPECT_EQ(c.stiffness(2, 2), 162e9);
  EXPECT_EQ(c.stiffness(4, 4), 43e9);
  EXPECT_EQ(c.stiffness(5, 5), (166e9 - 77e9) / 2);
  EXPECT_EQ(c.piezoelectric(2, 0), -4.4);
  EXPECT_EQ(c.piezoelectric(2, 2), 18.6);
  EXPECT_EQ(c.piezoelectric(0, 4), 11.6);
  EXPECT_EQ(c.permittivity(2, 2), 12.6e-9);
  EXPECT_EQ(c.thermal_stress[2], 1.89e6);
  EXPECT_EQ(c.pyroelectric[2], -1e-4);
  EXPECT_NEAR(c.heat_capacity(), 5500 * 420 / 293., 1e-9);
}

TEST(Material, InTwoDimensionsThePlaneIsTheCrystals13Plane) {
  // The printed matrix of section 4.
  const BodyConstants<2> c =
      restricted<2>(rotated(constants_of(batio3()), crystal_axes(batio3(), 2)));
  Eigen::Matrix4d stiffness;  // xx, yy, zz, xy: the crystal's 11, 33, 22, 13
  stiffness << 166e9, 78e9, 77e9, 0, 78e9, 162e9, 78e9, 0, 77e9, 78e9, 166e9, 0, 0, 0, 0, 43e9;
  EXPECT_LT((c.stiffness - stiffness).norm(), 1e-3);
  Eigen::Matrix<double, 2, 4> piezoelectric;
  piezoelectric << 0, 0, 0, 11.6, -4.4, 18.6, -4.4, 0;
  EXPECT_LT((c.piezoelectric - piezoelectric).norm(), 1e-13);
  EXPECT_LT((c.thermal_stress - Eigen::Vector4d(2.24e6, 1.89e6, 2.24e6, 0)).norm(), 1e-8);
  EXPECT_LT((c.conductivity - Eigen::Matrix2d(Eigen::Vector2d(50, 75).asDiagonal())).norm(), 1e-12);
}

TEST(Material, RotatingTheCrystalAndTheStateLeavesEveryEnergyAsItWas) {
  Constants crystal = constants_of(batio3());
  crystal.stiffness(0, 3) = crystal.stiffness(3, 0) = 5e9;  // less symmetric than 6mm
  crystal.piezoelectric(1, 4) = 2;
  crystal.thermal_stress[4] = 3e5;
  const Tensor r = (Eigen::AngleAxisd(0.7, Vector(1, 2, 3).normalized())).toRotationMatrix();
  const Constants body = rotated(crystal, r);
  Tensor strain;
  strain << 1, 0.3, -0.2, 0.3, -2, 0.5, -0.2, 0.5, 0.7;
  const Vector field(0.4, -1, 2);
  const Voigt in_crystal = strain_voigt(strain), in_body = strain_voigt(r * strain * r.transpose());
  const auto close = [](double a, double b) { EXPECT_NEAR(a, b, 1e-12 * std::abs(a)); };
  close(in_crystal.dot(crystal.stiffness * in_crystal), in_body.dot(body.stiffness * in_body));
  close(field.dot(crystal.piezoelectric * in_crystal),
        (r * field).dot(body.piezoelectric * in_body));
  close(crystal.thermal_stress.dot(in_crystal), body.thermal_stress.dot(in_body));
  close(field.dot(crystal.permittivity * field), (r * field).dot(body.permittivity * (r * field)));
  close(crystal.pyroelectric.dot(field), body.pyroelectric.dot(r * field));
}

TEST(Material, PolingTurnsTheAxisOfIsotropyIntoItsDirection) {
  casefile::MaterialCase asked = batio3();
  asked.poling = {1, 0, 0};
  const Constants c = rotated(constants_of(asked), crystal_axes(asked, 3));
  EXPECT_NEAR(c.stiffness(0, 0), 162e9, 1);
  EXPECT_NEAR(c.piezoelectric(0, 0), 18.6, 1e-12);
  EXPECT_NEAR(c.pyroelectric[0], -1e-4, 1e-18);
  EXPECT_NEAR(c.permittivity(0, 0), 12.6e-9, 1e-20);
}

TEST(Material, InThePlanePyroelectricMeansTheComponents1And3) {
  casefile::MaterialCase asked = batio3();
  asked.pyroelectric = {3e-5, 1e-4};
  const BodyConstants<2> c = restricted<2>(rotated(constants_of(asked), crystal_axes(asked, 2)));
  EXPECT_NEAR(c.pyroelectric[0], 3e-5, 1e-18);
  EXPECT_NEAR(c.pyroelectric[1], 1e-4, 1e-18);
}

TEST(Material, AMissingConstantIsAnErrorAndNotADefault) {
  casefile::MaterialCase asked;
  asked.constants = {{"c11", 1e9}};
  try {
    constants_of(asked);
    FAIL();
  } catch (const CaseError &error) {
    EXPECT_NE(std::string(error.what()).find("c12"), std::string::npos);
  }
}

TEST(Material, AnEnergyThatIsNotPositiveIsRefused) {
  casefile::MaterialCase asked = batio3();
  asked.constants["c44"] = -1;
  EXPECT_THROW(constants_of(asked), CaseError);
  asked = batio3();
  asked.constants["p3"] = 1;  // beyond sqrt(beta33 alpha) = 0.01
  EXPECT_THROW(constants_of(asked), CaseError);
}

TEST(Material, AConductivityThatIsNotPositiveIsRefused) {
  for (const double k11 : {0., -50.}) {
    casefile::MaterialCase asked = batio3();
    asked.constants["k11"] = k11;
    EXPECT_THROW(constants_of(asked), CaseError) << k11;
  }
}

TEST(Material, AMisspeltNameIsAnsweredWithTheNearest) {
  try {
    casefile::MaterialCase asked;
    asked.library = "BaTiO3-Lui2014";
    find(asked);
    FAIL();
  } catch (const CaseError &error) {
    EXPECT_NE(std::string(error.what()).find("\"BaTiO3-Liu2014\""), std::string::npos);
  }
}

TEST(Material, PlaneStrainIsRefusedWherePlaneFieldsDriveADisplacementOutOfThePlane) {
  Constants c = constants_of(batio3());  // crystal axis 3 along z: e15 couples E_x to eps_xz
  EXPECT_THROW(restricted<2>(c), CaseError);
}

}  // namespace
}  // namespace tourmaline::material
