#pragma once

#include <CLI/CLI.hpp>
#include <functional>

/// What `main` does with its arguments, of which the first is the program's name: its exit status.
using CommandLine = std::function<int(int argc, char **argv)>;

/// `tourmaline sweep`, whose members run by the `program` of that name. Leaves in `status` what the
/// program is to end with; throws what the library throws.
void add_sweep(CLI::App &app, char *name, const CommandLine &program, int &status);
