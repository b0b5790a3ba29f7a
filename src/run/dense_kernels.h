#pragma once

#include <string>
#include <string_view>

namespace tourmaline::run {

/// What the kernels of a BLAS may be written with, each with all before it.
enum class Instructions { basic, avx2, avx512 };

/// What this processor and its operating system offer.
Instructions offered_instructions();

/// What OpenBLAS's kernels for the processor that it calls `core` use.
Instructions instructions_of(std::string_view core);

/// The value of OPENBLAS_CORETYPE that gives kernels with all `offered` instructions; empty where
/// those for `core` use them. OpenBLAS falls back to kernels of 2004 on processors that are newer
/// than itself.
std::string better_kernels(std::string_view core, Instructions offered);

/// OpenBLAS's name of the processor whose kernels it uses.
std::string dense_kernels();

/// OpenBLAS reads OPENBLAS_CORETYPE before `main` begins, so where other kernels are better the
/// program `argv` starts itself once more; where the user has set that variable it is left alone.
void start_again_with_better_kernels(char **argv);

}  // namespace tourmaline::run
