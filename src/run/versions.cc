#include "run/versions.h"

#include <deal.II/base/config.h>
#include <dmumps_c.h>
#include <fmt/format.h>
#include <metis.h>

#include "run/dense_kernels.h"

extern "C" char *openblas_get_config();

namespace tourmaline::run {

std::string program_version() {
  return TOURMALINE_VERSION;
}

std::map<std::string, std::string> component_versions() {
  return {{"deal.II", DEAL_II_PACKAGE_VERSION},
          {"MUMPS", MUMPS_VERSION},
          {"METIS", fmt::format("{}.{}.{}", METIS_VER_MAJOR, METIS_VER_MINOR, METIS_VER_SUBMINOR)},
          {"BLAS", fmt::format("{} ({})", openblas_get_config(), dense_kernels())}};
}

}  // namespace tourmaline::run
