#include "library_text.h"

namespace tourmaline::material {

// Constants in SI units; each entry says where its numbers are from. What its source does not give
// is listed in `not_given`, and a case must add it. 293 K stands for room temperature, at which the
// constants were measured.
const std::string_view library_text = R"toml(
[BaTiO3-Liu2014]
source = "P. Liu et al., Int. J. Solids Struct. 51 (2014) 2167-2182, as used by Ouafik (2020), section 4. The pyroelectric constant is p3 = -1e-4 as printed; see docs/paper-notes.md for the sign that fits the paper's figures better. c12 = 77 GPa completes the set in three dimensions."
symmetry = "6mm"
c11 = 166e9
c12 = 77e9
c13 = 78e9
c33 = 162e9
c44 = 43e9
e31 = -4.4
e33 = 18.6
e15 = 11.6
beta11 = 11.2e-9
beta33 = 12.6e-9
m11 = 2.24e6
m33 = 1.89e6
p3 = -1e-4
k11 = 50
k33 = 75
density = 5500
specific_heat = 420
reference_temperature = 293

[BaTiO3-Jaffe1971]
source = "Ceramic, B. Jaffe, W. R. Cook, H. Jaffe, Piezoelectric Ceramics (1971), and D. A. Berlincourt, D. R. Curran, H. Jaffe in W. P. Mason (ed.), Physical Acoustics I A (1964): strain-charge form, permittivity at constant stress"
not_given = ["a11", "a33", "p3", "k11", "k33", "specific_heat"]
symmetry = "6mm"
s11 = 9.1e-12
s12 = -2.7e-12
s13 = -2.9e-12
s33 = 9.5e-12
s44 = 22.8e-12
d31 = -78e-12
d33 = 190e-12
d15 = 260e-12
eps11_T = 1450
eps33_T = 1700
density = 5700
reference_temperature = 293

[PZT-4]
source = "B. Jaffe, W. R. Cook, H. Jaffe, Piezoelectric Ceramics (1971), and D. A. Berlincourt, D. R. Curran, H. Jaffe in W. P. Mason (ed.), Physical Acoustics I A (1964): strain-charge form, permittivity at constant stress"
not_given = ["a11", "a33", "p3", "k11", "k33", "specific_heat"]
symmetry = "6mm"
s11 = 12.3e-12
s12 = -4.05e-12
s13 = -5.31e-12
s33 = 15.5e-12
s44 = 39.0e-12
d31 = -123e-12
d33 = 289e-12
d15 = 496e-12
eps11_T = 1475
eps33_T = 1300
density = 7500
reference_temperature = 293

[PZT-5A]
source = "B. Jaffe, W. R. Cook, H. Jaffe, Piezoelectric Ceramics (1971), and D. A. Berlincourt, D. R. Curran, H. Jaffe in W. P. Mason (ed.), Physical Acoustics I A (1964): strain-charge form, permittivity at constant stress"
not_given = ["a11", "a33", "p3", "k11", "k33", "specific_heat"]
symmetry = "6mm"
s11 = 16.4e-12
s12 = -5.74e-12
s13 = -7.22e-12
s33 = 18.8e-12
s44 = 47.5e-12
d31 = -171e-12
d33 = 374e-12
d15 = 584e-12
eps11_T = 1730
eps33_T = 1700
density = 7750
reference_temperature = 293

[PZT-5H]
source = "D. A. Berlincourt, H. H. A. Krueger, C. Near, Properties of Morgan Electro Ceramic Ceramics, technical publication TP-226; B. Jaffe, W. R. Cook, H. Jaffe, Piezoelectric Ceramics (1971): strain-charge form, permittivity at constant stress"
not_given = ["a11", "a33", "p3", "k11", "k33", "specific_heat"]
symmetry = "6mm"
s11 = 16.5e-12
s12 = -4.78e-12
s13 = -8.45e-12
s33 = 20.7e-12
s44 = 43.5e-12
d31 = -274e-12
d33 = 593e-12
d15 = 741e-12
eps11_T = 3130
eps33_T = 3400
density = 7500
reference_temperature = 293

[PVDF]
source = "Uniaxially drawn and poled film, axis 1 along the drawing: Y. Roh, V. V. Varadan, V. K. Varadan, IEEE Trans. Ultrason. Ferroelectr. Freq. Control 49 (2002) 836-847: stress-charge form, permittivity at constant strain. Not compared with the printed table, but the set agrees with itself: it yields d31, d32, d33, d24, d15 = 21, 1.5, -32.5, -23, -27 pC/N and relative permittivities of 6.1, 7.5, 6.7. Density: makers' data sheets of such film"
not_given = ["a11", "a22", "a33", "p3", "k11", "k22", "k33", "specific_heat"]
symmetry = "mm2"
c11 = 3.61e9
c12 = 1.61e9
c13 = 1.42e9
c22 = 3.13e9
c23 = 1.31e9
c33 = 1.63e9
c44 = 0.55e9
c55 = 0.59e9
c66 = 0.69e9
e31 = 32.075e-3
e32 = -4.07e-3
e33 = -21.19e-3
e24 = -12.65e-3
e15 = -15.93e-3
beta11 = 53.985e-12
beta22 = 66.375e-12
beta33 = 59.295e-12
density = 1780
reference_temperature = 293

[AlN]
source = "K. Tsubouchi, K. Sugai, N. Mikoshiba, Proc. IEEE Ultrasonics Symp. (1981) 375-380, and K. Tsubouchi, N. Mikoshiba, IEEE Trans. Sonics Ultrason. 32 (1985) 634-644: stress-charge form, permittivity at constant strain. The stiffness is that which the Material Properties Open Database gives for these authors (entry 1000161), e that which is quoted from the NSM archive of the Ioffe Institute; the permittivity was not compared with the papers (NSM archive: 9.14 eps0). Density: of the lattice cell"
not_given = ["a11", "a33", "p3", "k11", "k33", "specific_heat"]
symmetry = "6mm"
c11 = 345e9
c12 = 125e9
c13 = 120e9
c33 = 395e9
c44 = 118e9
e31 = -0.58
e33 = 1.55
e15 = -0.48
beta11 = 8.0e-11
beta33 = 9.5e-11
density = 3260
reference_temperature = 293

[LiNbO3]
source = "A. W. Warner, M. Onoe, G. A. Coquin, J. Acoust. Soc. Am. 42 (1967) 1223-1231: stress-charge form, relative permittivity at constant strain"
not_given = ["a11", "a33", "p3", "k11", "k33", "specific_heat"]
symmetry = "3m"
c11 = 203e9
c12 = 53e9
c13 = 75e9
c14 = 9e9
c33 = 245e9
c44 = 60e9
e15 = 3.7
e22 = 2.5
e31 = 0.2
e33 = 1.3
eps11 = 44
eps33 = 29
density = 4700
reference_temperature = 293

[quartz]
source = "Alpha quartz, R. Bechmann, Phys. Rev. 110 (1958) 1060-1061: stress-charge form, permittivity at constant strain, axes of the IRE standard of 1949; thermal expansion: R. Bechmann, A. D. Ballato, T. J. Lukaszek, Proc. IRE 50 (1962) 1812-1822. Class 32 has no pyroelectricity"
not_given = ["k11", "k33", "specific_heat"]
symmetry = "32"
c11 = 86.74e9
c12 = 6.99e9
c13 = 11.91e9
c14 = -17.91e9
c33 = 107.2e9
c44 = 57.94e9
e11 = 0.171
e14 = -0.0406
beta11 = 39.21e-12
beta33 = 41.03e-12
a11 = 13.71e-6
a33 = 7.48e-6
density = 2649
reference_temperature = 293

[tourmaline]
source = "Elastic constants: B. A. Auld, Acoustic Fields and Waves in Solids I (1973), appendix 2; d: W. P. Mason, Piezoelectric Crystals and Their Application to Ultrasonics (1950); permittivity at constant stress. Not compared with the printed tables; d33 and d33 + 2 d31 are 8 and 5 per cent above the means over 20 crystals of L. B. Geesaman, J. R. Hearst, D. V. Power, J. Appl. Phys. 35 (1964) 2145-2150, from which single crystals differ by up to 15. Elastic constants of other authors differ by up to 21 per cent, more than the composition explains"
not_given = ["a11", "a33", "p3", "k11", "k33", "specific_heat"]
symmetry = "3m"
c11 = 272e9
c12 = 40e9
c13 = 35e9
c14 = -6.8e9
c33 = 165e9
c44 = 65e9
d15 = 3.63e-12
d22 = -0.33e-12
d31 = 0.34e-12
d33 = 1.83e-12
eps11_T = 8.2
eps33_T = 7.5
density = 3100
reference_temperature = 293

[steel]
source = "Structural steel at 20 C: EN 1993-1-1 (2005), section 3.2.6; heat: EN 1993-1-2 (2005), section 3.4.1; density: EN 1991-1-1"
symmetry = "isotropic"
conductor = true
young = 210e9
poisson = 0.3
a11 = 12e-6
k11 = 53.3
density = 7850
specific_heat = 439.8
reference_temperature = 293

[aluminium]
source = "Alloys at 20 C: EN 1999-1-1 (2007), section 3.2.5; heat: EN 1999-1-2 (2007), section 3.3, series 3xxx and 6xxx"
symmetry = "isotropic"
conductor = true
young = 70e9
poisson = 0.3
a11 = 23e-6
k11 = 191.4
density = 2700
specific_heat = 911.2
reference_temperature = 293

[silicon]
source = "Crystal, axes along its cubic ones: J. J. Hall, Phys. Rev. 161 (1967) 756-761 (elasticity); S. M. Sze, Physics of Semiconductor Devices (1981), appendix (permittivity, specific heat, expansion); NSM archive of the Ioffe Institute (density); C. J. Glassbrenner, G. A. Slack, Phys. Rev. 134 (1964) A1058-A1069 (conductivity at 300 K). An insulator here; `conductor = true` for highly doped silicon needs a material of one's own without eps11"
symmetry = "cubic"
c11 = 165.64e9
c12 = 63.94e9
c44 = 79.51e9
eps11 = 11.9
a11 = 2.6e-6
k11 = 148
density = 2329
specific_heat = 700
reference_temperature = 293
)toml";

}  // namespace tourmaline::material
