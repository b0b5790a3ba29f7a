#include <gtest/gtest.h>

#include "run/process.h"

// MPI can be started only once in a process, so all tests of an executable share it.
int main(int argc, char **argv) {
  testing::InitGoogleTest(&argc, argv);
  const tourmaline::run::Process process(1);
  return RUN_ALL_TESTS();
}
