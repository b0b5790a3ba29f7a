#pragma once

// Where the sources and the program are. As names and not as definitions of the compiler, so that
// what it makes of a test is the same in every clone.
extern const char *const tests_source_dir;
extern const char *const tests_program;
#define TOURMALINE_SOURCE_DIR tests_source_dir
#define TOURMALINE_BINARY tests_program
