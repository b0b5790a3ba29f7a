// Label: analytic. Measured in other units, the same body does the same.

#include "image.h"

namespace tourmaline::verified {
namespace {

// The paper's case in millimetres, newtons, seconds, kelvins and volts. Energy is then in N mm = mJ
// and charge in mJ/V = mC; a density times a specific heat is in mJ/(mm^3 K).
std::vector<std::string> in_millimetres() {
  return {"mesh.box.max=[100,100]",
          "material.c11=166e3",  // N/mm^2
          "material.c12=77e3",
          "material.c13=78e3",
          "material.c33=162e3",
          "material.c44=43e3",
          "material.e31=-4.4e-3",  // mC/mm^2
          "material.e33=18.6e-3",
          "material.e15=11.6e-3",
          "material.beta11=11.2e-9",  // mC/(V mm)
          "material.beta33=12.6e-9",
          "material.m11=2.24",  // N/(K mm^2)
          "material.m33=1.89",
          "material.pyroelectric=[5e-8,1e-7]",  // mC/(K mm^2)
          "material.k11=50",                    // N/(s K)
          "material.k33=75",
          "material.density=5500e-12",     // N s^2/mm^4
          "material.specific_heat=420e6",  // mm^2/(s^2 K)
          "boundary[2].traction=['3e-6*t','-5e-6*t']",
          "contact.friction.bound=12e-6",
          "contact.heat.coefficient=1e-3"};  // N/(s K mm)
}

TEST(Units, MillimetresInsteadOfMetresChangeNothingButTheNumbers) {
  Image image;
  image.length = 1e3;
  image.stress = 1e-6;
  image.heat_flux = 1e-3;
  expect_image(RunCase(paper()), RunCase(paper(in_millimetres())), image);
}

TEST(Units, EnergiesOfOneMillimetreOfDepthInMillijoulesAreThoseOfOneMetreInJoules) {
  const Table metres = RunCase(paper()).history(),
              millimetres = RunCase(paper(in_millimetres())).history();
  for (const char *energy : {"elastic_energy", "electric_energy", "thermal_energy"})
    EXPECT_LT(difference(millimetres, metres, energy), round_off) << energy;
}

}  // namespace
}  // namespace tourmaline::verified
