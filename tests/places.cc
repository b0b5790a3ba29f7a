#include "places.h"

const char *const tests_source_dir = SOURCE_DIR;
const char *const tests_program = PROGRAM;
