#pragma once

#include "tourmaline/case/range.h"

/// Sizes that can be meant, by what a number is: orders of magnitude beyond materials and devices,
/// and wide enough for problems whose units are scaled so that constants are about 1. What lies
/// outside is a slip of the pen, and products of such numbers leave double precision.
namespace tourmaline::casefile::sense {

constexpr Sense length{1e-12, 1e9};  ///< of a body or a part of it, with a width [m]
constexpr Sense coordinate{0, 1e9};  ///< [m]
constexpr Sense direction{0, 1e12};  ///< entry of a vector whose length does not matter
constexpr Sense time{1e-18, 1e18};   ///< [s]

constexpr Sense stiffness{1e-3, 1e18};            ///< [Pa]
constexpr Sense compliance{1e-18, 1e3};           ///< [1/Pa]
constexpr Sense elastic_coupling{0, 1e18};        ///< c12, ... [Pa]
constexpr Sense compliant_coupling{0, 1e3};       ///< s12, ... [1/Pa]
constexpr Sense stress_coefficient{0, 1e9};       ///< e [C/m^2]
constexpr Sense strain_coefficient{0, 1e3};       ///< d [C/N]
constexpr Sense permittivity{1e-15, 1e6};         ///< [C/(V m)]
constexpr Sense permittivity_entry{0, 1e6};       ///< [C/(V m)]
constexpr Sense relative_permittivity{1, 1e12};   ///< [1]
constexpr Sense thermal_stress{0, 1e15};          ///< [N/(K m^2)]
constexpr Sense thermal_expansion{0, 1e3};        ///< [1/K]
constexpr Sense pyroelectric{0, 1e6};             ///< [C/(K m^2)]
constexpr Sense conductivity{1e-12, 1e12};        ///< [W/(K m)]
constexpr Sense conductivity_entry{0, 1e12};      ///< [W/(K m)]
constexpr Sense density{1e-12, 1e12};             ///< [kg/m^3]
constexpr Sense specific_heat{1e-9, 1e12};        ///< [J/(kg K)]
constexpr Sense absolute_temperature{1e-9, 1e9};  ///< [K]

constexpr Sense traction{0, 1e18};                ///< and friction bounds [N/m^2]
constexpr Sense volume_force{0, 1e24};            ///< [N/m^3]
constexpr Sense potential{0, 1e15};               ///< [V]
constexpr Sense velocity{0, 1e12};                ///< [m/s]
constexpr Sense acceleration{0, 1e18};            ///< [m/s^2]
constexpr Sense damping_time{0, 1e12};            ///< [s]
constexpr Sense damping_rate{0, 1e18};            ///< [1/s]
constexpr Sense charge{0, 1e12};                  ///< [C], [C/m^2] and [C/m^3]
constexpr Sense temperature{0, 1e12};             ///< difference [K]
constexpr Sense heat_flux{0, 1e24};               ///< [W/m^2]
constexpr Sense heat_source{0, 1e30};             ///< [W/m^3]
constexpr Sense heat_exchange{0, 1e18};           ///< [W/(K m^2)]
constexpr Sense charge_exchange{0, 1e12};         ///< [F/m^2], [S/m^2]
constexpr Sense contact_compliance{1e-12, 1e60};  ///< [N/m^(2+m)], [N s/m^3]
constexpr Sense contact_exponent{0, 1e2};         ///< [1]
constexpr Sense friction{0, 1e6};                 ///< coefficients [1]
constexpr Sense slip{1e-24, 1e9};                 ///< [m]
constexpr Sense slip_rate{1e-24, 1e12};           ///< [m/s]
constexpr Sense resistance{1e-12, 1e24};          ///< [ohm]
constexpr Sense capacitance{1e-24, 1e12};         ///< [F]

constexpr Sense augmentation{1e-6, 1e30};  ///< of the augmented Lagrangian [N/m^3], [N s/m^3]
constexpr Sense tolerance{1e-30, 1};       ///< [1]
constexpr Sense ratio{0, 1e9};             ///< of cell sizes [1]

}  // namespace tourmaline::casefile::sense
