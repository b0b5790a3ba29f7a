#pragma once

#include <CLI/CLI.hpp>

/// `tourmaline sweep`. Leaves in `status` what the program is to end with; throws what the library
/// throws.
void add_sweep(CLI::App &app, int &status);
