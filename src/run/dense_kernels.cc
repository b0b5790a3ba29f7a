#include "run/dense_kernels.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <system_error>

extern "C" char *openblas_get_corename();

namespace tourmaline::run {
namespace {

constexpr const char *setting = "OPENBLAS_CORETYPE";

}  // namespace

Instructions offered_instructions() {
#ifdef __x86_64__
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
      __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl"))
    return Instructions::avx512;
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
    return Instructions::avx2;
#endif
  return Instructions::basic;
}

Instructions instructions_of(std::string_view core) {
  constexpr std::array<std::string_view, 3> avx512{"SkylakeX", "Cooperlake", "SapphireRapids"};
  constexpr std::array<std::string_view, 3> avx2{"Haswell", "Zen", "Excavator"};
  if (std::ranges::find(avx512, core) != avx512.end())
    return Instructions::avx512;
  return std::ranges::find(avx2, core) != avx2.end() ? Instructions::avx2 : Instructions::basic;
}

std::string better_kernels(std::string_view core, Instructions offered) {
  if (offered <= instructions_of(core))
    return "";
  return offered == Instructions::avx512 ? "SkylakeX" : "Haswell";
}

std::string dense_kernels() {
  return openblas_get_corename();
}

void start_again_with_better_kernels(char **argv) {
  const std::string better = better_kernels(dense_kernels(), offered_instructions());
  if (better.empty() || std::getenv(setting))
    return;
  // The link itself would give the process the name "exe".
  std::error_code error;
  const auto program = std::filesystem::read_symlink("/proc/self/exe", error);
  if (error || setenv(setting, better.c_str(), 1) != 0)
    return;
  execv(program.c_str(), argv);
  unsetenv(setting);  // where that did not go, as before
}

}  // namespace tourmaline::run
