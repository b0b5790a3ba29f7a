#include <gtest/gtest.h>

#include "material/orientation.h"
#include "material/plane.h"
#include "tourmaline/case/case.h"

namespace tourmaline::material {
namespace {

// A crystal that couples everything with everything, turned out of the plane.
Constants turned() {
  casefile::MaterialCase asked;
  asked.library = "BaTiO3-Liu2014";
  const Tensor r = Eigen::AngleAxisd(0.7, Vector(1, 2, 3).normalized()).toRotationMatrix();
  return rotated(constants_of(asked), r);
}

// A state of the plane, of which the strains across it follow from there being no stress.
struct Sheet {
  Constants c = turned();
  Voigt strain;
  Vector field{3e4, -7e4, 0};
  double theta = 1.5;

  Sheet() {
    strain << 3e-5, -2e-5, 0, 0, 0, 4e-5;
    strain.segment<3>(2) = strains_across(c, strain, field, theta);
  }
};

TEST(PlaneStress, HasNoStressAcrossThePlane) {
  const Sheet s;
  const Voigt stress = s.c.stiffness * s.strain - s.c.piezoelectric.transpose() * s.field -
                       s.c.thermal_stress * s.theta;
  EXPECT_LT(stress.segment<3>(2).norm(), 1e-12 * stress.norm());
  EXPECT_GT(s.strain.segment<3>(2).norm(), 1e-6);
}

TEST(PlaneStress, StressChargeAndEntropyOfThePlaneAreThoseOfTheSolid) {
  const Sheet s;
  const BodyConstants<2> plane = restricted<2>(s.c, Plane::stress);
  Eigen::Vector4d strain;  // eps_zz is 0 here, whatever it is in the solid
  strain << s.strain[0], s.strain[1], 0, s.strain[5];
  const Eigen::Vector2d field = s.field.head<2>();
  const Voigt stress = s.c.stiffness * s.strain - s.c.piezoelectric.transpose() * s.field -
                       s.c.thermal_stress * s.theta;
  const Eigen::Vector4d of_plane = plane.stiffness * strain -
                                   plane.piezoelectric.transpose() * field -
                                   plane.thermal_stress * s.theta;
  EXPECT_LT((of_plane - Eigen::Vector4d(stress[0], stress[1], 0, stress[5])).norm(),
            1e-12 * stress.norm());
  const Vector charge =
      s.c.piezoelectric * s.strain + s.c.permittivity * s.field + s.c.pyroelectric * s.theta;
  const Eigen::Vector2d charge_of_plane =
      plane.piezoelectric * strain + plane.permittivity * field + plane.pyroelectric * s.theta;
  EXPECT_LT((charge_of_plane - charge.head<2>()).norm(), 1e-12 * charge.norm());
  const double entropy = s.c.thermal_stress.dot(s.strain) + s.c.pyroelectric.dot(s.field) +
                         s.c.heat_capacity() * s.theta;
  EXPECT_NEAR(plane.thermal_stress.dot(strain) + plane.pyroelectric.dot(field) +
                  plane.heat_capacity * s.theta,
              entropy, 1e-12 * entropy);
}

// E / (1 - nu^2) and E nu / (1 - nu^2), beside (lambda + 2 G) and lambda in plane strain.
TEST(PlaneStress, OfAnIsotropicMaterialHasTheStiffnessOfASheet) {
  casefile::MaterialCase asked;
  asked.symmetry = "isotropic";
  asked.constants = {{"young", 2e11},
                     {"poisson", 0.3},
                     {"eps11", 1},
                     {"k11", 1},
                     {"density", 1},
                     {"specific_heat", 1},
                     {"reference_temperature", 300}};
  const auto stiffness = restricted<2>(constants_of(asked), Plane::stress).stiffness;
  EXPECT_NEAR(stiffness(0, 0), 2e11 / 0.91, 1);
  EXPECT_NEAR(stiffness(0, 1), 0.3 * 2e11 / 0.91, 1);
  EXPECT_NEAR(stiffness(3, 3), 2e11 / 2.6, 1);
}

}  // namespace
}  // namespace tourmaline::material
