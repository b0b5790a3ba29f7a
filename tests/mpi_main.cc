#include <gtest/gtest.h>

#include "run/process.h"

int main(int argc, char **argv) {
  testing::InitGoogleTest(&argc, argv);
  tourmaline::run::start_process(1);
  return RUN_ALL_TESTS();
}
