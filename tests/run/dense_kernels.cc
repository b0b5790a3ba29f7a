#include "run/dense_kernels.h"

#include <gtest/gtest.h>

namespace tourmaline::run {
namespace {

TEST(DenseKernels, OnAProcessorThatOpenBlasDoesNotKnowTheyAreThoseOfItsInstructions) {
  EXPECT_EQ(better_kernels("Prescott", Instructions::avx512), "SkylakeX");
  EXPECT_EQ(better_kernels("Prescott", Instructions::avx2), "Haswell");
  EXPECT_EQ(better_kernels("Zen", Instructions::avx512), "SkylakeX");
  EXPECT_EQ(better_kernels("Sandybridge", Instructions::avx2), "Haswell");
}

TEST(DenseKernels, WhereOpenBlasUsesAllInstructionsItIsLeftAlone) {
  EXPECT_EQ(better_kernels("Cooperlake", Instructions::avx512), "");
  EXPECT_EQ(better_kernels("Zen", Instructions::avx2), "");
  EXPECT_EQ(better_kernels("Haswell", Instructions::avx2), "");
  EXPECT_EQ(better_kernels("Prescott", Instructions::basic), "");
}

TEST(DenseKernels, WhatIsSetIsNeverBelowWhatItReplaces) {
  for (const Instructions offered : {Instructions::avx2, Instructions::avx512})
    EXPECT_EQ(instructions_of(better_kernels("Prescott", offered)), offered);
}

}  // namespace
}  // namespace tourmaline::run
