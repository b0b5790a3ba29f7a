#pragma once

#include <map>
#include <string>

namespace tourmaline::run {

/// Tourmaline's version.
std::string program_version();

/// Versions of the libraries in use, by name, the BLAS with its kernels.
std::map<std::string, std::string> component_versions();

}  // namespace tourmaline::run
