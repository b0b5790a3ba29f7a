#pragma once

namespace tourmaline::run {

/// What one core of this machine does: the floors of a factorisation and of its substitutions.
struct MachineSpeed {
  double reading = 0;     ///< bytes a second, from memory
  double taking = 0;      ///< bytes a second of memory that the process had not had before
  double operations = 0;  ///< multiplications and additions a second, in OpenBLAS's matrix product
};

/// The best of so many trials, each of about a seventh of a second. Throws MachineError where there
/// are no 128 MiB for it.
MachineSpeed measured_speed(int trials);

}  // namespace tourmaline::run
